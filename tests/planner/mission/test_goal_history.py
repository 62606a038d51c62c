"""The list of missions: what is told stays listed, found by day, state and words, page by page."""

from __future__ import annotations

import asyncio
import sqlite3
from contextlib import closing
from pathlib import Path

import pytest

from planner.language.catalogue import message
from planner.mission import goal_history
from planner.mission.effects import Journal
from planner.mission.errors import UnknownGoal
from planner.mission.goal_history import GoalHistory, HistoryPage, HistoryQuery
from planner.mission.journal import MissionJournal
from planner.mission.state import Mission
from planner.plan import Code, GoalState, Language, Outcome

DAY_S = 86_400.0
MANY = 10_000


def mission(order: int, text: str, state: GoalState = GoalState.SUCCEEDED) -> Mission:
    ended = state is not GoalState.RUNNING
    outcome = Outcome(code=Code.DONE, message=message(Code.DONE)) if ended else None
    return Mission(
        id=f"g{order}", order=order, text=text, language=Language.EN, state=state, outcome=outcome,
        by="cli:ana", questions=("Which cup?",), replies=("the red one",), metres=2.5,
        created_unix_s=order * DAY_S, updated_unix_s=order * DAY_S + 40.0,
    )  # fmt: skip


def written(home: Path, *missions: Mission) -> GoalHistory:
    journal = MissionJournal.in_home(home)
    for number, each in enumerate(missions, 1):
        journal.write((Journal(number, (each,), ()),))
    journal.close()
    return GoalHistory.in_home(home)


def found(history: GoalHistory, query: HistoryQuery) -> HistoryPage:
    return asyncio.run(history.find(query))


def test_goals_come_newest_first_with_what_they_took_and_how_they_ended(tmp_path: Path) -> None:
    history = written(tmp_path, mission(1, "go home"), mission(2, "<b>x", GoalState.RUNNING))
    running, ended = found(history, HistoryQuery()).goals
    assert (running.id, running.text, running.seconds, running.told) == ("g2", "<b>x", None, {})
    assert (ended.seconds, ended.metres, ended.source) == (40.0, 2.5, "cli:ana")
    assert set(ended.told) == {"en", "zh"}


def test_pages_follow_each_other_without_a_gap_while_new_goals_come(tmp_path: Path) -> None:
    history = written(tmp_path, *(mission(n, f"goal {n}") for n in range(1, 6)))
    first = found(history, HistoryQuery(limit=2))
    written(tmp_path, mission(6, "meanwhile"))
    second = found(history, HistoryQuery(limit=2, before=first.next))
    third = found(history, HistoryQuery(limit=2, before=second.next))
    ids = [goal.id for page in (first, second, third) for goal in page.goals]
    assert ids == ["g5", "g4", "g3", "g2", "g1"]
    assert third.next is None


def test_ten_thousand_missions_are_read_page_by_page_and_none_is_left_out(tmp_path: Path) -> None:
    history = written(tmp_path, mission(1, "the oldest"))
    more = [goal_history.row_of(mission(n, f"goal {n}")) for n in range(2, MANY + 1)]
    with closing(sqlite3.connect(tmp_path / goal_history.FILE)) as connection, connection:
        connection.executemany(goal_history.PUT_ROW, more)
    before: int | None = None
    ids: list[str] = []
    while not ids or before is not None:
        page = found(history, HistoryQuery(before=before, limit=500))
        before, ids = page.next, [*ids, *(goal.id for goal in page.goals)]
    assert ids == [f"g{n}" for n in range(MANY, 0, -1)]
    assert [goal.id for goal in found(history, HistoryQuery(search="oldest")).goals] == ["g1"]


@pytest.mark.parametrize(
    ("query", "ids"),
    [
        (HistoryQuery(since_unix_s=2 * DAY_S, until_unix_s=3 * DAY_S), ["g2"]),
        (HistoryQuery(state=GoalState.FAILED), ["g2"]),
        (HistoryQuery(search="KITCHEN the"), ["g3"]),
        (HistoryQuery(search="100%"), ["g1"]),
        (HistoryQuery(search="%"), ["g1"]),
        (HistoryQuery(search="attic"), []),
    ],
)
def test_goals_are_found_by_day_state_and_words(
    tmp_path: Path, query: HistoryQuery, ids: list[str]
) -> None:
    history = written(
        tmp_path,
        mission(1, "be 100% there"),
        mission(2, "go home", GoalState.FAILED),
        mission(3, "go to the kitchen"),
    )
    assert [goal.id for goal in found(history, query).goals] == ids


def test_a_story_holds_who_what_was_asked_and_when_its_state_changed(tmp_path: Path) -> None:
    running, ended = mission(1, "find the cup", GoalState.RUNNING), mission(1, "find the cup")
    history = written(tmp_path, running, ended)
    record, story = asyncio.run(history.story("g1"))
    assert record == ended
    assert (story.source, story.questions, story.replies) == (
        "cli:ana", ("Which cup?",), ("the red one",),
    )  # fmt: skip
    assert [change.state for change in story.changes] == ["running", "succeeded"]
    with pytest.raises(UnknownGoal):
        asyncio.run(history.story("g9"))


def test_a_former_programs_goals_are_listed_as_well(tmp_path: Path) -> None:
    written(tmp_path, mission(1, "go home"))
    with closing(sqlite3.connect(tmp_path / goal_history.FILE)) as connection:
        connection.execute("DROP TABLE history")
    assert [goal.id for goal in found(written(tmp_path), HistoryQuery()).goals] == ["g1"]


def test_each_goal_that_changed_comes_once_as_it_stands_behind_its_cursor(tmp_path: Path) -> None:
    history = written(
        tmp_path,
        mission(1, "go home", GoalState.RUNNING),
        mission(2, "go to the attic", GoalState.RUNNING),
        mission(1, "go home"),
    )
    first = asyncio.run(history.changed_since(0, 1))
    rest = asyncio.run(history.changed_since(first.cursor, 9))
    assert [(m.id, m.state) for m in (*first.missions, *rest.missions)] == [
        ("g2", GoalState.RUNNING), ("g1", GoalState.SUCCEEDED),
    ]  # fmt: skip
    none = asyncio.run(history.changed_since(rest.cursor, 9))
    assert (none.missions, none.cursor) == ((), rest.cursor)
    written(tmp_path, mission(2, "go to the attic", GoalState.FAILED))
    later = asyncio.run(history.changed_since(none.cursor, 9))
    assert [(m.id, m.state) for m in later.missions] == [("g2", GoalState.FAILED)]


def test_an_empty_home_has_no_changes_and_no_keys(tmp_path: Path) -> None:
    history = GoalHistory.in_home(tmp_path)
    assert asyncio.run(history.changed_since(7, 9)).cursor == 7
    assert asyncio.run(history.find_key("k")) is None
