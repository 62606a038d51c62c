"""Say whom a pronoun fits, which one thing an order speaks of, and what an answer completes.

Pure. An order is completed by the answer to the grammar's question about it, and by no other: a
model reads the answer beside its question. "She's in the study" completes an order that speaks of
one person, whom it fits, and of no place; "the kitchen" stands in for the one place of an order
that nobody knows.
"""

from __future__ import annotations

import re
from typing import TYPE_CHECKING, Protocol

from planner.language.folding import has_chinese
from planner.language.motion_guard.mentioned_names import find_places, plain
from planner.language.person_names import people_named
from planner.plan import Code, Edit, GoalState

if TYPE_CHECKING:
    from planner.plan import Change, PlanRecord, StepRecord, Vocabulary


class EarlierOrder(Protocol):
    """Show what is known of an order that was given before."""

    @property
    def steps(self) -> tuple[StepRecord, ...]: ...
    @property
    def plan(self) -> PlanRecord | None: ...
    @property
    def order_text(self) -> str: ...
    @property
    def state(self) -> GoalState: ...
    @property
    def has_begun(self) -> bool: ...


ORDERS_BACK = 3
"""Orders before the newest one in which a person may have been spoken of."""
_HER = re.compile(
    r"(?:mom|mum|mommy|mummy|mother|grandma|grandmother|granny|nana|nan|gran|mama|wife|daughter"
    r"|sister|aunt|auntie)$"
    r"|妈|奶奶|外婆|姥姥|姐|妹|阿姨|老婆|妻|女",
    re.IGNORECASE,
)
_HIM = re.compile(
    r"(?:dad|daddy|father|grandpa|grandfather|grand?dad|gramps|papa|husband|son|brother|uncle)$"
    r"|爸|爷爷|外公|姥爷|哥|弟|叔|老公|丈夫|儿子|先生",
    re.IGNORECASE,
)
_SOUGHT = frozenset({"find", "count", "go_to_object", "recall"})


def fits(pronoun: str, person: str) -> bool:
    """Tell whether a pronoun can mean a person of this name."""
    she, he = _HER.search(person) is not None, _HIM.search(person) is not None
    if pronoun.lower() in ("him", "he", "他"):
        return not she or he
    return not he or she if pronoun.lower() in ("her", "she", "她") else True


def _was_only_proposed(last: EarlierOrder) -> bool:
    """Tell whether a plan was laid before a person, and nothing of it was begun."""
    waits = last.state in (GoalState.AWAITING_CONFIRMATION, GoalState.CANCELLED)
    return waits and not last.has_begun


def thing_of(last: EarlierOrder) -> str | None:
    """Return the one thing that an order speaks of, in its own words."""
    things = {step.object for step in last.steps if step.kind in _SOUGHT and step.object}
    thing = things.pop() if len(things) == 1 else None
    if thing is None:
        return None
    if _was_only_proposed(last) and thing not in plain(last.order_text):
        return None
    return re.sub(r"^(?:the|my|our|your|an?) ", "", thing)


_QUOTED = re.compile("“([^”]+)”")
"""A question about an unknown place tells its name first."""


def complete_place(change: Change, asked: EarlierOrder, names: Vocabulary) -> str | None:
    """Return "go to the kitchen …" of "go to the garage …"; None where another thing is asked."""
    plan, place, order = asked.plan, change.inner or change.place, asked.order_text
    if plan is None or plan.code is not Code.UNKNOWN_PLACE or plan.text is None or place is None:
        return None
    unknown = _QUOTED.search(plan.text.en)
    if unknown is None or change.act not in (Edit.WHERE, Edit.INSTEAD) or change.asks:
        return None
    name, words = names.by_id[place].name, re.escape(unknown[1])
    if has_chinese(order):
        found, said = re.findall(words, order), name.zh
    else:
        words = rf"\b(?:(?:the|my|our|your) )?{words}\b"
        found, said = re.findall(words, order, re.IGNORECASE), f"the {name.en}"
    if len(found) != 1:
        return None
    return re.sub(words, lambda _: said, order, flags=re.IGNORECASE)


def complete_person(change: Change, asked: EarlierOrder, names: Vocabulary) -> str | None:
    """Return "tell Dad in the study …" of "tell Dad …"; None where another thing is asked."""
    order, plan = plain(asked.order_text), asked.plan
    people, place = people_named(asked.order_text), change.inner or change.place
    waits = asked.state is GoalState.NEEDS_CLARIFICATION and plan is not None
    if not waits or plan is None or plan.code is not Code.INCOMPLETE or place is None:
        return None
    if len(people) != 1 or find_places(order, names):
        return None
    person = people[0]
    if change.who == "it" or (change.who and not fits(change.who, person)):
        return None
    name = names.by_id[place].name
    if has_chinese(order):
        at = order.find(plain(person))
        return f"{order[:at]}{name.zh}的{order[at:]}" if at >= 0 else None
    named = re.search(rf"\b{re.escape(person)}\b(?!'s)", asked.order_text, re.IGNORECASE)
    if named is None:
        return None
    return f"{asked.order_text[: named.end()]} in the {name.en}{asked.order_text[named.end() :]}"
