"""Reach every typed outcome of an order, and read what a person is told, in both languages."""

from __future__ import annotations

import asyncio

import pytest

from planner.brain import BrainDown, OfflineBrain, ScriptedBrain, ThinkRequest
from planner.brain.interface import Observation
from planner.mission.effects import AskBrain
from planner.mission.events import Planned
from planner.mission.plan_request import thinker
from planner.plan import (
    EVERY_KIND,
    AnswerPlan,
    Clarify,
    Code,
    Language,
    Refuse,
    StepPlan,
    Vocabulary,
    say_same,
)
from tests.planner.mission.lockstep import Together, go

ORDERS = {
    Code.UNKNOWN_PLACE: (
        ("go to the kichten", "“kichten”. Did you mean kitchen? Known places: living room"),
        ("去厨防", "我不知道叫“厨防”的地方。您是指厨房吗？已知的地方：客厅"),
    ),
    Code.AMBIGUOUS: (
        ("go to the kitchen or the study", "Which do you want? First: go to the kitchen. Second:"),
        ("去厨房还是书房", "您要哪一个？第一：去厨房。第二：去书房"),
    ),
    Code.INCOMPLETE: (
        ("follow Mary", "Something is missing in “Mary”: where is Mary? Name the place."),
        ("跟着小明", "“小明”里缺少信息：小明在哪里？请说出地点。"),
    ),
    Code.NO_CAPABILITY: (
        ("bring me the cup from the kitchen", "beyond this robot. Shall I do only this: find the"),
        ("去厨房把杯子拿过来", "照这样说，我做不到“把杯子拿过来”。要不要只做这些：去厨房"),
    ),
    Code.UNSAFE: (
        ("run over the cat", "I will not do “run over the cat”: it could hurt somebody"),
        ("撞墙", "我不会做“撞墙”：可能会伤到人或物。"),
    ),
    Code.NEGATED: (
        ("don't go to the kitchen", "I take that as an order not to do it"),
        ("不要去厨房", "我理解为不要这样做，因此不会为此移动。"),
    ),
    Code.CONDITIONAL: (
        (
            "if the bell rings, go to the kitchen",
            "I can't check the condition “if the bell rings”,",
        ),
        ("如果天黑了就去厨房", "所以不会开始。"),
    ),
    Code.OUT_OF_SCOPE: (
        ("go to x=1, y=2", "Speeds and coordinates are not mine to choose"),
        ("去坐标(1,2)", "速度和坐标不由指令决定"),
    ),
    Code.NOT_UNDERSTOOD: (
        ("zwei dingse flumpen", "I can't read “zwei dingse flumpen” without a model"),
        ("天地玄黄", "没有模型，我读不懂“天地玄黄”"),
    ),
}
RULES = {
    "run over the cat": "it could hurt",
    "block the front door": "a way out stays free",
    "drive down the stairs": "level floor only",
    "ignore the obstacles": "nothing that watches over people",
    "堵住大门": "出口必须保持畅通",
    "下楼梯": "只在平地上行驶",
    "关掉雷达去厨房": "都不能关闭或绕过",
}


def think(text: str, home: Vocabulary, **more: object) -> StepPlan | AnswerPlan | Clarify | Refuse:
    asked = {"text": text, "vocabulary": home, "runnable": EVERY_KIND, **more}
    return asyncio.run(OfflineBrain().think(ThinkRequest.model_validate(asked))).plan


@pytest.mark.parametrize("code", list(ORDERS))
def test_outcome_is_told_in_both_languages(code: Code, home: Vocabulary) -> None:
    for language, (text, words) in zip(Language, ORDERS[code], strict=True):
        made = think(text, home)
        assert isinstance(made, Clarify | Refuse), text
        told = made.question if isinstance(made, Clarify) else made.reason
        if code is Code.CONDITIONAL and made.code is Code.NEGATED:  # "没人": a no as well
            continue
        assert (made.code, words in told.of(language)) == (code, True), told
        assert told.en != told.zh


@pytest.mark.parametrize("text", list(RULES))
def test_an_unsafe_order_is_told_its_rule(text: str, home: Vocabulary) -> None:
    made = think(text, home)
    assert isinstance(made, Refuse)
    assert made.code is Code.UNSAFE
    assert RULES[text] in made.reason.en + made.reason.zh


def test_what_is_possible_is_offered_as_a_button(home: Vocabulary) -> None:
    made = think("bring me the cup from the kitchen", home)
    assert isinstance(made, Clarify)
    (button,) = made.options
    assert button.label.zh == "去厨房找杯子"
    again = think(button.text, home)
    assert isinstance(again, StepPlan)
    assert [step.kind for step in again.steps] == ["go_to", "find"]


@pytest.mark.parametrize(
    ("text", "code"),
    [("find the cup", Code.NO_CAMERA), ("去厨房看看有没有人", Code.NO_CAMERA)],
)
def test_without_a_camera_the_camera_is_what_is_missing(
    text: str, code: Code, home: Vocabulary
) -> None:
    made = think(text, home, runnable=frozenset({"go_to", "say"}))
    assert isinstance(made, Clarify | Refuse)
    assert made.code is code


def test_a_model_that_is_down_is_told_in_both_languages(home: Vocabulary) -> None:
    ask = AskBrain("g1", "sing me a sonnet", Language.EN, None)

    async def story() -> Planned:
        return await thinker(ScriptedBrain([BrainDown("503")]), home)(ask)

    planned = asyncio.run(story())
    assert planned.failure is not None
    assert planned.failure.code is Code.MODEL_UNAVAILABLE
    assert planned.failure.message.en.startswith("I can't think that through now")
    assert planned.failure.message.zh.startswith("帮我思考的模型没有应答")


def test_a_robot_that_is_not_armed_is_told_in_both_languages() -> None:
    world = Together()
    goal = world.give(go("kitchen"))
    told = world.goal(goal).outcome
    assert told is not None
    assert told.code is Code.NOT_ARMED
    assert told.message.en == "I may not drive yet. Arm me, then say “go on”."
    assert told.message.zh == "我还不能行驶。请先解锁，再说“继续”。"


def seen(step: str, result: str) -> Observation:
    return Observation.model_validate({"step": step, "result": result, "detail": say_same("x")})


@pytest.mark.parametrize(
    ("walked", "left"),
    [
        ([("go_to", "failed")], ["go_to", "say", "go_to"]),
        ([("go_to", "succeeded"), ("say", "succeeded"), ("go_to", "failed")], ["go_to"]),
        ([("go_to", "succeeded"), ("decide", "succeeded")], None),
    ],
)
def test_nothing_that_is_over_is_ordered_again(
    walked: list[tuple[str, str]], left: list[str] | None, home: Vocabulary
) -> None:
    text = 'go to the kitchen, say "hi", go to the study'
    made = think(text, home, observed=tuple(seen(*one) for one in walked))
    if left is None:
        assert isinstance(made, Refuse)
        return
    assert isinstance(made, StepPlan)
    assert [step.kind for step in made.steps] == left


def test_a_plan_walked_to_its_end_is_told(home: Vocabulary) -> None:
    made = think("wait 5 seconds", home, observed=(seen("wait", "succeeded"),))
    assert made == AnswerPlan(text=say_same("x"))


def test_the_clock_is_told_and_a_step_says_it(home: Vocabulary) -> None:
    answer = think("what time is it", home)
    assert isinstance(answer, AnswerPlan)
    assert "When you asked it was" in answer.text.en
    made = think("go to the kitchen and tell me a joke", home)
    assert isinstance(made, StepPlan)
    assert [step.kind for step in made.steps] == ["go_to", "say"]
