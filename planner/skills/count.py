"""Count things or people, in one place or in the whole home.

Precondition and budget as for ``find``; what the detector does not know a vision model counts. Law:
things told by a neighbour ("cups on the table") are counted in one room, the first in order that
turns out to have such a neighbour; in the home where several are meant or none is seen. Verdict:
things that are sure, stand apart from each other and were seen during this step; what moves from
room to room may be counted twice, and is not when it stays one thing to the memory. None is a
result, too, where all was looked at.
"""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

from planner.language.catalogue import message, say
from planner.language.object_names import name_object, named_several
from planner.language.questions import has_several_neighbours
from planner.plan import Bilingual, Code
from planner.skills import object_matching, search
from planner.skills.actions import Finish, Question, Retry, Scene, SkillAction
from planner.skills.find import unknown
from planner.skills.longer_search import offer_more, tell_looked
from planner.skills.look_around import look_round
from planner.skills.model_search import seek, tell_count
from planner.skills.result_text import by_neighbour, name_count, room_name
from planner.skills.skill_state import CountState
from planner.skills.viewpoints import NEAR

if TYPE_CHECKING:
    from planner.perception.snapshot import Thing
    from planner.skills.perception import WantedObject
    from wire import Pose2


def count(scene: Scene[CountState]) -> SkillAction:
    """Return the next act towards seeing everything, or the number."""
    wanted = object_matching.wanted_of(scene)
    if wanted is None and not scene.eyes.searches:
        return unknown(scene)
    pose = scene.pose
    if pose is None:
        return Retry()
    if wanted is None:
        by_model = seek(scene, pose, all_of_it=True)
        if isinstance(by_model, CountState):
            return tell_count(scene.but(by_model))
        return by_model
    scene = search.begin(scene, pose, wanted)
    inside = _narrow(scene, pose, wanted)
    if search.find_spent_budget(scene) is not None:
        return _tell_count(inside, wanted)
    next_ = look_round(scene, pose, search.spots(inside, pose), None)
    if isinstance(next_, CountState):
        changed = next_ != scene.state  # another room may be meant, where this one was shut
        return count(scene.but(next_)) if changed else _tell_count(inside, wanted)
    act = search.keep_in_bounds(scene, pose, next_)
    return _tell_count(inside.but(act), wanted) if isinstance(act, CountState) else act


def _narrow(scene: Scene[CountState], pose: Pose2, wanted: WantedObject) -> Scene[CountState]:
    """Return the scene as if the room were named whose neighbour is meant, once that is known.

    It is the first in order that has one; a room that was not looked through may have one yet.
    """
    by, words = wanted.by, scene.step.object or ""
    if by is None or scene.step.place is not None or has_several_neighbours(words, by.label):
        return scene
    state, neighbours = scene.state, _neighbours(scene, wanted)
    has = {t.room or scene.facts.room_at(t.x_m, t.y_m) for t in neighbours}
    left = [
        s
        for s in search.spots(scene, pose)
        if s.key not in state.spots and not s.key.endswith(NEAR)
    ]
    to_see = {spot.room for spot in left}
    open_ = (r for r in state.order if r not in state.shut or r in state.rooms)
    room = next((r for r in open_ if r in has or r in to_see), None)
    if room is None or room not in has:
        return scene
    step = scene.step.model_copy(update={"place": room})
    return replace(scene, step=step, state=state.but(order=(room,)))


def _neighbours(scene: Scene[CountState], wanted: WantedObject) -> list[Thing]:
    return [
        t
        for t in scene.sight.things
        if object_matching.sure(t) and object_matching.fits(t, wanted.by)
    ]


def _tell_count(scene: Scene[CountState], wanted: WantedObject) -> Finish | Question:
    """Tell the number; where there is no such neighbour, that there is none.

    None seen in a part of what was to be looked at is no number.
    """
    state, inside = scene.state, search.PlaceFilter(scene)
    seen = object_matching.list_confirmed(scene.sight, wanted, scene.now_s - scene.spent_s)
    number = len(object_matching.drop_doubles(filter(inside, seen)))
    what = by_neighbour(_name_so_many(number, wanted.label, wanted.color), wanted)
    if number == 0 and wanted.by is not None and not any(map(inside, _neighbours(scene, wanted))):
        what = _name_so_many(0, wanted.by.label, wanted.by.color)
    place = room_name(scene.facts, scene.step.place)
    where = tell_looked(scene)
    known = number > 0 or not search.ran_out(scene)
    if not known:
        name = by_neighbour(name_object(wanted.label, wanted.color), wanted)
        said = message(Code.NOT_FOUND, thing=name, looked=where)
    elif place and not search.ran_out(scene):
        words = "object_step.saw_in" if number else "object_step.saw_none_in"
        said = say(words, what=what, place=place)
    else:
        words = "object_step.saw" if number else "object_step.saw_none"
        said = say(words, what=what, looked=where)
    figures = {"count": number if known else None, "rooms": state.rooms}
    return offer_more(scene, said) or Finish(figures, Code.COUNTED, said)


def _name_so_many(count: int, label: str, color: str | None) -> Bilingual:
    """Return so many of a thing; of none the bare name, for its sentence says "no" itself."""
    return name_count(count, label, color) if count else named_several(label, color)
