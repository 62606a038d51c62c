"""The robot.toml that comes with the project shows the defaults and nothing else."""

from __future__ import annotations

from pathlib import Path

import pytest

from pons.settings import CHECKOUT
from wire import RobotDescription, load_robot

PRESETS = sorted((CHECKOUT / "robots").glob("*.toml"))


def test_it_states_the_defaults(repository: Path) -> None:
    assert load_robot(repository / "robot.toml") == RobotDescription()


@pytest.mark.parametrize("path", PRESETS, ids=lambda path: path.stem)
def test_each_preset_loads_and_says_whether_metal_was_tried(path: Path) -> None:
    robot = load_robot(path)
    assert not robot.drive.virtual
    assert "tried on metal:" in path.read_text("utf-8").lower()
