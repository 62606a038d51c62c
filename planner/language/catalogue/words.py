"""Render messages of the catalogue in each language that has a file. Pure after the import."""

from __future__ import annotations

import tomllib
from dataclasses import dataclass, field
from pathlib import Path
from string import Formatter
from types import MappingProxyType
from typing import TYPE_CHECKING, Any

from pydantic import Field

from planner.plan.base import Bilingual

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Mapping, Sequence

    from planner.plan.outcome import Code

    Fact = Bilingual | str | int | float | None

FOLDER = Path(__file__).parent
PLACES = ("room", "landmark", "noun")
"""Groups of nouns by which places of a site are called."""
VOWELS = "aeiou"
WORDED = 11
"""From this number on digits are said."""
FIRST = "en"
"""The language that stands in for words which another one lacks."""
CARRIED = frozenset({"en", "zh"})
"""What the API, the journal and the models' schema carry; further languages live in the process."""


class UnknownMessage(KeyError):
    """No language has such a message: the caller's fault."""


class Multilingual(Bilingual):
    """Hold a text in more languages than the API carries."""

    more: dict[str, str] = Field(exclude=True)

    def of(self, language: str) -> str:
        """Return the text in the language asked for; English where it has none."""
        return self.more[language] if language in self.more else super().of(language)

    def __hash__(self) -> int:
        """Return the hash of what the API carries: the rest follows from it."""
        return hash((self.en, self.zh))


class _Figures(Formatter):
    """Fill blanks, with a language's own sign between whole and parts of a figure."""

    def __init__(self, decimal: str) -> None:
        self._decimal = decimal

    def format_field(self, value: Any, format_spec: str) -> str:
        """Return one blank filled."""
        filled = str(super().format_field(value, format_spec))
        return filled.replace(".", self._decimal) if isinstance(value, float) else filled


@dataclass(frozen=True, slots=True)
class Words:
    """Hold the messages of one language by their codes."""

    language: str
    messages: Mapping[str, str]


@dataclass(frozen=True, slots=True)
class Catalogue:
    """Render messages in all its languages; English and Chinese are always among them."""

    words: Sequence[Words]
    _by_language: dict[str, Mapping[str, str]] = field(init=False)

    def __post_init__(self) -> None:
        by_language = {each.language: each.messages for each in self.words}
        if not set(by_language) >= CARRIED:
            lacking = ", ".join(sorted(CARRIED - set(by_language)))
            raise ValueError(f"the catalogue lacks {lacking}; it has {', '.join(by_language)}")
        object.__setattr__(self, "_by_language", by_language)

    def has(self, code: str) -> bool:
        """Return whether there is such a message."""
        return code in self._by_language[FIRST]

    def raw(self, code: str, language: str) -> str:
        """Return a message with its blanks still open.

        Raises:
            UnknownMessage: there is none of this code.
        """
        first = self._by_language[FIRST].get(code)
        if first is None:
            raise UnknownMessage(f"no message {code!r} among {len(self._by_language[FIRST])}")
        return self._by_language[language].get(code, first)

    def render(self, code: str, language: str, facts: Mapping[str, Fact]) -> str:
        """Return a message in one language, its blanks filled.

        Raises:
            UnknownMessage: there is none of this code.
            KeyError: a blank was given no fact.
        """
        own = {
            name: fact.of(language) if isinstance(fact, Bilingual) else fact
            for name, fact in facts.items()
        }
        text = self.raw(code, language)
        decimal = self._by_language[language].get("number.decimal", ".")
        return text.format(**own) if decimal == "." else _Figures(decimal).format(text, **own)

    def keys(self, group: str) -> tuple[str, ...]:
        """Return the keys of a group of messages, in their order."""
        start = f"{group}."
        return tuple(c.removeprefix(start) for c in self._by_language[FIRST] if c.startswith(start))

    def synonyms(self, code: str, language: str) -> tuple[str, ...]:
        """Return the words of a noun in one language: the first is said, all of them are read."""
        return tuple(self.raw(code, language).split(", "))

    def noun(self, code: str) -> Bilingual:
        """Return the word of a noun that is said."""
        return self.build(lambda language: self.synonyms(code, language)[0])

    def plural(self, code: str) -> Bilingual:
        """Return the word for several of a noun: of its own, or by the language's rule."""
        key = code.partition(".")[2]

        def plural_in(language: str) -> str:
            messages = self._by_language[language]
            messages = messages if code in messages else self._by_language[FIRST]
            own = messages.get(f"plural.{key}") or messages.get("plural.other", "{name}")
            return own.format(name=self.synonyms(code, language)[0])

        return self.build(plural_in)

    def quantity(self, count: int, code: str, name: Bilingual) -> Bilingual:
        """Return so many of a noun by their name, with what each language puts between the two.

        Args:
            count: how many.
            code: of the noun.
            name: of one or of several of it, with a colour or not.
        """
        key = code.partition(".")[2]

        def quantity_in(language: str) -> str:
            messages = self._by_language[language]
            own = name.of(language)
            other = "vowel" if own[:1].lower() in VOWELS else "other"
            measure = messages.get(f"measure.{key}", messages.get(f"measure.{other}", ""))
            number = self.raw(f"number.{count}", language) if count < WORDED else str(count)
            if count == 1:
                return self.raw("result.one", language).format(measure=measure, name=own)
            if messages.get("plural.other") == "{name}":  # where nouns have no plural, measures do
                number += measure
            return self.raw("result.many", language).format(count=number, name=own)

        return self.build(quantity_in)

    def place_name(self, en: str, zh: str) -> Bilingual:
        """Return a place's name; where a language beyond these two has a word for it, with that."""
        name = Bilingual(en=en, zh=zh)
        if set(self._by_language) == CARRIED:
            return name
        codes = (f"{group}.{key}" for group in PLACES for key in self.keys(group))
        return next(
            (each for each in map(self.noun, codes) if (each.en, each.zh) == (en, zh)), name
        )

    def build(self, make: Callable[[str], str]) -> Bilingual:
        """Return the text that a function makes for each language."""
        more = {each: make(each) for each in self._by_language if each not in CARRIED}
        en, zh = make("en"), make("zh")
        return Multilingual(en=en, zh=zh, more=more) if more else Bilingual(en=en, zh=zh)

    def say(self, code: str, /, **facts: Fact) -> Bilingual:
        """Return a message in every language; a fact in several fills each with its own words."""
        return self.build(lambda language: self.render(code, language, facts))

    def join(self, texts: Iterable[Bilingual], joint: str = "joint.sentence") -> Bilingual:
        """Return texts as one, with each language's joint between two of them."""
        several = tuple(texts)
        return self.build(
            lambda language: self.raw(joint, language).join(t.of(language) for t in several)
        )

    def list_names(self, names: Iterable[Bilingual], last: str = "joint.name") -> Bilingual:
        """Return names as a list; ``last`` stands before its last one."""
        several = tuple(names)

        def list_in(language: str) -> str:
            own = [name.of(language) for name in several]
            before = self.raw("joint.name", language).join(own[:-1])
            return f"{before}{self.raw(last, language)}{own[-1]}" if before else "".join(own)

        return self.build(list_in)


def load(folder: Path) -> Catalogue:
    """Read every language of a folder.

    Raises:
        ValueError: a file is no TOML, or English or Chinese is not there.
    """
    files = sorted(folder.glob("*.toml"))
    return Catalogue(tuple(Words(f.stem, read_messages(f.read_text("utf-8"))) for f in files))


def read_messages(text: str) -> Mapping[str, str]:
    """Return the messages of a TOML file by their codes.

    Raises:
        ValueError: it is no TOML.
    """
    tables = tomllib.loads(text)
    return {f"{group}.{key}": text for group, t in tables.items() for key, text in t.items()}


CATALOGUE = load(FOLDER)


def say(code: str, /, **facts: Fact) -> Bilingual:
    """Return a message of the catalogue in every language.

    Raises:
        UnknownMessage: there is none of this code.
        KeyError: a blank of the message was given no fact.
    """
    return CATALOGUE.say(code, **facts)


def say_or_quote(group: str, word: str) -> Bilingual:
    """Return the message of a word from elsewhere; the word itself where there is none."""
    code = f"{group}.{word}"
    return CATALOGUE.say(code) if CATALOGUE.has(code) else Bilingual(en=word, zh=word)


def raw(code: str, language: str) -> str:
    """Return a message in one language with its blanks still open.

    Raises:
        UnknownMessage: there is none of this code.
    """
    return CATALOGUE.raw(code, language)


def build(make: Callable[[str], str]) -> Bilingual:
    """Return the text that a function makes for each language."""
    return CATALOGUE.build(make)


def noun(code: str) -> Bilingual:
    """Return the word of a noun that is said.

    Raises:
        UnknownMessage: there is none of this code.
    """
    return CATALOGUE.noun(code)


def plural(code: str) -> Bilingual:
    """Return the word for several of a noun.

    Raises:
        UnknownMessage: there is none of this code.
    """
    return CATALOGUE.plural(code)


def quantity(count: int, code: str, name: Bilingual) -> Bilingual:
    """Return so many of a noun by their name, in each language's own grammar."""
    return CATALOGUE.quantity(count, code, name)


def place_name(en: str, zh: str) -> Bilingual:
    """Return a place's name; where a language beyond these two has a word for it, with that."""
    return CATALOGUE.place_name(en, zh)


def message(code: Code, /, **facts: Fact) -> Bilingual:
    """Return the sentence of an outcome's code.

    Raises:
        KeyError: a blank of the sentence was given no fact.
    """
    return CATALOGUE.say(f"outcome.{code.value}", **facts)


def pair_up(group: str, codes: Iterable[str]) -> Mapping[str, tuple[str, str]]:
    """Return each code's message in English and Chinese, for a process that carries both.

    Raises:
        UnknownMessage: there is none of a code in this group.
    """
    said = {code: say(f"{group}.{code}") for code in codes}
    return MappingProxyType({code: (both.en, both.zh) for code, both in said.items()})


def template(code: Code) -> Bilingual:
    """Return the sentence of an outcome's code with its blanks still open."""
    return build(lambda language: raw(f"outcome.{code.value}", language))


def join(texts: Iterable[Bilingual], joint: str = "joint.sentence") -> Bilingual:
    """Return texts as one, with each language's joint between two of them."""
    return CATALOGUE.join(texts, joint)


def list_names(names: Iterable[Bilingual], last: str = "joint.name") -> Bilingual:
    """Return names as a list: "hall, kitchen"; ``last`` stands before the last of several."""
    return CATALOGUE.list_names(names, last)
