"""Count things or people, in one place or in the whole home.

Precondition and budget as for ``find``. Verdict: things that are sure, stand apart from each other
and were seen during this step; what moves from room to room may be counted twice, and is not when
it stays one thing to the memory. None is a result, too.
"""

from __future__ import annotations

from planner.mission.skills.act import Act, Done, Later, Scene
from planner.mission.skills.around import look_round
from planner.mission.skills.find import unknown
from planner.mission.skills.notes import Notes
from planner.mission.skills.search import begin, spent, spots, within
from planner.mission.skills.seen import apart, confirmed, wanted_of
from planner.mission.skills.tell import counted, looked_in, room_name
from planner.plan import Bilingual, Code


def count(scene: Scene) -> Act:
    """Return what to do next to see everything, or the number."""
    wanted = wanted_of(scene)
    if wanted is None:
        return unknown(scene)
    if scene.pose is None:
        return Later()
    pose = scene.pose
    scene = begin(scene, pose, wanted)
    next_ = look_round(scene, pose, spots(scene, pose), None)
    if not isinstance(next_, Notes) and spent(scene) is None:
        return next_
    scene = scene.but(next_) if isinstance(next_, Notes) else scene
    seen = confirmed(scene.sight, wanted, scene.now_s - scene.spent_s)
    number = len(apart(filter(within(scene), seen)))
    what = counted(number, wanted.label, wanted.color)
    place = room_name(scene.facts, scene.step.place)
    shut = tuple(room for room in scene.notes.shut if room not in scene.notes.rooms)
    where = looked_in(scene.facts, scene.notes.rooms, shut, spent(scene))
    said = Bilingual(
        en=f"I saw {what.en}" + (f" in the {place.en}." if place else f". {where.en}"),
        zh=(f"在{place.zh}" if place else "") + f"看到 {what.zh}。" + ("" if place else where.zh),
    )
    return Done({"count": number, "rooms": scene.notes.rooms}, Code.COUNTED, said)
