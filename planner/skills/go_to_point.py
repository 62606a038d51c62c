"""Drive to the point that a pixel shows: onto floor, or short of a thing that stands there.

Law: the point counts in the picture that the plan was made on, from where that was taken; a wall,
the sky and what lies outside the fence are refused before anything moves. No brain that plans is
shown a picture or offered this step (``Means.plannable``), so no sign can choose the point, and
nobody is asked; where a model that looks points, see pointing.py. Verdict: the bridge reached the
leg. Budget: one leg.
"""

from __future__ import annotations

from planner.skills.actions import AskImage, Finish, Retry, Scene, SkillAction
from planner.skills.go_to_object import approach, set_off
from planner.skills.image_errors import point_refused
from planner.skills.look_around import leg_to
from planner.skills.object_matching import bearing
from planner.skills.skill_state import GoToPointState

FLOOR_M = 0.12
"""What lies lower is driven onto."""


def go_to_point(scene: Scene[GoToPointState]) -> SkillAction:
    """Return the leg to the point, or that it was reached."""
    pose, state = scene.pose, scene.state
    if pose is None:
        return Retry()
    if state.reached:
        return Finish()
    if state.stand > 0:
        return point_refused("point_no_route")
    if state.at is not None:
        return approach(scene, pose, None)
    if scene.answer is None:
        return AskImage(x=scene.step.x or 0, y=scene.step.y or 0, then=state)
    at = scene.answer.at
    if at is None:
        return point_refused(scene.answer.failure or "point_no_depth")
    if at[2] > FLOOR_M:
        return set_off(scene, pose, state, at)
    heading = bearing(pose, at[:2])
    return leg_to(pose, at[:2], heading, state.but(reached=True), state.but(stand=1))
