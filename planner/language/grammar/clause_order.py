"""Bring clauses into the order in which they are to be done: "before", "after", "first", "之前".

A sentence is turned round at most once; with two such words it is left as it is, and then read by
no rule.
"""

from __future__ import annotations

import re

from planner.language.grammar.lexicon import MARK

_WORDS = re.compile(
    r"\bbefore\b|(?<!come )(?<!go )(?<!look )(?<!run )\bafter\b(?! that| this)|\bfirst\b|之前|以前|"
    r"但先|但是先"
)
_POLITE = r"(?P<polite>(?:(?:please|robot|pons|hey|hi|ok|(?:can|could|would|will) you),? )*)"
_EN = (
    re.compile(rf"{_POLITE}before (?P<late>[^,]+), ?(?P<early>.+)"),
    re.compile(r"(?P<late>.+?)[,.;] ?(?:but |and )?before (?:that|this|it),? (?P<early>.+)"),
    re.compile(r"(?P<early>.+?),? (?:but |and )?before (?P<late>(?!that\b|this\b|it\b).+)"),
    re.compile(rf"{_POLITE}after (?P<early>[^,]+), ?(?P<late>.+)"),
    re.compile(
        rf"{_POLITE}after (?P<early>[^,]*?{MARK}) (?P<late>(?:go|drive|come|visit|find|look|check|"
        r"return|turn|head)\b.+)"
    ),
    re.compile(r"(?P<late>[^,;.]+?),? (?:but |and |only )?after (?P<early>[^,;.]+)"),
    re.compile(r"(?P<late>.+?),? (?:but|and) first,? (?P<early>.+)"),
    re.compile(r"(?P<late>.+)[,;.] ?(?:but |and )?(?P<early>[^,;.]+?) first"),
)
_ZH = (
    re.compile(r"(?P<late>.+?)[,。;]?(?:但是?)?在?(?:此|这|那)之前,?(?:先)?(?P<early>.+)"),
    re.compile(r"(?:在)?(?P<late>.+?)(?:之前|以前),?(?:请|要)?(?:先)?(?P<early>.+)"),
    re.compile(r"(?P<late>.+?)[,。;]?但是?先(?P<early>.+)"),
    re.compile(r"最后(?P<late>.+?)[,。;]先(?P<early>.+)"),
)
_BARE = re.compile(rf"(?:(?:the|my|our) )?{MARK}")
_GERUNDS = {
    "going": "go", "driving": "drive", "moving": "move", "heading": "head", "walking": "walk",
    "visiting": "visit", "checking": "check", "coming": "come", "returning": "return",
    "waiting": "wait", "finding": "find", "looking": "look", "searching": "search",
    "counting": "count", "turning": "turn", "saying": "say", "telling": "tell",
    "following": "follow", "patrolling": "patrol", "inspecting": "inspect", "greeting": "greet",
    "meeting": "meet", "asking": "ask", "locating": "locate", "reaching": "reach",
    "navigating": "navigate", "entering": "enter", "stopping by": "stop by", "leaving": "leave",
}  # fmt: skip
_GERUND = re.compile(rf"^(?:you (?=\w)|(?P<verb>{'|'.join(_GERUNDS)})\b)")


def in_order(text: str) -> str:
    """Return a marked sentence with what is to be done first standing first."""
    if len(_WORDS.findall(text)) != 1:
        return text
    plain = text.rstrip(".!? 。")
    for pattern in (*_EN, *_ZH):
        found = pattern.fullmatch(plain)
        if found:
            early, late = (_order(found[part]) for part in ("early", "late"))
            polite = found.groupdict().get("polite") or ""
            joint = ", then " if pattern in _EN else ",然后"
            return f"{polite}{_going(early) if pattern in _EN else early}{joint}{late}"
    return text


def _order(clause: str) -> str:
    """Write "going to the kitchen" as an order."""
    return _GERUND.sub(
        lambda found: _GERUNDS[found["verb"]] if found["verb"] else "", clause.strip(" ,")
    )


def _going(clause: str) -> str:
    return f"go to {clause}" if _BARE.fullmatch(clause) else clause
