"""What a model costs where the owner has set no price; the file is held to genai-prices."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import pytest
from genai_prices.data import providers
from genai_prices.types import ModelPrice

from planner.settings import FILE, Price, load_settings
from planner.settings.model_prices import _read_prices, find_published_price
from scripts.model_prices import HOSTS, _base

OPENAI = "https://api.openai.com/v1"
CLOUD = f'[model]\nurl = "{OPENAI}"\nname = "gpt-4o-mini"\nkey = "k"\nallow_offhost = true\n'
OWN = "[budget.price]\nprompt_per_million = 9.0\n"


def test_a_known_model_has_its_servers_price_and_the_owners_own_wins(tmp_path: Path) -> None:
    (tmp_path / FILE).write_text(CLOUD + "[budget.day]\nmoney = 1.0\n")
    (tmp_path / FILE).chmod(0o600)
    price = load_settings(tmp_path, {}).budget.price
    assert price == Price(prompt_per_million=0.15, reply_per_million=0.6, currency="USD")
    (tmp_path / FILE).write_text(CLOUD + OWN)
    own = load_settings(tmp_path, {}).budget.price
    assert own is not None
    assert (own.prompt_per_million, own.reply_per_million) == (9.0, 0.0)


@pytest.mark.parametrize(
    ("url", "name"),
    [
        ("http://127.0.0.1:11434/v1", "gpt-4o-mini"),
        ("http://api.openai.com.example/v1", "gpt-4o-mini"),
        ("https://example.org/api.openai.com", "gpt-4o-mini"),
        (OPENAI, "a-model-of-nobody"),
        (OPENAI, ""),
        (OPENAI, "*"),
        ("https://[", "gpt-4o-mini"),
    ],
)
def test_what_is_not_known_has_no_price(url: str, name: str) -> None:
    assert find_published_price(url, name) is None


def test_a_dated_name_costs_what_its_family_does() -> None:
    url = "https://api.anthropic.com/v1"
    dated = find_published_price(url, "claude-3-5-haiku-20241022")
    assert dated is not None
    assert dated == find_published_price(url, "Claude-3-5-Haiku-latest")


def test_every_price_is_the_one_that_genai_prices_has_for_that_name() -> None:
    by_id = {each.id: each for each in providers}
    wrong = []
    for known, hosts in HOSTS.items():
        for host in hosts:
            for name in _read_prices()[host]:
                said = name.replace("*", "-20260101")
                model = by_id[known].find_model(said)
                ours = find_published_price(f"https://{host}/v1", said)
                known_as = [] if model is None else model.prices
                if isinstance(known_as, ModelPrice):
                    rows = [known_as]
                else:
                    rows = [each.prices for each in known_as]
                sent = {_base(row.input_mtok) for row in rows}
                back = {_base(row.output_mtok) for row in rows}
                if ours is None or ours.prompt_per_million not in sent:
                    wrong.append((host, said, ours, sent))
                elif ours.reply_per_million not in back:
                    wrong.append((host, said, ours, back))
    assert wrong == []


def test_a_planner_reads_the_file_alone() -> None:
    found = (
        "import sys; from planner.settings.model_prices import find_published_price as find; "
        f"assert find({OPENAI!r}, 'gpt-4o-mini'); assert 'genai_prices' not in sys.modules"
    )
    subprocess.run([sys.executable, "-c", found], check=True)
