"""Check `pons eval` from its words to its table, its JSON and its exit status."""

from __future__ import annotations

import asyncio
import json
from dataclasses import replace
from pathlib import Path

import pytest

from planner.brain import (
    BadPlan,
    BrainDown,
    OfflineBrain,
    ScriptedBrain,
    ThinkRequest,
    ThinkResult,
)
from planner.brain.streamed_draft import Hear
from planner.budget.ledger import MAX_ID
from planner.plan import GoTo, StepPlan
from pons.__main__ import main
from pons.evals.command import score_whole
from pons.evals.matchers import read_expectation
from pons.evals.report import GuardCount, content, guard_count, has_passed, table
from pons.evals.score import score
from pons.evals.suites import Case, load
from tests.pons.mock_llm.mocks import running_mock
from tools.evals.category_rules import LAWS

SUITE = """# split, group, sentence, expectation
tuned\tdrive\tgo to the kitchen\tgo kitchen
held\tdrive\t去书房\tgo study
tuned\tno\tdo not go to the kitchen\tstill negated
"""


@pytest.fixture
def suite(tmp_path: Path) -> str:
    path = tmp_path / "mine.tsv"
    path.write_text(SUITE, encoding="utf-8")
    return str(path)


def test_our_own_suites_reach_the_goal(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["eval", "home"]) == 0
    shown = capsys.readouterr().out
    assert "home_en: " in shown
    assert "held out" in shown


@pytest.mark.parametrize(
    ("line", "told"),
    [
        ("tuned\tdrive\tgo to the kitchen", "mine.tsv:1: 3 columns between tabs; expected 4"),
        ("tuned\tdrive\tgo to Narnia\tgo narnia", "mine.tsv:1: unknown place narnia; known: "),
        ("tuned\tfind\tfind it\tfind cup @attic", "mine.tsv:1: unknown place attic; known: "),
        ("tuned\tturn\tturn left\tturn left", "mine.tsv:1: 'turn left': turn needs a number"),
    ],
)
def test_a_line_that_can_not_be_read_is_told_with_its_number(
    tmp_path: Path,
    capsys: pytest.CaptureFixture[str],
    monkeypatch: pytest.MonkeyPatch,
    line: str,
    told: str,
) -> None:
    path = tmp_path / "mine.tsv"
    path.write_text(f"{line}\n", encoding="utf-8")
    assert main(["eval", str(path)]) == 2
    said = capsys.readouterr().err
    assert told in said
    assert said.isascii()
    monkeypatch.setenv("LC_ALL", "zh_CN.UTF-8")
    assert main(["eval", str(path)]) == 2
    said = capsys.readouterr().err
    assert told in said
    assert "句集文件" in said


def test_an_unknown_suite_is_told_with_all_that_there_are(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    for locale, told in (("C", "no suite"), ("zh_CN.UTF-8", "没有这个句集")):
        monkeypatch.setenv("LC_ALL", locale)
        assert main(["eval", "nosuch"]) == 2
        said = capsys.readouterr().err
        assert all(words in said for words in ("home", "guard_zh", told))


@pytest.mark.parametrize("name", ["chat_en", "chat_zh"])
def test_what_asks_for_nothing_moves_nothing(name: str) -> None:
    (ours,) = load(name)
    verdicts = asyncio.run(score(ours, OfflineBrain()))
    assert [verdict.case.text for verdict in verdicts if not verdict.right] == []


def test_results_as_json(suite: str, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["eval", suite, "--json"]) == 0
    (result,) = json.loads(capsys.readouterr().out)["suites"]
    assert (result["suite"], result["passed"], result["failures"]) == ("mine", True, [])
    sums = [line for line in result["groups"] if line["group"] == "all"]
    assert {line["split"]: line["count"] for line in sums} == {"tuned": 2, "held out": 1, "all": 3}


def test_a_suite_below_the_goal_is_told(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    hard = tmp_path / "hard.tsv"
    hard.write_text("tuned\tdrive\tgo to the moon\tgo kitchen\n", encoding="utf-8")
    assert main(["eval", str(hard)]) == 1
    assert "go to the moon" in capsys.readouterr().out


def test_a_model_elsewhere_needs_a_yes(suite: str, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["eval", suite, "--model", "some@https://model.example/v1"]) == 2
    assert "3 sentences would be sent to model.example" in capsys.readouterr().err


def test_a_spent_budget_keeps_what_was_scored(
    suite: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setenv("PONS_HOME", str(tmp_path))
    (tmp_path / "settings.toml").write_text("[budget.day]\ncalls = 2\n")
    with running_mock() as mock:
        words = ["eval", suite, "--json", "--model", f"m@{mock.url}"]
        assert main(words) == 1
        shown = capsys.readouterr()
        [result] = json.loads(shown.out)["suites"]
        assert (result["passed"], result["not_asked"], result["failures"]) == (False, 1, [])
        assert "2 of 2 questions" in shown.err
        assert main(words) == 2
        assert capsys.readouterr().out == ""


class InterruptedBrain(ScriptedBrain):
    """Be interrupted at the second sentence, as asyncio.run does it on Ctrl-C."""

    async def think(self, request: ThinkRequest, hear: Hear | None = None) -> ThinkResult:
        task = asyncio.current_task()
        if self.asked and task is not None:
            task.cancel()
            await asyncio.Event().wait()
        return await super().think(request, hear)


def test_ctrl_c_keeps_what_was_scored(suite: str, capsys: pytest.CaptureFixture[str]) -> None:
    (ours,) = load(suite)
    brain = InterruptedBrain([StepPlan(steps=(GoTo(place="kitchen"),))])
    _, [scored] = asyncio.run(score_whole((ours,), brain))
    assert ([verdict.right for verdict in scored.verdicts], scored.left) == ([True], 2)
    assert "interrupted" in capsys.readouterr().err


def test_each_sentence_of_each_run_is_a_goal_of_its_own(tmp_path: Path) -> None:
    path = tmp_path / f"{'long' * 30}.tsv"
    path.write_text(SUITE, encoding="utf-8")
    (ours,) = load(str(path))
    brain = ScriptedBrain(replies=[BrainDown("503")])
    for _ in range(2):
        asyncio.run(score(ours, brain))
    assert len({request.goal[:MAX_ID] for request in brain.asked}) == 6


@pytest.mark.parametrize("trouble", [BadPlan("no"), BrainDown("503")], ids=["plan", "answer"])
def test_no_decision_is_right_nowhere(suite: str, trouble: Exception) -> None:
    (ours,) = load(suite)
    texts = ("do not go to the kitchen", "go to the moon")
    cases = (
        Case(
            texts[0],
            "no",
            read_expectation("still | refuse bad_plan | refuse model_unavailable"),
        ),
        Case(texts[1], "reject", LAWS["reject"]),
    )
    verdicts = asyncio.run(score(replace(ours, cases=cases), ScriptedBrain(replies=[trouble])))
    assert [v.fault.split(":")[0] in ("no plan", "no answer") for v in verdicts] == [True, True]
    assert not any(verdict.right for verdict in verdicts)


def test_what_bad_plans_cost_is_counted(
    suite: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """Each sentence is asked twice; 48 of 72 sentences once were, and told to have cost nothing."""
    monkeypatch.setenv("PONS_HOME", str(tmp_path))
    with running_mock() as mock:
        mock.set(fault="garbage")
        assert main(["eval", suite, "--json", "--model", f"m@{mock.url}"]) == 1
        [result] = json.loads(capsys.readouterr().out)["suites"]
        assert result["no_decision"] == {"bad_plan": 3}
        assert result["calls"] == mock.report()["calls"] == 6
        assert result["tokens"] > 0


def test_a_brain_that_fails_is_scored_and_not_trusted(suite: str) -> None:
    """A wrong drive, no plan and no answer are three faults; only the first would have moved."""
    (ours,) = load(suite)
    drive = StepPlan(steps=(GoTo(place="study"),))
    brain = ScriptedBrain(replies=[drive, BadPlan("no"), BrainDown("503")])
    verdicts = asyncio.run(score(ours, brain))
    assert [verdict.right for verdict in verdicts] == [False, False, False]
    assert [bool(verdict.wrong) for verdict in verdicts] == [True, False, False]
    assert not has_passed(verdicts)


def test_the_guard_is_counted_beside_a_models_wrong_motions(suite: str) -> None:
    """The first sentence asks for the kitchen and the second for the study; the third forbids."""
    (ours,) = load(suite)
    drive = StepPlan(steps=(GoTo(place="study"),))
    verdicts = asyncio.run(score(ours, ScriptedBrain([drive], by_grammar=False)))
    assert [verdict.needs_yes for verdict in verdicts] == [True, False, True]
    assert guard_count(verdicts) == GuardCount(moving=3, needs_yes=2, wrong=2, walked_unasked=0)
    assert "of 3 plans that move 2 wait for a yes; of 2 that move wrongly 0 do not" in table(
        "mine", "scripted", verdicts
    )
    offline = asyncio.run(score(ours, OfflineBrain()))
    assert guard_count(offline).moving == 0, "the grammar is not held to the guard"


def test_why_a_model_decided_nothing_is_counted(suite: str) -> None:
    (ours,) = load(suite)
    troubles = [BadPlan("no"), BrainDown("late", why="timeout"), BrainDown("late", why="timeout")]
    verdicts = asyncio.run(score(ours, ScriptedBrain(replies=troubles)))
    assert "no decision: timeout 2, bad_plan 1" in table("mine", "scripted", verdicts)
    assert content("mine", "scripted", verdicts)["no_decision"] == {"timeout": 2, "bad_plan": 1}


@pytest.mark.parametrize(
    "words", [[], ["home", "--quick"], ["home", "--journal", "x"], ["--quick", "--journal", "x"]]
)
def test_one_kind_of_examination_is_asked_for(
    words: list[str], capsys: pytest.CaptureFixture[str]
) -> None:
    with pytest.raises(SystemExit, match="2"):
        main(["eval", *words])
    assert "--quick" in capsys.readouterr().err


def test_the_quick_exam_and_the_journal_are_two_more_kinds(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setenv("PONS_HOME", str(tmp_path))
    monkeypatch.delenv("PONS_MODEL", raising=False)
    assert main(["eval", "--quick"]) == 2
    assert "pons eval --quick: model_not_set: " in capsys.readouterr().err
    assert main(["eval", "--journal", str(tmp_path)]) == 2
    assert "pons eval --journal: journal_missing: " in capsys.readouterr().err
