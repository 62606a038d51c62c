"""Drive from frontier to frontier until the map that is being made is whole.

Precondition: the map grows while the robot drives. The route search knows the map and chooses; here
is decided whether to go on. Verdict: no frontier is left that can be looked at. Three ways in a row
that are shut, or a spent budget, end it early, and it says so: what was mapped stays, and another
order goes on there. Budget: 55 m and 540 s, since a grant is 60 m and 600 s.
"""

from __future__ import annotations

from planner.language.catalogue import message
from planner.mission.skills.actions import DriveLeg, Finish, Retry, Scene, SkillAction, Way
from planner.mission.skills.search import LAST_M, MAX_M, MAX_S
from planner.mission.skills.skill_state import ExploreState
from planner.plan import Bilingual, Code

DRAWN_S = 3.0
"""From standing until the map shows what is seen from there: it is written every 2 s."""
MOST_SHUT = 3


def explore(scene: Scene[ExploreState]) -> SkillAction:
    """Return the leg to the next frontier, or what was explored."""
    state = scene.state
    if state.explored:
        return _finish(scene, Code.EXPLORED)
    if state.shut_ways >= MOST_SHUT or scene.spent_m >= MAX_M or scene.spent_s >= MAX_S:
        return _finish(scene, Code.PARTLY_EXPLORED)
    if scene.pose is None:
        return Retry()
    if state.arrived:
        return Retry(DRAWN_S, state.but(arrived=False))
    return DriveLeg(
        scene.pose,
        heading=False,
        way=Way.EXPLORE,
        limit_m=LAST_M - scene.spent_m,
        state=state,
        then=state.but(arrived=True, shut_ways=0, looks=state.looks + 1),
        otherwise=state.but(shut_ways=state.shut_ways + 1),
    )


def _finish(scene: Scene[ExploreState], code: Code) -> Finish:
    known, driven = f"{scene.state.known_m2:.0f}", f"{scene.spent_m:.0f}"
    said: Bilingual = message(code, known=known, driven=driven, looks=str(scene.state.looks))
    return Finish({}, code, said)
