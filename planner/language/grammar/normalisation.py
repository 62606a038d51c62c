"""Bring every way of writing a sentence to one: width, case, script, contractions, spaces.

Pure text to text. What it takes away carries no meaning; all else is left for the grammar to
account for, symbols included.
"""

from __future__ import annotations

import re
import unicodedata

from planner.language.folding import CHINESE, fold

_CJK = rf"[{CHINESE}。、]"
_CJK_GAP = re.compile(rf"(?<={_CJK})\s+|\s+(?={_CJK})")
_IN_BRACKETS = re.compile(r"\(([^()\d]+)\)")
_HYPHEN = re.compile(r"(?<=[a-z])[-_](?=[a-z])")
_CONTRACTIONS = (
    (re.compile(r"\bcan'?t\b"), "can not"),
    (re.compile(r"\bwon'?t\b"), "will not"),
    (re.compile(r"\b(do|does|did|is|are|would|could|should|must)n'?t\b"), r"\1 not"),
    (re.compile(r"\b(what|where|who|how)'?s\b"), r"\1 is"),
    (re.compile(r"\blet's\b"), "let us"),
    (re.compile(r"\bi'd\b"), "i would"),
    (re.compile(r"\bi'm\b"), "i am"),
    (re.compile(r"\byou're\b"), "you are"),
)
_QUOTES = str.maketrans({"’": "'", "‘": "'", "“": '"', "”": '"', "「": '"', "」": '"'})


def normalise(text: str) -> str:
    """Return the sentence in one form of writing; the same words always give the same form."""
    folded = fold(text).translate(_QUOTES)
    shown = "".join(char for char in folded if unicodedata.category(char) != "Cf")
    plain = _HYPHEN.sub(" ", shown)
    for pattern, words in _CONTRACTIONS:
        plain = pattern.sub(words, plain)
    whole = " ".join(_CJK_GAP.sub("", plain).split())
    inside = _IN_BRACKETS.fullmatch(whole)
    return inside[1] if inside else whole


def squash(name: str) -> str:
    """Return a name without what people write differently: spaces, hyphens, apostrophes, case."""
    return re.sub(r"[\s\-_'’\"]+", "", normalise(name))
