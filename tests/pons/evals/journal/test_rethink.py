"""Check that recorded sentences are read whole, thought again, compared by deeds."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from planner.language.catalogue import message
from planner.mission import MissionJournal
from planner.mission.effects import Journal
from planner.mission.state import Mission
from planner.plan import (
    BrainTag,
    Clarify,
    Code,
    ComeBack,
    GoalState,
    GoTo,
    Language,
    Plan,
    Say,
    StepPlan,
    Wait,
    plan_record,
    say_same,
)
from planner.settings import BudgetSettings
from pons.__main__ import main
from pons.evals.journal.recorded import NoJournal, read
from pons.evals.journal.show import verdict
from pons.evals.journal.think import Difference, SecondThought, difference, plan_line
from pons.settings import CHECKOUT
from tests.pons.mock_llm.mocks import running_mock
from wire import ConfigError

TWO_ROOM = CHECKOUT / "sites" / "two_room"
KITCHEN = StepPlan(steps=(GoTo(place="kitchen"),))
LOUNGE = StepPlan(steps=(GoTo(place="living_room"),))
ASKED = Clarify(
    code=Code.NOT_UNDERSTOOD, question=message(Code.NOT_UNDERSTOOD, part=say_same("x")), options=()
)


def mission(goal: str, text: str, plan: Plan | None, **more: object) -> Mission:
    """Return a record as the journal keeps it."""
    fields = {
        "id": goal,
        "order": 1,
        "text": text,
        "language": Language.EN,
        "state": GoalState.RUNNING,
        "plan": None if plan is None else plan_record(plan),
        "brain": None if plan is None else BrainTag(name="offline", version="1"),
        "created_unix_s": 1.0,
        "updated_unix_s": 1.0,
        **more,
    }
    return Mission.model_validate(fields)


def journal(home: Path, *missions: Mission) -> Path:
    """Write records, one entry each."""
    kept = MissionJournal.in_home(home)
    for entry, one in enumerate(missions, 1):
        kept.write((Journal(entry, (one,), ()),))
    kept.close()
    return home


def test_the_first_plan_of_each_sentence_is_the_decision(tmp_path: Path) -> None:
    home = journal(
        tmp_path / "h",
        mission("a", "go", None),
        mission("a", "go", ASKED),
        mission("a", "go", KITCHEN, replies=("the kitchen",)),
        mission("a", "go", LOUNGE, replies=("the kitchen",), replans=1),
        mission("b", "stop", None),
        mission("c", "wait", StepPlan(steps=(Wait(seconds=1.0),)), accepted_at=(1.0, 2.0, 0.5)),
    )
    found = read(home)
    assert [(d.goal, d.text, plan_line(d.plan)) for d in found.decisions] == [
        ("c", "wait", "wait 1"),
        ("a", "the kitchen", "go_to kitchen"),
        ("a", "go", "clarify not_understood"),
    ]
    assert (found.without, found.unreadable) == (1, 0)
    assert found.decisions[0].start == (1.0, 2.0, 0.5)
    assert {path.name for path in home.iterdir()} == {"missions.db"}


@pytest.mark.parametrize("raw", [b"", b"\x89MCAP0\r\n", b"SQLite format 3\x00" + b"x" * 4000])
def test_what_holds_no_sentences_says_where_they_are(raw: bytes, tmp_path: Path) -> None:
    path = tmp_path / "x.mcap"
    path.write_bytes(raw)
    with pytest.raises(NoJournal, match="no_sentences"):
        read(path)
    with pytest.raises(NoJournal, match="journal_missing"):
        read(tmp_path)


@pytest.mark.parametrize(
    ("one", "other", "relation"),
    [
        (KITCHEN, KITCHEN, Difference.SAME),
        (KITCHEN, LOUNGE, Difference.DIFFERS),
        (KITCHEN, StepPlan(steps=(GoTo(place="kitchen"), ComeBack())), Difference.DIFFERS),
        (KITCHEN, ASKED, Difference.DIFFERS),
        (
            ASKED,
            ASKED.model_copy(update={"question": say_same("what do you mean?")}),
            Difference.WORDS,
        ),
        (
            StepPlan(steps=(Say(text="hello"),)),
            StepPlan(steps=(Say(text="good day"),)),
            Difference.WORDS,
        ),
        (
            StepPlan(steps=(Wait(seconds=1.0),)),
            StepPlan(steps=(Wait(seconds=2.0),)),
            Difference.DIFFERS,
        ),
    ],
)
def test_decisions_are_compared_by_deeds(one: Plan, other: Plan, relation: Difference) -> None:
    assert difference(plan_record(one), plan_record(other)) is relation


def test_the_command_tells_what_differs_and_what_would_have_stopped_it(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    home = journal(
        tmp_path / "h",
        mission("a", "wait 1 second", StepPlan(steps=(Wait(seconds=1.0),))),
        mission("b", "go to the kitchen", LOUNGE),
    )
    monkeypatch.setenv("PONS_HOME", str(tmp_path / "mine"))
    monkeypatch.setenv("PONS_SITE", str(TWO_ROOM))
    with running_mock() as mock:
        words = ["replay", str(home), "--with-model", f"mock@{mock.url}"]
        assert main([*words, "--json"]) == 1
        shown = json.loads(capsys.readouterr().out)
        assert main([*words, "--most", "0"]) == 0
        assert "0 sentences" in (said := capsys.readouterr().out)
        assert "0 条指令" in said
        mock.set(fault="hallucinate")
        assert main([*words, "--most", "1"]) == 1
        assert "without a plan" in capsys.readouterr().out
    assert (shown["counts"]["same"], shown["counts"]["differs"], shown["cost"]["calls"]) == (
        1,
        1,
        2,
    )
    [differs] = [one for one in shown["decisions"] if one["relation"] == "differs"]
    assert (differs["text"], differs["made"]) == ("go to the kitchen", "go_to kitchen")
    assert differs["verdict"] == "valid, and moves; not driven here"


def test_people_s_words_go_nowhere_unasked(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    home = journal(tmp_path / "h", mission("a", "go to the kitchen", KITCHEN))
    monkeypatch.setenv("PONS_HOME", str(tmp_path / "mine"))
    monkeypatch.setattr("sys.stdin.isatty", lambda: False, raising=False)
    words = ["replay", str(home), "--with-model", "m@https://model.example/v1"]
    assert main(words) == 2
    assert "1 recorded sentences" in (said := capsys.readouterr().err)
    assert "not_agreed" in said
    assert main([*words, "--yes"]) == 2
    assert "model_offhost" in capsys.readouterr().err
    assert main(["replay", str(home), str(home), "--with-model", "m"]) == 2
    assert "one_journal" in capsys.readouterr().err


def test_as_many_calls_are_allowed_as_were_agreed_to(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    allowed = list[int]()

    def refused(budget: BudgetSettings, *_: object, **__: object) -> None:
        allowed.append(budget.goal.calls)
        raise ConfigError("budget_unreadable", "as this test wants it")

    home = journal(tmp_path / "h", *(mission(g, "go to the kitchen", KITCHEN) for g in "abc"))
    monkeypatch.setenv("PONS_HOME", str(tmp_path / "mine"))
    monkeypatch.setattr("pons.evals.model_access.Purse", refused)
    words = ["replay", str(home), "--with-model", "m@https://model.example/v1", "--yes"]
    for locale, told, where in (
        ("C", "at most {} calls", "not this machine"), ("zh_CN.UTF-8", "最多 {} 次", "不是本机"),
    ):  # fmt: skip
        monkeypatch.setenv("LC_ALL", locale)
        assert main(words) == 2
        said = capsys.readouterr().err
        assert told.format(allowed[-1]) in said
        assert where in said


def test_each_end_of_a_decision_is_told(tmp_path: Path) -> None:
    [decision] = read(journal(tmp_path, mission("a", "go", KITCHEN))).decisions
    ends = {
        "offline brain": SecondThought(decision, "none", "no answer: timeout"),
        "refused by validation (no_camera)": SecondThought(
            decision, "differs", "look", "no_camera"
        ),
        "moves nothing": SecondThought(decision, "differs", "clarify ambiguous"),
        "valid, and moves; not": SecondThought(decision, "differs", "go", moves=True),
        "": SecondThought(decision, "same", "go_to kitchen"),
    }
    for words, again in ends.items():
        assert words in verdict(again)
