"""Own the words of colours in both languages, and which colours light may turn into each other."""

from __future__ import annotations

WORDS: dict[str, tuple[tuple[str, ...], tuple[str, ...]]] = {
    "red": (("red", "scarlet", "crimson"), ("大红", "鲜红", "红")),
    "orange": (("orange",), ("橘黄", "橘红", "橘", "橙")),
    "yellow": (("yellow", "golden"), ("金黄", "金", "黄")),
    "green": (("green",), ("翠绿", "墨绿", "绿")),
    "blue": (("blue", "navy", "azure"), ("天蓝", "蔚蓝", "蓝")),
    "purple": (("purple", "violet"), ("紫",)),
    "pink": (("pink",), ("粉红", "粉")),
    "brown": (("brown",), ("咖啡", "褐", "棕")),
    "black": (("black",), ("黑",)),
    "gray": (("gray", "grey", "silver"), ("银灰", "银", "灰")),
    "white": (("white",), ("乳白", "雪白", "白")),
}
"""English words, and Chinese ones without 色; the first and the last are what is told."""
COLORS: tuple[str, ...] = tuple(WORDS)

_SHADES_EN = ("light", "dark", "bright", "deep", "pale")
_SHADES_ZH = "深浅暗亮淡"

_BY_WORD = {word: color for color, (en, zh) in WORDS.items() for word in (*en, *zh)}

_any_en = "|".join(word for en, _ in WORDS.values() for word in en)
_any_zh = "|".join(sorted((word for _, zh in WORDS.values() for word in zh), key=len, reverse=True))
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
    """Tell whether two looks at one thing may give these; what has no colour may be any."""
    if one is None or other is None or one == other:
        return True
    return frozenset((one, other)) in _NEAR


def names_of(color: str) -> tuple[str, str]:
    """Return a colour's name in English and Chinese."""
    _, zh = WORDS.get(color, ((color,), (color,)))
    return color, f"{zh[-1]}色" if color in WORDS else color
