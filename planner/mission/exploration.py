"""Take the answer to one who explores: a spot to look from, or that no frontier is left.

From then on the leg is one by route, so that it recovers where its way is shut, as any other does.
On the way it is asked now and then whether to look from elsewhere, as the map grows: what the robot
was to look at often comes into view long before it is there. Nothing stops for that question.
"""

from __future__ import annotations

from dataclasses import replace
from math import hypot
from typing import TYPE_CHECKING

from planner.mission.activity import RoutePurpose
from planner.mission.legs import ask_route, new_leg
from planner.mission.step_execution import go_on
from planner.mission.step_failure import fail_step
from planner.plan import Code
from planner.skills import Fail, Way
from planner.skills.skill_state import ExploreState
from wire import Pose2

if TYPE_CHECKING:
    from planner.mission.activity import Driving
    from planner.mission.events import Routed
    from planner.mission.state import Mission
    from planner.mission.transaction import Transaction


AGAIN_S = 3.0
"""The map is drawn anew every 2 s."""
ELSEWHERE_M = 0.3


def reconsider_viewpoint(turn: Transaction) -> None:
    """Ask whether to look from elsewhere, for a leg that explores and is driven undisturbed."""
    leg, now_s = turn.driving, turn.now_s
    if leg is None or leg.leg is None or not isinstance(leg.act.state, ExploreState):
        return
    if leg.ticket is None and now_s - max(leg.since_s, leg.explore_asked_s) >= AGAIN_S:
        turn.change(explore_asked_s=now_s)
        ask_route(turn, RoutePurpose.EXPLORE)


def take_better_viewpoint(
    turn: Transaction, mission: Mission, leg: Driving, routed: Routed
) -> None:
    """Turn to another spot, or end where nothing is left to look at; else the leg goes on."""
    floor, end_m = routed.floor, routed.end_m
    if floor is None or end_m is None or leg.leg is None:
        return
    off_m = hypot(end_m[0] - leg.act.goal.x_m, end_m[1] - leg.act.goal.y_m)
    if floor.explored or off_m > ELSEWHERE_M:
        take_viewpoint(turn, mission, leg, routed)


def take_viewpoint(turn: Transaction, mission: Mission, leg: Driving, routed: Routed) -> None:
    """Drive to where the route ends, or tell the skill that all was explored."""
    act, floor, end_m = leg.act, routed.floor, routed.end_m
    state = act.state
    if not isinstance(state, ExploreState) or floor is None or end_m is None:
        fail_step(turn, Fail(Code.NO_ROUTE, "no_route"))
        return
    known_m2 = round(floor.known_m2, 1)
    if floor.explored:
        go_on(turn, state.but(known_m2=known_m2, explored=True))
        return
    act = replace(
        act,
        way=Way.ROUTE,
        goal=Pose2(*end_m, act.goal.yaw_rad),
        state=state.but(known_m2=known_m2),
        then=act.then.but(known_m2=known_m2) if act.then is not None else None,
        otherwise=act.otherwise.but(known_m2=known_m2) if act.otherwise is not None else None,
    )
    turn.change(act=act)
    new_leg(turn, mission)
