"""Say what a goal's order is once a person has answered the grammar's question about it. Pure.

Law: only what the grammar asked is completed here; a model reads the answer beside its question.
"She's in the study" completes an order that speaks of one person, whom it fits, and of no place;
"the kitchen" stands in for the one place of an order that nobody knows.
"""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

from planner.brain.interface import OFFLINE
from planner.language.changes.reader import read_changes
from planner.language.folding import has_chinese
from planner.language.motion_guard.mentioned_names import find_places, plain
from planner.language.person_names import people_named
from planner.language.sentence import parse
from planner.mission.antecedents import fits
from planner.mission.open_questions import find_choice, find_offer
from planner.plan import Code, Edit, GoalState

if TYPE_CHECKING:
    from planner.mission.state import Mission
    from planner.plan import Change
    from planner.site.site_view import SiteView

_QUOTED = re.compile("“([^”]+)”")
"""A question about an unknown place tells its name first."""


def complete_order(facts: SiteView, asking: Mission, answer: str) -> str:
    """Return the order that an answer agrees to, chooses or completes.

    Else it is the answer as it was said.
    """
    offered = find_offer(asking) if parse(answer).consent else None
    chosen = offered or find_choice(asking, answer)
    if chosen is not None or asking.brain is None or asking.brain.name != OFFLINE:
        return chosen or answer
    changes = read_changes(answer, facts.names)
    named = [complete_place(each, asking, facts) for each in changes]
    placed = [complete_person(each, asking, facts) for each in changes if each.act is Edit.WHERE]
    return next((order for order in (*named, *placed) if order is not None), answer)


def complete_place(change: Change, asked: Mission, facts: SiteView) -> str | None:
    """Return "go to the kitchen …" of "go to the garage …"; None where another thing is asked."""
    plan, place, order = asked.plan, change.inner or change.place, asked.order_text
    if plan is None or plan.code is not Code.UNKNOWN_PLACE or plan.text is None or place is None:
        return None
    unknown = _QUOTED.search(plan.text.en)
    if unknown is None or change.act not in (Edit.WHERE, Edit.INSTEAD) or change.asks:
        return None
    name, words = facts.targets[place].name, re.escape(unknown[1])
    if has_chinese(order):
        found, said = re.findall(words, order), name.zh
    else:
        words = rf"\b(?:(?:the|my|our|your) )?{words}\b"
        found, said = re.findall(words, order, re.IGNORECASE), f"the {name.en}"
    if len(found) != 1:
        return None
    return re.sub(words, lambda _: said, order, flags=re.IGNORECASE)


def complete_person(change: Change, asked: Mission, facts: SiteView) -> str | None:
    """Return "tell Dad in the study …" of "tell Dad …"; None where another thing is asked."""
    order, plan = plain(asked.order_text), asked.plan
    people, place = people_named(asked.order_text), change.inner or change.place
    waits = asked.state is GoalState.NEEDS_CLARIFICATION and plan is not None
    if not waits or plan is None or plan.code is not Code.INCOMPLETE or place is None:
        return None
    if len(people) != 1 or find_places(order, facts.names):
        return None
    person = people[0]
    if change.who == "it" or (change.who and not fits(change.who, person)):
        return None
    name = facts.targets[place].name
    if has_chinese(order):
        at = order.find(plain(person))
        return f"{order[:at]}{name.zh}的{order[at:]}" if at >= 0 else None
    named = re.search(rf"\b{re.escape(person)}\b(?!'s)", asked.order_text, re.IGNORECASE)
    if named is None:
        return None
    return f"{asked.order_text[: named.end()]} in the {name.en}{asked.order_text[named.end() :]}"
