"""Let people walk about in a lockstep world, by rules. None of them ever steps into the robot.

A polite one stops 0.3 m before the robot, waits, and walks round it where there is room. A blind
one stops only before it would touch, and waits. Each is a disc that the simulator places.
"""

from __future__ import annotations

from enum import StrEnum
from math import atan2, cos, hypot, pi, sin
from typing import TYPE_CHECKING

from planner.navigation import RouteFailure, RouteLimits, RouteRequest
from planner.navigation.router import Router
from wire import Pose2

if TYPE_CHECKING:
    from collections.abc import Sequence

    from tools.lockstep.world import World

PERSON_M, ROBOT_M = 0.25, 0.30
STOPS_M = 0.30
"""A polite person's distance from the robot's rim."""
TOUCHES_M = 0.12
PASSES_M = 0.05
"""Beside the robot there is room enough to walk past."""
WAITS_S = 1.5
AROUND_M = 3.0
"""A way round that is longer by more than this is no walking round."""
EVERY = 5
"""Ticks between two steps: 0.05 s."""
BODY = RouteLimits(radius_m=0.20)
"""The search adds 0.05 m, which makes 0.25 m: people squeeze past each other without a margin."""


class Manner(StrEnum):
    """How a walker meets the robot."""

    POLITE = "polite"
    BLIND = "blind"


class Walker:
    """Walk from goal to goal, round and round, on the floor of the world's map."""

    def __init__(
        self,
        world: World,
        name: str,
        start: tuple[float, float],
        goals: Sequence[tuple[float, float]],
        speed_mps: float,
        manner: Manner,
        router: Router | None = None,
    ) -> None:
        """Stand at the start; the first goal is walked to from the first turn on.

        Args:
            world: where; ``turn`` is called after each of its ticks.
            name: a person or spare obstacle of its simulator.
            start: x, y in ``map`` [m].
            goals: likewise, in their order, again and again; none: stand.
            speed_mps: of walking.
            manner: how it meets the robot.
            router: finds its ways; one router may serve several walkers.
        """
        self._world, self.name, self.manner = world, name, manner
        self._router = router or Router(world.scene.site, BODY)
        self._goals, self._next, self._speed_mps = tuple(goals), 0, speed_mps
        self.x_m, self.y_m = start
        self._path: list[tuple[float, float]] = []
        self._held_s = 0.0
        self._passing = False
        self._put(0.0)

    @property
    def gap_m(self) -> float:
        """Return the distance between its rim and the robot's."""
        return self._gap_at(self.x_m, self.y_m)

    @property
    def walks(self) -> bool:
        """Tell whether it moves now."""
        return self._held_s == 0.0 and bool(self._path)

    def turn(self) -> None:
        """Take a step when one is due."""
        if self._world.tick_count % EVERY == 0 and self._goals:
            self._step(EVERY * 0.01)

    def _step(self, step_s: float) -> None:
        if not self._path and not self._plan(around=False):
            self._next = (self._next + 1) % len(self._goals)
            return
        x_m, y_m = self._ahead(self._speed_mps * step_s)
        if self._may(x_m, y_m):
            self._held_s = 0.0
            heading = atan2(y_m - self.y_m, x_m - self.x_m)
            self.x_m, self.y_m = x_m, y_m
            self._put(heading)
            return
        self._held_s += step_s
        if self.manner is Manner.POLITE and self._held_s >= WAITS_S:
            self._held_s = step_s
            self._passing = self._plan(around=True)

    def _ahead(self, step_m: float) -> tuple[float, float]:
        """Return the point that far along the path; what is passed of the path is dropped."""
        x_m, y_m = self.x_m, self.y_m
        while self._path:
            to_x, to_y = self._path[0]
            left_m = hypot(to_x - x_m, to_y - y_m)
            if left_m > step_m:
                share = step_m / left_m
                return x_m + share * (to_x - x_m), y_m + share * (to_y - y_m)
            x_m, y_m, step_m = to_x, to_y, step_m - left_m
            self._path.pop(0)
        self._next, self._passing = (self._next + 1) % len(self._goals), False
        return x_m, y_m

    def _may(self, x_m: float, y_m: float) -> bool:
        """Tell whether its manner lets it go there: away from the robot it always may."""
        gap_m = self._gap_at(x_m, y_m)
        least_m = TOUCHES_M
        if self.manner is Manner.POLITE:
            least_m = PASSES_M if self._passing else STOPS_M
        return gap_m >= least_m or gap_m >= self.gap_m

    def _gap_at(self, x_m: float, y_m: float) -> float:
        robot = self._world.truth
        return hypot(x_m - robot.x_m, y_m - robot.y_m) - PERSON_M - ROBOT_M

    def _plan(self, *, around: bool) -> bool:
        """Find the way to the goal, round the robot if asked; say whether there is one."""
        goal = self._goals[self._next]
        start = Pose2(self.x_m, self.y_m, 0.0)
        robot = self._world.truth
        rim = tuple(
            (robot.x_m + ROBOT_M * cos(a * pi / 18), robot.y_m + ROBOT_M * sin(a * pi / 18))
            for a in range(36)
        )
        try:
            free = self._router.route(RouteRequest(start, Pose2(*goal, 0.0)))
            found = free
            if around:
                found = self._router.route(RouteRequest(start, Pose2(*goal, 0.0), rim))
        except RouteFailure:
            return False
        if not found.length_m <= free.length_m + AROUND_M:
            return False
        self._path = [(point.x_m, point.y_m) for point in found.points]
        return True

    def _put(self, heading_rad: float) -> None:
        pose = Pose2(self.x_m, self.y_m, heading_rad)
        self._world.sim.place_thing(self.name, pose)
