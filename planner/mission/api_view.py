"""Show missions as the API does. Reads the book, changes nothing."""

from __future__ import annotations

from datetime import UTC, datetime
from math import isfinite
from typing import TYPE_CHECKING, Any

from planner.mission.activity import Driving, Retrying, Waiting
from planner.mission.state import Mission, MissionState
from planner.plan import Goal, PauseReason, PlanRecord

if TYPE_CHECKING:
    from collections.abc import Iterable

Progress = dict[str, float | int | str]
"""The goal, the number of its step, and what is left of it: ``left_m``, ``left_rad``, ``left_s``.
"""


def goal_of(book: MissionState, mission: Mission) -> Goal:
    """Return a mission as a goal, with its place in the queue."""
    position = book.queue.index(mission.id) if mission.id in book.queue else None
    now = {"plan": _plan_now(book, mission), "position": position}
    return recorded_goal(mission).model_copy(update=now)


def recorded_goal(mission: Mission) -> Goal:
    """Return a goal as its record has it: no place in the queue, no progress."""
    return Goal(
        id=mission.id,
        text=mission.text,
        by=mission.by,
        stopped_by=mission.stopped_by if mission.reason == PauseReason.STOP.value else None,
        answers=mission.answers,
        language=mission.language,
        state=mission.state,
        reason="held" if mission.held and mission.reason is None else mission.reason,
        plan=mission.plan,
        outcome=mission.outcome,
        brain=mission.brain,
        created=datetime.fromtimestamp(mission.created_unix_s, UTC),
        updated=datetime.fromtimestamp(mission.updated_unix_s, UTC),
    )


def tell_book(book: MissionState, goals: Iterable[Goal]) -> dict[str, Any]:
    """Return where everything stands, as JSON."""
    return {
        "running": book.running,
        "queue": list(book.queue),
        "goals": [goal.model_dump(mode="json") for goal in goals],
        "status": book.status.model_dump(mode="json") if book.status is not None else None,
    }


def progress_of(book: MissionState) -> Progress | None:
    """Return the rest of the running step: metres, radians or seconds; None of no motion."""
    mission, activity = book.running_goal, book.activity
    if mission is None or activity is None or mission.current_step is None:
        return None
    step, left = mission.current_step, dict[str, float]()
    if isinstance(activity, Waiting):
        left["left_s"] = (
            round(max(0.0, activity.until_s - book.status_s)) if isfinite(book.status_s) else 0
        )
    elif isinstance(activity, (Driving, Retrying)) and step.kind == "turn":
        left["left_rad"] = round((step.angle_rad or 0.0) - mission.done - activity.amount, 2)
    elif isinstance(activity, Driving) and activity.left_m is not None:
        left["left_m"] = round(activity.left_m, 2)
    return {"goal": mission.id, "step": mission.step, **left} if left else None


def _plan_now(book: MissionState, mission: Mission) -> PlanRecord | None:
    """Return the plan with the rest of the step that runs now."""
    plan = mission.plan
    progress = progress_of(book) if mission.id == book.running else None
    if plan is None or progress is None:
        return plan
    left = {name: value for name, value in progress.items() if name.startswith("left_")}
    steps = list(plan.steps)
    steps[mission.step] = steps[mission.step].model_copy(update=left)
    return plan.model_copy(update={"steps": tuple(steps)})
