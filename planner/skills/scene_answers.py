"""Answer a question by the sights of its step, in both languages. Pure.

Yes is what stands where it was asked for; no needs the neighbour to be seen now; what the eyes
can't judge, or don't know well enough where it is, is said to be so.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

from planner.language.catalogue import say
from planner.language.object_names import name_object, resolve
from planner.plan import Bilingual, say_same
from planner.skills.object_matching import drop_doubles, fits, list_confirmed, sure
from planner.skills.object_query import FLOOR, sought_in, unknown_kind
from planner.skills.result_text import list_things, name_count, unknown_name
from planner.skills.search import PlaceFilter
from planner.skills.spatial_relations import judge_relation, on_floor

if TYPE_CHECKING:
    from planner.language.questions import Relation
    from planner.perception.snapshot import Thing
    from planner.skills.actions import Scene
    from planner.skills.perception import WantedObject

    Things = tuple[Thing, ...]

_FLOOR = say("scene.floor")


class SortedThings(NamedTuple):
    """Sort things by whether they stand where it was asked for."""

    there: Things
    unsure: Things
    elsewhere: Things


class SpotPhrases(NamedTuple):
    """Say where was looked, and beside what."""

    at: Bilingual
    """With a preposition, or empty: `` in the kitchen``, ``在厨房``."""
    by: Bilingual
    beside: Bilingual
    """With a preposition: `` on the table in the kitchen``, ``在厨房的桌子上``."""


class SceneAnswer(NamedTuple):
    """Hold the answer, and whether it is a yes."""

    said: Bilingual
    yes: bool | None = None
    """None: nothing is asked for that is there or not, or it can't be told."""
    lists: bool = False
    """Whether it names what is there, which a model's reading adds to."""


def answer(scene: Scene[Any], question: str) -> SceneAnswer:
    """Tell the sights of this step; where one thing is asked for, whether it was there."""
    sought = sought_in(question, scene.facts, scene.step.place, scene.eyes.classes)
    late = tell_unknown(scene, question) if sought.what is None else None
    if late is not None:  # at the beginning they told none
        return SceneAnswer(late)
    inside, since_s = PlaceFilter(scene), scene.now_s - scene.spent_s
    seen = drop_doubles(t for t in list_confirmed(scene.sight, None, since_s) if inside(t))
    fitting = tuple(t for t in seen if fits(t, sought.what))
    at = _at(scene, sought.by or sought.what)
    if sought.what is not None and not sought.is_presence:
        return SceneAnswer(_tell_without_judging(sought.what, fitting, at, scene.eyes.model))
    if sought.by is not None and sought.relation is not None:
        known = [t for t in scene.sight.things if inside(t) and sure(t) and fits(t, sought.by)]
        there = sought.by is FLOOR or any(t.seen_s >= since_s for t in known)
        judged_so = _sort_by_relation(
            fitting, sought.relation, None if sought.by is FLOOR else known
        )
        return _tell_beside(
            sought.what, judged_so, _spot(sought.by, sought.relation, at), seen=there
        )
    if sought.unclear and sought.what is not None and not fitting:
        return SceneAnswer(_unseen("scene.state_unseen", sought.what, at))
    if sought.unclear and fitting:
        what = _name_things(fitting, sought.what)
        return SceneAnswer(say("scene.unclear", what=what, at=at, unclear=sought.unclear))
    return _plainly(sought.what, fitting, at)


def tell_unknown(scene: Scene[Any], question: str) -> Bilingual | None:
    """Say, where no vision model is set, that the eyes don't know the kind that is asked for."""
    eyes = scene.eyes
    name = unknown_kind(question, scene.facts, scene.language, eyes.classes)
    return unknown_name(name, eyes.classes) if name is not None and not eyes.model else None


def _sort_by_relation(things: Things, relation: Relation, by: list[Thing] | None) -> SortedThings:
    """Sort things by how they stand to the nearest to yes of these; None: to the floor."""
    sorts: dict[bool | None, list[Thing]] = {True: [], None: [], False: []}
    for thing in things:
        told = [on_floor(thing)] if by is None else [judge_relation(thing, relation, t) for t in by]
        sorts[True if True in told else None if None in told else False].append(thing)
    return SortedThings(tuple(sorts[True]), tuple(sorts[None]), tuple(sorts[False]))


def _tell_beside(
    what: WantedObject | None, so: SortedThings, spot: SpotPhrases, *, seen: bool
) -> SceneAnswer:
    """Tell whether the object stands by its neighbour; ``seen``: that one was seen now."""
    at, beside = spot.at, spot.beside
    if so.there:
        found = _name_things(so.there, what)
        code = "scene.yes_beside" if what is not None else "scene.seen_beside"
        return SceneAnswer(
            say(code, found=found, beside=beside),
            None if what is None else True,
            lists=what is None,
        )
    if so.unsure:
        found = _name_things(so.unsure, what)
        return SceneAnswer(say("scene.unsure", found=found, at=at))
    if not seen:
        return SceneAnswer(_without_neighbour(what, so.elsewhere, spot))
    no = _plainly(what, (), beside)
    if what is None or not so.elsewhere:
        return no
    found = _name_things(so.elsewhere, what)
    said = say("scene.elsewhere", said=no.said, found=found)
    return SceneAnswer(said, no.yes)


def _without_neighbour(
    what: WantedObject | None, elsewhere: Things, spot: SpotPhrases
) -> Bilingual:
    """Say that it can't be told, since the neighbour was not seen."""
    at, by = spot.at, spot.by
    if what is None:
        return say("scene.no_neighbour", by=by, at=at)  # fmt: skip
    if not elsewhere:
        name = name_object(what.label, what.color)
        return say("scene.neither", name=name, by=by, at=at)  # fmt: skip
    found = _name_things(elsewhere, what)
    return say("scene.no_neighbour_but", found=found, by=by, at=at)  # fmt: skip


def _tell_without_judging(
    what: WantedObject, things: Things, at: Bilingual, has_model: bool
) -> Bilingual:
    """Tell the sights where more is asked than a detector knows, such as a state.

    With a vision model its reading follows, and is the answer; else that it can't be told.
    """
    found = _name_things(things, what)
    if has_model:
        return say("scene.seen", found=found, at=at) if things else _unseen("scene.none", what, at)
    if things:
        return say("scene.state_untold", found=found, at=at)
    return _unseen("scene.state_unseen", what, at)


def _unseen(code: str, what: WantedObject, at: Bilingual) -> Bilingual:
    return say(code, name=name_object(what.label, what.color), at=at)


def _plainly(what: WantedObject | None, things: Things, at: Bilingual) -> SceneAnswer:
    """Tell the sights of the object, without any neighbour."""
    if what is None:
        if not things:
            return SceneAnswer(say("scene.nothing", at=at), lists=True)
        found = list_things(things)
        return SceneAnswer(say("scene.seen", found=found, at=at), lists=True)
    if not things:
        return SceneAnswer(_unseen("scene.no", what, at), False)
    found = _name_things(things, what)
    said = say("scene.yes", found=found, at=at)
    return SceneAnswer(said, True)


def _name_things(things: Things, what: WantedObject | None) -> Bilingual:
    return (
        name_count(len(things), what.label, what.color) if what is not None else list_things(things)
    )


def _at(scene: Scene[Any], named: WantedObject | None) -> Bilingual:
    """Say where was looked; nothing of a place that is the thing itself, or its neighbour."""
    target = scene.facts.targets.get(scene.step.place or "")
    if target is None:
        return say_same("")
    if target.room:
        return say("scene.in", name=target.name)
    if named is not None and (resolve(target.name.en) or ("",))[0] == named.label:
        return say_same("")
    return say("scene.near", name=target.name)


def _spot(by: WantedObject, relation: Relation, at: Bilingual) -> SpotPhrases:
    name = _FLOOR if by is FLOOR else name_object(by.label, by.color)
    code = f"beside.{relation.value}"
    beside = say(f"{code}_at", name=name, at=at) if at.en else say(code, name=name)
    return SpotPhrases(at, name, beside)
