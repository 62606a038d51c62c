"""Draw sentences with what they ask for, by seed, from the phrases and sentences of this folder.

A sentence of ``people_*`` is taken as it was said. A phrase is filled, given an opening or an end
that says nothing, and now and then a slip of the keyboard; the same phrases denied, told of others,
put off or hung on something ask for nothing.
"""

from __future__ import annotations

import re
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from random import Random

from planner.language.grammar.guessed_order import NONE
from planner.language.grammar.lexicon import Lexicon, lexicon_of
from planner.language.grammar.sentence_text import normalise
from planner.language.intent.features import MOST_UNITS, units_of
from planner.language.intent.intent_model import NAME, OTHER, THING, WORDS
from planner.site.site import Site
from planner.site.site_view import vocabulary_of

PHRASES = Path(__file__).parent / "phrases"
HOME = Path(__file__).parents[2] / "sites" / "home"
LANGUAGES = ("en", "zh")
PEOPLE_SHARE = 0.6
NONE_SHARE = 0.35
"""Of what is drawn from phrases."""
SWAPPED = 0.25
"""Of sentences in which a thing is sought, so many seek another thing."""
_PLACES = {"{p}": "\ue000", "{q}": "\ue001"}
_SLOTS = {"t": THING, "w": WORDS, "n": NAME}


@dataclass(frozen=True, slots=True)
class Example:
    """Hold the units of a sentence, what it asks for, and what its units belong to."""

    units: tuple[str, ...]
    intent: str
    labels: tuple[int, ...]


@dataclass(frozen=True, slots=True)
class SaidExample:
    """Hold a sentence that somebody said, and who."""

    writer: str
    language: str
    example: Example


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


@cache
def said_by_people() -> tuple[SaidExample, ...]:
    """Return the sentences of both languages that can be read at a glance, with their labels."""
    lexicon = lexicon_of(vocabulary_of(Site.load(HOME)))
    found = []
    for language in LANGUAGES:
        for line in (PHRASES / f"people_{language}.tsv").read_text("utf-8").splitlines():
            writer, intent, sentence, slots = line.split("\t")
            units = units_of(lexicon.mark(normalise(sentence)).text)
            if 0 < len(units) <= MOST_UNITS:
                labels = tuple(_label(units, slots, lexicon))
                example = Example(tuple(units), intent, labels)
                found.append(SaidExample(f"{language}{writer}", language, example))
    return tuple(found)


def _label(units: list[str], slots: str, lexicon: Lexicon) -> list[int]:
    """Return a label a unit; ``slots`` is ``t:red cup; w:dinner is ready; n:Anna`` or ``-``."""
    labels = [OTHER] * len(units)
    for slot in slots.split("; "):
        kind, _, words = slot.partition(":")
        sought = units_of(lexicon.mark(normalise(words)).text)
        for at in range(len(units) - len(sought) + 1) if sought and kind in _SLOTS else ():
            if all(map(_alike, sought, units[at:])):
                labels[at : at + len(sought)] = [_SLOTS[kind]] * len(sought)
                break
    return labels


def _alike(sought: str, unit: str) -> bool:
    """Tell whether two units are one; places are numbered anew in a part of a sentence."""
    return sought == unit or (sought[0] == "<" and unit[0] == "<")


@cache
def intents() -> tuple[str, ...]:
    """Return what may be asked for, in a fixed order."""
    said = {one.example.intent for one in said_by_people()}
    return tuple(sorted(said.union(*map(phrases, LANGUAGES))))


@cache
def writers() -> tuple[str, ...]:
    """Return who said the sentences, as ``en1``."""
    return tuple(sorted({one.writer for one in said_by_people()}))


@cache
def _words(name: str) -> tuple[str, ...]:
    lines = (PHRASES / f"{name}.txt").read_text("utf-8").splitlines()
    return tuple(line for line in lines if line and not line.startswith("#"))


@cache
def _said_without(away: frozenset[str]) -> tuple[SaidExample, ...]:
    return tuple(one for one in said_by_people() if one.writer not in away)


def draw(random: Random, away: frozenset[str] = frozenset()) -> Example:
    """Draw one example.

    Args:
        random: its chance.
        away: writers whose sentences are not drawn.
    """
    said = _said_without(away)
    if said and random.random() < PEOPLE_SHARE:
        return _with_another_thing(random.choice(said), random)
    language = random.choice(LANGUAGES)
    table = phrases(language)
    none = random.random() < NONE_SHARE
    intent = NONE if none else random.choice([one for one in table if one != NONE])
    phrase = random.choice(table[intent])
    if none and random.random() < 0.4:
        source = random.choice([one for one in table if one != NONE])
        hung = random.choice(_words(f"hung_{language}"))
        phrase = hung.replace("…", random.choice(table[source]))
    return _example(_dress(phrase, language, random), intent, language, random)


def _with_another_thing(said: SaidExample, random: Random) -> Example:
    """Return a sentence, now and then with another thing in it."""
    example = said.example
    if THING not in example.labels or random.random() > SWAPPED:
        return example
    begin = example.labels.index(THING)
    end = begin
    while end < len(example.labels) and example.labels[end] == THING:
        end += 1
    thing = tuple(units_of(normalise(random.choice(_words(f"things_{said.language}")))))
    units = (*example.units[:begin], *thing, *example.units[end:])
    labels = (*example.labels[:begin], *(THING for _ in thing), *example.labels[end:])
    return Example(units, example.intent, labels)


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
    labels: list[int] = []
    phrase = normalise(phrase)
    for part in re.split(r"(\{[pqt]\})", phrase):
        is_thing = part == "{t}"
        text = thing if is_thing else _PLACES.get(part, part)
        if not is_thing and part not in _PLACES:
            text = _slip(text, random) if random.random() < 0.05 else text
        cut = units_of(text) if part not in _PLACES else [f"<{'pq'.index(part[1])}>"]
        units += cut
        labels += [THING if is_thing else OTHER] * len(cut)
    if units and units[0] == "<1>":
        units = ["<0>" if unit == "<1>" else "<1>" if unit == "<0>" else unit for unit in units]
    return Example(tuple(units), intent, tuple(labels))


def _slip(text: str, random: Random) -> str:
    """Return a text with two neighbours swapped, or one character lost."""
    if len(text) < 5:
        return text
    at = random.randrange(1, len(text) - 2)
    if random.random() < 0.5:
        return text[:at] + text[at + 1] + text[at] + text[at + 2 :]
    return text[:at] + text[at + 1 :]
