"""The notation and its plans are one to one, and what isn't of the grammar is refused."""

from __future__ import annotations

from random import Random

import pytest

from planner.language.semantic_parser.normal_plan import normalise_plan
from planner.language.semantic_parser.plan_grammar import (
    FORMS,
    NotationError,
    PlanNode,
    parse_plan,
    render_plan,
)
from planner.plan.steps import EVERY_KIND
from tools.train_reader.assignments import draw_assignment


@pytest.mark.parametrize("language", ["en", "zh"])
def test_a_plan_that_is_rendered_is_parsed_as_itself(language: str) -> None:
    random = Random(5)
    for _ in range(400):
        plan = parse_plan(draw_assignment(random, language)[4])
        assert parse_plan(render_plan(plan)) == plan
        assert normalise_plan(normalise_plan(plan)) == normalise_plan(plan)


@pytest.mark.parametrize(
    "text",
    [
        'go(kitchen); say("dinner\'s ready", to "Dad")',
        'if not check("anyone", in hall) { back } else { home }',
        "until find(it) { turn(left, 90 deg); wait(a bit) }",
        'at("every day", "at eight") { inspect(kitchen + hall); patrol(all, except loo) }',
        'order_move("the walk", to "nine")',
        "again(2 times)",
        "recall(it, in there)",
        "wait(5 min)",
        'try { go(hall) } else { say("blocked") }',
    ],
)
def test_the_notation_is_rendered_as_it_was_written(text: str) -> None:
    assert render_plan(parse_plan(text)) == text


@pytest.mark.parametrize(
    "text",
    [
        "",
        "go",
        "go(kitchen",
        "go(kitchen + hall)",
        "fly(kitchen)",
        "go(kitchen) extra",
        "find(cup)",
        'find(" cup")',
        "turn(up)",
        "wait(5 m)",
        "none; home",
        'at("nine") { stop }',
        'if go(hall) { home }',
        'if check("x") { }',
        "repeat(2 times)",
        "slowly { slowly { home } }",
        "until check(\"x\") { " * 6 + "home" + " }" * 6,
        "; ".join(["home"] * 25),
        "go(kitchen, in hall)",
    ],
)  # fmt: skip
def test_what_is_not_of_the_grammar_is_refused(text: str) -> None:
    with pytest.raises(NotationError):
        parse_plan(text)


def test_a_drive_before_a_look_at_the_same_place_is_the_look_alone() -> None:
    assert normalise_plan(parse_plan("go(hall); look")) == (PlanNode("look", (("hall",),)),)
    assert normalise_plan(parse_plan("go(hall); look(in hall)")) == parse_plan("look(in hall)")
    apart = parse_plan("go(hall); look(in kitchen)")
    assert normalise_plan(apart) == apart


def test_each_kind_of_step_that_words_can_ask_for_has_a_form() -> None:
    forms = {"go_to": "go", "stand_at": "stand", "come_back": "back", "return_home": "home"}
    forms |= {"go_to_object": "approach"}
    unsaid = {"decide", "go_to_point"}
    assert {forms.get(kind, kind) for kind in EVERY_KIND - unsaid} <= set(FORMS)
