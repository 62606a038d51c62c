"""Complete an order in its own words once a person says where somebody is: "she's in the study".

Pure. The grammar asks where a person is before it plans anything, so there are no steps to change.
Law: the order speaks of one person, whom the pronoun fits, and of no place.
"""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

from planner.language.folding import has_chinese
from planner.language.motion_guard.mentioned_names import find_places, plain
from planner.language.person_names import people_named
from planner.mission.antecedents import fits
from planner.plan import Code, GoalState

if TYPE_CHECKING:
    from planner.mission.state import Mission
    from planner.plan import Change
    from planner.site.site_view import SiteView


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
