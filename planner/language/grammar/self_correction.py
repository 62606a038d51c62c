"""Read a sentence that takes itself back: "the kitchen, no sorry, the study", 厨房，不对，书房.

Pure, over a marked sentence. Law: what was taken back is never done. The words behind the
correction are the order; where they are a place alone, they stand in the one place of the order
before them. With two corrections, or with more than one place, nothing is read.
"""

from __future__ import annotations

import re

from planner.language.folding import has_chinese
from planner.language.grammar.lexicon import MARK

_OH = r"(?:(?:oh|er|erm|um|uh|ah|oops|hang on|hold on)[, ]+)*"
_BACK = (
    rf"{_OH}(?:no[, ]+(?:wait|sorry|no|actually|hang on|i mean|i meant)|wait[, ]+no"
    r"|sorry[, ]+(?:no|i mean|i meant)|make that|scratch that|oops"
    r"|actually[, ]+no|no)"
    r"(?:[, ]+(?:wait|sorry|no|actually|i mean|i meant|make (?:that|it)|oh))*"
)
_EN = re.compile(rf"(?P<first>.+?)(?:[,.;!]+| [-–—]+|(?= no wait\b)) *{_BACK}[, ]+(?P<rest>.+)")
_ZH = re.compile(
    r"(?P<first>.+?)[,。!;](?:呃+|额+|嗯+|哦|啊|哎呀?|,)*"
    r"(?:(?:不对|错了|说错了|口误|不不|哦不|不是|不)(?:不对|不是|不|了|啊|哦|,)*)[,。!]"
    r"(?:是|应该是|我是说|我说的是|我的意思是|先|改)?(?P<rest>.+)"
)
_ALONE = re.compile(rf"(?:(?:to|in|into|at) )?(?:the |my |our )?(?P<place>{MARK})[里上]?")
_ORDER = re.compile(
    r"(?:please )?(?:go|drive|come|find|look|search|count|follow|wait|patrol|turn|check|head)\b"
    r"|[去到回找看跟等数巡转]"
)


def take_last_word(text: str) -> str | None:
    """Return the order that is left of a marked sentence that takes itself back, or None."""
    said = text.strip(" .!?。")
    pattern = _ZH if has_chinese(said) else _EN
    found = pattern.fullmatch(said)
    if found is None or pattern.fullmatch(found["rest"]) is not None:
        return None
    rest = found["rest"].strip(" ,")
    alone = _ALONE.fullmatch(rest)
    if alone is not None:
        places = re.findall(MARK, found["first"])
        return found["first"].replace(places[0], alone["place"]) if len(places) == 1 else None
    return rest if _ORDER.match(rest) else None
