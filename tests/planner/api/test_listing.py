"""A list of goals stays quickly sent, however long what was said and what came of it."""

from __future__ import annotations

import json

from planner.api.listing import MOST_BYTES, list_goals
from planner.plan import Bilingual, GoalState, PlanRecord, StepRecord
from tests.planner.api.fakes import goal

LONG = "去" * 4_000


def huge(number: int, state: GoalState) -> object:
    said = Bilingual(en="x" * 5_000, zh=LONG)
    step = StepRecord(kind="say", text="y" * 500, said=said, read=said, rooms=("r" * 64,) * 20)
    plan = PlanRecord(kind="plan", steps=(step,) * 20, text=said)
    return goal(f"g{number}", LONG, state).model_copy(update={"plan": plan})


def test_a_list_of_the_longest_goals_is_below_a_megabyte_and_names_all_that_are_open() -> None:
    goals = [huge(n, GoalState.QUEUED if n < 33 else GoalState.FAILED) for n in range(200)]
    found = list_goals(goals)  # type: ignore[arg-type]  # goals all the same
    assert len(json.dumps(found, ensure_ascii=False).encode()) < 1_000_000
    assert [one["id"] for one in found[:33]] == [f"g{n}" for n in range(33)]
    assert MOST_BYTES < 1_000_000


def test_an_ordinary_goal_is_shown_as_it_is() -> None:
    one = goal(text="go to the kitchen, then to the hall; then 回来")
    assert list_goals([one]) == [one.model_dump(mode="json")]


def test_a_long_text_ends_in_a_mark() -> None:
    [one] = list_goals([goal(text=LONG)])
    assert one["text"] == "去" * 299 + "…"
