"""Find a thing or a person, and say where.

Precondition: the detector knows what is meant; else a vision model is asked, direction by direction
(model_search.py). Verdict: found is what two pictures at least agree
on, standing, in the colour that was asked for. Not found is told with the rooms that were looked
in and with those that were not. Budget: search_bounds.py; the rooms of the site, or the one place
that is named.
"""

from __future__ import annotations

from typing import Any

from planner.language.catalogue import message
from planner.language.object_names import name_object
from planner.perception.snapshot import Thing
from planner.plan import JUDGED, Code
from planner.skills.actions import Fail, Finish, Question, Retry, Scene, SkillAction
from planner.skills.conditions import HOLDS, with_answer
from planner.skills.longer_search import offer_more, takes_else, tell_else, tell_looked
from planner.skills.model_search import seek, tell_found
from planner.skills.object_matching import anybody_for, found, wanted_of
from planner.skills.perception import WantedObject
from planner.skills.result_text import by_neighbour, found_at, unknown_words
from planner.skills.search import alike, ran_out, search
from planner.skills.skill_state import FindState, SearchState


def find(scene: Scene[FindState]) -> SkillAction:
    """Return the search's next act, or its result."""
    wanted = wanted_of(scene) or anybody_for(scene.step.object or "", scene.eyes.classes)
    if wanted is None and not scene.eyes.searches:
        return unknown(scene)
    if scene.pose is None:
        return Retry()
    if wanted is None:
        by_model = seek(scene, scene.pose, all_of_it=False)
        if isinstance(by_model, FindState):
            return tell_found(scene.but(by_model))
        return by_model
    next_ = search(scene, scene.pose, wanted)
    if isinstance(next_, Thing):
        return _found(scene, next_, wanted)
    return not_found(scene.but(next_), wanted) if isinstance(next_, FindState) else next_


def _found(scene: Scene[FindState], thing: Thing, wanted: WantedObject) -> Finish:
    record = found(thing, scene.pose, scene.now_s)
    said = found_at(scene.facts, thing.label, thing.color, thing.room, record.distance_m, wanted)
    ended = Finish({"found": record, "rooms": scene.state.rooms}, Code.FOUND, said)
    return with_answer(ended, True) if scene.step.role in JUDGED else ended


def not_found(scene: Scene[SearchState], wanted: WantedObject) -> Fail | Question:
    """Say that it was not seen, and where was looked, or ask whether to look on."""
    others = alike(scene, wanted)
    name = by_neighbour(name_object(wanted.label, wanted.color), wanted)
    said = message(Code.NOT_FOUND, thing=name, looked=tell_looked(scene, others))
    asked = offer_more(scene, said)
    if asked is not None:
        return asked
    figures: dict[str, Any] = {"rooms": scene.state.rooms}
    if scene.step.role not in JUDGED:
        return Fail(Code.NOT_FOUND, "not_found", said, figures)
    if not others:  # else it may be there, in another light
        said = tell_else(scene, said)
    unsure = others or (ran_out(scene) and not takes_else(scene))
    figures[HOLDS] = None if unsure else False
    return Fail(Code.NOT_FOUND, "not_found", said, figures)


def unknown(scene: Scene[Any]) -> Fail:
    """Tell that these eyes don't know the thing, and the things they know."""
    said = unknown_words(scene.step.object or "", scene.eyes.classes, scene.step.kind)
    return Fail(Code.OBJECT_UNKNOWN, "object_unknown", said)
