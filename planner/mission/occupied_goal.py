"""Wait beside a goal on which something stands, look for room there, and give it up in time."""

from __future__ import annotations

from math import hypot

from planner.mission.account import place_name
from planner.mission.activity import Driving, RoutePurpose
from planner.mission.legs import ask_route
from planner.mission.obstruction_text import tell_occupied
from planner.mission.state import Mission
from planner.mission.step_failure import fail_step
from planner.mission.transaction import Transaction
from planner.plan import Code
from planner.skills import Fail
from wire import Pose2

OCCUPIED_S = 10.0
"""A goal on which something stands is waited for so long."""
OCCUPIED_RETRY_S = 2.0


def wait_beside(turn: Transaction, mission: Mission, leg: Driving) -> None:
    """Wait for what stands on the goal to leave; after ten seconds give the goal up."""
    since_s = leg.occupied_since_s if leg.occupied_since_s is not None else turn.now_s
    if turn.now_s - since_s >= OCCUPIED_S:
        give_up_goal(turn, mission, leg)
        return
    turn.change(occupied_since_s=since_s, rung_since_s=turn.now_s)
    turn.change(retry_s=turn.now_s + OCCUPIED_RETRY_S if leg.leg is None else None)


def look_for_room(turn: Transaction, mission: Mission, leg: Driving) -> None:
    """Look again now and then for room beside the goal; give it up after ten seconds."""
    since_s = leg.occupied_since_s
    if since_s is not None and turn.now_s - since_s >= OCCUPIED_S:
        give_up_goal(turn, mission, leg)
    elif leg.rung_since_s is not None and turn.now_s - leg.rung_since_s >= OCCUPIED_RETRY_S:
        turn.change(rung_since_s=turn.now_s)
        ask_route(turn, RoutePurpose.DETOUR)


def give_up_goal(turn: Transaction, mission: Mission, leg: Driving) -> None:
    """Fail the step, with how near the robot came."""
    pose = turn.book.status.base_in_map if turn.book.status is not None else None
    near_m = _away_m(pose, leg.act.goal) if pose is not None else 0.0
    name = place_name(turn.book.facts, mission, mission.current_step)
    said = tell_occupied(name, near_m)
    fail_step(turn, Fail(Code.GOAL_OCCUPIED, "goal_occupied", said))


def _away_m(pose: Pose2, goal: Pose2) -> float:
    return hypot(pose.x_m - goal.x_m, pose.y_m - goal.y_m)
