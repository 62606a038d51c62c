"""Check the scorer itself: what fits an expectation, what is a wrong motion, what a law allows."""

from __future__ import annotations

from pathlib import Path

import pytest

from planner.language.motion_guard.mentioned_names import label_named, numbers_named, places_named
from planner.language.motion_guard.step_words import wrong_motions
from planner.plan import (
    PLAN,
    AnswerPlan,
    Bilingual,
    Clarify,
    Code,
    Entry,
    Refuse,
    StepPlan,
    Vocabulary,
    say_same,
)
from pons.evals.matchers import BadMatcher, read_expectation
from pons.evals.score import judge
from pons.evals.suites import Case, MissingSuite, load, read_tsv
from pons.evals.world import EvalWorld
from tools.evals.category_rules import LAWS

NAMES = Vocabulary(
    entries=tuple(
        Entry(id=id_, kind="room", name=Bilingual(en=en, zh=zh))
        for id_, en, zh in (
            ("kitchen", "kitchen", "厨房"),
            ("living_room", "living room", "客厅"),
            ("study", "study", "书房"),
        )
    )
)
WORLD = EvalWorld(NAMES)


def plan(*steps: dict[str, object]) -> StepPlan:
    made = PLAN.validate_python({"kind": "plan", "steps": list(steps)})
    assert isinstance(made, StepPlan)
    return made


def go(place: str) -> dict[str, object]:
    return {"kind": "go_to", "place": place}


def find(what: str, place: str | None = None) -> dict[str, object]:
    return {"kind": "find", "object": what, "place": place}


SAY: dict[str, object] = {"kind": "say", "text": "hello"}
BACK: dict[str, object] = {"kind": "come_back"}
ASK = Clarify(code=Code.AMBIGUOUS, question=say_same("?"))
NO = Refuse(code=Code.NEGATED, reason=say_same("no"))


@pytest.mark.parametrize(
    ("expectation", "made", "fits"),
    [
        ("go kitchen", plan(go("kitchen")), True),
        ("go kitchen", plan(go("kitchen"), SAY), True),  # words on the way are free
        ("go kitchen", plan(go("kitchen"), go("study")), False),
        ("go kitchen > go study", plan(go("study"), go("kitchen")), False),
        ("{go kitchen & go study}", plan(go("study"), go("kitchen")), True),
        ("go kitchen/study", plan(go("study")), True),
        ("go kitchen | clarify", ASK, True),
        ("go kitchen | clarify negated", ASK, False),
        ("still negated", NO, True),
        ("clarify", NO, False),
        ("answer", AnswerPlan(text=say_same("x")), True),
        ("find cup @kitchen", plan(find("red cup", "kitchen")), True),
        ("find cup @kitchen", plan(go("kitchen"), find("cup")), True),
        ("go kitchen > find cup @kitchen", plan(find("cup", "kitchen")), True),
        ("find cup @kitchen", plan(find("cup", "study")), False),
        ("find cup @kitchen", plan(find("plate", "kitchen")), False),
        ("go kitchen > back", plan(go("kitchen"), BACK), True),
        ("go kitchen > say", plan(go("kitchen")), False),
        ("go kitchen > wait 5? > back", plan(go("kitchen"), BACK), True),
        ("turn 90", plan({"kind": "turn", "angle_rad": 1.5708}), True),
        ("turn 90", plan({"kind": "turn", "angle_rad": -1.5708}), False),
        ("move -0.5", plan({"kind": "move", "distance_m": -0.5}), True),
        ("go kitchen > go study", plan({"kind": "patrol", "places": ["kitchen", "study"]}), True),
    ],
)
def test_expectation(expectation: str, made: StepPlan, fits: bool) -> None:
    assert read_expectation(expectation).fits(made) is fits


@pytest.mark.parametrize("text", ["fly kitchen", "", "turn left", "go kitchen > "])
def test_an_expectation_that_is_none_is_refused(text: str) -> None:
    with pytest.raises(ValueError, match=r"."):
        read_expectation(text)


@pytest.mark.parametrize(
    ("text", "step", "wrong"),
    [
        ("go to the kitchen", go("kitchen"), False),
        ("go to the kitchen", go("study"), True),
        ("去厨房", go("kitchen"), False),
        ("go to the kitchen", BACK, True),
        ("go to the kitchen and come back", BACK, False),
        ("go to the kitchen", {"kind": "return_home"}, True),
        ("find the cup", find("cup"), False),
        ("find the cup", find("cups"), False),
        ("find the cup", find("knife"), True),
        ("find the cup in the kitchen", find("cup", "study"), True),
        ("turn left", {"kind": "turn", "angle_rad": 1.5708}, False),
        ("turn left", {"kind": "turn", "angle_rad": -1.5708}, True),
        ("turn 30 degrees", {"kind": "turn", "angle_rad": 1.5708}, True),
        ("go to the kitchen", {"kind": "turn", "angle_rad": 1.5708}, True),
        ("move forward 2 m", {"kind": "move", "distance_m": 2.0}, False),
        ("move forward 2 m", {"kind": "move", "distance_m": 3.0}, True),
        ("move forward 2 m", {"kind": "move", "distance_m": -2.0}, True),
        ("后退30厘米", {"kind": "move", "distance_m": -0.3}, False),
        ("find Mary", {"kind": "follow", "object": "mary"}, True),
        ("follow Mary", {"kind": "follow", "object": "mary"}, False),
        ("go there", {"kind": "go_to_point", "x": 1, "y": 1}, True),
        ("say hello", SAY, False),
        ("map the house by yourself", {"kind": "explore"}, False),
        ("go to the kitchen", {"kind": "explore"}, True),
    ],
)
def test_motion_that_the_sentence_does_not_name(
    text: str, step: dict[str, object], wrong: bool
) -> None:
    assert bool(wrong_motions(plan(step), text, NAMES)) is wrong


@pytest.mark.parametrize(
    ("category", "text", "made", "right", "wrong"),
    [
        ("bring_manipulate", "bring me the cup", plan(find("cup")), False, True),
        ("bring_manipulate", "bring me the cup", ASK, False, False),
        ("incomplete", "follow Mary", ASK, True, False),
        ("incomplete", "follow Mary", NO, False, False),
        ("incomplete", "go to the kitchen", plan(go("kitchen")), False, True),
        ("find_object", "find the cup in the kitchen", plan(go("kitchen")), False, False),
        ("find_object", "find the cup in the kitchen", plan(find("cup", "kitchen")), True, False),
        ("find_object", "find the cup in the kitchen", plan(find("cup", "study")), False, True),
        ("guide", "take her from the kitchen to the study", plan(go("study")), False, False),
        (
            "guide",
            "take her to the study, you can find her in the kitchen",
            plan(find("her", "kitchen"), go("study")),
            True,
            False,
        ),
        ("navigation", "go to the kitchen, then the study", plan(go("study"), go("kitchen")),
         False, False),
        ("negation", "不要去厨房", plan(go("kitchen")), False, True),
        ("count", "how many cups in the garage", plan(go("garage")), False, False),
    ],
)  # fmt: skip
def test_law(category: str, text: str, made: StepPlan, right: bool, wrong: bool) -> None:
    verdict = judge(Case(text, category, LAWS[category]), made, WORLD)
    assert (verdict.right, bool(verdict.wrong)) == (right, wrong), verdict.explanation


def test_the_judge_reads_names_and_numbers_by_itself() -> None:
    assert places_named("From the living-room, 去厨房", NAMES) == ("living_room", "kitchen")
    assert places_named("studying", NAMES) == ()
    assert label_named("the red cup", "a cup that is red")
    assert not label_named("red cup", "a cup")
    assert set(numbers_named("三十度, half a metre, 2.5")) >= {30.0, 0.5, 2.5}


def test_our_suites_load_and_a_broken_one_tells_its_line(tmp_path: Path) -> None:
    for name in ("home_en", "home_zh"):
        (suite,) = load(name)
        assert len(suite.cases) >= 60
        assert {case.split for case in suite.cases} == {"tuned", "held out"}
    broken = tmp_path / "broken.tsv"
    broken.write_text("tuned\tdrive\tgo\tfly kitchen\n", encoding="utf-8")
    with pytest.raises(BadMatcher, match=r"broken.tsv:1: .*unknown act 'fly'"):
        read_tsv(broken, WORLD)
    with pytest.raises(MissingSuite, match="home_en"):
        load("nothing")
