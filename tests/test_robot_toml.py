"""The robot.toml that comes with the project shows the defaults and nothing else."""

from __future__ import annotations

from pathlib import Path

from wire import RobotDescription, load_robot


def test_it_states_the_defaults(repository: Path) -> None:
    assert load_robot(repository / "robot.toml") == RobotDescription()
