"""Tell how a goal ended, with figures: the order, the result, how far, and the limits.

"Arrived" is what odometry and the bridge say, never a model.
"""

from __future__ import annotations

from math import cos, hypot, inf, sin

from planner.language.catalogue import message, say
from planner.language.formatting import definite
from planner.language.questions import looks_round
from planner.mission.account import MOTION, account, place_name
from planner.mission.state import GivenOrder, Mission, Progress
from planner.mission.transaction import Transaction
from planner.plan import Bilingual, Code, Outcome, Spot, StepRecord, StepState
from planner.site.polygon import contains
from planner.site.site_view import SiteView, Target
from wire import Pose2

AHEAD_M = 1.0
"""What lies so far before a camera fills its picture."""
NEAR_M = 1.0
MAX_LIMITS_NAMED = 5
MIN_LIMIT_SHARE = 0.02
"""A limit that was the nearest one in under 2 % of the statuses explains nothing."""
SEEKS = frozenset({"find", "count", "follow", "go_to_object", "go_to_point"})
BUDGET = say("account.budget")


def moves(step: StepRecord) -> bool:
    """Tell whether a step may move the robot: a look ahead does not."""
    if step.kind == "look":
        return step.place is not None or looks_round(step.text or "")
    return step.kind in MOTION or step.kind in SEEKS


def spot_at(facts: SiteView, pose: Pose2 | None, place: str | None = None) -> Spot:
    """Name where a pose is: its room and the point itself."""
    if pose is None:
        return Spot(place=place)
    return Spot(
        place=place,
        room=facts.room_at(pose.x_m, pose.y_m),
        x_m=round(pose.x_m, 3),
        y_m=round(pose.y_m, 3),
        yaw_rad=round(pose.yaw_rad, 4),
    )


def find_place_near(facts: SiteView, pose: Pose2) -> Target | None:
    """Return the nearest place that is no room, where it is at hand."""
    near = [
        (hypot(t.pose.x_m - pose.x_m, t.pose.y_m - pose.y_m), t.id)
        for t in facts.targets.values()
        if not t.room
    ]
    far_m, place = min(near, default=(inf, ""))
    return facts.targets[place] if far_m <= NEAR_M else None


def looks_into(facts: SiteView, place: str, pose: Pose2 | None) -> bool:
    """Tell whether what lies before the robot is of the room that a place is, or lies in.

    So it counts where no pose, or no room, is known.
    """
    target = facts.targets.get(place)
    if target is None or pose is None:
        return True
    room = facts.targets.get(spot_at(facts, target.pose).room or "")
    outline = target.polygon or (room.polygon if room is not None else None)
    x_m, y_m = pose.x_m + AHEAD_M * cos(pose.yaw_rad), pose.y_m + AHEAD_M * sin(pose.yaw_rad)
    return outline is None or contains(outline, x_m, y_m)


def asked_spot(facts: SiteView, mission: Mission, step: StepRecord) -> Spot | None:
    """Name where a step was to go, or None where it goes nowhere."""
    if step.kind == "come_back":
        return spot_at(facts, accepted_at(mission))
    if step.kind == "go_to_pose":
        return Spot(x_m=step.x_m, y_m=step.y_m, yaw_rad=step.yaw_rad)
    target = facts.targets.get(facts.home if step.kind == "return_home" else step.place or "")
    if target is None:
        return Spot(place=step.place) if step.kind in MOTION else None
    return spot_at(facts, target.pose, target.id)


def accepted_at(mission: GivenOrder) -> Pose2 | None:
    """Return the pose in ``map`` at which the goal was accepted, where it was known."""
    return Pose2(*mission.accepted_at) if mission.accepted_at is not None else None


def limits(mission: Progress) -> tuple[str, ...]:
    """Return the bridge's names for the limits on the speed, the longest first."""
    counts = mission.limited
    total = sum(counts.values())
    named = sorted((-n, name) for name, n in counts.items() if n >= MIN_LIMIT_SHARE * total)
    return tuple(name for _, name in named[:MAX_LIMITS_NAMED])


def plain_outcome(code: Code, **facts: str | float | Bilingual) -> Outcome:
    """Return a code with its own sentence."""
    return Outcome(code=code, message=message(code, **facts))


def ended_outcome(
    turn: Transaction, mission: Mission, code: Code, said: Bilingual | None
) -> Outcome:
    """Return the outcome of a mission that had begun: each step's result, and the figures.

    ``said``: how it ends, where no step tells that.
    """
    drives = [s for s in mission.steps if moves(s)]
    tried = [s for s in drives if s.state not in (StepState.PENDING, StepState.SKIPPED)]
    last = tried[-1] if tried else (drives[0] if drives else None)
    facts = turn.book.facts
    return Outcome(
        code=code,
        message=account(facts, mission, code, said),
        asked=asked_spot(facts, mission, last) if last is not None else None,
        reached=(last.reached if last is not None and last.reached else None)
        or (spot_at(facts, turn.book.pose) if tried else None),
        metres=round(mission.metres, 3),
        seconds=round(max(0.0, turn.now_unix_s - mission.created_unix_s), 3),
        limited_by=limits(mission),
    )


def failure(
    facts: SiteView, mission: Mission, step: StepRecord | None, code: Code, row: str
) -> Bilingual:
    """Return the sentence of a mission that failed on its way."""
    if code in (Code.BLOCKED, Code.NO_ROUTE):
        return message(code, place=definite(place_name(facts, mission, step)))
    if code is Code.OUT_OF_BUDGET:
        return message(code, budget=BUDGET)
    if code is Code.FAULT:
        return message(code, row=row)
    return message(code)
