"""Say what a goal's order is once a person has answered the grammar's question about it. Pure.

Law: only what the grammar asked is completed here; a model reads the answer beside its question.
"She's in the study" completes an order that speaks of one person, whom it fits, and of no place.
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


def complete_order(facts: SiteView, asking: Mission, answer: str) -> str:
    """Return the order that an answer agrees to, chooses or completes.

    Else it is the answer as it was said.
    """
    offered = find_offer(asking) if parse(answer).consent else None
    chosen = offered or find_choice(asking, answer)
    if chosen is not None or asking.brain is None or asking.brain.name != OFFLINE:
        return chosen or answer
    places = [each for each in read_changes(answer, facts.names) if each.act is Edit.WHERE]
    completed = (complete_person(place, asking, facts) for place in places)
    return next((order for order in completed if order is not None), answer)


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
