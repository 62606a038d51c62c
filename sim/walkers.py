"""Let one person walk about among spots of the floor, by a rule of who waits for whom.

Law: no step ever brings a walker nearer to the robot than its manner allows, nor into a shut leaf,
and every step stays on the floor. What the robot does about a walker is the robot's part.
"""

from __future__ import annotations

from enum import StrEnum
from math import atan2, hypot
from typing import TYPE_CHECKING

from sim.site.classes import PERSON_RADIUS_M
from wire import Pose2

if TYPE_CHECKING:
    from collections.abc import Sequence

    from sim.site.shapes import Rect
    from sim.walking_floor import Point, WalkingFloor

STOPS_M = 0.30
"""A polite person's distance from the robot's rim."""
TOUCHES_M = 0.12
PASSES_M = 0.05
"""Beside the robot there is room enough for a polite one to walk past."""
WAITS_S = 1.5
LONGER_M = 3.0
"""A way round that is longer by more than this is no walking round."""
GIVES_UP_S = 6.0
"""Whoever waited so long goes somewhere else."""
LEAF_CLEAR_M = PERSON_RADIUS_M + 0.03


class WalkerManner(StrEnum):
    """How a walker meets the robot."""

    POLITE = "polite"
    BLIND = "blind"


class ScriptedWalker:
    """Walk from spot to spot, round and round."""

    def __init__(
        self,
        name: str,
        manner: WalkerManner,
        floor: WalkingFloor,
        spots: Sequence[Point],
        speed_mps: float,
        at: Point,
    ) -> None:
        """Stand at a point of the floor; the first spot is walked to from the first step on."""
        self.name, self.manner = name, manner
        self._floor, self._spots, self._next = floor, tuple(spots), 0
        self._speed_mps = speed_mps
        self.x_m, self.y_m = at
        self._way: list[Point] = []
        self._held_s = self._waits_s = 0.0
        self.passes = False
        """Whether it is walking round the robot now."""

    def step(
        self, step_s: float, robot: Pose2, robot_radius_m: float, leaves: Sequence[Rect]
    ) -> Pose2 | None:
        """Go on for a time; return where it stands then, or None where it waits."""
        if not self._way:
            self._way = self._floor.way((self.x_m, self.y_m), self._spots[self._next])
            if not self._way:
                self._take_next()
                return None
        (x_m, y_m), passed = self._ahead(self._speed_mps * step_s)
        if self._may(x_m, y_m, robot, robot_radius_m, leaves):
            heading_rad = atan2(y_m - self.y_m, x_m - self.x_m)
            self.x_m, self.y_m, self._held_s, self._waits_s = x_m, y_m, 0.0, 0.0
            del self._way[:passed]
            if not self._way:
                self._take_next()
            return Pose2(x_m, y_m, heading_rad)
        self._wait(step_s, robot, robot_radius_m)
        return None

    def gap_m(self, robot: Pose2, robot_radius_m: float) -> float:
        """Return the distance between its rim and the robot's [m]."""
        return _gap_m(self.x_m, self.y_m, robot, robot_radius_m)

    def stand_at(self, x_m: float, y_m: float) -> None:
        """Go on from another point."""
        self.x_m, self.y_m, self._way, self.passes = x_m, y_m, [], False

    def _wait(self, step_s: float, robot: Pose2, robot_radius_m: float) -> None:
        self._held_s += step_s
        self._waits_s += step_s
        if self._held_s >= GIVES_UP_S:
            self._take_next()
        elif self.manner is WalkerManner.POLITE and self._waits_s >= WAITS_S:
            self._waits_s = 0.0
            disc = (robot.x_m, robot.y_m, robot_radius_m + PERSON_RADIUS_M + 2 * PASSES_M)
            here, goal = (self.x_m, self.y_m), self._spots[self._next]
            found = self._floor.way_round(here, goal, disc, LONGER_M)
            if found:
                self._way, self.passes = found, True

    def _take_next(self) -> None:
        self._next = (self._next + 1) % len(self._spots)
        self._way, self.passes, self._held_s, self._waits_s = [], False, 0.0, 0.0

    def _ahead(self, step_m: float) -> tuple[Point, int]:
        """Return the point that far along the way, and how many corners lie behind it then."""
        x_m, y_m = self.x_m, self.y_m
        for passed, (to_x, to_y) in enumerate(self._way):
            left_m = hypot(to_x - x_m, to_y - y_m)
            if left_m > step_m:
                share = step_m / left_m
                return (x_m + share * (to_x - x_m), y_m + share * (to_y - y_m)), passed
            x_m, y_m, step_m = to_x, to_y, step_m - left_m
        return (x_m, y_m), len(self._way)

    def _may(
        self, x_m: float, y_m: float, robot: Pose2, robot_radius_m: float, leaves: Sequence[Rect]
    ) -> bool:
        """Return whether its manner lets it stand there: away from what is near it always may."""
        least_m = TOUCHES_M
        if self.manner is WalkerManner.POLITE:
            least_m = PASSES_M if self.passes else STOPS_M
        gap_m = _gap_m(x_m, y_m, robot, robot_radius_m)
        if not (gap_m >= least_m or gap_m >= self.gap_m(robot, robot_radius_m)):
            return False
        return all(
            leaf.distance(x_m, y_m) >= LEAF_CLEAR_M
            or leaf.distance(x_m, y_m) > leaf.distance(self.x_m, self.y_m)
            for leaf in leaves
        )


def _gap_m(x_m: float, y_m: float, robot: Pose2, robot_radius_m: float) -> float:
    return hypot(x_m - robot.x_m, y_m - robot.y_m) - PERSON_RADIUS_M - robot_radius_m
