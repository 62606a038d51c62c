"""Load templates from their file; an owner's (``owners.py``) has the same form."""

from __future__ import annotations

import re
import tomllib
from collections.abc import Mapping
from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path
from typing import Any

from planner.language.templates.automaton import Automaton
from planner.language.templates.expressions import (
    Expression,
    OneOf,
    Sequel,
    SlotFilling,
    TemplateError,
    parse_expression,
)

OURS = Path(__file__).with_name("templates.toml")
LANGUAGES = ("en", "zh")
_PLAN = re.compile(r"(?P<form>[a-z_]+)\((?P<inside>[^()]*)\)")


@dataclass(frozen=True, slots=True)
class FreeKind:
    """Say which words a free kind admits."""

    marks: bool = False
    """What stands for a place, a person or a quotation may be such a word, too."""
    people: bool = False
    """A person's name may."""
    without: frozenset[str] = frozenset()
    first_without: frozenset[str] = frozenset()
    weight: float = 1.0
    """By how much such a word counts against a template."""

    def admits(self, token: str, *, is_first: bool) -> bool:
        """Return whether a token may be such a word, at its begin or behind it."""
        if "\ue000" <= token[0] <= "\uf8ff":
            return self.marks or (self.people and "\ue900" <= token[0] <= "\ue9ff")
        if token in self.without or (is_first and token in self.first_without):
            return False
        return self.marks or token not in ",.;:!?。、"


@dataclass(frozen=True, slots=True)
class SentenceTemplate:
    """Hold one meaning: its plan's name, fixed values and slots, and its sentences."""

    form: str
    values: Mapping[str, str]
    slots: tuple[str, ...]
    stage: int
    sentences: tuple[tuple[str, Expression], ...]
    """Each with its language."""


class TemplateSet:
    """Hold templates and what matches them."""

    def __init__(
        self,
        rows: tuple[SentenceTemplate, ...],
        free: Mapping[str, FreeKind],
        words: Mapping[str, Mapping[str, str]],
    ) -> None:
        self.rows, self.free, self.words = rows, dict(free), {k: dict(v) for k, v in words.items()}
        self.free_kinds = tuple(
            (f"{kind}^" if first else kind, rule, first)
            for kind, rule in free.items()
            for first in (True, False)
        )
        weights = {kind: rule.weight for kind, rule in free.items()}
        self.of_sentence: dict[str, tuple[int, ...]] = {}
        self.automata: dict[str, Automaton] = {}
        for tongue in LANGUAGES:
            said = [
                (number, expression)
                for number, row in enumerate(rows)
                for language, expression in row.sentences
                if language == tongue
            ]
            self.of_sentence[tongue] = tuple(number for number, _ in said)
            self.automata[tongue] = Automaton([expression for _, expression in said], weights)


@dataclass(frozen=True, slots=True)
class TemplateFind:
    """Hold what a template found in a clause: its slots' words and amounts, and its own values."""

    text: str
    slots: dict[str, str]
    amounts: dict[str, float]
    free_words: float
    """How much of it no template names."""

    def __getitem__(self, name: str | int) -> str:
        """Return the words of a slot; those of the whole clause by 0; empty where it lacks."""
        return self.text if isinstance(name, int) else self.slots.get(name, "")

    def has(self, name: str) -> bool:
        """Return whether a slot is filled."""
        return name in self.slots


@lru_cache(maxsize=1)
def load_templates() -> TemplateSet:
    """Return the templates that Pons ships."""
    return read_templates(OURS.read_text(encoding="utf-8"))


def read_templates(text: str, ours: TemplateSet | None = None) -> TemplateSet:
    """Return the templates of a file's text.

    Args:
        text: of the file.
        ours: whose named and free words the templates may use, too.

    Raises:
        TemplateError: a template can't be read, or a plan is not known.
    """
    try:
        data = tomllib.loads(text)
    except tomllib.TOMLDecodeError as wrong:
        raise TemplateError(
            f"not a TOML file: {wrong}",
            "write it as templates.toml is written",
            "请按 templates.toml 的格式书写",
        ) from None
    words = {tongue: dict(data.get("words", {}).get(tongue, {})) for tongue in LANGUAGES}
    free = {kind: _free(row) for kind, row in data.get("free", {}).items()}
    if ours is not None:
        words = {tongue: ours.words[tongue] | words[tongue] for tongue in LANGUAGES}
        free = ours.free | free
    read: dict[str, dict[str, Expression]] = {tongue: {} for tongue in LANGUAGES}
    rows = []
    for row in data.get("template", ()):
        try:
            rows.append(_template(row, words, frozenset(free), read))
        except TemplateError as wrong:
            where = f"line {_line_of(row, text)}: {wrong.problem}"
            raise TemplateError(where, wrong.cure, wrong.cure_zh) from None
    return TemplateSet(tuple(rows), free, words)


def _line_of(row: Mapping[str, Any], text: str) -> int:
    """Return the line at which a template's plan stands; of one without any, the file's first."""
    lines = text.splitlines()
    plan = str(row.get("plan", ""))
    return next((at for at, line in enumerate(lines, 1) if plan and plan in line), 1)


def _free(row: Mapping[str, Any]) -> FreeKind:
    without, first = (frozenset(row.get(key, "").split()) for key in ("without", "first_without"))
    weight = float(row.get("weight", 1.0))
    return FreeKind(bool(row.get("marks")), bool(row.get("people")), without, first, weight)


def _template(
    row: Mapping[str, Any],
    words: Mapping[str, Mapping[str, str]],
    free: frozenset[str],
    read: Mapping[str, dict[str, Expression]],
) -> SentenceTemplate:
    plan = _PLAN.fullmatch(str(row.get("plan", "")))
    if plan is None:
        raise TemplateError(
            f"plan {row.get('plan')!r} is not of the form name(slot, key=value)",
            'write for example plan = "drive_to(place)"',
            '请写成例如 plan = "drive_to(place)"',
        )
    parts = [part.strip() for part in plan["inside"].split(",") if part.strip()]
    values = dict(part.split("=", 1) for part in parts if "=" in part)
    slots = tuple(part for part in parts if "=" not in part)
    sentences = tuple(
        (tongue, parse_expression(sentence, words[tongue], free, read[tongue]))
        for tongue in LANGUAGES
        for sentence in row.get(tongue, ())
    )
    for tongue, sentence in sentences:
        unknown = _slots_of(sentence) - set(slots)
        if unknown:
            raise TemplateError(
                f"{plan[0]} ({tongue}) fills {sorted(unknown)}, which the plan lacks",
                "name every slot of the sentences in the plan",
                "句子中的每个槽位都要写在 plan 里",
            )
    return SentenceTemplate(plan["form"], values, slots, int(row.get("stage", 0)), sentences)


def _slots_of(expression: Expression) -> set[str]:
    match expression:
        case SlotFilling():
            return {expression.name} | _slots_of(expression.filled_by)
        case Sequel():
            return set().union(*map(_slots_of, expression.parts))
        case OneOf():
            return set().union(*map(_slots_of, expression.options))
    return set()


def template_words() -> frozenset[str]:
    """Return every English word that stands in a template: they are spelt right."""
    return frozenset(re.findall(r"[a-z]{4,}", OURS.read_text(encoding="utf-8")))
