"""Write words that are to be said in every room as one drive after the other, each with its words.

Pure text to text, English: "say good night in every room". Law: words with a condition, a choice or
an exception in them are left to the grammar, which refuses them.
"""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

from planner.plan import MAX_STEPS

if TYPE_CHECKING:
    from planner.plan import Vocabulary

_LEAD = (
    r"(?:(?:please|pls|robot|pons|hey|hi|ok|okay|just|now|(?:can|could|would|will) you)[ ,]+)*"
    r"(?:go (?:and )?)?"
)
_ROOMS = r"(?:all (?:of )?(?:the |our )?rooms|every (?:single )?room|each (?:of the )?rooms?)"
_HERE = (
    rf"(?:in(?:to)? {_ROOMS}|one room after (?:another|the other)|room by room|from room to room"
    r"|in each (?:one|room) in turn)"
)
_SAY = r"(?:say|announce|shout|call out)(?: that)?"
_ALL = r"(?:everyone|everybody|all|them|people|whoever(?:'s| is) (?:there|in there))"
_WORDS = r"(?P<w>[^;.]+?)"
_REST = (
    r"(?P<rest>(?:,? (?:and )?then |,? and )(?:go|come|return|drive|head|charge|dock|wait)\b.*)?"
    r"(?:[ ,]+(?:please|thanks|thank you))?[.! ]*"
)
_FORMS = (
    re.compile(rf"{_LEAD}{_SAY} {_WORDS}(?: to {_ALL})?,? {_HERE}{_REST}", re.IGNORECASE),
    re.compile(
        rf"{_LEAD}(?:(?:go (?:through|to|into|round|around)|visit|drive (?:through|to)|do|patrol)"
        rf" {_ROOMS}),?(?: and| to)?(?: then)? (?:{_SAY}|tell {_ALL}(?: that)?) {_WORDS}"
        rf"(?: to {_ALL})?(?: in each(?: one| room| of them)?)?{_REST}",
        re.IGNORECASE,
    ),
    re.compile(
        rf"{_LEAD}tell {_ALL} (?:(?:who(?:'s| is) )?(?:in the (?:whole )?(?:house|flat|home"
        rf"|apartment)"
        rf"|at home)|in {_ROOMS})(?: that)? {_WORDS}{_REST}",
        re.IGNORECASE,
    ),
)
_OPEN = re.compile(
    r"\b(?:if|unless|until|till|when|whenever|while|before|after|or|except|but|not|then|once|twice"
    r"|times)\b|n't\b",
    re.IGNORECASE,
)
_ASKS = re.compile(
    r"(?:what|who|how many|if|whether|where|which|to|about|it|that|so)\b", re.IGNORECASE
)


def say_in_each_room(text: str, vocabulary: Vocabulary) -> str:
    """Return the text with the drives to all rooms written out; the same where it is none such."""
    said = " ".join(text.split())
    names = [entry.name.en for entry in vocabulary.entries if entry.kind == "room"]
    for form in _FORMS:
        found = form.fullmatch(said)
        if found is None:
            continue
        words = found["w"].strip(" \"'“”‘’,")
        steps = 2 * len(names)
        if (
            not words
            or not names
            or steps >= MAX_STEPS
            or _OPEN.search(words)
            or _ASKS.match(words)
        ):
            return text
        said_there = (f'go to the {name} and say "{words}"' for name in names)
        return f"{', then '.join(said_there)}{found['rest'] or ''}"
    return text
