"""Draw sentences with what they ask for, by seed, from the phrases of this folder.

A phrase is filled, given an opening or an end that says nothing, and now and then a slip of the
keyboard. The same phrases denied, told of others, put off or hung on something ask for nothing.
"""

from __future__ import annotations

import re
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from random import Random

from planner.language.grammar.guessed_order import NONE
from planner.language.grammar.sentence_text import normalise
from planner.language.intent.features import units_of

PHRASES = Path(__file__).parent / "phrases"
LANGUAGES = ("en", "zh")
NONE_SHARE = 0.35
_PLACES = {"{p}": "\ue000", "{q}": "\ue001"}


@dataclass(frozen=True, slots=True)
class Example:
    """Hold the units of a sentence, what it asks for, and which units name a thing."""

    units: tuple[str, ...]
    intent: str
    thing: tuple[bool, ...]


@cache
def phrases(language: str) -> dict[str, tuple[str, ...]]:
    """Return the phrases of a language by intent, in the file's order."""
    found: dict[str, list[str]] = {}
    intent = ""
    for line in (PHRASES / f"{language}.txt").read_text("utf-8").splitlines():
        if line.startswith("["):
            intent = line.strip("[]")
            found[intent] = []
        elif line and not line.startswith("#"):
            found[intent].append(line)
    return {intent: tuple(lines) for intent, lines in found.items()}


def intents() -> tuple[str, ...]:
    """Return what may be asked for, in a fixed order."""
    return tuple(phrases("en"))


@cache
def _words(name: str) -> tuple[str, ...]:
    lines = (PHRASES / f"{name}.txt").read_text("utf-8").splitlines()
    return tuple(line for line in lines if line and not line.startswith("#"))


def draw(random: Random, held: float = 0.0, *, from_held: bool = False) -> Example:
    """Draw one example.

    Args:
        random: its chance.
        held: this share of every intent's phrases is kept away, or alone drawn from.
        from_held: draw from the phrases that are kept away.
    """
    language = random.choice(LANGUAGES)
    table = phrases(language)
    none = random.random() < NONE_SHARE
    intent = NONE if none else random.choice([one for one in table if one != NONE])
    source = intent
    hung = none and random.random() < 0.4
    if hung:
        source = random.choice([one for one in table if one != NONE])
    lines = [
        line
        for number, line in enumerate(table[source])
        if (Random(f"{line}{number}").random() < held) == from_held
    ]
    phrase = random.choice(lines or list(table[source]))
    if hung:
        phrase = random.choice(_words(f"hung_{language}")).replace("…", phrase)
    return _example(_dress(phrase, language, random), intent, language, random)


def _dress(phrase: str, language: str, random: Random) -> str:
    """Return a phrase as it may be said: with an opening or an end that says nothing."""
    if language == "en":
        phrase = re.sub(
            r"\bthe \{", random.choice(("the {",) * 6 + ("{", "our {", "that {")), phrase
        )
    if random.random() < 0.55:
        opening = random.choice(_words(f"openings_{language}"))
        phrase = opening + ("" if language == "zh" else " ") + phrase
    if random.random() < 0.45:
        end = random.choice(_words(f"ends_{language}"))
        phrase = phrase + ("" if language == "zh" or end[0] in ",.?!" else " ") + end
    return phrase


def _example(phrase: str, intent: str, language: str, random: Random) -> Example:
    thing = random.choice(_words(f"things_{language}"))
    if language == "en" and random.random() < 0.2:
        thing = (
            f"{random.choice(('red', 'blue', 'black', 'green', 'old', 'big', 'little'))} {thing}"
        )
    if language == "zh" and random.random() < 0.2:
        thing = f"{random.choice(('红色的', '蓝', '黑色', '那个', '大', '小'))}{thing}"
    units: list[str] = []
    tags: list[bool] = []
    phrase = normalise(phrase)
    for part in re.split(r"(\{[pqt]\})", phrase):
        is_thing = part == "{t}"
        text = thing if is_thing else _PLACES.get(part, part)
        if not is_thing and part not in _PLACES:
            text = _slip(text, random) if random.random() < 0.05 else text
        cut = units_of(text)
        units += cut if part not in _PLACES else [f"<{'pq'.index(part[1])}>"]
        tags += [is_thing] * (len(cut) if part not in _PLACES else 1)
    if units and units[0] == "<1>":
        units = ["<0>" if unit == "<1>" else "<1>" if unit == "<0>" else unit for unit in units]
    return Example(tuple(units), intent, tuple(tags))


def _slip(text: str, random: Random) -> str:
    """Return a text with two neighbours swapped, or one character lost."""
    if len(text) < 5:
        return text
    at = random.randrange(1, len(text) - 2)
    if random.random() < 0.5:
        return text[:at] + text[at + 1] + text[at] + text[at + 2 :]
    return text[:at] + text[at + 1 :]
