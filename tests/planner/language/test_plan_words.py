"""A plan laid before a person tells every step, place and word of it, in both languages."""

from __future__ import annotations

from random import Random

import pytest

from planner.language.plan_words import tell_steps
from planner.language.semantic_parser.plan_grammar import (
    FORMS,
    LabelledPlan,
    SlotKind,
    parse_plan,
)
from planner.language.semantic_parser.plan_steps import StepMaker
from planner.plan import Bilingual, Entry, Language, Vocabulary, say_same
from tools.train_reader.assignments import draw_assignment

SITE = Vocabulary(
    entries=tuple(
        Entry(id=name, kind="room", name=Bilingual(en=name, zh=name))
        for name in ("kitchen", "hall", "study")
    )
)


def told(label: str, language: str = "en") -> str | None:
    plan = StepMaker(SITE, Language(language), lambda words: "10:00").plan(parse_plan(label))
    return None if plan is None else tell_steps(plan.steps, say_same).of(language)


@pytest.mark.parametrize(
    ("label", "english", "chinese"),
    [
        ("look(in hall); back", "look in the hall, then come back", "去hall看看，然后回来"),
        ('check("window open", in hall)', "check in the hall: “window open?”", None),
        ('go(hall); approach("red cup")', "go to the hall, then go up to the red cup", None),
        ('follow("me", for 5 min)', "follow the person for 5 min", None),
        (
            'if check("Dad", in hall) { home } else { wait(2 min) }',
            "if the answer to “Dad?” in the hall is yes: go home; otherwise: wait 2 min",
            None,
        ),
        (
            'if not find("keys") { home }',
            "unless I find the keys: go home",
            "除非找到keys，不然就回家",
        ),
        ("repeat(3 times) { turn(full) }", "3 times: turn left 360 degrees", None),
        (
            "try { go(study) } else { home }",
            "go to the study; if that does not work: go home",
            None,
        ),
    ],
)
def test_steps_are_told_as_an_order(label: str, english: str, chinese: str | None) -> None:
    assert told(label) == english
    if chinese is not None:
        assert told(label, "zh") == chinese


def _held(plan: LabelledPlan) -> list[str]:
    """Return the places and the words that a plan holds."""
    found: list[str] = []
    for node in plan:
        for slot, value in zip(FORMS[node.form].slots, node.slots, strict=False):
            told_of = (SlotKind.PLACE, SlotKind.WORDS, SlotKind.THING)
            found += [text for text in value if slot.kind in told_of]
        found += _held(node.condition)
        for block in node.blocks:
            found += _held(block)
    return found


@pytest.mark.parametrize("language", ["en", "zh"])
def test_no_place_and_no_word_of_a_plan_is_left_out(language: str) -> None:
    drawn = 0
    for seed in range(400):
        *_, home, label = draw_assignment(Random(f"{language}{seed}"), language)
        for number, name in enumerate(home.split(" | ")):
            label = label.replace(name, ("kitchen", "hall", "study")[number % 3])
        words = told(label, language)
        if words is None or "later" in label or "earlier" in label or "wait_until" in label:
            continue
        drawn += 1
        for held in _held(parse_plan(label)):
            assert held in ("me", "us", "我", "我们") or held.casefold() in words.casefold(), label
    assert drawn > 60
