"""Check the brain's door: the offline brain and the scripted double behave as one protocol."""

from __future__ import annotations

import asyncio

import pytest

import planner.brain
from planner.brain import (
    BadPlan,
    Brain,
    BrainConfigError,
    OfflineBrain,
    ScriptedBrain,
    ThinkRequest,
)
from planner.plan import AnswerPlan, Clarify, Code, GoTo, Refuse, StepPlan, Vocabulary, Wait

GOOD = StepPlan(steps=(Wait(seconds=1.0),))


def ask(brain: Brain, home: Vocabulary, text: str = "go to the kitchen", **more: str) -> object:
    request = ThinkRequest.model_validate({"text": text, "vocabulary": home, **more})
    return asyncio.run(brain.think(request)).plan


def test_offline_brain_plans_and_names_itself(home: Vocabulary) -> None:
    brain = OfflineBrain()
    assert ask(brain, home) == StepPlan(steps=(GoTo(place="kitchen"),))
    assert (brain.tag.name, brain.tag.version) == ("offline", "2")


@pytest.mark.parametrize("text", ["yes", "no", "yes please", "好的", "不用"])
def test_a_yes_to_nothing_is_told_so(home: Vocabulary, text: str) -> None:
    made = asyncio.run(OfflineBrain().think(ThinkRequest(text=text, vocabulary=home))).plan
    assert isinstance(made, AnswerPlan)
    assert "asked nothing" in made.text.en
    assert "没有在等" in made.text.zh


def test_what_a_yes_would_do_is_told_in_the_question(home: Vocabulary) -> None:
    made = ask(OfflineBrain(), home, "去厨房叫我起床")
    assert isinstance(made, Clarify)
    [option] = made.options
    assert made.question.zh == f"没有模型，我读不懂“叫我起床”。要不要只做这些：{option.label.zh}？"


def test_offline_brain_knows_the_room_it_is_told(home: Vocabulary) -> None:
    answer = ask(OfflineBrain(), home, "你在哪", room="kitchen")
    assert isinstance(answer, AnswerPlan)
    assert answer.text.zh == "我在厨房。"


TOOLS = (
    "what is in my calendar today", "which meetings do I have tomorrow?", "is it dry tomorrow",
    "tell me what is in my calendar tomorrow", "any calendar entries?", "ask calendar what is on",
    "今天我的日历里有什么", "明天要不要带伞", "今天几点开会", "calendar里有什么",
)  # fmt: skip


@pytest.mark.parametrize("text", TOOLS)
def test_what_only_a_tool_could_answer_is_told_to_need_a_model(home: Vocabulary, text: str) -> None:
    told = ask(OfflineBrain(servers=("calendar", "mail")), home, text)
    assert isinstance(told, Refuse)
    assert told.code is Code.TOOLS_NEED_MODEL
    assert "calendar, mail" in told.reason.en
    assert "calendar, mail" in told.reason.zh
    plain = ask(OfflineBrain(), home, text)
    assert getattr(plain, "code", None) is not Code.TOOLS_NEED_MODEL


@pytest.mark.parametrize(
    "text", ["go to the kitchen", "is there a cup in the cellar?", "dance"]
)  # fmt: skip
def test_servers_change_nothing_about_other_sentences(home: Vocabulary, text: str) -> None:
    assert ask(OfflineBrain(servers=("calendar",)), home, text) == ask(OfflineBrain(), home, text)


def test_script_is_followed_and_its_last_line_repeats(home: Vocabulary) -> None:
    other = StepPlan(steps=(Wait(seconds=2.0),))
    brain = ScriptedBrain(replies=[GOOD, other])
    assert [ask(brain, home) for _ in range(3)] == [GOOD, other, other]
    assert [request.text for request in brain.asked] == ["go to the kitchen"] * 3


@pytest.mark.parametrize(
    "text",
    [
        *("not json", "", "{}", '{"kind":"plan","steps":[{"kind":"fly"}]}', "[" * 10_000, "NaN"),
        '{"kind":"plan","steps":[{"kind":"wait","seconds":1e999}]}',
    ],
    ids=lambda text: text[:20],
)
def test_a_text_that_is_no_plan_is_rejected(text: str, home: Vocabulary) -> None:
    with pytest.raises(BadPlan, match="no plan"):
        ask(ScriptedBrain(replies=[text]), home)


def test_an_empty_script_refuses_to_start() -> None:
    with pytest.raises(BrainConfigError, match="got none"):
        ScriptedBrain(replies=[])


async def test_a_brain_that_hangs_can_be_cancelled(home: Vocabulary) -> None:
    brain = ScriptedBrain(replies=[], hangs=True)
    thinking = asyncio.create_task(brain.think(ThinkRequest(text="x", vocabulary=home)))
    await asyncio.sleep(0)  # one turn of the loop: the brain has been asked and waits
    assert brain.asked
    thinking.cancel()
    with pytest.raises(asyncio.CancelledError):
        await thinking


def test_the_door_opens_every_name_it_lists_and_no_other() -> None:
    for name in planner.brain.__all__:
        assert getattr(planner.brain, name) is not None
    with pytest.raises(AttributeError, match="no attribute 'nothing'"):
        _ = planner.brain.nothing
