"""Say what a goal's order is once a person has answered the grammar's question about it. Pure.

Law: only what the grammar asked is completed here; a model reads the answer beside its question.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from planner.brain.interface import OFFLINE
from planner.language.changes.reader import read_changes
from planner.language.sentence import parse
from planner.mission.open_questions import find_choice, find_offer
from planner.mission.whereabouts import complete_person
from planner.plan import Edit

if TYPE_CHECKING:
    from planner.mission.state import Mission
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
