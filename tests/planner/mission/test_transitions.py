"""The tables of states and commands are whole: nothing else writes a state or is allowed."""

from __future__ import annotations

import itertools
import re
from typing import Any

import pytest

from planner.mission.events import Cancel, ChangeSpeed, Move, Reply
from planner.mission.reducer import advance
from planner.mission.state import Mission, MissionState
from planner.mission.transaction import Transaction
from planner.mission.transitions import (
    ALLOWED,
    FIRST,
    TRANSITIONS,
    BrainCause,
    ForbiddenTransition,
    GoalFact,
    PersonCause,
    next_state,
    refusal,
)
from planner.plan import ENDED, GoalState, Language
from tests.planner.mission.fakes import FACTS

CAUSES = (*PersonCause, *BrainCause, *GoalFact)


def _mission(state: GoalState) -> Mission:
    return Mission(id="g1", order=1, text="x", language=Language.EN, state=state,
                   created_unix_s=0.0, updated_unix_s=0.0)  # fmt: skip


def test_what_is_absent_is_forbidden_and_the_error_says_what_exists() -> None:
    for state, cause in itertools.product(GoalState, CAUSES):
        if (state, cause) in TRANSITIONS:
            assert next_state(state, cause) is TRANSITIONS[state, cause]
            continue
        with pytest.raises(ForbiddenTransition, match=f"{state.value} can't be left by"):
            next_state(state, cause)


def test_an_ended_goal_stays_as_it_ended() -> None:
    assert not [state for state, _ in TRANSITIONS if state in ENDED]


def test_every_state_is_reached_and_every_open_goal_can_end() -> None:
    reached = {FIRST}
    while more := {a for (s, _), a in TRANSITIONS.items() if s in reached} - reached:
        reached |= more
    assert reached == set(GoalState)
    for state in set(GoalState) - ENDED:
        assert next_state(state, PersonCause.CANCELS) is GoalState.CANCELLED


def test_every_cause_leads_somewhere() -> None:
    assert {cause for _, cause in TRANSITIONS} == set(CAUSES)


def test_a_state_is_written_by_its_cause_alone() -> None:
    mission = _mission(GoalState.RUNNING)
    turn = Transaction(MissionState(FACTS, missions={"g1": mission}), 1.0)
    with pytest.raises(ForbiddenTransition):
        turn.put(mission, state=GoalState.SUCCEEDED)
    with pytest.raises(ForbiddenTransition):
        turn.move_to(mission, BrainCause.PLANS)
    assert turn.book.missions["g1"] is mission
    assert turn.move_to(mission, GoalFact.STEPS_OVER, reason="x").state is GoalState.SUCCEEDED
    assert turn.book.missions["g1"].reason == "x"


def test_every_command_in_every_state_is_allowed_or_refused_with_what_exists() -> None:
    """The table is whole: what is absent is a typed refusal that names the state."""
    for kind, allowed in ALLOWED.items():
        for state in GoalState:
            mission = _mission(state)
            book = MissionState(FACTS, missions={"g1": mission})
            given: dict[type, dict[str, Any]] = {
                Reply: {"text": "x"},
                ChangeSpeed: {"slower": True},
            }
            command = kind("g1", **given.get(kind, {}))
            error = refusal(book, command)
            assert (error is None) == (state in allowed)
            if error is not None:
                assert error.code == "bad_state"
                assert state.value in error.message.en
                assert not re.search("[a-z]{2}", error.message.zh), error.message.zh
                after, effects = advance(book, command, 1.0)
                assert (after, effects) == (book, ())


def test_unknown_goals_are_named_with_what_exists() -> None:
    mission = Mission(id="g1", order=1, text="x", language=Language.EN, state=GoalState.QUEUED,
                      created_unix_s=0.0, updated_unix_s=0.0)  # fmt: skip
    book = MissionState(FACTS, missions={"g1": mission}, queue=("g1",))
    for command in (Cancel("nope"), Move("g1", "nope")):
        error = refusal(book, command)
        assert error is not None
        assert error.code == "unknown_goal"
        assert "g1" in error.message.en
