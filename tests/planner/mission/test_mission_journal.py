"""What is written comes back, however the process ended, whatever clocks, maps and disks do."""

from __future__ import annotations

import asyncio
import json
import resource
import sqlite3
import time
from collections.abc import AsyncIterator, Callable
from contextlib import asynccontextmanager, closing
from pathlib import Path
from typing import Any, cast

import pytest

from planner.language.catalogue import message
from planner.mission import JournalSync, MissionJournal
from planner.mission import journal as journal_module
from planner.mission.effects import Journal
from planner.mission.goal_history import GoalHistory
from planner.mission.journal import PRUNE_MOST, SCHEMA
from planner.mission.state import MAX_ENDED, GoalKey, Mission
from planner.plan import Code, GoalState, Language, Outcome, Say, StepPlan, StepState
from planner.skills.skill_state import FindState
from tests.killed_writers import kill_writers
from tests.planner.mission.former_records import DRIVE, FIND, YOUNGER
from tests.planner.mission.lockstep import SUCCEEDED, Together, driving, standing_still
from wire import ConfigError, Unwritable


def mission(
    goal_id: str, order: int, state: GoalState = GoalState.QUEUED, step: int = 0
) -> Mission:
    outcome = None
    if state is GoalState.SUCCEEDED:
        outcome = Outcome(code=Code.DONE, message=message(Code.DONE))
    return Mission(id=goal_id, order=order, text="去厨房", language=Language.ZH, state=state,
                   outcome=outcome, step=step, limited={"max_speed": 3},
                   accepted_at=(1.0, 2.0, 3.0), created_unix_s=1.5, updated_unix_s=2.5)  # fmt: skip


MAX_KEPT, KEPT_WHOLE, PRUNE_EVERY = 60, 20, 10


@pytest.fixture
def small(monkeypatch: pytest.MonkeyPatch) -> None:
    """Let a few goals fill a journal that is bounded at thousands."""
    monkeypatch.setattr(journal_module, "MAX_KEPT", MAX_KEPT)
    monkeypatch.setattr(journal_module, "KEPT_WHOLE", KEPT_WHOLE)
    monkeypatch.setattr(journal_module, "PRUNE_EVERY", PRUNE_EVERY)


def on_disk(home: Path, statement: str, **values: str) -> list[tuple[Any, ...]]:
    """Execute one statement on the file of a journal; return its rows."""
    with closing(sqlite3.connect(home / "missions.db")) as connection, connection:
        return connection.execute(statement, values).fetchall()


def test_the_newest_record_comes_back_and_every_transition_stays(tmp_path: Path) -> None:
    journal = MissionJournal.in_home(tmp_path / "home")
    first, later = mission("a", 1), mission("a", 1, GoalState.RUNNING)
    other = mission("b", 2)
    journal.write((Journal(1, (first,), ("a",)),))
    journal.write((Journal(2, (later, other), ("b",)),), (GoalKey("k", "f", "b"),))
    journal.close()
    kept = MissionJournal.in_home(tmp_path / "home").load()
    assert kept.missions == (later, other)
    assert kept.queue == ("b",)
    assert kept.keys == (GoalKey("k", "f", "b"),)
    states = on_disk(tmp_path / "home", "select mission, state from transitions order by seq")
    assert states == [("a", "queued"), ("a", "running"), ("b", "queued")]


@pytest.mark.usefixtures("small")
def test_the_oldest_goals_that_ended_leave_the_disk_and_no_open_one_does(tmp_path: Path) -> None:
    journal = MissionJournal.in_home(tmp_path)
    open_ = tuple(mission(f"open{n}", n) for n in range(5))
    journal.write((Journal(1, open_, ("open0",)),))
    for batch in range(0, MAX_KEPT + 4 * PRUNE_EVERY, PRUNE_EVERY):
        ended = tuple(
            mission(f"e{n}", 10 + n, GoalState.SUCCEEDED) for n in range(batch, batch + PRUNE_EVERY)
        )
        keys = tuple(GoalKey(f"k{n}", "f", f"e{n}") for n in range(batch, batch + PRUNE_EVERY))
        journal.write((Journal(2 + batch, ended, ("open0",)),), keys)
    kept = journal.load()
    journal.close()
    assert kept.missions[:5] == open_
    assert kept.missions[-1].id == f"e{MAX_KEPT + 4 * PRUNE_EVERY - 1}"
    for table, column in (("missions", "id"), ("transitions", "mission")):
        found = [name for (name,) in on_disk(tmp_path, f"select {column} from {table}")]
        ended_ids = [name for name in found if name.startswith("e")]
        assert len(ended_ids) == MAX_KEPT
        assert "e0" not in ended_ids
        assert sum(name.startswith("open") for name in found) == 5


@pytest.mark.usefixtures("small")
def test_of_an_old_goal_the_last_transition_stays_and_its_key_for_good(tmp_path: Path) -> None:
    journal = MissionJournal.in_home(tmp_path)
    count = KEPT_WHOLE + 2 * PRUNE_EVERY
    for batch in range(0, count, PRUNE_EVERY):
        numbers = range(batch, batch + PRUNE_EVERY)
        running = tuple(mission(f"e{n}", n, GoalState.RUNNING) for n in numbers)
        ended = tuple(mission(f"e{n}", n, GoalState.SUCCEEDED) for n in numbers)
        keys = tuple(GoalKey(f"k{n}", "f", f"e{n}") for n in numbers)
        journal.write((Journal(2 + batch, running, ()), Journal(3 + batch, ended, ())), keys)
    journal.close()
    history = GoalHistory.in_home(tmp_path)
    _, old = asyncio.run(history.story("e0"))
    _, new = asyncio.run(history.story(f"e{count - 1}"))
    assert [change.state for change in old.changes] == [GoalState.SUCCEEDED]
    assert [change.state for change in new.changes] == [GoalState.RUNNING, GoalState.SUCCEEDED]
    assert asyncio.run(history.find_key("k0")) == GoalKey("k0", "f", "e0")
    assert asyncio.run(history.find_key("k")) is None
    changed = asyncio.run(history.changed_since(0, count))
    assert [m.id for m in changed.missions] == [f"e{n}" for n in range(count)]


@pytest.mark.usefixtures("small")
def test_a_journal_of_an_older_program_is_pruned_bit_by_bit(tmp_path: Path) -> None:
    journal = MissionJournal.in_home(tmp_path)
    many = MAX_KEPT + 2 * PRUNE_MOST
    crowd = tuple(mission(f"e{n}", n, GoalState.SUCCEEDED) for n in range(many))
    journal.write((Journal(1, crowd, ()),))
    journal.close()
    assert on_disk(tmp_path, "select count(*) from missions") == [(many - PRUNE_MOST,)]


def test_the_queue_is_written_when_it_changes_within_a_batch_and_after_a_failure(
    tmp_path: Path,
) -> None:
    journal = MissionJournal.in_home(tmp_path)

    def kept() -> tuple[str, ...]:
        return journal.load().queue

    one = mission("a", 1)
    journal.write((Journal(1, (one,), ("a",)),))
    journal.write((Journal(2, (one,), ("a", "b")), Journal(3, (one,), ("a",))))
    assert kept() == ("a",)
    bad = GoalKey("k", "f", cast("str", None))
    with pytest.raises(sqlite3.IntegrityError):
        journal.write((Journal(4, (one,), ("c",)),), (bad,))
    assert kept() == ("a",)
    journal.write((Journal(4, (one,), ("c",)),))
    assert kept() == ("c",)
    journal.close()


def test_a_key_that_comes_again_after_a_503_is_its_new_goals(tmp_path: Path) -> None:
    journal = MissionJournal.in_home(tmp_path)
    journal.write((), (GoalKey("k", "f", "a"), GoalKey("other", "f", "b")))
    journal.write((Journal(1, (mission("c", 1),), ()),), (GoalKey("k", "f2", "c"),))
    kept = journal.load()
    journal.close()
    assert set(kept.keys) == {GoalKey("other", "f", "b"), GoalKey("k", "f2", "c")}
    assert [m.id for m in kept.missions] == ["c"]


def test_all_open_missions_come_back_and_only_the_newest_ended(tmp_path: Path) -> None:
    journal = MissionJournal.in_home(tmp_path)
    open_ = tuple(mission(f"o{i}", i) for i in range(5))
    ended = tuple(mission(f"e{i}", 10 + i, GoalState.SUCCEEDED) for i in range(MAX_ENDED + 7))
    journal.write((Journal(1, open_ + ended, ()),))
    kept = journal.load().missions
    journal.close()
    assert kept == open_ + ended[7:]


def test_a_journal_of_another_version_refuses_to_start(tmp_path: Path) -> None:
    MissionJournal.in_home(tmp_path).close()
    on_disk(tmp_path, "update facts set value = '99' where name = 'schema'")
    with pytest.raises(ConfigError, match="schema 99, this program reads 1, 2"):
        MissionJournal.in_home(tmp_path)


def test_a_journal_of_schema_1_is_taken_over_and_refused_by_a_former_program(
    tmp_path: Path,
) -> None:
    journal = MissionJournal.in_home(tmp_path)
    journal.write((Journal(1, (mission("g1", 1),), ("g1",)),), (GoalKey("k", "f", "g1"),))
    journal.close()
    on_disk(tmp_path, "update facts set value = '1' where name = 'schema'")
    on_disk(tmp_path, "update missions set record = :row", row=FIND)
    after = MissionJournal.in_home(tmp_path)
    kept = after.load()
    after.close()
    assert (kept.queue, kept.keys) == (("g1",), (GoalKey("k", "f", "g1"),))
    assert isinstance(kept.missions[0].skill_state, FindState)
    # A former program says "the journal has schema 2, expected 1".
    assert on_disk(tmp_path, "select value from facts where name = 'schema'") == [(SCHEMA,)]
    assert on_disk(tmp_path, "select record from missions") == [(FIND,)], "not rewritten"


def test_what_is_no_database_refuses_to_start(tmp_path: Path) -> None:
    (tmp_path / "missions.db").write_bytes(b"not a database at all, far from it" * 100)
    with pytest.raises(ConfigError, match="journal_unavailable") as wrong:
        MissionJournal.in_home(tmp_path)
    assert not isinstance(wrong.value, Unwritable), "no restart mends it"


def test_what_cannot_be_opened_at_present_may_pass(tmp_path: Path) -> None:
    (tmp_path / "missions.db").mkdir()
    with pytest.raises(Unwritable, match=r"journal_unavailable: .*unable to open"):
        MissionJournal.in_home(tmp_path)
    (tmp_path / "missions.db").rmdir()
    MissionJournal.in_home(tmp_path).close()


@pytest.mark.parametrize("kept", [True, False], ids=["a journal", "none yet"])
def test_a_journal_that_cannot_be_written_at_present_may_pass(tmp_path: Path, kept: bool) -> None:
    """Each write is refused as on a full disk."""
    if kept:
        MissionJournal.in_home(tmp_path).close()
    most = resource.getrlimit(resource.RLIMIT_FSIZE)
    resource.setrlimit(resource.RLIMIT_FSIZE, (0, most[1]))
    try:
        with pytest.raises(Unwritable, match="journal_unavailable: "):
            MissionJournal.in_home(tmp_path)
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, most)
    MissionJournal.in_home(tmp_path).close()


def test_a_record_that_is_not_ours_is_named(tmp_path: Path) -> None:
    journal = MissionJournal.in_home(tmp_path)
    journal.write((Journal(1, (mission("a", 1),), ()),))
    on_disk(tmp_path, "update missions set record = '{}'")
    with pytest.raises(ConfigError, match="journal_malformed"):
        journal.load()
    journal.close()


def test_a_row_of_a_former_program_still_loads_whole(tmp_path: Path) -> None:
    journal = MissionJournal.in_home(tmp_path)
    journal.write((Journal(1, (mission("g1", 1),), ()),))
    on_disk(tmp_path, "update missions set record = :row", row=DRIVE)
    [kept] = journal.load().missions
    journal.close()
    former = json.loads(DRIVE)
    now = json.loads(kept.model_dump_json())
    for step in now["plan"]["steps"]:
        for name in YOUNGER:
            del step[name]
    del former["notes"]  # its skill remembered nothing; see test_journal_records.py
    assert {name: now[name] for name in former} == former
    assert kept.skill_state is None
    assert (kept.state, kept.leg, kept.done) == (GoalState.PAUSED, 1, 1.5)
    assert kept.current_step is not None
    assert (kept.current_step.kind, kept.current_step.state) == ("go_to", StepState.RUNNING)


class Opened:
    """Hold a disk that writes, and the entries that it called safe."""

    def __init__(self, home: Path) -> None:
        self.disk = JournalSync(MissionJournal.in_home(home))
        self.safe: list[int] = []

    async def until(self, holds: Callable[[], bool]) -> None:
        async with asyncio.timeout(10.0):
            while not holds():  # noqa: ASYNC110  # the thread tells the loop alone
                await asyncio.sleep(0.01)


@asynccontextmanager
async def writing(home: Path) -> AsyncIterator[Opened]:
    opened = Opened(home)
    await opened.disk.open(opened.safe.append)
    yield opened
    await opened.disk.close()


async def test_the_writer_reports_safe_only_what_is_written(tmp_path: Path) -> None:
    async with writing(tmp_path) as opened:
        for number in range(1, 6):
            opened.disk.write(Journal(number, (mission("a", 1, step=number),), ()))
        await opened.until(lambda: 5 in opened.safe)
    assert opened.safe == sorted(opened.safe)
    after = MissionJournal.in_home(tmp_path)
    assert after.load().missions[0].step == 5
    after.close()


async def test_a_disk_that_refuses_is_tried_again_and_nothing_is_called_safe(
    tmp_path: Path,
) -> None:
    async with writing(tmp_path) as opened:
        on_disk(tmp_path, "drop table facts")
        opened.disk.write(Journal(1, (mission("a", 1),), ()))
        await opened.until(lambda: opened.disk.trouble is not None)
        assert opened.safe == []
        on_disk(tmp_path, "create table facts (name varchar(32) primary key, value text not null)")
        await opened.until(lambda: bool(opened.safe))
        assert opened.safe == [1]


WRITE = """
from planner.mission.effects import Journal
from planner.mission.journal import MissionJournal
from planner.mission.state import Mission
from planner.plan import GoalState, Language

def goal(name, step):
    return Mission(id=name, order=1, text="x", language=Language.EN, state=GoalState.RUNNING,
                   step=step, created_unix_s=0.0, updated_unix_s=0.0)

def write(home):
    journal = MissionJournal.in_home(home)
    number = 0
    while True:
        number += 1
        journal.write((Journal(number, (goal("a", number), goal("b", number)), ("b",)),))
        yield number
"""
"""It imports no test: each writer waits for what this loads."""


def test_kill_at_any_instant_keeps_whole_entries(tmp_path: Path, repository: Path) -> None:
    for home, last in kill_writers(WRITE, tmp_path, repository):
        check_whole(home, last)


def check_whole(home: Path, last: int) -> None:
    journal = MissionJournal.in_home(home)
    kept = {m.id: m for m in journal.load().missions}
    journal.close()
    assert kept["a"].step == kept["b"].step, "both records of one entry, or neither"
    assert kept["a"].step >= last, "what was reported written is there"


async def test_an_entry_that_is_safe_as_the_wait_ends_is_not_called_lost(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Its goal may move already: called lost, it would be taken back and done again."""
    monkeypatch.setattr("planner.mission.journal_sync.SAFE_WITHIN_S", 0.02)
    disk = JournalSync(MissionJournal.in_home(tmp_path))
    await disk.open(lambda _: None)
    waiting = asyncio.create_task(disk.wait(1))
    await asyncio.sleep(0)
    asyncio.get_running_loop().call_soon_threadsafe(disk._note, 1)
    time.sleep(0.05)  # noqa: ASYNC251  # the loop is held up: both come in one turn
    await waiting
    await disk.close()


def test_a_disk_that_fills_up_on_the_way_lets_no_further_step_begin(world: Together) -> None:
    goal = driving(world, "kitchen", "hall")
    world.disk = False
    world.run(20.0)
    assert world.bridge.pose.x_m == pytest.approx(4.0, abs=0.1), "the step on disk was walked"
    assert standing_still(world, 5.0)
    assert world.goal(goal).state is GoalState.RUNNING
    world.disk = True
    world.sync()
    world.run_until(goal, SUCCEEDED)


def test_words_are_not_said_on_a_full_disk(world: Together) -> None:
    world.disk = False
    world.give(StepPlan(steps=(Say(text="hello"),)))
    world.run(5.0)
    assert world.said == []


async def test_a_full_disk_calls_nothing_safe_and_loses_nothing_once_there_is_room(
    tmp_path: Path,
) -> None:
    missions = tuple(
        Mission(id=f"g{i}", order=i, text="x" * 2000, language=Language.EN,
                state=GoalState.QUEUED, created_unix_s=1.0, updated_unix_s=1.0)
        for i in range(40)
    )  # fmt: skip
    async with writing(tmp_path) as opened:
        connection = opened.disk._journal._connection
        connection.execute("PRAGMA max_page_count=20")
        opened.disk.write(Journal(1, missions, ("g0",)))
        await opened.until(lambda: opened.disk.trouble is not None)
        assert "full" in (opened.disk.trouble or "")
        assert not opened.safe
        connection.execute("PRAGMA max_page_count=100000")
        await opened.until(lambda: bool(opened.safe))
    after = MissionJournal.in_home(tmp_path)
    assert len(after.load().missions) == 40
    after.close()
