"""Set aside the words that the robot is to say, so that no grammar reads them as orders."""

from __future__ import annotations

import re

from planner.language.grammar.grammar import FIRST_QUOTE

_SAYING = re.compile(
    r"(?P<verb>\b(?:say|announce|tell (?:me|us|them|everyone))(?: out loud)?"
    r"|(?:说|說|喊|讲|播报)(?:一声|一句|一下|出)?)\s*[:：,，]?\s*"
    r"(?:[\"“”「](?P<double>[^\"“”「」]*)[\"“”」]|['‘](?P<single>.*?)['’](?!\w))",
    re.IGNORECASE,
)
_MARKS = re.compile(r"[\"“”「」『』]")
_MOST = 200


def take_quotes(text: str) -> tuple[str, tuple[str, ...]]:
    """Return the text with each quotation after "say" as one private character, and the words.

    Quotation marks elsewhere (a name in quotes) are dropped and their words stay in the sentence.
    """
    words: list[str] = []

    def aside(found: re.Match[str]) -> str:
        if len(words) >= _MOST:
            return found[0]
        words.append(found["double"] if found["double"] is not None else found["single"])
        return f"{found['verb']} {chr(FIRST_QUOTE + len(words) - 1)}"

    return _MARKS.sub("", _SAYING.sub(aside, text)), tuple(words)
