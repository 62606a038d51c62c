"""Drive a plan in its world and keep account of it, step by step. Reads the world's truth.

The account knows no brain and no process: it looks at where the robot truly is, at the rows that
bind the bridge, and at what the mission says of its steps.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from math import hypot
from typing import TYPE_CHECKING

import numpy as np

from lockstep.latencies import TICK_S
from lockstep.rehearsal_world import world_of
from planner.driven_rehearsal import LONGEST_WAIT_S, DrivenPlan, DrivenStep
from planner.plan import ENDED, GoalState, GoToPose, StepState, step_of

if TYPE_CHECKING:
    from collections.abc import Iterator

    from numpy.typing import NDArray

    from lockstep.driven_world import DrivenWorld
    from lockstep.goal_handle import GoalHandle
    from planner.driven_rehearsal import DriveRequest
    from planner.plan import Step, StepRecord
    from wire import Pose2

STILL_M = 0.01
"""Less than this between two looks is the noise of a robot that stands."""
TRAIL_M = 0.05
LOOK_TICKS = 5
STUCK_S = 60.0
"""Without a centimetre of way, and with nothing to wait for: it will not go on by itself."""
WAITS = frozenset({GoalState.QUEUED, GoalState.PLANNING, GoalState.RUNNING})
"""States that something still comes of without a person."""
_OUTCOMES = {
    StepState.PENDING: "pending",
    StepState.RUNNING: "running",
    StepState.SUCCEEDED: "succeeded",
    StepState.FAILED: "failed",
    StepState.SKIPPED: "succeeded",
}


@dataclass(slots=True)
class StepAccount:
    """Add up one step while it is driven."""

    index: int
    row: StepRecord
    rest_s: float
    """Of a wait, beyond what is waited for here."""
    length_m: float = 0.0
    seconds: float = 0.0
    nearest_m: float | None = None
    nearest_at: tuple[float, float] | None = None
    contacts: int = 0
    rows: dict[str, None] = field(default_factory=dict)
    end: Pose2 | None = None


class RehearsalDrive:
    """Drive one plan; :meth:`turns` yields after each look, until it is over."""

    def __init__(self, asked: DriveRequest, body: bytes) -> None:
        """Build the world. Raises what ``world_of`` does, and MissionError."""
        self._limit_s = asked.limit_s
        self._accounts = [
            StepAccount(index, row, max(0.0, (row.seconds or 0.0) - LONGEST_WAIT_S))
            for index, row in asked.rows
        ]
        steps = tuple(_short(step_of(row)) for _, row in asked.rows)
        self.world: DrivenWorld = world_of(asked, body, steps)
        self._boxes = _boxes_of(self.world)
        self._radius_m = self.world.scene.robot.base.radius_m
        self._goal = self._give(steps)
        self._began_s = self._moved_s = self.world.now_s
        self._last, self._contacts = self.world.truth, self.world.contacts
        self._faced_rad = self._last.yaw_rad
        self._trail: list[tuple[float, float]] = []
        self._stuck: str | None = None

    def _give(self, steps: tuple[Step, ...]) -> GoalHandle:
        points = tuple(step for step in steps if isinstance(step, GoToPose))
        return self.world.go(*points) if points else self.world.say("go there")

    def turns(self) -> Iterator[None]:
        """Let time pass, look by look, until the plan is over or gets no further."""
        while self._stuck is None and not self._goal.has_ended:
            for _ in range(LOOK_TICKS):
                self.world.tick()
            self._look()
            yield

    def plan(self) -> DrivenPlan:
        """Return the account so far."""
        steps = tuple(map(self._step, range(len(self._accounts))))
        nearest = (step.nearest_m for step in steps if step.nearest_m is not None)
        here = self.world.truth
        return DrivenPlan(
            steps=steps,
            trail=tuple(self._trail),
            at=here,
            length_m=round(sum(one.length_m for one in self._accounts), 2),
            seconds=round(sum(step.seconds for step in steps), 1),
            contacts=sum(one.contacts for one in self._accounts),
            nearest_m=min(nearest, default=None),
        )

    @property
    def simulated_s(self) -> float:
        """Return how long it has driven on the simulated clock."""
        return self.world.now_s - self._began_s

    def _look(self) -> None:
        """Add what passed since the last look to the step under way."""
        world, here = self.world, self.world.truth
        account = self._accounts[min(self._at, len(self._accounts) - 1)]
        account.seconds += LOOK_TICKS * TICK_S
        account.end = here
        moved_m = hypot(here.x_m - self._last.x_m, here.y_m - self._last.y_m)
        if moved_m >= STILL_M:
            account.length_m += moved_m
            self._last, self._moved_s = here, world.now_s
        if abs(here.yaw_rad - self._faced_rad) >= STILL_M:
            self._faced_rad, self._moved_s = here.yaw_rad, world.now_s
        if world.contacts > self._contacts:
            account.contacts += world.contacts - self._contacts
            self._contacts = world.contacts
        account.rows.update({row.row: None for row in world.status.rows if row.binding})
        self._measure(account, here)
        last = self._trail[-1] if self._trail else None
        if last is None or hypot(here.x_m - last[0], here.y_m - last[1]) >= TRAIL_M:
            self._trail.append((round(here.x_m, 3), round(here.y_m, 3)))
        self._stuck = self._why_stuck()

    def _measure(self, account: StepAccount, here: Pose2) -> None:
        """Note how near the nearest thing is to the robot's rim."""
        dx = np.maximum(np.maximum(self._boxes[:, 0] - here.x_m, here.x_m - self._boxes[:, 2]), 0)
        dy = np.maximum(np.maximum(self._boxes[:, 1] - here.y_m, here.y_m - self._boxes[:, 3]), 0)
        away_m = round(max(0.0, float(np.hypot(dx, dy).min()) - self._radius_m), 2)
        if account.nearest_m is None or away_m < account.nearest_m:
            account.nearest_m = away_m
            account.nearest_at = (round(here.x_m, 3), round(here.y_m, 3))

    def _why_stuck(self) -> str | None:
        """Return why nothing more comes of it by itself; None: it goes on."""
        goal = self._goal.record
        if goal.state in ENDED:
            return None
        if goal.state not in WAITS:
            return goal.reason or goal.state.value
        waits = self._accounts[min(self._at, len(self._accounts) - 1)].row.kind == "wait"
        if not waits and self.world.now_s - self._moved_s > STUCK_S:
            return "no_progress"
        return "time_limit" if self.simulated_s > self._limit_s else None

    @property
    def _at(self) -> int:
        return self.world.planner.book.missions[self._goal.id].step

    def _step(self, number: int) -> DrivenStep:
        account, goal = self._accounts[number], self._goal.record
        rows = goal.plan.steps if goal.plan is not None else ()
        row = rows[number] if number < len(rows) else None
        outcome = "pending" if row is None else _OUTCOMES[row.state]
        code = None if row is None else row.reason
        message = None
        if number == self._at and self._stuck is not None:
            outcome, code = "stuck", self._stuck
        if number == self._at and goal.outcome is not None and outcome == "failed":
            code, message = goal.outcome.code.value, goal.outcome.message
        if row is None and goal.outcome is not None and number == 0:
            outcome, code = "failed", goal.outcome.code.value
            message = goal.outcome.message
        done_s = account.rest_s if outcome == "succeeded" else 0.0
        return DrivenStep.model_validate(
            {
                "index": account.index, "kind": account.row.kind, "place": account.row.place,
                "outcome": outcome, "length_m": round(account.length_m, 2),
                "seconds": round(account.seconds + done_s, 1), "nearest_m": account.nearest_m,
                "nearest_at": account.nearest_at, "contacts": account.contacts,
                "rows": tuple(account.rows), "end": account.end, "code": code, "message": message,
            }
        )  # fmt: skip


def _short(step: Step) -> Step:
    """Return a step whose wait is short: the rest is added up instead of waited for."""
    seconds = getattr(step, "seconds", None)
    if step.kind != "wait" or seconds is None or seconds <= LONGEST_WAIT_S:
        return step
    return step.model_copy(update={"seconds": LONGEST_WAIT_S})


def _boxes_of(world: DrivenWorld) -> NDArray[np.float64]:
    """Return all that stands in a world as boxes: x0, y0, x1, y1 in ``map`` [m], shape (n, 4)."""
    pieces = world.sim.home.furniture.values()
    return np.array([piece.box for piece in pieces if piece.box is not None], np.float64)
