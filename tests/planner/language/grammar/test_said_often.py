"""How often something is to be said or done, also where the number is left open."""

from __future__ import annotations

import asyncio
from itertools import product

import pytest

from planner.brain import OfflineBrain, ThinkRequest
from planner.language.motion_guard import PersonWords, find_unasked
from planner.language.numbers import times
from planner.plan import RUNNABLE, Language, Plan, Repeat, Say, StepPlan
from planner.site import Site
from planner.site.site_view import vocabulary_of
from pons_assets import DEFAULT_SITE

HOME = vocabulary_of(Site.load(DEFAULT_SITE))


def think(text: str) -> Plan:
    language = Language.EN if text.isascii() else Language.ZH
    request = ThinkRequest(text=text, vocabulary=HOME, language=language, runnable=RUNNABLE)
    return asyncio.run(OfflineBrain().think(request)).plan


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
    plan = think(text)
    assert isinstance(plan, StepPlan)
    said = [
        each
        for step in plan.steps
        for each in (step.steps * step.times if isinstance(step, Repeat) else (step,))
    ]
    assert said == [Say(text=words)] * often


ROUNDS = (
    *product(
        ("patrol the kitchen and the study", "go to the study and back"),
        ((f" {number} times", round(times(f"{number} times")))
         for number in ("2", "10", "11", "20", "twelve", "twenty")),
    ),
    *product(("巡逻厨房和书房", "去书房再回来"),
             (("两次", 2), ("20次", 20), ("十二次", 12), ("二十次", 20))),
)  # fmt: skip


@pytest.mark.parametrize(("main", "rounds"), ROUNDS)
def test_rounds_of_any_number_are_read_and_need_no_yes(main: str, rounds: tuple[str, int]) -> None:
    text, often = main + rounds[0], rounds[1]
    plan = think(text)
    assert isinstance(plan, StepPlan)
    assert [s.times for s in plan.steps if isinstance(s, Repeat)] == [often]
    assert find_unasked(plan, PersonWords((text,)), HOME, by_all_words=True) == ()
