"""Match what a question asks for against what these eyes know. Pure.

Where it is to be that no eye here can tell ("on the shelf", "箱子里") stays in the question's
words, so that it can be said.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

from planner.language.object_names import resolve, singles_out
from planner.language.questions import Relation, fold_names, names_floor, read_question
from planner.skills.object_matching import find_mentioned
from planner.skills.perception import WantedObject

if TYPE_CHECKING:
    from planner.language.questions import PlaceNames, QuestionReading, Whereabouts
    from planner.plan import Language
    from planner.site.site_view import SiteView

FLOOR = WantedObject("floor")
"""No detector finds it, and every height tells of it."""


@dataclass(frozen=True, slots=True)
class ObjectQuery:
    """Hold the object that a question asks for."""

    what: WantedObject | None = None
    """None: all that is there."""
    relation: Relation | None = None
    by: WantedObject | None = None
    """What it is to stand so to: a kind that these eyes know, or the floor."""
    unclear: str = ""
    """Where it is to be, in words that no eye here can judge."""
    is_presence: bool = True
    """Whether the question is surely about being there: else no detector has a yes or no."""


def sought_in(
    question: str, facts: SiteView, place: str | None, classes: tuple[str, ...]
) -> ObjectQuery:
    """Return the query in a question to eyes with these classes.

    Args:
        question: as it was said.
        facts: the site; its rooms and places are where to look.
        place: where is looked round; None: from where the robot stands.
        classes: what the eyes know; empty: not known yet.
    """
    read = read_question(question, place_names(facts), place)
    sought = _make_query(read, classes)
    if not read.is_sure and sought.by is None:
        mentioned = find_mentioned(question, classes)
        return ObjectQuery(mentioned, is_presence=mentioned is None)
    known = sought.what is None or _is_kind_alone(read.what, classes)
    return replace(sought, is_presence=read.is_sure and known)


def _is_kind_alone(what: str, classes: tuple[str, ...]) -> bool:
    """Return whether words name a kind and colour and nothing else: "open door" says a state."""
    return resolve(what, None, classes) is not None and not singles_out(what, classes)


def unknown_kind(
    question: str, facts: SiteView, language: Language, classes: tuple[str, ...]
) -> str | None:
    """Return the one kind that a question asks for and eyes with these classes don't know.

    Yes or no to "do you see a piano?" needs eyes that know pianos, and no drive helps eyes that do
    not. None where it asks for anything else, for what they know, or for a room or place of the
    site, and where it is not known yet what they know.
    """
    if not classes:
        return None
    for what, certain, _, may_refuse in read_question(question, place_names(facts)).asked:
        if (
            may_refuse
            and resolve(what, language, classes) is None
            and (
                resolve(what, language) is not None
                or (certain and find_mentioned(what, classes) is None)
            )
        ):
            return what
    return None


def place_names(facts: SiteView) -> PlaceNames:
    """Return what the rooms and places of a site are called."""
    return fold_names(
        (target.room, (target.name.en, target.name.zh, *target.aliases))
        for target in facts.targets.values()
    )


def _make_query(read: QuestionReading, classes: tuple[str, ...]) -> ObjectQuery:
    wanted = find_mentioned(read.what, classes)
    if read.where is None:
        return ObjectQuery(wanted)
    by = _neighbour(read.where, classes)
    if by is None:
        return ObjectQuery(wanted, unclear=read.where.said)
    return ObjectQuery(wanted, read.where.relation, by)


def _neighbour(where: Whereabouts, classes: tuple[str, ...]) -> WantedObject | None:
    """Return the kind of thing that a neighbour's words mean, where these eyes can tell it."""
    if where.relation is None:
        return None
    if names_floor(where.by):
        return FLOOR if where.relation is Relation.ON else None
    found = None if singles_out(where.by, classes) else resolve(where.by, None, classes)
    return WantedObject(*found) if found is not None else None
