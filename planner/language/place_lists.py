"""List places and the reasons against a plan for a person."""

from __future__ import annotations

from typing import TYPE_CHECKING

from planner.language.catalogue import list_names, message, say, say_or_quote
from planner.plan import Code, Outcome

if TYPE_CHECKING:
    from planner.plan import Bilingual, PlanRejection, Vocabulary

SHOWN = 30


def known_places(vocabulary: Vocabulary, limit: int = SHOWN) -> Bilingual:
    """List the rooms and places that exist, at most ``limit`` of them by name."""
    names = [entry.name for entry in vocabulary.entries[:limit]]
    more = len(vocabulary.entries) - limit
    if more > 0:
        names.append(say("place.more", more=more))
    return list_names(names) if names else say("place.none")


def rejection_outcome(rejection: PlanRejection, vocabulary: Vocabulary) -> Outcome:
    """Return the outcome of a goal whose plan may not be walked."""
    first = rejection.first
    if first.code is Code.UNKNOWN_PLACE:
        said = message(first.code, name=first.what, near="", known=known_places(vocabulary))
    elif first.code is Code.BAD_PLAN:
        said = message(first.code, why=say("plan.flaw", what=first.what))
    else:
        said = message(first.code, part=say_or_quote("step_kind", first.what))
    return Outcome(code=first.code, message=said)
