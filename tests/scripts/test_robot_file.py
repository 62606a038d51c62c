"""Check the shipped robot.toml: it loads, hides no value, and says what the code's defaults say."""

from __future__ import annotations

import tomllib
from pathlib import Path

from wire import RobotDescription, load_robot


def test_shipped_robot_is_the_default_robot(repository: Path) -> None:
    assert load_robot(repository / "robot.toml") == RobotDescription()


def test_shipped_robot_shows_every_value(repository: Path) -> None:
    shown = tomllib.loads((repository / "robot.toml").read_text("utf-8"))
    assert shown == RobotDescription().model_dump(mode="json", exclude_none=True)
