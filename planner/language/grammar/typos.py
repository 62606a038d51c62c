"""Mend misspelt words of command, one letter wrong: "naviagte", "folow", "plaese".

Only words of five letters and more that are no word of the grammar, and only towards one word; a
wrong "not" is never made or unmade. Names of places are the lexicon's business.
"""

from __future__ import annotations

import re
from functools import lru_cache

from rapidfuzz.distance import OSA

_COMMANDS = (
    ("navigate", "drive", "return", "visit", "follow", "locate", "search", "count", "patrol",
     "inspect", "please", "describe", "rotate", "proceed", "travel", "forward", "backward",
     "degrees", "seconds", "minutes", "metres", "meters", "could", "would", "where", "escort",
     "guide", "greet", "introduce", "finally", "afterwards", "charge", "again", "there", "check")
)  # fmt: skip
_WORD = re.compile(r"(?<![a-z'])[a-z]{4,}(?![a-z'])")
_SHORTEST = 5
_ENDINGS = ("s", "d", "r", "er", "ed", "ing", "y", "ly")


def mend(text: str, known: frozenset[str]) -> str:
    """Return a normalised sentence with its words of command spelt right."""
    return _WORD.sub(lambda found: _right(found[0], known), text)


@lru_cache(maxsize=4096)
def _right(word: str, known: frozenset[str]) -> str:
    if word in known or any(word == command + end for command in _COMMANDS for end in _ENDINGS):
        return word
    near = [
        command
        for command in _COMMANDS
        if len(command) >= _SHORTEST
        and word[0] == command[0]
        and OSA.distance(word, command, score_cutoff=1) <= 1
    ]
    return near[0] if len(near) == 1 else word


def words_of(*patterns: re.Pattern[str]) -> frozenset[str]:
    """Return every word that stands in these patterns: they are spelt right."""
    found: set[str] = set()
    for pattern in patterns:
        found.update(re.findall(r"[a-z]{4,}", pattern.pattern))
        found.update(part.replace("?", "") for part in re.findall(r"[a-z?]{4,}", pattern.pattern))
    return frozenset(found)
