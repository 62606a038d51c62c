"""Set words in quotation marks aside before a sentence is read, and put them back."""

from __future__ import annotations

import re

FIRST_QUOTE = 0xF800
QUOTE = "[\uf800-\uf8ff]"

_SAYING = re.compile(
    r"(?P<verb>\b(?<!\bi )(?:say|announce|tell (?:me|us|them|everyone)"
    r"|(?:tell|ask) (?:[\w']+ ){0,6}?[\w']+(?=[:,]? [\"“]))(?: out loud)?"
    r"|(?<!我)(?:说|說|喊|讲|播报)(?:一声|一句|一下|出|(?:[两二三四五2-5]|好?几)[遍声次句])?)\s*[:：,，]?\s*"
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

    def set_aside(found: re.Match[str]) -> str:
        if len(words) >= _MOST:
            return found[0]
        words.append(found["double"] if found["double"] is not None else found["single"])
        return f"{found['verb']} {chr(FIRST_QUOTE + len(words) - 1)}"

    return _MARKS.sub("", _SAYING.sub(set_aside, text)), tuple(words)


def put_quotes_back(text: str, words: tuple[str, ...]) -> str:
    """Return a text with its quotations in marks again, as ``take_quotes`` found them."""
    return re.sub(
        QUOTE,
        lambda found: f'"{words[at]}"' if (at := ord(found[0]) - FIRST_QUOTE) < len(words) else "",
        text,
    )
