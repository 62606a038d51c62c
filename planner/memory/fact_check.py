"""Judge the words of a fact before they are kept: short, one line, text alone. Pure.

A fact is data whatever it says: one that looks like an order, or like markup, is kept as it was
said, shown as a quotation, and orders nothing.
"""

from __future__ import annotations

import unicodedata

from planner.language.catalogue import say
from planner.plan import Bilingual

MAX_FACT = 300
"""Characters; the longest that a person says in one go."""
_UNSEEN = frozenset({"Cc", "Cf", "Cs", "Co", "Cn"})


class FactRefusal(Exception):
    """A fact is not kept, or not forgotten; ``code`` is stable, ``said`` is for a person."""

    def __init__(self, code: str, detail: str, said: Bilingual) -> None:
        super().__init__(f"{code}: {detail}")
        self.code, self.detail, self.said = code, detail, said


def refuse_fact(code: str, detail: str, **facts: str | int) -> FactRefusal:
    """Return the refusal of a code with its sentence."""
    return FactRefusal(code, detail, say(f"memory.{code}", **facts))


def clean_fact(text: str) -> str:
    """Return a fact's words with single spaces.

    Raises:
        FactRefusal: ``fact_empty``, ``fact_too_long``, ``fact_bad_text``.
    """
    if len(text) > MAX_FACT:
        detail = f"{len(text)} characters; at most {MAX_FACT}"
        raise refuse_fact("fact_too_long", detail, length=len(text), limit=MAX_FACT)
    words = " ".join(text.split())
    if not any(map(str.isalnum, words)):
        raise refuse_fact("fact_empty", f"got {words[:20]!r}; expected words")
    odd = [char for char in words if unicodedata.category(char) in _UNSEEN]
    if odd:
        found = ", ".join(sorted({f"U+{ord(char):04X}" for char in odd})[:5])
        raise refuse_fact("fact_bad_text", f"holds {found}; expected plain words", found=found)
    return words
