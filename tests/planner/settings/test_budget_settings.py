"""Check what the owner may set about spending, and that what nobody could keep refuses to start."""

from __future__ import annotations

from pathlib import Path

import pytest

from planner.settings import FILE, BudgetSettings, load_settings
from wire import ConfigError

LOCAL = '[model]\nurl = "http://127.0.0.1:11434/v1"\nname = "qwen3:8b"\n'
WHOLE = """
[budget.goal]
calls = 4
[budget.day]
calls = 100
money = 0.5
[budget.price]
prompt_per_million = 0.4
reply_per_million = 1.6
currency = "CNY"
"""


def test_there_are_limits_without_a_word(tmp_path: Path) -> None:
    found = load_settings(tmp_path, {}).budget
    assert found == BudgetSettings()
    assert 0 < found.goal.calls <= found.day.calls


def test_limits_and_prices_are_data(tmp_path: Path) -> None:
    (tmp_path / FILE).write_text(WHOLE)
    found = load_settings(tmp_path, {}).budget
    assert (found.goal.calls, found.day.calls, found.day.money) == (4, 100, 0.5)
    assert found.price is not None
    assert (found.price.reply_per_million, found.price.currency) == (1.6, "CNY")


@pytest.mark.parametrize(
    ("text", "code", "told"),
    [
        ("[budget]\ncals = 3\n", "settings_malformed", "unknown key 'budget.cals'"),
        ("[budget.goal]\ncals = 3\n", "settings_malformed", "known: calls, prompt_tokens"),
        ("[budget.week]\n", "settings_malformed", "known: goal, day, price"),
        ("[budget.price]\nper_million = 3\n", "settings_malformed", "known: prompt_per_million"),
        ("budget = 3\n", "settings_malformed", "budget"),
        ("[budget.day]\ncalls = -1\n", "settings_malformed", "budget.day.calls"),
        ("[budget.day]\ncalls = 1.5\n", "settings_malformed", "budget.day.calls"),
        ("[budget.day]\ncalls = inf\n", "settings_malformed", "budget.day.calls"),
        ("[budget.day]\nseconds = nan\n", "settings_malformed", "budget.day.seconds"),
        ("[budget.price]\nreply_per_million = -2\n", "settings_malformed", "reply_per_million"),
        ('[budget.price]\ncurrency = "€ 2"\n', "settings_malformed", "currency"),
        ("[budget.day]\nmoney = 2.0\n", "budget_contradictory", "needs [budget.price]"),
        (LOCAL + "[budget.goal]\nreply_tokens = 50\n", "budget_contradictory", "max_tokens"),
    ],
)
def test_what_nobody_could_keep_refuses_to_start(
    text: str, code: str, told: str, tmp_path: Path
) -> None:
    (tmp_path / FILE).write_text(text)
    with pytest.raises(ConfigError) as wrong:
        load_settings(tmp_path, {})
    assert wrong.value.code == code
    assert told in str(wrong.value)
