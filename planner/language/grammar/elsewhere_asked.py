"""Refuse to answer here what a clause asks about a place that nobody knows."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

from planner.language.grammar.parse_result import ClauseProblem, Steps
from planner.language.questions import find_elsewhere
from planner.plan import Code, Look

if TYPE_CHECKING:
    from planner.language.grammar.parse_result import Meaning, Reading

_UNREAD = frozenset({Code.NOT_UNDERSTOOD, Code.INCOMPLETE, Code.UNKNOWN_PLACE})
_ASKS = re.compile(
    r"看|检查|查看|巡视|[吗么]$|有没有|有人|什么|谁"
    r"|^(?:is|are|what|who|do you|can you|check|look|see|watch|inspect)\b"
)


def tell_elsewhere(text: str, meaning: Meaning, reading: Reading) -> Meaning:
    """Return a clause's meaning, or that a place is unknown of which would be answered here.

    Args:
        text: the clause, its known places marked.
        meaning: what it was read as.
        reading: of the clause.
    """
    looks = isinstance(meaning, Steps) and any(
        isinstance(step, Look) and step.place is None for step in meaning.steps
    )
    asks = isinstance(meaning, ClauseProblem) and meaning.code in _UNREAD
    name = find_elsewhere(text) if looks or (asks and _ASKS.search(text)) else None
    if name is None:
        return meaning
    near = reading.lexicon.near(name)
    return ClauseProblem(Code.UNKNOWN_PLACE, name, places=near, name=name)
