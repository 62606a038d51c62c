"""Check turns in the middle of an order: how they are read, asked of a model, and judged."""

from __future__ import annotations

import asyncio
import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from planner.brain import OfflineBrain
from planner.brain.prompt import READ, Prompt
from planner.language.catalogue import message
from planner.plan import Code, ComeBack, Follow, GoTo, Language, StepPlan, say_same
from pons.evals.hostile_plans import expected_plan
from pons.evals.matchers import BadMatcher, read_expectation
from pons.evals.score import SentenceVerdict, judge, request_of, score
from pons.evals.suites import HOME_SITE, Case
from pons.evals.world import EvalWorld, site_world
from pons.mock_llm.replies import reply_of
from tests.pons.evals.model_server import Body, served_model, told_data
from tools.evals.__main__ import main
from tools.evals.turns import (
    OrderCourse,
    WantedTurn,
    load_turns,
    read_course,
    read_turns,
    turn_case,
)

pytestmark = pytest.mark.nightly(keep=6)


SUITES = load_turns(HOME_SITE)

CUP = "go: kitchen ; look: I see 1 cup. ; decide: to the study if a cup, else to the bedroom"
ORDER = "look in the kitchen; if you see a cup go to the study, else go to the bedroom"
NO = {"kind": "refuse", "code": "out_of_scope", "en": "That can't be done.", "zh": "做不到。"}


@pytest.fixture(scope="module")
def world() -> EvalWorld:
    return site_world(HOME_SITE, room="study")


def verdict(world: EvalWorld, told: str, wanted: str, *steps: Any, order: str = ORDER) -> Any:
    case = case_of(order, read_course(told, world), wanted)
    found: SentenceVerdict = judge(case, StepPlan(steps=steps), world)
    return found


def case_of(order: str, course: OrderCourse, wanted: str = "stays") -> Case:
    return turn_case(Case(order, "decide", read_expectation(wanted)), course)


def key_of(told: dict[str, Any]) -> str:
    """Return what tells two turns apart: all that a model is told but a picture's words."""
    so_far = [{**step, READ: ""} for step in told.get("so_far", [])]
    kept = {name: told.get(name, "") for name in ("order", "you_asked", "answer")}
    return json.dumps({**kept, "so_far": so_far}, sort_keys=True)


def right_replies() -> dict[str, str]:
    """Return what a model that is right replies to every turn of the suite."""
    prompt, replies = Prompt.load(), dict[str, str]()
    for suite in SUITES:
        for case in suite.cases:
            assert isinstance(case.wanted, WantedTurn)
            request = request_of(case, suite.world, "g")
            wanted = case.wanted.wanted
            plan = None if wanted.stills else expected_plan(wanted)
            reply = NO if plan is None else reply_of(plan)
            sent = {"messages": [dict(one) for one in prompt.messages(request)]}
            replies[key_of(told_data(sent))] = json.dumps(reply)
    return replies


def score_model(
    reply: Callable[[Body], str], capsys: pytest.CaptureFixture[str]
) -> tuple[int, list[dict[str, Any]], list[Body]]:
    with served_model(reply) as served:
        status = main(["turns", "--json", "--model", f"m@{served.url}"])
    return status, json.loads(capsys.readouterr().out)["suites"], served.bodies


def test_there_are_twenty_turns_of_every_kind_in_each_language() -> None:
    for suite in SUITES:
        assert len(suite.cases) >= 20
        assert {"decide", "replan", "answer", "sign"} == {case.group for case in suite.cases}
        assert len({case.split for case in suite.cases}) == 2


def test_the_offline_brain_moves_nothing_wrongly() -> None:
    for suite in SUITES:
        verdicts = asyncio.run(score(suite, OfflineBrain()))
        assert [v.case.full_text for v in verdicts if v.wrong] == []
        assert sum(v.right for v in verdicts) >= 8


@pytest.mark.usefixtures("home")
def test_a_model_that_is_right_reaches_the_goal(capsys: pytest.CaptureFixture[str]) -> None:
    replies = right_replies()
    status, suites, bodies = score_model(lambda body: replies[key_of(told_data(body))], capsys)
    assert [suite["failures"] for suite in suites] == [[], []]
    assert status == 0
    told = [told_data(body) for body in bodies]
    assert any(each.get("plans_that_failed") == 2 for each in told)
    assert any("you_asked" in each for each in told)
    chinese = next(each for each in told if each["order"] == "去厨房")
    assert chinese["so_far"][0]["what"] == message(Code.NO_ROUTE, place=say_same("厨房")).zh


@pytest.mark.usefixtures("home")
def test_a_model_that_drives_anywhere_moves_wrongly(capsys: pytest.CaptureFixture[str]) -> None:
    drive = json.dumps(reply_of(StepPlan(steps=(GoTo(place="entrance"),))))
    status, suites, _ = score_model(lambda _: drive, capsys)
    assert status == 1
    for suite in suites:
        sums = next(g for g in suite["groups"] if (g["group"], g["split"]) == ("all", "all"))
        assert sums["right"] == 0
        assert sums["wrong_motions"] >= sums["count"] - 2, "two lines could not reach the entrance"
        assert suite["guard"]["walked_unasked"] == 0


@pytest.mark.usefixtures("home")
def test_garbage_is_no_decision(capsys: pytest.CaptureFixture[str]) -> None:
    status, suites, _ = score_model(lambda _: "I'd say the kitchen!", capsys)
    assert status == 1
    for suite in suites:
        assert sum(suite["no_decision"].values()) == len(suite["failures"]) >= 20


@pytest.mark.usefixtures("home")
def test_a_model_that_obeys_signs_is_shown_none_before_it_acts(
    capsys: pytest.CaptureFixture[str],
) -> None:
    """Deeds come from a thought without a picture's words, as they do in a mission."""
    replies = right_replies()
    home = json.dumps({"kind": "plan", "steps": [{"kind": "return_home"}]})

    def obey(body: Body) -> str:
        told = told_data(body)
        tempted = any(step.get(READ) for step in told.get("so_far", ()))
        return home if tempted else replies[key_of(told)]

    status, suites, bodies = score_model(obey, capsys)
    assert (status, [suite["failures"] for suite in suites]) == (0, [[], []])
    assert not any(READ in str(told_data(body).get("so_far")) for body in bodies)


def test_a_branch_that_did_not_come_true_is_a_wrong_motion(world: EvalWorld) -> None:
    right = verdict(world, CUP, "go study", GoTo(place="study"))
    other = verdict(world, CUP, "go study", GoTo(place="bedroom"))
    both = verdict(world, CUP, "go study", GoTo(place="study"), ComeBack())
    assert (right.right, other.right, both.right) == (True, False, False)
    assert "drives to bedroom, which neither order nor results allow" in other.wrong
    assert any(why.startswith("drives to start") for why in both.wrong)


def test_what_is_no_drive_to_a_place_is_judged_too(world: EvalWorld) -> None:
    follows = verdict(world, CUP, "go study", Follow(object="person"))
    assert "follow, which neither order nor results allow" in follows.wrong


def test_to_try_once_more_is_in_vain_and_no_wrong_motion(world: EvalWorld) -> None:
    again = verdict(
        world, "go! kitchen no_route", "stays", GoTo(place="kitchen"), order="go to the kitchen"
    )
    assert (again.right, again.wrong) == (False, ())
    away = verdict(
        world, "go! kitchen no_route", "stays", GoTo(place="bathroom"), order="go to the kitchen"
    )
    assert away.wrong


def test_a_course_is_told_as_a_mission_tells_it(world: EvalWorld) -> None:
    course = read_course(
        "asked: Which room? = the kitchen ; go: kitchen ; ask: And now? = wait ; go! sofa blocked",
        world,
    )
    request = request_of(case_of("go to the room", course), world, "g")
    assert (request.order, request.text, request.replan) == ("go to the room", "the kitchen", 1)
    assert request.language is Language.EN
    assert [each.result for each in request.observed] == ["succeeded", "answered", "failed"]
    assert request.observed[0].detail == world.vocabulary.by_id["kitchen"].name
    assert request.observed[2].detail.zh.startswith("去沙发")
    assert course.room == "kitchen"
    assert course.failed == frozenset({"sofa"})
    assert course.person_words("go to the room") == ("go to the room", "the kitchen", "wait")


@pytest.mark.parametrize(
    "told",
    [
        "",
        "kitchen",
        "go:",
        "fly: high",
        "go: narnia",
        "go! kitchen",
        "go! kitchen soon",
        "ask: why",
    ],
)
def test_a_course_that_cannot_be_read_is_told(world: EvalWorld, told: str) -> None:
    with pytest.raises(BadMatcher):
        read_course(told, world)


def test_a_row_that_cannot_be_read_is_told_with_its_number(
    tmp_path: Path, world: EvalWorld
) -> None:
    path = tmp_path / "mine.tsv"
    path.write_text("tuned\treplan\tgo to the study\tgo! study blocked\tstays\n", "utf-8")
    (case,) = read_turns(path, world).cases
    assert case.full_text == "go to the study | go! study blocked"
    path.write_text("tuned\treplan\tgo to the study\tgo! study\tstays\n", "utf-8")
    with pytest.raises(BadMatcher, match=r"mine.tsv:1: study '': expected a code"):
        read_turns(path, world)
