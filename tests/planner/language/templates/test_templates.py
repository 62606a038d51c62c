"""Laws of the templates: what each says is read by it, in one way, and alike in both languages."""

from __future__ import annotations

import random
import sys
from collections.abc import Iterator
from types import FrameType

import pytest

from planner.language.grammar import Context, plan
from planner.language.grammar.lexicon import lexicon_of, mark_people
from planner.language.grammar.parse_result import Reading, Steps
from planner.language.templates import automaton
from planner.language.templates.builders import BUILDERS
from planner.language.templates.expressions import (
    Expression,
    LiteralWords,
    OneOf,
    Sequel,
    SlotFilling,
    TemplateError,
    UnitKind,
)
from planner.language.templates.reader import TEMPLATES, find_templates, read_exactly
from planner.language.templates.template_file import read_templates
from planner.plan import EVERY_KIND, Language, StepPlan, Vocabulary
from tests.planner.language.grammar.conftest import HOME

SAID: dict[str, dict[str, str]] = {
    "en": {
        "place": "kitchen", "person": "Anna", "length": "2 m", "angle": "40 degrees",
        "duration": "ten seconds", "times": "twice", "quote": "\uf800",
    },
    "zh": {
        "place": "厨房", "person": "小红", "length": "2米", "angle": "40度",
        "duration": "10秒", "times": "两圈", "quote": "\uf800",
    },
}  # fmt: skip
OTHER_WORD = {"en": "gizmo", "zh": "物"}
SAMPLES = 6
MOTION = {"drive_to", "home", "wait", "turn", "move"}


def _say(expression: Expression, tongue: str, dice: random.Random) -> list[str]:
    """Return the tokens of one sentence that an expression stands for."""
    match expression:
        case LiteralWords():
            options = sorted(each for rows in expression.by_length.values() for each in rows)
            return list(dice.choice(options))
        case UnitKind():
            word = OTHER_WORD[tongue] if expression.is_free else SAID[tongue][expression.kind]
            return [word]
        case Sequel():
            return [token for part in expression.parts for token in _say(part, tongue, dice)]
        case OneOf():
            return _say(dice.choice(expression.options), tongue, dice)
        case SlotFilling():
            return _say(expression.filled_by, tongue, dice)


def sentences() -> Iterator[tuple[int, str, str]]:
    """Yield sentences of every template: its row, the language, the words."""
    dice = random.Random(74)
    for number, row in enumerate(TEMPLATES.rows):
        for tongue, expression in row.sentences:
            for _ in range(SAMPLES):
                tokens = _say(expression, tongue, dice)
                yield number, tongue, ("" if tongue == "zh" else " ").join(tokens)


SENTENCES = tuple(dict.fromkeys(sentences()))


def _marked(text: str, tongue: str) -> str:
    names = {"kitchen": "\ue000", "厨房": "\ue000", "Anna": "\ue900", "小红": "\ue900"}
    for name, mark in names.items():
        text = text.replace(name, mark)
    return text


def test_every_template_reads_what_it_says() -> None:
    missed = [
        (TEMPLATES.rows[row].form, text)
        for row, tongue, text in SENTENCES
        if not any(
            found is TEMPLATES.rows[row]
            for found, _ in find_templates(_marked(text, tongue), Language(tongue))
        )
    ]
    assert not missed


def _exact(text: str, home: Vocabulary = HOME) -> object:
    marked = lexicon_of(home).mark(text)
    language = Language.EN if text.isascii() else Language.ZH
    return read_exactly(marked.text, Reading(marked, lexicon_of(home), home, language), EVERY_KIND)


def _steps_of(text: str, tongue: str) -> set[object]:
    """Return the steps of all templates that read a sentence with the fewest free words."""
    marked = mark_people(lexicon_of(HOME).mark(text), text)
    language = Language(tongue)
    reading = Reading(marked, lexicon_of(HOME), HOME, language, ("hello",), maps=True)
    found = find_templates(marked.text, language)
    stage = min((row.stage for row, _ in found), default=0)
    tied = [
        (row.form, hit)
        for row, hit in found
        if hit.free_words == found[0][1].free_words and row.stage == stage
    ]
    meanings = [BUILDERS[form](hit, reading) for form, hit in tied]
    return {each.steps for each in meanings if isinstance(each, Steps) and each.steps}


def test_no_two_templates_give_different_plans_for_one_sentence() -> None:
    plans = {text: _steps_of(text, tongue) for _, tongue, text in SENTENCES}
    assert [text for text, steps in plans.items() if len(steps) > 1] == []


ORDERS = tuple(
    (TEMPLATES.rows[row], tongue, text)
    for row, tongue, text in SENTENCES
    if TEMPLATES.rows[row].form in MOTION and _exact(text) is not None
)


def test_there_are_exact_orders() -> None:
    assert {row.form for row, _, _ in ORDERS} == MOTION


def test_both_languages_give_equal_steps() -> None:
    steps: dict[tuple[object, ...], set[object]] = {}
    for row, _, text in ORDERS:
        has = tuple(unit for unit in SAID["en"] if any(s[unit] in text for s in SAID.values()))
        if row.form == "home" and "\ue000" in lexicon_of(HOME).mark(text).text:
            continue  # this home has a place of that name
        meaning = _exact(text)
        side = row.values.get("side"), row.values.get("way")
        steps.setdefault((row.form, side, has), set()).add(getattr(meaning, "steps", None))
    assert {key: found for key, found in steps.items() if len(found) > 1} == {}


@pytest.mark.parametrize(
    ("before", "tongue"),
    [("don't ", "en"), ("never ", "en"), ("shall we ", "en"), ("I ", "en"), ("I'm going to ", "en"),
     ("if it rains, ", "en"), ("别", "zh"), ("不要", "zh"), ("我", "zh"), ("他要", "zh")],
)  # fmt: skip
def test_what_is_no_order_is_not_read(before: str, tongue: str) -> None:
    assert [text for _, said, text in ORDERS if said == tongue and _exact(before + text)] == []


@pytest.mark.parametrize("behind", [" quickly", " or not", " but slowly", " unless it is dark"])
def test_no_word_is_passed_over(behind: str) -> None:
    assert [text for _, said, text in ORDERS if said == "en" and _exact(text + behind)] == []


def test_an_order_alone_is_what_it_is_before_another() -> None:
    context = Context(runnable=EVERY_KIND)
    differ = []
    for _, tongue, text in ORDERS:
        alone = plan(text, HOME, context)
        joined = plan(
            text + (", then wait 7 seconds" if tongue == "en" else ",然后等7秒"), HOME, context
        )
        steps = alone.steps if isinstance(alone, StepPlan) else ()
        if not isinstance(joined, StepPlan) or joined.steps[:-1] != steps:
            differ.append(text)
    assert differ == []


def _work(text: str, tongue: str) -> int:
    """Return how many arcs are tried for a clause."""
    tried = 0

    def count(frame: FrameType, event: str, _argument: object) -> None:
        nonlocal tried
        tried += event == "call" and frame.f_code is automaton._ends.__code__

    find_templates.cache_clear()
    sys.setprofile(count)
    try:
        find_templates(text, Language(tongue))
    finally:
        sys.setprofile(None)
    return tried


@pytest.mark.parametrize(
    ("unit", "tongue"),
    [("cup ", "en"), ("in the \ue000 ", "en"), ("杯", "zh"), ("去\ue000", "zh"), ("有几个", "zh")],
)
def test_work_grows_with_the_length_and_no_faster(unit: str, tongue: str) -> None:
    begin = "find the " if tongue == "en" else "找"
    short, long = (_work(begin + unit * times, tongue) for times in (40, 80))
    assert long <= 2.2 * short


@pytest.mark.parametrize(
    ("wrong", "told"),
    [
        ("[[template]", "TOML"),
        ('[[template]]\nplan = "fly"', "name(slot"),
        ('[[template]]\nplan = "home()"\nen = ["go (home"]', "missing"),
        ('[[template]]\nplan = "home()"\nen = ["go <nowhere>"]', "nowhere"),
        ('[[template]]\nplan = "home()"\nen = ["go @planet"]', "planet"),
        ('[words.en]\nspot = "@place"\n[[template]]\nplan = "home()"\nen = ["go {spot}"]', "spot"),
        ('[words.en]\na = "<a>"\n[[template]]\nplan = "home()"\nen = ["<a>"]', "itself"),
    ],
)
def test_a_wrong_file_is_told_with_its_cure(wrong: str, told: str) -> None:
    with pytest.raises(TemplateError) as raised:
        read_templates(wrong)
    assert told in str(raised.value)
    assert raised.value.code == "bad_template"
    assert raised.value.cure
    assert raised.value.cure_zh


@pytest.mark.parametrize(
    "text",
    ["when there visit the kitchen", "once there, visit the kitchen", "drive over at the sofa"],
)
def test_what_stands_around_an_order_is_judged(text: str) -> None:
    assert not isinstance(plan(text, HOME, Context(runnable=EVERY_KIND)), StepPlan)
