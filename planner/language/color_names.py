"""Read the words of colours, and know which colours light may turn into each other."""

from __future__ import annotations

from planner.language.catalogue import CATALOGUE, noun
from planner.plan import Bilingual, say_same

COLORS = CATALOGUE.keys("color")
_WORDS_EN = {color: CATALOGUE.synonyms(f"color.{color}", "en") for color in COLORS}
_WORDS_ZH = {
    color: tuple(word.removesuffix("色") for word in CATALOGUE.synonyms(f"color.{color}", "zh"))
    for color in COLORS
}

_SHADES_EN = ("light", "dark", "bright", "deep", "pale")
_SHADES_ZH = "深浅暗亮淡"

_BY_WORD = {
    word: color for own in (_WORDS_EN, _WORDS_ZH) for color, words in own.items() for word in words
}
_any_en = "|".join(word for words in _WORDS_EN.values() for word in words)
_any_zh = "|".join(
    sorted((word for words in _WORDS_ZH.values() for word in words), key=len, reverse=True)
)
ENGLISH = rf"(?:(?:{'|'.join(_SHADES_EN)})[ -])?(?:{_any_en})(?:[ -]colou?red)?"
"""A pattern of one colour as English says it."""
CHINESE = rf"[{_SHADES_ZH}]?(?:{_any_zh})色?"
"""A pattern of one colour as Chinese says it, without the 的 behind it."""

_NEAR = frozenset(
    frozenset(pair.split("-"))
    for pair in (
        "red-orange", "red-pink", "red-brown", "red-purple", "orange-yellow", "orange-brown",
        "orange-pink", "yellow-brown", "yellow-green", "yellow-white", "green-blue", "green-black",
        "green-gray", "blue-purple", "blue-black", "blue-gray", "purple-pink", "purple-black",
        "pink-white", "brown-black", "brown-gray", "black-gray", "gray-white",
    )
)  # fmt: skip


def color_of(words: str) -> str | None:
    """Return the colour that one phrase of a colour means: "dark red", "深红色"."""
    plain = words.casefold().replace("-", " ").removesuffix("色")
    for tail in (" coloured", " colored"):
        plain = plain.removesuffix(tail)
    plain = plain.split(" ")[-1]
    return _BY_WORD.get(plain) or _BY_WORD.get(plain.lstrip(_SHADES_ZH))


def may_be(one: str | None, other: str | None) -> bool:
    """Return whether two looks at one thing may give these colours; no colour may be any."""
    if one is None or other is None or one == other:
        return True
    return frozenset((one, other)) in _NEAR


def color_name(color: str) -> Bilingual:
    """Return what to call a colour."""
    return noun(f"color.{color}") if color in COLORS else say_same(color)
