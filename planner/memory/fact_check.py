"""Judge the words of a fact before they are kept: short, one line, plain text, no order. Pure.

A kept fact orders nothing, whatever it says: it is shown as a quotation. Markup and orders are
refused all the same, so that a person learns at once that they do nothing here.
"""

from __future__ import annotations

import re
import unicodedata

from planner.language.catalogue import say
from planner.language.commands import TeachFact, intent_of
from planner.language.grammar import plan
from planner.language.reserved_names import name_reads_as_order
from planner.language.schedule import ScheduleCommand
from planner.language.stop import is_stop
from planner.plan import Bilingual, Clarify, Code, Refuse, StepPlan, Vocabulary

MAX_FACT = 300
"""Characters; the longest that a person says in one go."""
_UNSEEN = frozenset({"Cc", "Cf", "Cs", "Co", "Cn"})
_MARKUP = re.compile(
    r"</?[a-z!][^<>]*>|<[a-z/!?]|&(?:#\d+|#x[0-9a-f]+|amp|lt|gt|quot|apos|nbsp);|```|!?\[[^\]]*\]\([^)]*\)"
    r"|[{\[]\s*[\"'{\[]|[\"']\s*:\s*[\"'{\[\d]|\{\{|\}\}|\$\{|<\||\|>|^\s*#{1,6} ",
    re.IGNORECASE,
)
"""Tags and entities, code fences, links, JSON, templates, a chat's own marks, headings."""
_NAMES = re.compile(
    r"\b(?:name(?: is|'s|’s)|(?:is|are|am|was|'s|’s|'m|’m) (?:called|named)"
    r"|call(?:s|ed)? (?:him|her|it|them|me|us|this|that)(?! a\b))"
    r" (?P<en>[^,;:.!?]{1,40})$"
    r"|(?:名字(?:是|就?叫做?)|(?<!喊)叫做?|取名(?:为|叫)?|外号(?:是|叫)?)"
    r"(?P<zh>[^,，;；:：。.!！?？]{1,20})$",
    re.IGNORECASE,
)
"""What somebody or something is said to be called."""
_CALLED = re.compile(r"\bcall(?:s|ed)? (?:him|her|it|them|me|us|this|that) ", re.IGNORECASE)
"""Said of more than names: "they call me home at six"."""
_QUOTED = "\"'「」『』“”‘’《》 "
_NO_PLACES = Vocabulary(entries=())
_ORDERED = frozenset({Code.UNKNOWN_PLACE, Code.STOPPED, Code.INCOMPLETE})


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
        FactRefusal: ``fact_empty``, ``fact_too_long``, ``fact_bad_text``, ``fact_markup``,
            ``fact_order``, ``fact_order_name``.
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
    _refuse_markup(words)
    _refuse_order(words)
    return words


def _refuse_markup(words: str) -> None:
    found = _MARKUP.search(words)
    if found is not None:
        mark = found[0].strip()[:20]
        raise refuse_fact("fact_markup", f"holds {mark!r}; expected plain words", found=mark)


def _refuse_order(words: str) -> None:
    """Refuse what would stop or drive the robot, and a name that would.

    Places need no names for that: a drive to one that nobody knows is an order, too.
    """
    named = _NAMES.search(words)
    if named is not None:
        name = (named["en"] or named["zh"]).strip(_QUOTED)
        called = named["en"] and _CALLED.search(words) is not None
        reads = (not called and name_reads_as_order(name, _NO_PLACES)) or _is_order(name)
        if name and reads:
            raise refuse_fact("fact_order_name", f"the name {name!r} is an order", name=name)
    if _is_order(words):
        raise refuse_fact("fact_order", f"{words[:60]!r} is an order")


def _is_order(words: str) -> bool:
    if is_stop(words):
        return True
    intent = intent_of(words)
    if intent is not None:
        return not isinstance(intent, ScheduleCommand | TeachFact)  # "dinner is at seven"
    made = plan(words, _NO_PLACES)
    if isinstance(made, StepPlan):
        return True
    return isinstance(made, Clarify | Refuse) and made.code in _ORDERED
