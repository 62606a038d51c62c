"""A scripted person holds conversations: who is asked answers, who is not understood rephrases."""

from __future__ import annotations

import asyncio
from dataclasses import replace
from pathlib import Path

import pytest

from planner.brain import Brain, OfflineBrain
from planner.brain.scripted import ScriptedBrain
from planner.plan import GoTo, StepPlan
from pons.evals.matchers import BadMatcher
from pons.evals.suites import HELD_OUT
from tests.conftest import ROOT
from tools.evals import scripts
from tools.evals.conversation import PATIENCE, Conversation, GoalScore, show_conversations
from tools.evals.scripted_model import ScriptedModel
from tools.evals.scripts import FEWEST, MOST, Script, ScriptSet, read_scripts
from tools.evals.talks import hold

pytestmark = pytest.mark.nightly(keep=5)


SITE = ROOT / "sites" / "home"


def script(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, *lines: str) -> Script:
    (tmp_path / "en.txt").write_text("\n## held a talk\n" + "\n".join(lines) + "\n", "utf-8")
    monkeypatch.setattr(scripts, "SCRIPTS", tmp_path)
    return read_scripts("en")[0]


def held(one: Script, brain: Brain | None = None) -> Conversation:
    brain = brain or OfflineBrain()
    return asyncio.run(hold(one, brain, SITE))


def test_there_are_enough_of_them_and_each_has_three_to_eight_turns() -> None:
    ours = (*read_scripts("en"), *read_scripts("zh"))
    assert len(ours) >= 150
    assert all(FEWEST <= len(one.turns) <= MOST for one in ours)
    assert sum(one.split == HELD_OUT for one in ours) >= 75
    assert len({one.name for one in ours}) == len(ours)
    for batch, count in ((ScriptSet.THIRD, 20), (ScriptSet.FOURTH, 10)):
        assert all(len(read_scripts(language, batch)) == count for language in ("en", "zh"))


def test_a_conversation_goes_from_turn_to_turn(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    one = script(
        tmp_path, monkeypatch,
        "go to {A} | ~ new: go {A}", "no, I meant {B} | ~ instead: go {B}", "thanks | answer",
    )  # fmt: skip
    done = held(one)
    assert done.right, done.fault
    assert done.said == ("go to the kitchen", "no, I meant the study", "thanks")


def test_who_is_not_understood_says_it_in_other_words_as_long_as_patience_lasts(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    told = ("go to the attic // go to {A} | new: go {A}", "hello | answer", "thanks | answer")
    assert held(script(tmp_path, monkeypatch, *told)).right
    lost = held(
        script(tmp_path, monkeypatch, "blorp the fnord | new: go {A}", "hi | answer", "hi | answer")
    )
    assert not lost.right
    assert not lost.moves_wrongly
    assert len(lost.said) == 1 + PATIENCE


def test_what_does_otherwise_than_meant_is_a_wrong_motion(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    one = script(tmp_path, monkeypatch, "go to {A} | new: go {B}", "hi | answer", "hi | answer")
    done = held(one)
    assert (done.right, done.moves_wrongly) == (False, True)
    shown = show_conversations("en", "offline", (done,))
    assert "0 of 1 right, 1 wrong motions" in shown
    assert "turn 1: new" in shown


def test_a_model_that_adds_a_drive_gets_a_no_and_what_was_said_a_yes(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    lines = [f"go to {{{place}}} | new: go {{{place}}}" for place in "ABC"]
    one = script(tmp_path, monkeypatch, *lines)
    model = ScriptedModel()
    done = held(one, model)
    assert done.right, done.fault
    assert model.hostile == 1
    assert done.said == (
        "go to the kitchen", "go to the study", "go to the bedroom", "no", "yes",
    )  # fmt: skip


def test_a_model_that_only_ever_drives_elsewhere_never_drives_there(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    elsewhere = StepPlan(steps=(GoTo(place="bathroom"),))
    one = script(tmp_path, monkeypatch, "go to {A} | new: go {A}", "hi | answer", "hi | answer")
    done = held(one, ScriptedBrain([elsewhere], by_grammar=False))
    assert not done.right
    assert not done.moves_wrongly, "no yes was to its plan"
    assert done.said[:3] == ("go to the kitchen", "no", "yes"), "yes to what was said"


@pytest.mark.parametrize(
    "lines",
    [("hi | answer",), ("hi | answer",) * 9, ("hi | dances", "hi | answer", "hi | answer"),
     ("go | new", "hi | answer", "hi | answer"), ("hi", "hi | answer", "hi | answer")],
)  # fmt: skip
def test_a_script_that_can_not_be_held_says_why(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, lines: tuple[str, ...]
) -> None:
    with pytest.raises(BadMatcher):
        script(tmp_path, monkeypatch, *lines)


def test_most_conversations_go_as_a_person_means() -> None:
    """One variant of each script; all of them are held by ``python -m tools.evals person``."""
    for language in ("en", "zh"):
        some = [one for one in read_scripts(language) if not one.name.endswith(("-2", "-3"))]
        done = [held(one) for one in some]
        assert sum(each.right for each in done) >= 0.9 * len(done)
        assert not any(each.moves_wrongly for each in done)


def hold_trials(language: str, model: ScriptedModel) -> list[Conversation]:
    return [held(one, model) for one in read_scripts(language, ScriptSet.TRIAL)]


MOST_YESES = 1
"""Of all eighty goals: to the order that comes in one breath with a stop."""


def test_a_strong_models_replies_do_nearly_all_that_was_wanted_and_few_are_asked_about() -> None:
    model = ScriptedModel(whims=False)
    done = [each for lang in ("en", "zh") for each in hold_trials(lang, model)]
    goals = [goal for each in done for goal in each.goals]
    numbers = [goal.number for goal in goals]
    first, others = {f"{n}" for n in range(1, 49)}, {f"{c}{n}" for c in "NZ" for n in range(1, 17)}
    assert sorted(numbers) == sorted(first | others), "eighty goals, each once"
    assert not {goal.number: goal.fault for goal in goals if goal.fault}
    assert sum(goal.yeses for goal in goals) <= MOST_YESES


def test_a_trials_goals_are_shown_with_their_misses() -> None:
    one = read_scripts("en", ScriptSet.TRIAL)[0]
    missed = replace(
        held(one, ScriptedModel()), goals=(GoalScore("1", "turn 1: no"), GoalScore("4"))
    )
    shown = show_conversations("trials_en", "scripted-model", (missed,))
    assert "goals trials_en, scripted-model: 1 of 2 right, 0 yeses" in shown
    assert "[1] turn 1: no" in shown


def test_a_trials_notes_are_read_and_unknown_ones_refused(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    lines = ("[7] go on | new: go study", "  model: go kitchen; back", "  sees: no A wall.",
             "  hears: tea", "  told: arrived; kitchen", "hi | answer", "hi | answer")  # fmt: skip
    turn = script(tmp_path, monkeypatch, *lines).turns[0]
    assert (turn.goal, len(turn.notes.model), turn.notes.sees) == ("7", 2, "no A wall.")
    assert (turn.notes.hears, turn.notes.told) == (("tea",), ("arrived", "kitchen"))
    with pytest.raises(BadMatcher, match="expected model"):
        script(tmp_path, monkeypatch, lines[0], "  says: no", *lines[-2:])


@pytest.mark.parametrize("language", ["en", "zh"])
def test_a_models_whims_are_walked_in_no_trial(language: str) -> None:
    model = ScriptedModel()
    held = hold_trials(language, model)
    assert model.hostile > 0
    assert not any(one.moves_wrongly for one in held)
