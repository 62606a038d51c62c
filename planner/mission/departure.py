"""Say where "come back" leads: to where the order before was given, and where that is in doubt.

Pure. Nothing is leant on that is older than ``LEANS_S``.
"""

from __future__ import annotations

from math import hypot
from typing import TYPE_CHECKING

from planner.mission.outcomes import moves
from planner.mission.state import ORDER_SOURCE
from planner.plan import GoalState

if TYPE_CHECKING:
    from planner.mission.state import Mission, MissionState

LEANS_S = 1800.0
"""Half an hour: after it, "again" means nothing that a person could be held to."""
AWAY_M, DRIVEN_M = 1.0, 0.1
"""An order that is over, drove nothing and was given here was done here: one before is meant."""
OLD_POSE_S = 1.0
"""A status older than this says nothing of where the robot is."""
Point = tuple[float, float, float]
"""x [m], y [m], yaw [rad] in ``map``."""


def find_robot(book: MissionState) -> Point | None:
    """Return where the bridge's newest status says that the robot stands."""
    pose = book.status.base_in_map if book.status is not None else None
    return (pose.x_m, pose.y_m, pose.yaw_rad) if pose is not None else None


def departure_of(book: MissionState, now_s: float) -> Point | None:
    """Return where the robot stood when the order was given that led it away from there."""
    here = find_robot(book)
    if here is None or not now_s - book.status_s <= OLD_POSE_S:
        return None
    now_unix_s = now_s + book.wall_offset_s
    for order in sorted(book.missions.values(), key=lambda m: -m.order):
        by_schedule = order.source.startswith(ORDER_SOURCE)
        if not order.steps or order.state is GoalState.REFUSED or by_schedule:
            continue
        begin = order.accepted_at
        if begin is None or order.map_id != book.facts.map_id:
            return None
        if not now_unix_s - order.created_unix_s <= LEANS_S:
            return None
        near = hypot(here[0] - begin[0], here[1] - begin[1]) <= AWAY_M
        if not (near and order.has_ended and order.metres <= DRIVEN_M):
            return begin
    return None


def way_back_of(mission: Mission) -> Point | None:
    """Return where a goal's ``come_back`` leads: one that moves nowhere before leans on departure.

    Else it is where the goal was accepted.
    """
    first = next((step for step in mission.steps if moves(step)), None)
    if first is not None and first.kind == "come_back" and mission.departed_at is not None:
        return mission.departed_at
    return mission.accepted_at
