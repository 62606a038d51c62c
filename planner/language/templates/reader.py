"""Read one clause by templates: cut it into units, match all templates at once, say which.

The law: every word of the clause is accounted for. Of the templates that read it those with the
fewest free words come first; a builder may still say no, and the next one is asked.

A stage of templates stands among a grammar's rules: some Chinese words are read by rules between
two stages, for what takes an arm is told apart before free words become a thing or a place.
"""

from __future__ import annotations

import re
from collections import defaultdict
from dataclasses import dataclass
from functools import cache, lru_cache
from math import radians
from typing import TYPE_CHECKING

from planner.language.folding import CHINESE, has_chinese
from planner.language.grammar.parse_result import Meaning, Reading, Steps
from planner.language.semantic_parser.amounts import find_amounts
from planner.language.semantic_parser.plan_grammar import SlotKind
from planner.language.templates.automaton import Units
from planner.language.templates.expressions import TOKEN
from planner.language.templates.owners import read_owners_templates, read_skill_templates
from planner.language.templates.template_file import (
    SentenceTemplate,
    TemplateFind,
    TemplateSet,
    load_templates,
)
from planner.plan import Language

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping

    Builder = Callable[[TemplateFind, Reading], Meaning | None]

TEMPLATES = load_templates()

_MARKS = {
    "place": ("\ue000", "\ue8ff"),
    "person": ("\ue900", "\ue9ff"),
    "quote": ("\uf800", "\uf8ff"),
}
_AMOUNTS = {
    SlotKind.LENGTH: "length",
    SlotKind.ANGLE: "angle",
    SlotKind.DURATION: "duration",
    SlotKind.TIMES: "times",
}
_WORD = re.compile(rf"[\w'{CHINESE}°/-]+")


@dataclass(frozen=True, slots=True)
class ClauseUnits:
    """Hold a clause's units, where they stand in its text, and its amounts by their tokens."""

    text: str
    spans: tuple[tuple[int, int], ...]
    units: Units
    amounts: dict[tuple[str, int, int], float]

    def between(self, begin: int, end: int) -> str:
        """Return the words from one token up to another."""
        return self.text[self.spans[begin][0] : self.spans[end - 1][1]]


def cut_clause(text: str, templates: TemplateSet) -> ClauseUnits:
    """Return a marked clause's units."""
    found = list(TOKEN.finditer(text))
    tokens = tuple(token[0] for token in found)
    ends: dict[str, dict[int, tuple[int, ...]]] = defaultdict(dict)
    for kind, (low, high) in _MARKS.items():
        for at, token in enumerate(tokens):
            if low <= token[0] <= high:
                ends[kind][at] = (at + 1,)
    amounts: dict[tuple[str, int, int], float] = {}
    begins = {token.start(): at for at, token in enumerate(found)}
    after = {token.end(): at + 1 for at, token in enumerate(found)}
    for amount in find_amounts(text):
        kind = _AMOUNTS.get(amount.kind, "")
        begin, behind = begins.get(amount.start), after.get(amount.end)
        if kind and begin is not None and behind is not None:
            ends[kind][begin] = (*ends[kind].get(begin, ()), behind)
            amounts[kind, begin, behind] = (
                radians(amount.value) if kind == "angle" else amount.value
            )
    free = {
        kind: tuple(rule.admits(token, is_first=first) for token in tokens)
        for kind, rule, first in templates.free_kinds
    }
    spans = tuple(token.span() for token in found)
    return ClauseUnits(text, spans, Units(tokens, ends, free), amounts)


@lru_cache(maxsize=256)
def find_templates(
    text: str, language: Language, owners: str = "", skills: str = ""
) -> tuple[tuple[SentenceTemplate, TemplateFind], ...]:
    """Return the templates that read a marked clause, and what each found, the surest first.

    Args:
        text: of the clause.
        language: of the templates.
        owners: the templates of the site's owner; of two that are as sure theirs comes first.
        skills: the sentences that call the owner's skills, likewise.
    """
    found = [] if not skills else [*_find_in(read_skill_templates(skills), text, language)]
    if owners:
        found += _find_in(read_owners_templates(owners), text, language)
    ours = _find_in(TEMPLATES, text, language)
    return tuple(sorted((*found, *ours), key=lambda hit: hit[1].free_words)) if found else ours


def _find(
    clause: str, language: Language, reading: Reading
) -> tuple[tuple[SentenceTemplate, TemplateFind], ...]:
    names = reading.vocabulary
    return find_templates(clause, language, names.sentences, names.skill_templates)


def _find_in(
    templates: TemplateSet, text: str, language: Language
) -> tuple[tuple[SentenceTemplate, TemplateFind], ...]:
    clause = cut_clause(text, templates)
    hits = []
    for match in templates.automata[language].match(clause.units):
        template = templates.of_sentence[language][match.template]
        slots = {name: clause.between(*span) for name, span in match.slots.items()}
        amounts = {
            name: clause.amounts[kind, *span]
            for name, span in match.slots.items()
            for kind in dict.fromkeys(("duration", name))  # a slot is called as its parameter is
            if (kind, *span) in clause.amounts
        }
        hits.append(
            (
                templates.rows[template],
                TemplateFind(
                    text, {**templates.rows[template].values, **slots}, amounts, match.free_words
                ),
            )
        )
    return tuple(hits)


_LOOSE_END = re.compile(r" (?:in|at|on|near|by)$")
"""Nobody is described so: another phrase has begun."""


@cache
def _builders() -> Mapping[str, Builder]:
    """Return the builders; they know the grammar, which knows this file."""
    from planner.language.templates.builders import BUILDERS

    return BUILDERS


@dataclass(frozen=True, slots=True)
class TemplateStage:
    """Stand for the templates of some stages, where rules are tried one after the other."""

    language: Language
    stages: tuple[int, ...]

    def read(self, clause: str, reading: Reading) -> Meaning | None:
        """Return the meaning of a clause; None where no template of these reads it."""
        for row, found in _find(clause, self.language, reading):
            if row.stage not in self.stages:
                continue
            loose = _LOOSE_END.search(found["who"]) is not None
            meaning = None if loose else _builders()[row.form](found, reading)
            if meaning is not None:
                return meaning
        return None


def read_exactly(clause: str, reading: Reading, runnable: frozenset[str]) -> Steps | None:
    """Return the steps of a clause whose every word a template names; None of any other.

    Only what takes no eyes: what is seen or said to somebody hangs on more than the words.

    Args:
        clause: marked, without courtesies.
        reading: of the clause.
        runnable: the kinds of steps that the robot can do.
    """
    language = Language.ZH if has_chinese(clause) else Language.EN
    for row, found in _find(clause, language, reading):
        if found.free_words or "times" in found.amounts:  # rounds are counted by the chain's reader
            return None
        meaning = _builders()[row.form](found, reading)
        if meaning is not None:
            kinds = {step.kind for step in meaning.steps} if isinstance(meaning, Steps) else set()
            able = kinds and kinds <= _MOTION & runnable
            return meaning if able and isinstance(meaning, Steps) else None
    return None


_MOTION = frozenset({"go_to", "come_back", "return_home", "turn", "move", "wait", "use_skill"})
