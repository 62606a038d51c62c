"""Drive from frontier to frontier until the map that is being made is whole.

Precondition: the map grows while the robot drives. The route search knows the map and chooses; here
is decided whether to go on. Where a way is shut the robot turns round once: who stood in a door is
drawn as a wall until the floor there is seen again. Verdict: no frontier is left that can be looked
at. Three ways in a row that are shut, or a spent budget, end it early, and it says so: what was
mapped stays, and another order goes on there. Budget: 55 m and 540 s, since a grant is 60 m and
600 s.
"""

from __future__ import annotations

from math import pi

from planner.language.catalogue import message
from planner.plan import Bilingual, Code
from planner.skills.actions import DriveLeg, Finish, Retry, Scene, SkillAction, Way
from planner.skills.search_bounds import LEAST_M, LEAST_S, MOST_M
from planner.skills.skill_state import ExploreState
from wire import Pose2, wrap

DRAWN_S = 3.0
"""From standing until the map shows what is seen from there: it is written every 2 s."""
MOST_SHUT = 3
TURNS, TURN_S = 3, 20.0


def explore(scene: Scene[ExploreState]) -> SkillAction:
    """Return the leg to the next frontier, or what was explored."""
    state = scene.state
    if state.explored:
        return _finish(scene, Code.EXPLORED)
    if state.shut_ways >= MOST_SHUT or scene.spent_m >= LEAST_M or scene.spent_s >= LEAST_S:
        return _finish(scene, Code.PARTLY_EXPLORED)
    if scene.pose is None:
        return Retry()
    if state.arrived:
        return Retry(DRAWN_S, state.but(arrived=False))
    if state.turns > 0:
        return _turn(scene.pose, state.but(turns=state.turns - 1))
    return DriveLeg(
        scene.pose,
        heading=False,
        way=Way.EXPLORE,
        limit_m=MOST_M - scene.spent_m,
        state=state,
        then=state.but(arrived=True, shut_ways=0, looks=state.looks + 1),
        otherwise=state.but(shut_ways=state.shut_ways + 1, turns=TURNS),
    )


def _turn(pose: Pose2, then: ExploreState) -> DriveLeg:
    """Return a third of a look round: keyframes are taken on the way."""
    goal = Pose2(pose.x_m, pose.y_m, wrap(pose.yaw_rad + 2.0 * pi / TURNS))
    return DriveLeg(
        goal, heading=True, way=Way.SPIN, limit_s=TURN_S, limit_m=0.5, then=then, otherwise=then
    )


def _finish(scene: Scene[ExploreState], code: Code) -> Finish:
    known, driven = f"{scene.state.known_m2:.0f}", f"{scene.spent_m:.0f}"
    said: Bilingual = message(code, known=known, driven=driven, looks=str(scene.state.looks))
    return Finish({}, code, said)
