"""A speed limit of the owner's only lowers, and reaches what routes and hands ask for."""

from __future__ import annotations

from pathlib import Path
from typing import Any, cast

import pytest

from planner.navigation import RouteLimits
from planner.robot_service import LinkedRobot
from planner.settings import FILE, load_settings
from tests.wire.examples import STATUS
from wire import RobotDescription, Velocity


@pytest.mark.parametrize(("text", "mps"), [("", 0.5), ("0.2", 0.2), ("1.5", 0.5)])
def test_a_limit_of_the_owners_only_lowers(tmp_path: Path, text: str, mps: float) -> None:
    written = f"[limits]\nmax_speed_mps = {text}\n" if text else ""
    (tmp_path / FILE).write_text(written, "utf-8")
    limits = load_settings(tmp_path, {}).limits
    robot = RobotDescription()
    assert limits.lower_speed(robot.limits.max_speed_mps) == mps
    assert RouteLimits.of(robot, limits.max_speed_mps).max_speed_mps == mps


class HeardLink:
    """Keep what a hand is relayed as."""

    def __init__(self) -> None:
        self.said: list[Velocity] = []
        self.status = type("Aged", (), {"value": STATUS})()

    def teleop(self, velocity: Velocity) -> None:
        self.said.append(velocity)


def test_no_hand_is_relayed_faster() -> None:
    link = HeardLink()
    robot = LinkedRobot(cast("Any", link), RobotDescription(), 0.2)
    for asked in (0.5, -0.5, 0.1):
        robot.steer("a", asked, 0.3, dead_man=True)
    assert [(one.v_mps, one.w_radps) for one in link.said] == [(0.2, 0.3), (-0.2, 0.3), (0.1, 0.3)]
