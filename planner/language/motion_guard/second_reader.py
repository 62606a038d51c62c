"""Ask the grammar, as a second reader, what an order says; tell what each branch hangs on. Pure.

A sentence names a place in its condition, to look there, or in a branch, to go there: the guard
must tell these apart, and one branch from the other.
"""

from __future__ import annotations

import re
from collections import Counter
from functools import lru_cache

from planner.language.grammar.context import Context
from planner.language.grammar.parser import plan as read_order
from planner.language.motion_guard.mentioned_names import places_named, plain
from planner.plan import (
    EVERY_KIND,
    AnswerPlan,
    Clarify,
    ClockTime,
    Code,
    If,
    Refuse,
    Step,
    StepNode,
    StepPlan,
    StepRole,
    Vocabulary,
    children_of,
    list_nodes,
    parent_of,
    parents_of,
    places_of,
)

READ_BY_GRAMMAR = 300
"""Characters; in a longer text the words alone judge."""
_READ_LATELY = 16
"""An order and its clauses (``spare_clauses``): each plan made of them asks about them again."""
_UPON = frozenset(
    {StepRole.WHEN, StepRole.THEN, StepRole.OTHERWISE, StepRole.ON_FAILURE, StepRole.UNTIL}
)


def hangs_on_more(row: tuple[StepNode, ...], index: int) -> bool:
    """Tell whether a step is a condition, or done upon one or upon a failure alone."""
    return any(row[i].role in _UPON for i in (index, *parents_of(row, index)))


_BRANCHES = frozenset({StepRole.THEN, StepRole.OTHERWISE})


def asked_about(row: tuple[StepNode, ...], index: int) -> Counter[str]:
    """Return the places that the conditions ask about on which a step hangs.

    Where a sentence names one of them once, it names where to look and no place to go to.
    """
    asked: Counter[str] = Counter()
    for at in (index, *parents_of(row, index)):
        parent = parent_of(row, at)
        if parent is None or row[at].role not in _BRANCHES:
            continue
        for child in children_of(row, parent):
            if row[child].role is StepRole.WHEN:
                asked.update(places_of(row[child].step))
    return asked


_ELSE = re.compile(r"\bif (?:not|no)\b|要?不然的?话?|要不(?!要)|没有(?:的话)?(?=[,，]?[就便去回])")
"""Words that open the other branch and deny nothing."""
_DENIES = re.compile(r"\b(?:no|nobody|none|not|never|without|empty|unless)\b|n't|没|无|不|空")


@lru_cache(maxsize=_READ_LATELY)
def _read_order(
    text: str, vocabulary: Vocabulary, room: str | None
) -> StepPlan | AnswerPlan | Clarify | Refuse:
    """Return the grammar's plan of an order, read by a robot that can do every kind of step."""
    return read_order(text, vocabulary, Context(room=room, runnable=EVERY_KIND))


def read_branches(
    text: str, vocabulary: Vocabulary, room: str | None
) -> dict[StepRole, frozenset[str]] | None:
    """Return the places that each branch of an order's one condition names; else None."""
    if len(text) > READ_BY_GRAMMAR or _DENIES.search(_ELSE.sub(" | ", plain(text))):
        return None
    read = _read_order(text, vocabulary, room)
    row = list_nodes(read.steps) if isinstance(read, StepPlan) else ()
    if sum(isinstance(node.step, If) for node in row) != 1:
        return None
    places: dict[StepRole, set[str]] = {role: set() for role in _BRANCHES}
    for index, node in enumerate(row):
        role = branch_of(row, index)
        if role is not None:
            places[role].update(places_of(node.step))
    return {role: frozenset(named) for role, named in places.items()}


def branch_of(row: tuple[StepNode, ...], index: int) -> StepRole | None:
    """Return in which branch of the nearest condition a step stands."""
    roles = (row[at].role for at in (index, *parents_of(row, index)))
    return next((role for role in roles if role in _BRANCHES), None)


VETOES = frozenset(
    {
        Code.UNSAFE,
        Code.NO_CAPABILITY,
        Code.OUT_OF_SCOPE,
        Code.AMBIGUOUS,
    }
)
"""What the grammar says of an order upon which no motion is beyond doubt. It says negated and
conditional, too, but of the whole sentence; `order_scope` tells the part."""
_CLAUSE = re.compile(r"[,.;!?，。；！？]")
_MOST_CLAUSES = 12
_STATES = re.compile(
    r"(?:some(?:body|one)|there|it|i|we|my|our|he|she|they|the)\b|好像|有人|我|听|刚才|他|她"
)


def read_grammar(
    text: str, vocabulary: Vocabulary, room: str | None
) -> tuple[Counter[object], Counter[object], Code | None]:
    """Return the steps that the grammar reads in an order, or why nothing may move upon it.

    First those that are done anyhow, then these and what hangs on a condition or a failure.
    """
    if len(text) > READ_BY_GRAMMAR:
        return Counter(), Counter(), None
    read = _read_order(text, vocabulary, room)
    if isinstance(read, StepPlan):
        row = list_nodes(read.steps)  # what hangs on something is not asked for without it
        own = (n.step for i, n in enumerate(row) if not hangs_on_more(row, i))
        return Counter(map(key_of_step, own)), Counter(key_of_step(n.step) for n in row), None
    vetoed = isinstance(read, Refuse | Clarify) and read.code in VETOES
    if (
        isinstance(read, Clarify) and vetoed and read.code is Code.AMBIGUOUS
    ):  # a choice of drinks is no choice of ways
        vetoed = len(set(places_named(text, vocabulary))) > 1
    return (
        Counter(),
        Counter(),
        read.code if vetoed and isinstance(read, Refuse | Clarify) else None,
    )


def spare_clauses(text: str, vocabulary: Vocabulary, room: str | None) -> str | None:
    """Return what is ordered beside a mere statement; None where the order itself is vetoed."""
    clauses = [clause for clause in _CLAUSE.split(text) if clause.strip()]
    if not 1 < len(clauses) <= _MOST_CLAUSES:
        return None
    orders = [clause for clause in clauses if not _STATES.match(plain(clause))]
    vetoed = any(read_grammar(clause, vocabulary, room)[2] for clause in orders)
    return ", ".join(orders) if orders and not vetoed and len(orders) < len(clauses) else None


def key_of_step(step: Step | ClockTime) -> object:
    """Return what a step does, however it is worded."""
    label = getattr(step, "object", None)
    angle, far = getattr(step, "angle_rad", None), getattr(step, "distance_m", None)
    return (
        step.kind,
        places_of(step),
        label.casefold() if label is not None else None,
        round(angle, 1) if angle is not None else None,
        round(far, 2) if far is not None else None,
        getattr(step, "look", False),
        getattr(step, "side", None),
    )
