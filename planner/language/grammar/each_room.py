"""Write words that are to be said in every room as one drive after the other, each with its words.

Pure text to text: "say good night in every room", 每个房间喊一声吃饭了. Law: words with a
condition, a choice or an exception in them are left to the grammar, which refuses them.
"""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

from planner.language.folding import has_chinese
from planner.language.grammar.sentence_text import normalise
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
_ROOMS_ZH = (
    r"(?:每(?:一?个|间)?(?:房间|屋子?)|(?:所有|各个|全部)(?:的)?(?:房间|屋子?)"
    r"|挨(?:个|着)?(?:房间|屋子?)?|一个个房间|一个房间一个房间)"
)
_FORM_ZH = re.compile(
    rf"(?P<lead>(?:[^,]{{1,6}}了,)?)(?:请|你|帮我|麻烦|,)*(?:去|到|在)?{_ROOMS_ZH}(?:里面?)?"
    r"(?:都|去|挨个|给我|也|,)*(?:喊|说|讲|叫)(?:大家|他们|人)?(?:一[声句下遍])?[:,]?"
    r"(?P<w>[^,]{2,30}?)"
    r"(?P<rest>(?:,(?:喊|说|讲|叫|弄)?完(?:了|以后|之后)?(?:就|再|你)*(?:回|去).+)?)"
)
_DONE_ZH = re.compile(r",(?:喊|说|讲|叫|弄)?完(?:了|以后|之后)?(?:就|再|你)*")
_OPEN_ZH = re.compile(
    r"如果|要是|的话|除非|除了|或者?|还是|别|不要|不用|然后|再|什么|谁|哪|几|吗|有没有"
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
    if has_chinese(text):
        return _say_chinese(text, vocabulary)
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


def _say_chinese(text: str, vocabulary: Vocabulary) -> str:
    said = normalise(text).strip(" ,。.!?")
    found = _FORM_ZH.fullmatch(said)
    names = [entry.name.zh for entry in vocabulary.entries if entry.kind == "room"]
    if found is None or not names or 2 * len(names) >= MAX_STEPS:
        return text
    words = found["w"].strip('"“”「」')
    if not words or _OPEN_ZH.search(words) or _OPEN_ZH.search(found["lead"]):
        return text
    there = "，然后".join(f"去{name}说“{words}”" for name in names)
    return found["lead"] + there + _DONE_ZH.sub("，然后", found["rest"])
