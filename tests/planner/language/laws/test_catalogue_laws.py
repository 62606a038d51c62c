"""The laws of the catalogue: every message in every language, with the same blanks, and used."""

from __future__ import annotations

import ast
from collections.abc import Iterator
from functools import cache
from pathlib import Path
from string import Formatter

import pytest

from planner.language.catalogue import CATALOGUE
from planner.language.catalogue.words import PLACES
from planner.language.object_classes import KINDS
from planner.navigation import RouteFailure
from planner.perception.failure import VisionFailure
from planner.plan import Code

PAIRED = {"route_failure": RouteFailure, "vision_failure": VisionFailure}
"""Groups that a worker's failure takes whole."""
MESSAGES = {words.language: dict(words.messages) for words in CATALOGUE.words}
CODES = sorted({code for own in MESSAGES.values() for code in own})


def blanks(text: str) -> set[str]:
    fields = (name for _, name, _, _ in Formatter().parse(text) if name is not None)
    return {name.partition(".")[0] for name in fields}


PLURALS = {code for code in CODES if code.startswith(("plural.", "measure."))}
PLURALS -= {"plural.other", "measure.other", "measure.vowel"}
"""Each language lists those that its own rule does not make."""


ENGLISH_REASONS = {
    *("request.no_json", "refusal.disk_fails", "plan.flaw"),
    *("site_refusal.keyframes_malformed", "site_refusal.mend_unread", "site_refusal.robot_running"),
}
"""Their reason is a library's, in English alone: the Chinese sentence says what failed."""


@pytest.mark.parametrize("language", sorted(MESSAGES))
def test_every_language_has_every_message(language: str) -> None:
    assert sorted(set(MESSAGES[language]) - PLURALS) == sorted(set(CODES) - PLURALS)


def test_things_have_words_in_every_language_and_plurals_are_of_things() -> None:
    assert set(CATALOGUE.keys("noun")) == set(KINDS)
    assert {code.partition(".")[2] for code in PLURALS} <= set(KINDS)


@pytest.mark.parametrize("language", sorted(MESSAGES))
def test_every_language_has_the_same_blanks(language: str) -> None:
    odd = [
        code
        for code in set(CODES) - PLURALS - ENGLISH_REASONS
        if blanks(MESSAGES[language][code]) != blanks(MESSAGES["en"][code])
    ]
    assert odd == []
    for code in ENGLISH_REASONS:
        assert blanks(MESSAGES["en"][code]) - blanks(MESSAGES["zh"][code]) in ({"why"}, {"what"})
        assert blanks(MESSAGES["zh"][code]) <= blanks(MESSAGES["en"][code])


def test_every_outcome_has_a_sentence() -> None:
    told = {code.removeprefix("outcome.") for code in CODES if code.startswith("outcome.")}
    assert told == {code.value for code in Code}


@pytest.mark.parametrize("group", sorted(PAIRED))
def test_failures_of_a_worker_have_a_sentence_each(group: str) -> None:
    assert set(CATALOGUE.keys(group)) == set(PAIRED[group].reasons)


def test_messages_are_said_with_their_blanks(repository: Path) -> None:
    said = dict(literal_calls(repository))
    assert len(said) > 150
    unknown = {where: code for where, (code, _) in said.items() if code not in CODES}
    assert unknown == {}
    unfilled = {
        where: (code, missing)
        for where, (code, facts) in said.items()
        if facts is not None and (missing := blanks(MESSAGES["en"][code]) ^ facts)
    }
    assert unfilled == {}


BY_CODE = (
    *("order_reason", "order_refusal", "order_lacks"),
    *("blind", "goal_act", "goal_state", "step_kind", "recording_refusal"),
)
"""What is told by a kind of step, a state or a code."""


def test_no_message_is_left_over(repository: Path) -> None:
    strings = {
        node.value
        for path in (*sources(repository), repository / "pons" / "site.py")
        for node in nodes_of(path)
        if isinstance(node, ast.Constant) and isinstance(node.value, str)
    }
    starts = tuple(text for text in strings if text.endswith((".", "_")) and text[:1].isalpha())
    groups = {code.partition(".")[0] for code in CODES}
    computed = tuple(s for s in starts if s.partition(".")[0] in groups and "." in s)
    quoted = tuple(f"{group}." for group in ("paused", "beside", *BY_CODE, *PAIRED, *PLACES))
    left = [c for c in CODES if c not in strings and not c.startswith(computed + quoted)]
    assert left == []


@cache
def nodes_of(path: Path) -> tuple[ast.AST, ...]:
    """Return what a file is made of: two laws read each, and it takes a while."""
    return tuple(ast.walk(ast.parse(path.read_text("utf-8"))))


def sources(repository: Path) -> list[Path]:
    return sorted((repository / "planner").rglob("*.py"))


def literal_calls(repository: Path) -> Iterator[tuple[str, tuple[str, set[str] | None]]]:
    """Yield each call of ``say`` with a literal code, and the facts it names; None where spread."""
    for path in sources(repository):
        for node in nodes_of(path):
            if not (isinstance(node, ast.Call) and isinstance(node.func, ast.Name)):
                continue
            code = node.args[0] if node.func.id == "say" and node.args else None
            if isinstance(code, ast.Constant) and isinstance(code.value, str):
                names = [keyword.arg for keyword in node.keywords]
                facts = None if None in names else {name for name in names if name}
                yield f"{path.name}:{node.lineno}", (code.value, facts)
