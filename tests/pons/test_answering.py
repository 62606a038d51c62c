"""``pons answer`` and ``pons confirm`` find the goal that waits, or list them."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import pytest

from planner.plan import GoalState
from pons import goals
from pons.grammar import parser
from pons.settings import LaunchSettings, load
from pons.terminal_text import how_to_answer
from tests.planner.api.serving import served as real_planner
from tests.pons.served_goals import Planner, goal

pytestmark = pytest.mark.nightly(keep=12)


ASKED = {"message": {"en": "Shall I?", "zh": "要吗？"}}


WAITS = ("needs_clarification", "awaiting_confirmation")


@pytest.mark.parametrize("state", WAITS)
@pytest.mark.parametrize(
    ("words", "text"),
    [(["yes"], "yes"), (["g2", "好的"], "好的"), (["to", "the", "kitchen"], "to the kitchen")],
)
def test_the_one_goal_that_waits_is_answered_and_followed(
    served: tuple[Planner, LaunchSettings], state: str, words: list[str], text: str
) -> None:
    planner, settings = served
    planner.goals = [goal("g3", "running"), goal("g2", state), goal("g1", "succeeded")]
    assert goals.answer(settings, words, wait=True) == 0
    assert planner.heard == [("/v1/goals/g2/answer", {"text": text, "source": "cli"})]


def test_of_several_none_is_answered_and_each_is_listed_with_its_question(
    served: tuple[Planner, LaunchSettings], capsys: pytest.CaptureFixture[str]
) -> None:
    planner, settings = served
    chinese = goal("g1", WAITS[0], "去厨房", outcome=ASKED)
    planner.goals = [goal("g2", WAITS[1], outcome=ASKED), chinese]
    assert goals.answer(settings, ["yes"], wait=True) == 1
    told = capsys.readouterr().err
    assert "g2" in told
    assert "Shall I?" in told
    assert "要吗？" in told
    assert planner.heard == []
    assert goals.answer(settings, ["g1", "yes"], wait=False) == 0
    assert planner.heard == [("/v1/goals/g1/answer", {"text": "yes", "source": "cli"})]


@pytest.mark.parametrize("verb", ["answer", "confirm"])
def test_where_nothing_waits_that_is_told(
    served: tuple[Planner, LaunchSettings], capsys: pytest.CaptureFixture[str], verb: str
) -> None:
    planner, settings = served
    planner.goals = [goal("g1", "running")]
    done = (
        goals.answer(settings, ["yes"], wait=True)
        if verb == "answer"
        else goals.confirm(settings, None, wait=True)
    )
    assert done == 1
    assert "no_goal" in capsys.readouterr().err
    assert planner.heard == []


@pytest.mark.parametrize("named", [None, "g2"])
def test_a_plan_is_confirmed_though_a_question_waits_beside_it(
    served: tuple[Planner, LaunchSettings], named: str | None
) -> None:
    planner, settings = served
    planner.goals = [goal("g1", WAITS[0]), goal("g2", WAITS[1])]
    assert goals.confirm(settings, named, wait=True) == 0
    assert planner.heard == [("/v1/goals/g2/confirm", {"source": "cli"})]


def test_an_id_alone_answers_nothing(
    served: tuple[Planner, LaunchSettings], capsys: pytest.CaptureFixture[str]
) -> None:
    planner, settings = served
    planner.goals = [goal("g2", WAITS[0])]
    assert goals.answer(settings, ["g2"], wait=True) == goals.EXIT_NO_ANSWER
    assert "pons answer g2 TEXT" in capsys.readouterr().err
    assert planner.heard == []


@pytest.mark.parametrize("state", list(GoalState))
@pytest.mark.parametrize("language", ["en", "zh"])
def test_a_goal_that_waits_says_how_to_answer_it(state: str, language: str) -> None:
    """What is told is a command that the parser takes."""
    hint = how_to_answer(goal("g7", state), language)
    assert (hint != "") is (state in WAITS)
    if state == WAITS[1]:
        assert parser().parse_args(["confirm", "g7"]).goal == "g7"
        assert "pons confirm g7" in hint
        assert "pons answer g7 no" in hint
    offers = goal("g7", state, plan={"options": [{"text": "x"}]})
    assert ("yes" in how_to_answer(offers, "en")) is (state in WAITS)


def test_a_goal_that_ends_in_a_question_prints_how_to_answer(
    served: tuple[Planner, LaunchSettings], capsys: pytest.CaptureFixture[str]
) -> None:
    planner, settings = served
    planner.goals, planner.done = [goal("g1", WAITS[0], outcome=ASKED)], WAITS[0]
    assert goals.answer(settings, ["the red one"], wait=True) == goals.EXIT_WAITING
    assert "pons answer g1 TEXT" in capsys.readouterr().out


@pytest.mark.parametrize("words", ["停下", "uh robot there is a child please stop"])
def test_a_stop_is_said_without_a_planner(
    words: str,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    """With neither planner nor bridge it says that nobody confirmed, and what to do."""
    monkeypatch.setenv("PONS_HOME", str(tmp_path))
    monkeypatch.setenv("PONS_PORT", "1")
    assert goals.say(load(), words, wait=False) == goals.EXIT_UNREACHED
    assert "no_bridge" in capsys.readouterr().err


def test_a_sentence_that_is_too_long_is_told_to_be_in_both_languages(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    with real_planner() as planner:
        settings = replace(load(), host="127.0.0.1", port=planner.port)
        assert goals.say(settings, "go " * 2_000, wait=False) == goals.EXIT["refused"]
        told = capsys.readouterr().err
        monkeypatch.setenv("LC_ALL", "zh_CN.UTF-8")
        goals.say(settings, "go " * 2_000, wait=False)
    assert "goal_too_long: 6000 characters; at most 4000" in told
    assert "too long for an order" in told
    assert "指令太长" in capsys.readouterr().err


@pytest.mark.parametrize(
    ("text", "told"),
    [("nip to the kitchen", "The model may still be loading"), ("溜达去厨房", "模型可能还在加载")],
)
def test_a_plan_that_waits_for_a_load_is_explained_once(
    served: tuple[Planner, LaunchSettings],
    capsys: pytest.CaptureFixture[str],
    monkeypatch: pytest.MonkeyPatch,
    text: str,
    told: str,
) -> None:
    planner, settings = served
    monkeypatch.setattr(goals, "LOADING_S", 0.0)
    monkeypatch.setattr(goals, "POLL_S", 0.01)
    planner.asks_until_planned = 4
    planner.goals = [goal("g1", "planning", text)]
    assert goals.follow(settings, "g1", goals.language_of(text)) == 0
    assert capsys.readouterr().out.count(told) == 1
