"""Take the answer to one who explores: a spot to look from, or that no frontier is left.

From then on the leg is one by route, so that it recovers where its way is shut, as any other does.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from planner.mission.legs import new_leg
from planner.mission.skills import Fail, Way
from planner.mission.skills.skill_state import ExploreState
from planner.mission.step_execution import go_on
from planner.mission.step_failure import fail_step
from planner.plan import Code
from wire import Pose2

if TYPE_CHECKING:
    from planner.mission.activity import Driving
    from planner.mission.events import Routed
    from planner.mission.state import Mission
    from planner.mission.transaction import Transaction


def take_viewpoint(turn: Transaction, mission: Mission, leg: Driving, routed: Routed) -> None:
    """Drive to where the route ends, or tell the skill that all was explored."""
    state, floor, end_m = leg.state, routed.floor, routed.end_m
    if not isinstance(state, ExploreState) or floor is None or end_m is None:
        fail_step(turn, Fail(Code.NO_ROUTE, "no_route"))
        return
    known_m2 = round(floor.known_m2, 1)
    if floor.explored:
        go_on(turn, state.but(known_m2=known_m2, explored=True))
        return
    turn.change(
        way=Way.ROUTE,
        goal=Pose2(*end_m, leg.goal.yaw_rad),
        state=state.but(known_m2=known_m2),
        then=leg.then.but(known_m2=known_m2) if leg.then is not None else None,
        otherwise=leg.otherwise.but(known_m2=known_m2) if leg.otherwise is not None else None,
    )
    new_leg(turn, mission)
