"""Tell whether a would-be name of a place reads as an order, a denial or a condition. Pure.

Names are found in a sentence before anything else is read, so a name made of such words would take
them out of every later sentence: with a place called "do not", "do not go there" would lose its
negation.
"""

from __future__ import annotations

import re

from planner.language.commands.parser import intent_of
from planner.language.grammar import plan
from planner.language.grammar.sentence_text import normalise
from planner.language.stop import is_stop
from planner.plan import Clarify, Code, Plan, Refuse, Vocabulary

_HARMLESS = frozenset(
    {Code.UNKNOWN_PLACE, Code.NOT_UNDERSTOOD, Code.NO_CAMERA, Code.NO_CAPABILITY, Code.AMBIGUOUS}
)
_FUNCTION = re.compile(
    r"\b(?:and|or|then|to|from|into|please|not|no|go|come|drive|move|wait|back|here|there|it|home"
    r"|base|all|everything|everywhere|me|you|stop|first|last|left|right|forwards?|around)\b"
    r"|然后|接着|之后|以后|之前|以前|或者|还是|如果|要是|跟着|跟我|提醒|[别不没勿莫]"
)
_ALONE = re.compile(
    r"(?:[去到来回走停等请先再就把的里了吧吗我你他她它这那家和跟与])+|这里|那里|原地"
)


def name_reads_as_order(name: str, vocabulary: Vocabulary) -> bool:
    """Tell whether a name must not be taught, given what the names of today are."""
    plain = normalise(name)
    if _FUNCTION.search(plain) or _ALONE.fullmatch(plain):
        return True
    if name_is_command(name):
        return True
    sentences = (name, f"go to the {name}", f"去{name}")
    return not all(_harmless(plan(sentence, vocabulary)) for sentence in sentences)


def name_is_command(name: str) -> bool:
    """Tell whether a name said alone stops, pauses or otherwise commands the planner."""
    return is_stop(name) or intent_of(name) is not None


def _harmless(read: Plan) -> bool:
    """Tell whether a sentence without this name means nothing by itself."""
    return isinstance(read, (Clarify, Refuse)) and read.code in _HARMLESS
