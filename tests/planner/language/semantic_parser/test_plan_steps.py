"""Plans of the parser's grammar become steps that the plan check knows, or none at all."""

from __future__ import annotations

from math import pi
from random import Random

import pytest

from planner.language.semantic_parser.plan_grammar import parse_plan
from planner.language.semantic_parser.plan_steps import StepMaker
from planner.plan import (
    Attempt,
    Bilingual,
    ComeBack,
    Entry,
    Find,
    GoTo,
    If,
    Language,
    Look,
    MoveStraight,
    Patrol,
    PlanRole,
    Repeat,
    ReturnHome,
    Say,
    Step,
    StepPlan,
    Turn,
    Vocabulary,
    Wait,
)
from tools.train_reader.assignments import draw_assignment


def _entry(name: str, room: bool = True) -> Entry:
    kind = "room" if room else "place"
    return Entry(id=name, kind=kind, name=Bilingual(en=name, zh=name))


SITE = Vocabulary(entries=(_entry("kitchen"), _entry("hall"), _entry("sofa", room=False)))


def _hour(words: str) -> str | None:
    return {"ten": "10:00"}.get(words)


def _plan(label: str) -> StepPlan | None:
    return StepMaker(SITE, Language.EN, _hour).plan(parse_plan(label))


@pytest.mark.parametrize(
    ("label", "steps"),
    [
        ("go(hall); back", (GoTo(place="hall"), ComeBack())),
        ("look(in hall)", (GoTo(place="hall"), Look(question="look around", place="hall"))),
        ("turn(right, 90 deg)", (Turn(angle_rad=-pi / 2),)),
        ("turn(around)", (Turn(angle_rad=pi),)),
        ("move(backward, 20 cm)", (MoveStraight(distance_m=-0.2),)),
        ("wait(2 min)", (Wait(seconds=120.0),)),
        ('say("up", to "Dad")', (Find(object="Dad"), Say(text="Dad, up"))),
        ('go(hall); say("up", to "Dad")', (GoTo(place="hall"), Say(text="Dad, up"))),
        ("inspect(all, except hall)", (Patrol(places=("kitchen",), look=True),)),
        (
            'if not check("Dad", in hall) { home }',
            (
                If(
                    when=Look(question="Dad?", place="hall"),
                    then=(),
                    otherwise=(ReturnHome(),),
                ),
            ),
        ),
        ("repeat(2 times) { home }", (Repeat(steps=(ReturnHome(),), times=2),)),
        (
            "try { go(hall) } else { home }",
            (Attempt(steps=(GoTo(place="hall"),), on_failure=(ReturnHome(),)),),
        ),
    ],
)
def test_a_plan_becomes_its_steps(label: str, steps: tuple[Step, ...]) -> None:
    assert _plan(label) == StepPlan(steps=steps)


def test_a_row_that_acts_on_what_runs_has_its_role() -> None:
    assert _plan("after { home }") == StepPlan(steps=(ReturnHome(),), does=PlanRole.AFTER)
    assert _plan("slowly { home }") == StepPlan(steps=(ReturnHome(),), pace="slow")


@pytest.mark.parametrize(
    "label",
    [
        "none",
        "refuse",
        "stop",
        "go(there)",
        "find(it)",
        "change_place(hall)",
        'at("ten") { home }',
        'if later("dawn") { home }',
        'until not check("x") { home }',
        "try { home }",
        'recall("keys", when "yesterday")',
        "patrol(sofa, except sofa)",
        "move(forward, 90 m)",
    ],
)
def test_what_has_no_steps_gives_none(label: str) -> None:
    assert _plan(label) is None


def test_any_drawn_plan_gives_steps_or_none() -> None:
    random, maker = Random(2), StepMaker(SITE, Language.EN, _hour)
    made = [maker.plan(parse_plan(draw_assignment(random, "en")[4])) for _ in range(300)]
    assert sum(plan is not None for plan in made) > 60


@pytest.mark.parametrize(
    ("label", "last"),
    [
        ('check("老花镜", in hall)', Look(question="有没有老花镜？", place="hall")),
        ('check("冰箱门开着", in hall)', Look(question="冰箱门开着？", place="hall")),
        ('say("吃饭了", to "爷爷")', Say(text="爷爷，吃饭了")),
    ],
)
def test_chinese_words_are_put_as_chinese_is_written(label: str, last: Step) -> None:
    made = StepMaker(SITE, Language.ZH, _hour).plan(parse_plan(label))
    assert made is not None
    assert made.steps[-1] == last
