"""Tell what each branch of a plan hangs on, and what the order says of it. Pure.

A sentence names a place in its condition, to look there, or in a branch, to go there: the guard
must tell these apart, and one branch from the other.
"""

from __future__ import annotations

import re
from collections import Counter

from planner.language.grammar.parser import Context
from planner.language.grammar.parser import plan as read_order
from planner.language.motion_guard.mentioned_names import plain
from planner.plan import (
    EVERY_KIND,
    If,
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


def read_branches(
    text: str, vocabulary: Vocabulary, room: str | None
) -> dict[StepRole, frozenset[str]] | None:
    """Return the places that each branch of an order's one condition names; else None."""
    if len(text) > READ_BY_GRAMMAR or _DENIES.search(_ELSE.sub(" | ", plain(text))):
        return None
    read = read_order(text, vocabulary, Context(room=room, runnable=EVERY_KIND))
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
