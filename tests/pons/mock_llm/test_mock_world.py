"""Check what the mock reads out of a request: the order, the places, the steps that are offered."""

from __future__ import annotations

from typing import Any

import pytest

from planner.brain import ThinkRequest
from planner.brain.interface import Exchange
from planner.brain.prompt import Prompt
from planner.brain.schema import schema_of
from planner.plan import EVERY_KIND, RUNNABLE, Vocabulary
from pons.mock_llm.request_parser import request_of
from tests.planner.brain.conftest import HOME


def test_any_client_gets_a_plan_in_its_own_closed_world() -> None:
    world = {"properties": {"steps": {"items": {"properties": {"place": {"enum": ["lab", "9$"]}}}}}}
    body = {
        "messages": [{"role": "user", "content": [{"type": "text", "text": "go to the lab"}]}],
        "response_format": {"type": "json_schema", "json_schema": {"schema": world}},
    }
    asked = request_of(body)
    assert asked.text == "go to the lab"
    assert list(asked.vocabulary.by_id) == ["lab"]
    assert asked.runnable == RUNNABLE


@pytest.mark.parametrize("runnable", [RUNNABLE, EVERY_KIND, frozenset({"go_to", "look"})])
def test_the_steps_that_are_offered_are_the_steps_of_the_plan(runnable: frozenset[str]) -> None:
    request = ThinkRequest(text="look around", vocabulary=HOME, runnable=runnable)
    schema = {"json_schema": {"schema": schema_of(HOME, runnable)}}
    ours = {"messages": Prompt.load().messages(request), "response_format": schema}
    theirs = {"messages": [{"role": "user", "content": "look"}], "response_format": schema}
    assert [request_of(body).runnable for body in (ours, theirs)] == [runnable, runnable]


def test_an_answer_to_a_question_is_what_is_thought_about() -> None:
    asked = (Exchange(asked="Which room?", answer="go to the kitchen"),)
    request = ThinkRequest(
        text="go to the kitchen", vocabulary=HOME, order="bring it", exchanges=asked
    )
    assert request_of({"messages": Prompt.load().messages(request)}).text == "go to the kitchen"


@pytest.mark.parametrize(
    ("line", "en", "zh"),
    [
        ('taught_d4e0fed7: ["猫窝"]', "猫窝", "猫窝"),
        ('taught_d4e0fed7: ["猫窝","猫窝","喵窝"]', "猫窝", "猫窝"),
        ('den: ["the den"]', "the den", "the den"),
        ('den: ["the den","书房"]', "the den", "书房"),
        ("den: []", "den", "den"),
    ],
)
def test_a_place_is_called_by_a_name_and_never_by_its_code(line: str, en: str, zh: str) -> None:
    [entry] = request_of({"messages": [{"role": "system", "content": line}]}).vocabulary.entries
    assert (entry.name.en, entry.name.zh) == (en, zh)


@pytest.mark.parametrize(
    "body",
    [
        {},
        {"messages": None},
        {"messages": [7, None, {"role": "user"}, {"role": "user", "content": 7}]},
        {"messages": [{"role": "user", "content": '{"order":7}'}]},
        {"messages": [{"role": "user", "content": "x: [[[["}], "tools": [[[[]]]]},
    ],
)
def test_no_body_is_too_odd(body: dict[str, Any]) -> None:
    assert isinstance(request_of(body), ThinkRequest)


def test_an_empty_world_moves_nowhere() -> None:
    assert request_of({"messages": []}).vocabulary == Vocabulary()
