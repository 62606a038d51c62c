"""Drive arcs at given speeds as a planner or as a hand on the stick, whatever comes in the way."""

from __future__ import annotations

from typing import TYPE_CHECKING

from bridge.core.geometry.kinematics import along_arc
from tools.lockstep.hostile import HostilePlanner
from wire import Velocity, Waypoint

if TYPE_CHECKING:
    from tools.lockstep.together import LockstepWorld
    from wire import Pose2, Status


class ConstantDrive(HostilePlanner):
    """Own the robot and keep asking for the same arc."""

    def __init__(self, world: LockstepWorld) -> None:
        super().__init__(world, 0)
        self.mood, self.until_s = "steady", float("inf")
        self.metres, self.by_hand = 60.0, False
        self.v_mps, self.bend_per_m = 0.0, 0.0
        self._pressed = 0

    def turn(self) -> None:
        """Hear the newest status, echo it, and ask again."""
        status = self._ears.newest()
        if status is not None:
            self.status = status
        if self.status is None:
            return
        if status is not None:
            self._answer(status)
        tick = self._world.tick_count
        if self.by_hand:
            if tick % 5 == 0:
                self._press(self.status)
        elif tick % 10 == 0:
            self._horizon(self.status)

    def drive(self, v_mps: float, bend_per_m: float, *, by_hand: bool) -> None:
        """Ask for this from now on."""
        self.v_mps, self.bend_per_m, self.by_hand = v_mps, bend_per_m, by_hand
        self._pressed = 0
        self.mission = f"m{self.seq}"
        self.leg += 1

    def _press(self, status: Status) -> None:
        self.seq += 1
        self._pressed += 1
        held = self._pressed > 3  # seen released and neutral first
        turn = self.v_mps * self.bend_per_m if self.v_mps > 0.0 else -self.v_mps * self.bend_per_m
        velocity = Velocity(
            source_id="page",
            epoch=status.epoch,
            seq=self.seq,
            seen=status.seq,
            v_mps=self.v_mps if held else 0.0,
            w_radps=turn if held else 0.0,
            dead_man=held,
        )
        self._say("cmd/teleop", velocity)

    def _points(self, here: Pose2) -> tuple[Waypoint, ...]:
        """Lead on along the arc from where the robot is."""
        step = 0.1 if self.v_mps > 0.0 else -0.1
        poses = [along_arc(here, step * i, abs(step) * i * self.bend_per_m) for i in range(20)]
        return tuple(Waypoint(x_m=p.x_m, y_m=p.y_m, speed_mps=self.v_mps) for p in poses)
