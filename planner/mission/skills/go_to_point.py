"""Drive to what a point of the picture shows: onto floor, or short of what stands there.

Law: the point counts in the picture that the plan was made on, from where that was taken; a wall,
the sky and what lies outside the fence are refused before anything moves. Verdict: the bridge
reached the leg. Budget: one leg.
"""

from __future__ import annotations

from planner.mission.skills.act import Act, Cannot, Done, Inquire, Later, Scene
from planner.mission.skills.around import leg_to
from planner.mission.skills.go_to_object import approach, set_off
from planner.mission.skills.seen import bearing
from planner.plan import Bilingual, Code, message, same

FLOOR_M = 0.12
"""What lies lower is driven onto."""
WHY = {
    "point_on_wall": ("it shows a wall or furniture", "那里是墙或家具"),
    "point_off_map": ("it lies outside the floor that I may drive on", "那里不在允许行驶的区域内"),
    "point_no_depth": ("its distance is not known", "无法得知距离"),
    "point_too_far": ("it is too far away", "距离太远"),
    "point_no_pose": ("I did not know where I was", "当时位置未知"),
    "point_no_route": ("there is no way to it", "没有通往那里的路"),
}
ASK, THERE = 0, 1


def go_to_point(scene: Scene) -> Act:
    """Return the leg to the point, or that it was reached."""
    pose, notes = scene.pose, scene.notes
    if pose is None:
        return Later()
    if notes.stage == THERE:
        return Done()
    if notes.stand > 0:
        return refused("point_no_route")
    if notes.at is not None:
        return approach(scene, pose, None)
    if scene.answer is None:
        return Inquire(x=scene.step.x or 0, y=scene.step.y or 0, then=notes)
    at = scene.answer.at
    if at is None:
        return refused(scene.answer.failure or "point_no_depth")
    if at[2] > FLOOR_M:
        return set_off(scene, pose, notes, at)
    heading = bearing(pose, at[:2])
    return leg_to(pose, at[:2], heading, notes.but(stage=THERE), notes.but(stand=1))


def refused(code: str) -> Cannot:
    """Say why a point of the picture is not driven to."""
    en, zh = WHY.get(code, (code, code))
    said = message(Code.POINT_REFUSED, why=Bilingual(en=en, zh=zh) if code in WHY else same(code))
    return Cannot(Code.POINT_REFUSED, code, said)
