"""Drive to places of the site and to a person's point: ``go_to``, ``return_home``, ``come_back``,
``go_to_pose``.

Law: a place that is gone is not driven to, however recently it was there; nor is a point of another
map. A point is reached itself or not at all: no free floor beside it will do.

Precondition: the place exists now; for ``come_back`` the pose at which the goal was accepted was
known, and is on this map. Verdict: the bridge reached the leg, the robot stands, and for a room its
pose lies inside the outline. Budget: one leg; metres and seconds are the bridge's grant.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from planner.language.catalogue import list_names, message
from planner.plan import Bilingual, Code
from planner.skills.actions import DriveLeg, Fail, Finish, Scene, SkillAction
from wire import Pose2

if TYPE_CHECKING:
    from planner.site.site_view import SiteView


def drive_to(scene: Scene[Any], place: str) -> DriveLeg | Fail:
    """Return the leg to a place: into a room at any heading, to anything else at its own."""
    target = scene.facts.targets.get(place)
    if target is None:
        return place_gone(scene.facts, place)
    return DriveLeg(target.pose, heading=not target.room, target=target.id)


def place_gone(facts: SiteView, place: str) -> Fail:
    """Tell that a place was forgotten since the plan was made, and the places there are."""
    return Fail(Code.UNKNOWN_PLACE, "place_gone", tell_unknown_place(facts, place))


def tell_unknown_place(facts: SiteView, name: str | Bilingual) -> Bilingual:
    """Tell that no place is called so, and the places there are."""
    known = list_names(target.name for target in facts.targets.values())
    return message(Code.UNKNOWN_PLACE, name=name, near="", known=known)


def go_to(scene: Scene[None]) -> SkillAction:
    """Return the leg to the place, or that it was reached."""
    return Finish() if scene.part > 0 else drive_to(scene, scene.step.place or "")


SEES_FROM_M = 0.35
"""What is looked at lies before the robot, and not under it."""


def go_to_pose(scene: Scene[None]) -> SkillAction:
    """Return the leg to the point, or to where it is seen from, or that it was reached."""
    step = scene.step
    if scene.part > 0:
        return Finish()
    if step.map_id != scene.facts.map_id or step.x_m is None or step.y_m is None:
        return Fail(Code.POINT_OF_OTHER_MAP, Code.POINT_OF_OTHER_MAP.value)
    at = Pose2(step.x_m, step.y_m, step.yaw_rad or 0.0)
    if step.look:
        return DriveLeg(at, heading=True, sees=(at.x_m, at.y_m), sees_from_m=SEES_FROM_M)
    return DriveLeg(at, heading=step.yaw_rad is not None, exact=True)


def return_home(scene: Scene[None]) -> SkillAction:
    """Return the leg home, or that it was reached."""
    return Finish() if scene.part > 0 else drive_to(scene, scene.facts.home)


def come_back(scene: Scene[None]) -> SkillAction:
    """Return the leg back, or that it was reached."""
    if scene.part > 0:
        return Finish()
    if scene.accepted is None:
        return Fail(Code.NO_ROUTE, "no_route")
    return DriveLeg(scene.accepted, heading=True)
