"""Drive from goal to goal in a lockstep world and record what came of it, contacts by their cause.

Judged on the simulator's truth. A contact is the robot's where it moved: scripted walkers never
step into it, and leaves close on nobody. SPL is success weighted by path length (Anderson et al.
2018): shortest over driven path, never over 1, and 0 where the goal was not reached.
"""

from __future__ import annotations

from collections import Counter
from dataclasses import dataclass, field
from math import degrees, hypot
from random import Random
from typing import TYPE_CHECKING

from planner.navigation import RouteFailure, RouteRequest
from planner.plan import GoalState
from sim.site import pose2
from sim.site.classes import PERSON_RADIUS_M
from wire import compose, wrap

if TYPE_CHECKING:
    from collections.abc import Mapping

    from tools.lockstep import LockstepWorld
    from wire import Pose2

LOOK_TICKS = 10
MOVES_MPS = 0.05
TOUCH_M = 0.05
GOAL_LIMIT_S = 300.0
SHORTEST_M = 1.0
"""A goal nearer than this says nothing of paths."""


@dataclass(slots=True)
class TourRecord:
    """Hold what one drive came to; as JSON can hold it."""

    errors_m: list[float] = field(default_factory=list)
    errors_deg: list[float] = field(default_factory=list)
    reached: int = 0
    tried: int = 0
    spl: list[float] = field(default_factory=list)
    time_ratios: list[float] = field(default_factory=list)
    """Of goals that were reached: time over shortest path at full speed."""
    contacts: dict[str, int] = field(default_factory=dict)
    """By who moved into what: ``robot into person``, ``robot into home``, ``robot stood``."""
    pose_rows: dict[str, int] = field(default_factory=dict)
    """How often POSE_JUMP and POSE_LOST came up."""
    reasons: dict[str, int] = field(default_factory=dict)
    """Why goals were not reached."""


class RecordedDrive:
    """Drive one world."""

    def __init__(
        self, world: LockstepWorld, chance: str, goals: Mapping[str, Pose2] | None = None
    ) -> None:
        """Take a world that is ready, and what its goals are drawn by.

        Args:
            world: where to drive.
            chance: seeds the choice.
            goals: poses in ``map`` by the names to say; left out, the rooms of a declared home.
        """
        rooms = world.sim.home.rooms.values()
        self._goals = goals or {room.name.en: pose2(room.pose) for room in rooms}
        self._world, self._random = world, Random(chance)
        self.record = TourRecord()
        self._contacts: Counter[str] = Counter()
        self._rows: Counter[str] = Counter()
        self._up: set[str] = set()
        self._touched, self._path_m = world.contacts, 0.0

    def run(self, seconds: float = float("inf"), goals: int = 1_000_000) -> TourRecord:
        """Drive to rooms until the time is up or so many goals have ended.

        A goal that time cuts off counts nowhere.
        """
        world, end_s = self._world, self._world.now_s + seconds
        while world.now_s < end_s and self.record.tried < goals:
            self._go(end_s)
        self.record.contacts, self.record.pose_rows = dict(self._contacts), dict(self._rows)
        return self.record

    def _go(self, end_s: float) -> None:
        world = self._world
        name = self._random.choice(sorted(self._goals))
        pose, began_s = self._goals[name], world.now_s
        try:
            shortest_m = world.scene.router.route(RouteRequest(world.truth, pose)).length_m
        except RouteFailure:  # it stands where no route begins: pushed, or carried there
            shortest_m = 0.0
        goal = world.say(f"go to the {name}")
        self._path_m = 0.0
        while not goal.has_ended and world.now_s < began_s + GOAL_LIMIT_S:
            if world.now_s >= end_s:
                return
            self._look()
        reached = goal.state is GoalState.SUCCEEDED
        record, took_s = self.record, world.now_s - began_s
        record.tried += 1
        record.reached += reached
        if not goal.has_ended:
            world.cancel(goal)
        if not reached:
            reason = f"{goal.state.value} {goal.record.reason or ''}".strip()
            record.reasons[reason] = record.reasons.get(reason, 0) + 1
            for _ in range(20):
                self._look()
        if shortest_m >= SHORTEST_M:
            share = shortest_m / max(shortest_m, self._path_m)
            record.spl.append(share if reached else 0.0)
            if reached:
                speed_mps = world.scene.robot.limits.max_speed_mps
                record.time_ratios.append(took_s * speed_mps / shortest_m)

    def _look(self) -> None:
        """Let a tenth of a second pass and look at each tick of it."""
        world = self._world
        for _ in range(LOOK_TICKS):
            before, speed_mps = world.truth, abs(world.twist.v_mps)
            world.tick()
            here = world.truth
            self._path_m += hypot(here.x_m - before.x_m, here.y_m - before.y_m)
            if world.contacts > self._touched:
                self._contacts[self._cause(speed_mps)] += world.contacts - self._touched
                self._touched = world.contacts
        off_m, off_deg = pose_error(world)
        self.record.errors_m.append(off_m)
        self.record.errors_deg.append(off_deg)
        up = {row.row for row in world.status.rows if row.row.startswith("POSE")}
        self._rows.update(up - self._up)
        self._up = up

    def _cause(self, speed_mps: float) -> str:
        """Say who moved into what, by what is near."""
        world = self._world
        if not speed_mps > MOVES_MPS:
            return "robot stood"
        reach_m = world.scene.robot.base.radius_m + PERSON_RADIUS_M + TOUCH_M
        things = world.sim.things
        people = (things.pose_of(name) for name in things.people)
        here = world.truth
        near = any(
            hypot(one.x_m - here.x_m, one.y_m - here.y_m) < reach_m
            for one in people
            if one is not None
        )
        return "robot into person" if near else "robot into home"


def pose_error(world: LockstepWorld) -> tuple[float, float]:
    """Return how far off the said pose is [m, degrees], where the bridge now thinks it is."""
    said = world.localizer.localizer.said if world.localizer is not None else None
    if said is None:
        return float("inf"), 180.0
    base, true = compose(said.odom_in_map, world.bridge.state.odometry.base_in_odom), world.truth
    return (
        hypot(base.x_m - true.x_m, base.y_m - true.y_m),
        abs(degrees(wrap(base.yaw_rad - true.yaw_rad))),
    )
