"""Tell whether a person's words take something back, outside of conditions and quotes."""

from __future__ import annotations

import re

from planner.language.motion_guard.clause_moods import ClauseMood
from planner.language.motion_guard.clauses import read_clauses
from planner.plan import Vocabulary

_ENDS_IT = (
    r"\b(?:forget|cancel|never ?mind|scrap|scratch|abort|drop|call off|leave it|skip|enough|quit"
    r"|(?:don't|do not) (?:go|bother|need|look|do|drive))\b"
    r"|取消|撤销|算了|放弃|忘了|免了|不用|不要|别"
)
_ENDS = re.compile(_ENDS_IT)
_TAKES_BACK = re.compile(
    rf"(?:^|[,.;!|] *)(?:\w+ )?(?:no|nope|not)\b|\bnot (?:the|there|that|this)\b"
    r"|\b(?:instead|rather|wrong|i meant?|changed? (?:my|the|of)|actually|sorry|make (?:it|that))\b"
    rf"|不对|不是|不去|不不|^不|改|换|错|而是|还是去|我(?:说|要|指)的是|我是说|{_ENDS_IT}"
)


def takes_back(text: str) -> bool:
    """Tell whether a person's words take anything back, whatever they name."""
    return _TAKES_BACK.search(_unconditional(text)) is not None


def ends_goal(text: str) -> bool:
    """Tell whether a person's words end what is done, and nothing in its place."""
    return _ENDS.search(_unconditional(text)) is not None


def _unconditional(text: str) -> str:
    """Return what a sentence says outside of conditions and quotes, denials included."""
    clauses = read_clauses(text, Vocabulary())
    hangs = any(each.hung or each.mood is ClauseMood.CONDITION for each in clauses)
    out = {ClauseMood.CONDITION, ClauseMood.DENIED} if hangs else set()
    return " | ".join(each.text for each in clauses if each.mood not in out and not each.hung)
