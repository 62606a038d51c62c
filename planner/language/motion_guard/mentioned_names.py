"""Find the names in a sentence by plain text search, without a grammar.

It shares no code with any brain, so that a brain's misreading can't hide in the judge's.
"""

from __future__ import annotations

import re
from dataclasses import dataclass
from functools import lru_cache
from typing import TYPE_CHECKING

from rapidfuzz.distance import OSA

from planner.language.folding import CHINESE, fold_words
from planner.language.object_names import resolve, synonyms
from planner.plan import Language, Vocabulary

if TYPE_CHECKING:
    from collections.abc import Iterator

_WORD = re.compile(rf"[a-z0-9']+|[{CHINESE}]")
_GENERIC = frozenset(
    (
        "the",
        "a",
        "an",
        "of",
        "in",
        "on",
        "at",
        "to",
        "that",
        "any",
        "some",
        "all",
        "my",
        "your",
        "their",
        "his",
        "her",
        "its",
        "with",
        "and",
        "is",
        "are",
        "there",
        "who",
        "person",
        "people",
        "someone",
        "somebody",
        "objects",
        "object",
        "one",
        "thing",
        "things",
    )
)
_GENERIC_ZH = frozenset("的个一人有在里那这些吗")


def plain(text: str) -> str:
    """Return a text in one width and case, with single spaces."""
    return fold_words(text).replace("’", "'")


_SHORT = 5
"""A name this short may be another word with one letter changed: "table", "cable"."""
_LONG = re.compile(r"(?<![a-z0-9'])[a-z]{4,}(?![a-z0-9'])")
_NEXT_TOO = re.compile(r"[a-z]+ [a-z]+(?![a-z0-9'])")
_MOST_SLIPS = 2000


@dataclass(frozen=True, slots=True)
class NamedPlace:
    """Hold where a text names a place: by its id, from ``start`` to ``end`` of the plain text."""

    id: str
    start: int
    end: int


@dataclass(frozen=True, slots=True)
class _Names:
    """Hold the names of one vocabulary: as one pattern, and whose each is."""

    pattern: re.Pattern[str]
    owner: dict[str, str]
    slips: dict[str, str | None]
    """Misspelt names that were met, and the one place that each can mean."""

    def find(self, text: str) -> Iterator[NamedPlace]:
        """Yield the places that a plain text names, in its order."""
        at = 0
        for found in self.pattern.finditer(text):
            yield from self._slips_in(text, at, found.start())
            yield NamedPlace(self.owner[_tight(found[0])], found.start(), found.end())
            at = found.end()
        yield from self._slips_in(text, at, len(text))

    def _slips_in(self, text: str, start: int, end: int) -> Iterator[NamedPlace]:
        """Yield the places that are misspelt between two names: one letter of a word or two."""
        for found in _LONG.finditer(text, start, end):
            for words in (found, _NEXT_TOO.match(text, found.start(), end)):
                meant = self._meant_by(_tight(words[0])) if words is not None else None
                if meant is not None and words is not None:
                    yield NamedPlace(meant, words.start(), words.end())
                    break

    def _meant_by(self, slip: str) -> str | None:
        if slip not in self.slips:
            near = {
                place
                for name, place in self.owner.items()
                if name[:1] == slip[:1] and name[-1:] == slip[-1:] and len(name) > _SHORT
                if OSA.distance(name, slip, score_cutoff=1) == 1
            }
            if len(self.slips) >= _MOST_SLIPS:
                self.slips.clear()
            self.slips[slip] = next(iter(near)) if len(near) == 1 else None
        return self.slips[slip]


@lru_cache(maxsize=8)
def _names(vocabulary: Vocabulary) -> _Names:
    owner: dict[str, str] = {}
    for entry in vocabulary.entries:
        for spelling in entry.spellings:
            owner.setdefault(_tight(spelling), entry.id)
    by_length = sorted(owner, key=len, reverse=True)
    return _Names(re.compile("|".join(map(_loose, by_length)) or r"(?!)"), owner, {})


def _tight(name: str) -> str:
    return re.sub(r"[\s\-_']+", "", plain(name))


def _loose(name: str) -> str:
    letters = r"[\s\-_']*".join(map(re.escape, name))
    return rf"(?<![a-z0-9]){letters}(?![a-z0-9])" if name.isascii() else letters


def places_named(text: str, vocabulary: Vocabulary) -> tuple[str, ...]:
    """Return the ids of the places that a text names, in its order, with repetitions."""
    return tuple(found.id for found in _names(vocabulary).find(plain(text)))


def find_places(text: str, vocabulary: Vocabulary) -> tuple[NamedPlace, ...]:
    """Return where a text, in plain writing, names places, in its order."""
    return tuple(_names(vocabulary).find(plain(text)))


def first_place(text: str, vocabulary: Vocabulary) -> NamedPlace | None:
    """Return where a text, in plain writing, first names a place; what follows is not read."""
    return next(_names(vocabulary).find(plain(text)), None)


def label_named(label: str, text: str) -> bool:
    """Tell whether every word of a label stands in the text, but for words that name nothing."""
    said = plain(text)
    words = set(_WORD.findall(said))
    for word in _WORD.findall(plain(label)):
        if word in _GENERIC or word in _GENERIC_ZH or word in words:
            continue
        stem = word.removesuffix("s")
        if not (
            word.isascii() and len(stem) > 2 and any(said_.startswith(stem) for said_ in words)
        ):
            return False
    return True


def has_specific_words(label: str) -> bool:
    """Tell whether a label says more than that somebody or something is meant."""
    return any(
        word not in _GENERIC and word not in _GENERIC_ZH for word in _WORD.findall(plain(label))
    )


_NUMBERS = {
    word: float(value)
    for value, word in enumerate(
        (
            "zero",
            "one",
            "two",
            "three",
            "four",
            "five",
            "six",
            "seven",
            "eight",
            "nine",
            "ten",
            "eleven",
            "twelve",
        )
    )
} | {"half": 0.5, "a": 1.0, "an": 1.0, "fifteen": 15.0, "twenty": 20.0, "thirty": 30.0}
_ZH = {char: float(value) for value, char in enumerate("零一二三四五六七八九十")} | {
    "两": 2.0,
    "半": 0.5,
}


_TENS = re.compile(r"([一二三四五六七八九]?)十([一二三四五六七八九]?)")


def numbers_named(text: str) -> tuple[float, ...]:
    """Return every number that a text writes, in digits or in plain words."""
    said = plain(text)
    found = [float(number) for number in re.findall(r"\d+(?:\.\d+)?", said)]
    found += [_NUMBERS[word] for word in re.findall(r"[a-z]+", said) if word in _NUMBERS]
    for tens, ones in _TENS.findall(said):
        found.append(10 * _ZH.get(tens, 1.0) + _ZH.get(ones, 0.0))
    alone = _TENS.sub("", said)  # 三十 is thirty, and neither three nor ten
    for whole, tenths in re.findall(r"([一二两三四五六七八九\d])米([一二三四五六七八九半])", said):
        found.append(_ZH.get(whole, 0.0) + _ZH[tenths] / (1.0 if tenths == "半" else 10.0))
    return (*found, *(_ZH[char] for char in alone if char in _ZH))


_PEOPLE = re.compile(
    r"\b(?:person|people|persons|any ?(?:one|body)|some ?(?:one|body)|every ?(?:one|body)|who"
    r"|whom|m[ae]n|wom[ae]n|guests?|visitors?|child(?:ren)?|kids?|boys?|girls?|lady|ladies|guys?|mister|mr|mrs"
    r"|human|follow me|after me|behind me|with me|find me|meet|greet|welcome|introduce|him|her|them"
    r"|(?:tell|inform|remind|call|wake) (?!me\b|us\b|you)[a-z]+|(?:to|for) (?:my|our) [a-z]+"
    r"|(?:say|talk|speak) [a-z ]{0,16}to (?!me\b|us\b|you))\b"
    r"|人|谁|大家|客人|孩子|小孩|男|女|老|先生|女士|他|她|我|妈|爸|爷|奶|叔|阿姨|接|迎|打招呼|告诉(?!我)"
)


def thing_named(label: str, said: str) -> bool:
    """Tell whether words speak of a thing or a person that a step names."""
    if has_specific_words(label):
        return label_named(label, said) or _kind_named(label, said)
    return _PEOPLE.search(said) is not None


def _kind_named(label: str, said: str) -> bool:
    """Tell whether the same kind of thing is named, in either language."""
    kind = resolve(label)
    return kind is not None and any(
        re.search(pattern, said) is not None for pattern in _patterns(kind[0])
    )


@lru_cache(maxsize=128)
def _patterns(kind: str) -> tuple[str, ...]:
    english = "|".join(map(re.escape, synonyms(kind, Language.EN))) or r"(?!)"
    chinese = "|".join(map(re.escape, synonyms(kind, Language.ZH))) or r"(?!)"
    return rf"\b(?:{english})(?:e?s)?\b", rf"(?:{chinese})"
