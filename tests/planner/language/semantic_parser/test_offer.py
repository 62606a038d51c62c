"""What the learned reader reads is laid before a person, and nothing moves by it."""

from __future__ import annotations

from datetime import UTC, datetime

import pytest

from planner.language.grammar.context import Context
from planner.language.motion_guard.mentioned_names import find_places
from planner.language.readers import OrderWords, read_order
from planner.language.schedule import ScheduleCommand
from planner.language.semantic_parser.offer import HANGING, MOST_OFFERED
from planner.language.sentence import parse
from planner.plan import (
    EVERY_KIND,
    AnswerPlan,
    Clarify,
    Code,
    Language,
    Plan,
    Refuse,
    StepPlan,
    WaitFor,
    list_nodes,
    places_of,
)
from pons.evals.suites import HOME_SITE
from pons.evals.world import site_world

WORLD = site_world(HOME_SITE)
CONTEXT = Context(room="hallway", runnable=frozenset(EVERY_KIND))


def read(text: str) -> Plan:
    return read_order(OrderWords(parse(text), WORLD.vocabulary, CONTEXT)).plan


@pytest.mark.parametrize(
    ("text", "places"),
    [
        ("would you fancy a trip to the kitchen", {"kitchen"}),
        (
            "would you be a dear and nip to the kitchen, then over to the study",
            {"kitchen", "study"},
        ),
        ("麻烦您老人家移步去厨房一趟", {"kitchen"}),
    ],
)
def test_what_no_rule_reads_is_offered_as_one_plan_in_words(text: str, places: set[str]) -> None:
    asked = read(text)
    assert isinstance(asked, Clarify)
    (button,) = asked.options
    assert button.plan is not None
    steps = [node.step for node in list_nodes(button.plan.steps)]
    assert {place for step in steps for place in places_of(step)} == places
    for place in places:
        assert WORLD.vocabulary.name(place).en in button.label.en
        assert WORLD.vocabulary.name(place).zh in button.label.zh
    assert button.label.en in asked.question.en


@pytest.mark.parametrize("room", ["kitchen", "study", "bathroom"])
@pytest.mark.parametrize(
    "remark",
    [
        "we were in the {} yesterday, me and the girls",
        "I'll go to the {} myself, thank you",
        "昨天我们在{}待了一下午",
        "我自己去{}就好",
        "{}停过电",
    ],
)
def test_a_remark_that_names_a_room_is_met_with_no_drive_to_it(room: str, remark: str) -> None:
    name = WORLD.vocabulary.name(room)
    told = read(remark.format(name.en if remark.isascii() else name.zh))
    assert isinstance(told, Refuse), "nothing waits for an answer"


@pytest.mark.parametrize(
    "text",
    [
        "do not go to the kitchen",
        "whatever you do, keep out of the study",
        "别去厨房",
        "厨房千万不要去",
        "don't you go to the kitchen at eight tonight",
        "every evening at eight, keep out of the study",
        "今晚八点千万别去厨房",
        "don't slow down",
        "mum is in the bathroom, so don't go there",
    ],
)
def test_a_place_that_is_denied_is_in_no_offer(text: str) -> None:
    asked = read(text)
    assert not isinstance(asked, StepPlan | AnswerPlan)
    assert not getattr(asked, "options", ())


@pytest.mark.parametrize(
    "text",
    [
        "be a love and pop to the kitchen every evening at eight, would you",
        "tomorrow at nine you could find my glasses in the study, if you'd be so kind",
        "每天晚上八点辛苦您老人家去趟厨房哈",
        "on Friday at noon, ha, visitors are coming, so you go to the hallway, okay?",
    ],
)
def test_a_standing_order_is_offered_as_the_clock_reads_it_or_not(text: str) -> None:
    asked = read(text)
    assert not isinstance(asked, StepPlan)
    for button in getattr(asked, "options", ()):
        kept = parse(button.text).intent
        assert button.is_standing
        assert button.plan is not None
        assert isinstance(kept, ScheduleCommand)
        assert kept.problem is None


@pytest.mark.parametrize(
    "text",
    [
        "see about the cat, kitchen I think",
        "你去卧室瞅瞅老头子醒了没，醒了就喊他吃饭",
    ],
)
def test_what_may_mean_several_orders_is_a_choice_of_plans_told_in_words(text: str) -> None:
    asked = read(text)
    assert isinstance(asked, Clarify)
    assert 2 <= len(asked.options) <= MOST_OFFERED
    for language in Language:
        told = [button.label.of(language) for button in asked.options]
        assert len(set(told)) == len(told)
        assert all(words in asked.question.of(language) for words in told)
    assert all(button.plan is not None for button in asked.options)


@pytest.mark.parametrize("text", ["kitchen or study, go", "去客厅还是厨房呢", "去厨房或客厅"])
def test_of_two_places_that_are_named_both_are_laid_before_the_person(text: str) -> None:
    asked = read(text)
    assert isinstance(asked, Clarify)
    assert asked.code is Code.AMBIGUOUS
    named = {found.id for found in find_places(text, WORLD.vocabulary)}
    singles = [places_of(button.plan.steps[0]) for button in asked.options if button.plan]
    assert named <= {place for places in singles for place in places}


def test_a_condition_that_a_plan_does_not_wait_for_is_named_in_its_offer() -> None:
    named = 0
    for text, condition in (
        ("go to the kitchen when the moon is full", "when the moon is full"),
        ("go to the kitchen when the timer rings", "when the timer rings"),
        ("go to the study if it is empty", "if it is empty"),
        ("厨房没人看着，你要是能过去待着我就放心了", "要是能过去待着我"),
    ):
        for button in getattr(read(text), "options", ()):
            waits = {node.step.kind for node in list_nodes(button.plan.steps)} & HANGING
            is_named = condition in button.label.en and condition in button.label.zh
            assert waits or is_named, text
            named += is_named
    assert named


@pytest.mark.parametrize("text", ["zwei dingse flumpen", "天地玄黄", "qwertz uiop", "12345", "hmm"])
def test_nothing_is_offered_for_gibberish(text: str) -> None:
    assert getattr(read(text), "options", ()) == ()


def test_a_bare_hour_of_a_wait_is_the_one_that_comes_next() -> None:
    words = "if you would be so kind, stay in the kitchen until half past four"
    for hour, meant in ((2, "04:30"), (10, "16:30"), (17, "04:30")):
        now = datetime(2026, 5, 4, hour, 10, tzinfo=UTC)
        context = CONTEXT.model_copy(update={"now": now})
        asked = read_order(OrderWords(parse(words), WORLD.vocabulary, context)).plan
        assert isinstance(asked, Clarify)
        plans = [button.plan for button in asked.options if button.plan is not None]
        steps = [node.step for plan in plans for node in list_nodes(plan.steps)]
        assert {step.time for step in steps if isinstance(step, WaitFor)} == {meant}


def test_a_sentence_of_any_kind_moves_nothing_by_the_learned_reader() -> None:
    for text in ("the kitchen is lovely", "x" * 300, "厨房" * 40, "?!", "go go go to to the the"):
        assert not isinstance(read(text), StepPlan)
