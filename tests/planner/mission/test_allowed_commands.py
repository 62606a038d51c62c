"""The table of commands is whole: each is allowed, or refused with what exists."""

from __future__ import annotations

import re
from typing import Any

from planner.mission.events import Cancel, ChangeSpeed, Move, Reply
from planner.mission.reducer import advance
from planner.mission.state import Mission, MissionState
from planner.mission.transitions import ALLOWED, refusal
from planner.plan import GoalState, Language
from tests.planner.mission.fakes import FACTS


def test_every_command_in_every_state_is_allowed_or_refused_with_what_exists() -> None:
    """The table is whole: what is absent is a typed refusal that names the state."""
    for kind, allowed in ALLOWED.items():
        for state in GoalState:
            mission = Mission(id="g1", order=1, text="x", language=Language.EN, state=state,
                              created_unix_s=0.0, updated_unix_s=0.0)  # fmt: skip
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
