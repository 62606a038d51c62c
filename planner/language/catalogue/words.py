"""Render messages of the catalogue in each language that has a file. Pure after the import."""

from __future__ import annotations

import tomllib
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING

from pydantic import Field

from planner.plan.base import Bilingual

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Mapping, Sequence

    from planner.plan.outcome_codes import Code

    Fact = Bilingual | str | int | float | None

FOLDER = Path(__file__).parent
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
        return self.raw(code, language).format(**own)

    def build(self, make: Callable[[str], str]) -> Bilingual:
        """Return the text that a function makes for each language."""
        more = {each: make(each) for each in self._by_language if each not in CARRIED}
        en, zh = make("en"), make("zh")
        return Multilingual(en=en, zh=zh, more=more) if more else Bilingual(en=en, zh=zh)

    def say(self, code: str, /, **facts: Fact) -> Bilingual:
        """Return a message in every language; a fact in several fills each with its own words."""
        return self.build(lambda language: self.render(code, language, facts))

    def join(self, texts: Iterable[Bilingual], joint: str = "joint.sentence") -> Bilingual:
        """Return texts as one, with what a language puts between two of them."""
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
    return Catalogue(
        tuple(Words(f.stem, _flat(tomllib.loads(f.read_text("utf-8")))) for f in files)
    )


def _flat(tables: Mapping[str, Mapping[str, str]]) -> dict[str, str]:
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


def message(code: Code, /, **facts: Fact) -> Bilingual:
    """Return the sentence of an outcome's code.

    Raises:
        KeyError: a blank of the sentence was given no fact.
    """
    return CATALOGUE.say(f"outcome.{code.value}", **facts)


def template(code: Code) -> Bilingual:
    """Return the sentence of an outcome's code with its blanks still open."""
    return CATALOGUE.build(lambda language: CATALOGUE.raw(f"outcome.{code.value}", language))


def join(texts: Iterable[Bilingual], joint: str = "joint.sentence") -> Bilingual:
    """Return texts as one, with what a language puts between two of them."""
    return CATALOGUE.join(texts, joint)


def list_names(names: Iterable[Bilingual], last: str = "joint.name") -> Bilingual:
    """Return names as a list: "hall, kitchen"; ``last`` stands before the last of several."""
    return CATALOGUE.list_names(names, last)
