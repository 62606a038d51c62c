"""The bridge says first of all which robot it took: nobody is to drive by defaults unawares."""

from __future__ import annotations

import logging
from pathlib import Path

import pytest

from bridge.__main__ import _robot
from wire import RobotDescription

ROBOT = Path(__file__).resolve().parents[2] / "robot.toml"


@pytest.mark.parametrize(
    ("path", "said"), [(ROBOT, str(ROBOT)), (None, "the built-in default: no --robot was given")]
)
def test_it_says_which_robot_it_took(
    path: Path | None, said: str, caplog: pytest.LogCaptureFixture
) -> None:
    with caplog.at_level(logging.INFO, "bridge"):
        robot = _robot(path)
    assert caplog.messages == [f"robot: {said}"]
    assert path is not None or robot == RobotDescription()
