"""What the owner sets about goals is what the missions are bounded by."""

from __future__ import annotations

from dataclasses import asdict, fields
from pathlib import Path

import pytest

from planner.mission import Rules
from planner.settings import MissionSettings, load_settings
from wire import ConfigError


def test_the_settings_are_the_rules_by_name_and_by_default() -> None:
    assert MissionSettings().model_dump() == asdict(Rules())
    assert [field.name for field in fields(Rules)] == list(MissionSettings.model_fields)


@pytest.mark.parametrize(
    ("text", "taken"),
    [
        ("replans = 0\nanswer_s = 30", True),
        ("replans = -1", False),
        ("answer_s = nan", False),
        ("decides = 21", False),
        ("retries = 1", False),
    ],
)
def test_what_is_out_of_bounds_or_unknown_refuses_to_start(
    tmp_path: Path, text: str, taken: bool
) -> None:
    (tmp_path / "settings.toml").write_text(f"[mission]\n{text}\n", encoding="utf-8")
    if not taken:
        with pytest.raises(ConfigError):
            load_settings(tmp_path, {})
        return
    settings = load_settings(tmp_path, {}).mission
    assert (settings.replans, settings.decides, settings.answer_s) == (0, 3, 30.0)
