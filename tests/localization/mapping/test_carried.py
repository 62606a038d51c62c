"""Carried while it explores a robot is lost until it is put back, and never sure elsewhere."""

from __future__ import annotations

from math import hypot
from pathlib import Path

import pytest

from maps.canvas import canvas_site
from tools.lockstep import LockstepWorld
from wire import LocalizerStatus, Pose2, RobotDescription, compose, keys
from wire.keys import Party
from wire.robot import LocalizationConfig

pytestmark = pytest.mark.nightly


BEFORE_S = 8.0
ALIKE = Pose2(1.5, 5.0, 0.5)
"""In the other room, which looks much like the first from there."""


class Exploration:
    """Explore two rooms, with somebody who may carry the robot."""

    def __init__(self, folder: Path) -> None:
        robot = RobotDescription(localization=LocalizationConfig(kind="scans"))
        canvas_site(robot.base.radius_m).write(folder)
        self.world = LockstepWorld(site="two_room", canvas=folder, robot=robot, seed=1)
        assert self.world.mapping is not None
        self.builder = self.world.mapping.paced.builder
        self.start = self.world.truth
        self._heard = self.world.bus.port(Party.JUDGE).subscriber(keys.LOC_STATE)
        self.said: list[LocalizerStatus] = []
        self.world.say("explore the house")
        self.run(BEFORE_S)

    def run(self, seconds: float) -> None:
        """Let time pass; while the robot is said to be tracked, its pose must be true."""
        for _ in range(round(seconds / 0.05)):
            self.world.run(0.05)
            said = self._heard.newest()
            if said is not None:
                assert isinstance(said, LocalizerStatus)
                self.said.append(said)
            assert not self.said or self.said[-1].state != "tracking" or self.off_m() < 0.1

    def off_m(self) -> float:
        """Return how far the bridge's pose is from the truth; 0 while it has none."""
        believed = self.world.status.base_in_map
        if believed is None:
            return 0.0
        there = compose(self.start, believed)
        return hypot(there.x_m - self.world.truth.x_m, there.y_m - self.world.truth.y_m)


@pytest.mark.timeout(240)
def test_carried_to_a_room_that_looks_alike_it_is_lost_until_it_is_put_back(tmp_path: Path) -> None:
    exploration = Exploration(tmp_path / "canvas")
    world, before = exploration.world, len(exploration.said)
    was, keyframes = world.truth, len(exploration.builder.keyframes)
    world.teleport(ALIKE)
    world.run(0.2)  # the newest scan is still of where it was
    exploration.run(2.0)
    told = [one.state for one in exploration.said[before:]]
    assert told[-1] == "lost"
    assert {one.trouble for one in exploration.said if one.state == "lost"} == {
        "carried_while_mapping"
    }
    assert "POSE_LOST" in [row.row for row in world.status.rows]
    assert world.standing
    assert len(exploration.builder.keyframes) == keyframes, "nothing is written from there"
    world.teleport(Pose2(was.x_m + 0.1, was.y_m - 0.1, was.yaw_rad + 0.1))
    exploration.run(1.0)
    assert exploration.said[-1].state == "tracking"
    assert exploration.said[-1].trouble is None
    exploration.run(8.0)
    assert len(exploration.builder.keyframes) > keyframes, "it goes on"
