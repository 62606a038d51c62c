"""Refuse what is no readable text, before any grammar sees it."""

from __future__ import annotations

import unicodedata

from planner.language.catalogue import message, say
from planner.plan import Bilingual, Code, Refuse

MAX_CHARACTERS = 2000
EXAMPLE = say("grammar.example")

# Control, surrogate, private use: never part of a sentence. Bidirectional overrides show a person
# another sentence than the one that is read.
_OVERRIDES = frozenset("\u202a\u202b\u202c\u202d\u202e\u2066\u2067\u2068\u2069")
_NO_TEXT = frozenset({"Cc", "Cs", "Co"})


def refuse_bad_text(text: str) -> Refuse | None:
    """Return the refusal of an empty, endless or binary text, or None where it can be read."""
    if len(text) > MAX_CHARACTERS:
        return _no(Code.TEXT_TOO_LONG, length=len(text), limit=MAX_CHARACTERS)
    if not text.strip():
        return _no(Code.EMPTY_GOAL, example=EXAMPLE)
    strange = next((char for char in text if _strange(char)), None)
    if strange is not None:
        return _no(Code.BAD_TEXT, found=f"U+{ord(strange):04X}")
    if not any(char.isalnum() for char in text):
        return _no(Code.BAD_TEXT, found=text.strip()[:10])
    return None


def _strange(char: str) -> bool:
    if char in "\t\n\r":
        return False
    return char in _OVERRIDES or char == "\ufffd" or unicodedata.category(char) in _NO_TEXT


def _no(code: Code, **facts: str | int | Bilingual) -> Refuse:
    return Refuse(code=code, reason=message(code, **facts))
