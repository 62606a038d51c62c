"""How often something is to be said or done, also where the number is left open."""

from __future__ import annotations

import asyncio

import pytest

from planner.brain import OfflineBrain, ThinkRequest
from planner.language.motion_guard import PersonWords, find_unasked
from planner.language.numbers import times
from planner.plan import RUNNABLE, Language, Repeat, Say, StepPlan
from planner.site import Site
from planner.site.site_view import vocabulary_of
from pons_assets import DEFAULT_SITE

HOME = vocabulary_of(Site.load(DEFAULT_SITE))


@pytest.mark.parametrize(
    ("text", "words", "often"),
    [
        ("say hello three times", "hello", 3),
        ("say hello a few times", "hello", 3),
        ("say dinner is ready several times", "dinner is ready", 3),
        ("say good night a couple of times", "good night", 2),
        ("说吃饭了三遍", "吃饭了", 3),
        ("说吃饭了几遍", "吃饭了", 3),
        ("说“开饭了”好几遍", "开饭了", 3),
        ("说好几遍开饭了", "开饭了", 3),
        ("喊两声开饭了", "开饭了", 2),
    ],
)
def test_words_are_said_as_often_as_asked_and_the_number_is_not_among_them(
    text: str, words: str, often: int
) -> None:
    language = Language.EN if text.isascii() else Language.ZH
    request = ThinkRequest(text=text, vocabulary=HOME, language=language, runnable=RUNNABLE)
    plan = asyncio.run(OfflineBrain().think(request)).plan
    assert isinstance(plan, StepPlan)
    said = [
        each
        for step in plan.steps
        for each in (step.steps * step.times if isinstance(step, Repeat) else (step,))
    ]
    assert said == [Say(text=words)] * often


@pytest.mark.parametrize("number", ["2", "10", "11", "20", "twelve", "twenty"])
@pytest.mark.parametrize("main", ["patrol the kitchen and the study", "go to the study and back"])
def test_rounds_of_any_number_are_read_and_need_no_yes(main: str, number: str) -> None:
    check_rounds(f"{main} {number} times", round(times(f"{number} times")), Language.EN)


@pytest.mark.parametrize(("number", "often"), [("两", 2), ("20", 20), ("十二", 12), ("二十", 20)])
@pytest.mark.parametrize("main", ["巡逻厨房和书房", "去书房再回来"])
def test_rounds_are_read_in_chinese_too(main: str, number: str, often: int) -> None:
    check_rounds(f"{main}{number}次", often, Language.ZH)


def check_rounds(text: str, often: int, language: Language) -> None:
    """Hold that a sentence is one repeat, and that the guard lets it go."""
    request = ThinkRequest(text=text, vocabulary=HOME, language=language, runnable=RUNNABLE)
    plan = asyncio.run(OfflineBrain().think(request)).plan
    assert isinstance(plan, StepPlan)
    assert [s.times for s in plan.steps if isinstance(s, Repeat)] == [often]
    assert find_unasked(plan, PersonWords((text,)), HOME, by_all_words=True) == ()
