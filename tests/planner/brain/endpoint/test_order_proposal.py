"""A model's steps about standing orders: one offer that waits for a yes, or no plan at all."""

from __future__ import annotations

import json
from typing import Any

import pytest

from planner.brain.endpoint.plan_reply import Unusable, judge
from planner.brain.endpoint.reply_truth import find_untruth
from planner.brain.interface import ThinkRequest
from planner.brain.schema import schema_of
from planner.language.schedule import ChangeOrders, CorrectOrder, ScheduleCommand
from planner.language.sentence import parse
from planner.plan import EVERY_KIND, Clarify, Vocabulary
from planner.plan.order_steps import ORDER_STEPS

WORLD = Vocabulary(entries=())
ADD = {"kind": "order_add", "due": "every day at 20:00", "order": "say hello"}
REMOVE = {"kind": "order_remove", "which": "pills"}
CHANGE = {"kind": "order_change", "which": "pills", "due": "nine"}


def read(*steps: Any) -> object:
    return judge(json.dumps({"kind": "plan", "does": "new", "steps": steps}), WORLD)


@pytest.mark.parametrize(
    ("step", "text", "command"),
    [
        (ADD, "every day at 20:00 say hello", ScheduleCommand),
        ({"kind": "order_add", "due": "每天晚上八点", "order": "说晚安"}, "每天晚上八点说晚安",
         ScheduleCommand),
        (REMOVE, "remove the pills one", ChangeOrders),
        ({"kind": "order_remove", "which": "o3"}, "remove order o3", ChangeOrders),
        ({"kind": "order_remove", "which": "吃药"}, "取消吃药那个", ChangeOrders),
        (CHANGE, "move the pills one to nine", CorrectOrder),
        ({"kind": "order_change", "which": "o3", "due": "nine"}, "change order o3: make it nine",
         CorrectOrder),
        ({"kind": "order_change", "which": "吃药", "due": "九点"}, "把吃药那个改成九点",
         CorrectOrder),
        ({**ADD, "because": "every evening"}, "every day at 20:00 say hello", ScheduleCommand),
    ],
)  # fmt: skip
def test_a_step_becomes_one_offer_that_a_yes_keeps(
    step: dict[str, str], text: str, command: type
) -> None:
    plan = read(step)
    assert isinstance(plan, Clarify), plan
    assert [option.text for option in plan.options] == [text]
    assert text in plan.question.en
    assert isinstance(parse(text).intent, command)


@pytest.mark.parametrize(
    "steps",
    [
        (ADD, {"kind": "say", "text": "hello"}), ({"kind": "go_to", "place": "x"}, REMOVE),
        ({**ADD, "due": "soon"},), ({**ADD, "due": "when it rains"},),
        ({**ADD, "order": "every day at nine say hello"},), ({**CHANGE, "due": "the kitchen"},),
        ({"kind": "order_add", "order": "say hello"},), ({"kind": "order_remove"},),
        ({**REMOVE, "which": "pills and go to the kitchen if somebody is there or"},),
        ({**REMOVE, "which": ["pills"]},), ({**ADD, "order": "x" * 900},),
    ],
)  # fmt: skip
def test_what_is_no_order_is_no_plan(steps: tuple[dict[str, Any], ...]) -> None:
    assert isinstance(read(*steps), Unusable)


def test_no_plan_holds_such_a_step_and_none_hides_within_another() -> None:
    assert not ORDER_STEPS.keys() & EVERY_KIND
    hidden = {"kind": "repeat", "times": 2, "steps": [ADD]}
    assert isinstance(read(hidden), Unusable)
    step = schema_of(WORLD)["properties"]["steps"]["items"]["properties"]
    assert step["kind"]["enum"][-3:] == list(ORDER_STEPS)
    held = step["then"]["items"]["properties"]["kind"]["enum"]
    assert not ORDER_STEPS.keys() & set(held)


@pytest.mark.parametrize(
    ("said", "step", "stands"),
    [
        ("those pills, I have finished them", REMOVE, True),
        ("I am so tired", REMOVE, False),  # what it remembers names no order for a person
        ("the pills have to wait until nine", CHANGE, True),
        ("good morning", CHANGE, False),
        ("every day at 20:00 be polite", ADD, True),
        ("be polite", ADD, False),
    ],
)
def test_an_offer_is_of_the_persons_own_words(
    said: str, step: dict[str, str], stands: bool
) -> None:
    plan = read(step)
    assert isinstance(plan, Clarify)
    found = find_untruth(plan, None, ThinkRequest(text=said, vocabulary=WORLD), "")
    assert (found is None) is stands, found
