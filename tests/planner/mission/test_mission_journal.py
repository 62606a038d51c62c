"""Try the journal: what is written comes back, however the process ended."""

from __future__ import annotations

import asyncio
import json
import resource
import threading
from pathlib import Path
from typing import cast

import pytest
import sqlalchemy as sa
from sqlalchemy.dialects.postgresql.base import PGDialect

from planner.language.catalogue import message
from planner.mission.effects import Journal
from planner.mission.goal_history import GoalHistory
from planner.mission.journal import (
    KEPT_WHOLE,
    MAX_KEPT,
    PRUNE_EVERY,
    PRUNE_MOST,
    SCHEMA,
    MissionJournal,
    _facts,
    _in_one,
    _keys,
    _upsert_of,
)
from planner.mission.journal_sync import JournalWriter, PendingEntry
from planner.mission.skills.skill_state import FindState
from planner.mission.state import MAX_ENDED, GoalKey, Mission
from planner.plan import Code, GoalState, Language, Outcome, StepState
from tests.killed_writers import kill_writers
from tests.planner.mission.former_records import FIND, YOUNGER
from wire import ConfigError, Unwritable

FORMER_ROW = r"""
{"id": "g1", "order": 1, "text": "text g1", "language": "en", "state": "paused",
"reason": "operator", "replies": [], "questions": [], "source": "api", "plan": {"kind": "plan",
"steps": [{"kind": "go_to", "place": "kitchen", "places": [], "object": null, "text": null,
"seconds": null, "angle_rad": null, "distance_m": null, "state": "running", "reached": null,
"residual_m": null, "residual_rad": null, "moved_m": null, "turned_rad": null, "visited": null,
"x": null, "y": null, "found": null, "count": null, "rooms": [], "code": null, "said": null,
"read": null, "answer": null, "left_m": null, "left_rad": null, "left_s": null,
"reason": null}], "code": null, "text": null, "options": []}, "outcome": null, "brain": null,
"confirm": false, "replace": false, "first": false, "doubtful_stop": false,
"given_under_hold": null, "held": false, "kept": false, "map_id": "", "step": 0, "part": 0,
"began_at": null, "done": 1.5, "notes": {"stage": 0, "spot": null, "views": [], "turned": null,
"spots": [], "rooms": [], "missed": null, "shut": [], "broke": false, "here": null,
"ahead": null, "faced": [], "order": [], "aim": null, "tried": [], "at": null, "pointed": null,
"sure": null, "label": null, "color": null, "stand": 0, "again": 0, "heard": null,
"seen_s": 0.0}, "step_s": 3.0, "step_m": 1.5, "replans": 0, "decides": 0,
"tried": ["[{\"kind\": \"go_to\", \"place\": \"kitchen\"}]"],
"failure": null, "leg": 1, "accepted_at": [0.0, 0.0, 0.0], "speed_share": 1.0, "metres": 1.5,
"limited": {"max_speed": 60}, "created_unix_s": 100.25,
"updated_unix_s": 103.25}
"""
"""A goal paused on its way, as programs wrote it that kept one record for every activity."""


def mission(
    goal_id: str, order: int, state: GoalState = GoalState.QUEUED, step: int = 0
) -> Mission:
    outcome = None
    if state is GoalState.SUCCEEDED:
        outcome = Outcome(code=Code.DONE, message=message(Code.DONE))
    return Mission(id=goal_id, order=order, text="去厨房", language=Language.ZH, state=state,
                   outcome=outcome, step=step, limited={"max_speed": 3},
                   accepted_at=(1.0, 2.0, 3.0), created_unix_s=1.5, updated_unix_s=2.5)  # fmt: skip


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
    engine = sa.create_engine(f"sqlite:///{tmp_path / 'home' / 'missions.db'}")
    with engine.connect() as connection:
        states = connection.execute(sa.text("select mission, state from transitions order by seq"))
        assert [tuple(r) for r in states] == [("a", "queued"), ("a", "running"), ("b", "queued")]
    engine.dispose()


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
    engine = sa.create_engine(f"sqlite:///{tmp_path / 'missions.db'}")
    with engine.connect() as connection:
        for table, column in (("missions", "id"), ("transitions", "mission")):
            found = connection.execute(sa.text(f"select {column} from {table}")).scalars().all()
            ended_ids = [name for name in found if name.startswith("e")]
            assert len(ended_ids) == MAX_KEPT
            assert "e0" not in ended_ids
            assert sum(name.startswith("open") for name in found) == 5
    engine.dispose()


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


def test_a_journal_of_an_older_program_is_pruned_bit_by_bit(tmp_path: Path) -> None:
    journal = MissionJournal.in_home(tmp_path)
    many = MAX_KEPT + 2 * PRUNE_MOST
    crowd = tuple(mission(f"e{n}", n, GoalState.SUCCEEDED) for n in range(many))
    journal.write((Journal(1, crowd, ()),))
    engine = sa.create_engine(f"sqlite:///{tmp_path / 'missions.db'}")
    with engine.connect() as connection:
        left = connection.execute(sa.text("select count(*) from missions")).scalar()
    engine.dispose()
    journal.close()
    assert left == many - PRUNE_MOST


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
    with pytest.raises(sa.exc.IntegrityError):
        journal.write((Journal(4, (one,), ("c",)),), (bad,))
    assert kept() == ("a",)
    journal.write((Journal(4, (one,), ("c",)),))
    assert kept() == ("c",)
    journal.close()


@pytest.mark.parametrize("dialect", ["sqlite", "another"])
def test_a_row_is_put_in_the_place_of_the_one_with_its_key(dialect: str, tmp_path: Path) -> None:
    journal = MissionJournal.in_home(tmp_path)
    put = _upsert_of(_facts, dialect)
    with journal._engine.begin() as connection:
        for value in ("1", "2"):
            put(connection, {"name": "n", "value": value})
        rows = connection.execute(sa.select(_facts.c.value).where(_facts.c.name == "n")).all()
    journal.close()
    assert [row.value for row in rows] == ["2"]


@pytest.mark.parametrize("dialect", ["sqlite", "another"])
def test_a_key_that_comes_again_after_a_503_is_its_new_goals(dialect: str, tmp_path: Path) -> None:
    journal = MissionJournal.in_home(tmp_path)
    journal._put_key = _upsert_of(_keys, dialect, _keys.c.key)
    journal.write((), (GoalKey("k", "f", "a"), GoalKey("other", "f", "b")))
    journal.write((Journal(1, (mission("c", 1),), ()),), (GoalKey("k", "f2", "c"),))
    kept = journal.load()
    journal.close()
    assert set(kept.keys) == {GoalKey("other", "f", "b"), GoalKey("k", "f2", "c")}
    assert [m.id for m in kept.missions] == ["c"]


def test_postgres_has_the_one_statement_too() -> None:
    [key] = _facts.primary_key.columns
    made = _in_one(_facts, key, ["value"], "postgresql")
    assert made is not None
    dialect = PGDialect()  # type: ignore[no-untyped-call]  # sqlalchemy's own
    assert "ON CONFLICT (name) DO UPDATE" in str(made.compile(dialect=dialect))


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
    engine = sa.create_engine(f"sqlite:///{tmp_path / 'missions.db'}")
    with engine.begin() as connection:
        connection.execute(sa.text("update facts set value = '99' where name = 'schema'"))
    engine.dispose()
    with pytest.raises(ConfigError, match="schema 99, this program reads 1, 2"):
        MissionJournal.in_home(tmp_path)


def test_a_journal_of_schema_1_is_taken_over_and_refused_by_a_former_program(
    tmp_path: Path,
) -> None:
    journal = MissionJournal.in_home(tmp_path)
    journal.write((Journal(1, (mission("g1", 1),), ("g1",)),), (GoalKey("k", "f", "g1"),))
    journal.close()
    engine = sa.create_engine(f"sqlite:///{tmp_path / 'missions.db'}")
    with engine.begin() as connection:
        connection.execute(sa.text("update facts set value = '1' where name = 'schema'"))
        connection.execute(sa.text("update missions set record = :row"), {"row": FIND})
    after = MissionJournal.in_home(tmp_path)
    kept = after.load()
    after.close()
    assert (kept.queue, kept.keys) == (("g1",), (GoalKey("k", "f", "g1"),))
    assert isinstance(kept.missions[0].skill_state, FindState)
    with engine.connect() as connection:
        schema = connection.execute(sa.text("select value from facts where name = 'schema'"))
        row = connection.execute(sa.text("select record from missions"))
        # A former program says "the journal has schema 2, expected 1".
        assert (schema.scalar(), row.scalar()) == (SCHEMA, FIND), "what is open is not rewritten"
    engine.dispose()


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
    engine = sa.create_engine(f"sqlite:///{tmp_path / 'missions.db'}")
    with engine.begin() as connection:
        connection.execute(sa.text("update missions set record = '{}'"))
    engine.dispose()
    with pytest.raises(ConfigError, match="journal_malformed"):
        journal.load()
    journal.close()


def test_a_row_of_a_former_program_still_loads_whole(tmp_path: Path) -> None:
    journal = MissionJournal.in_home(tmp_path)
    journal.write((Journal(1, (mission("g1", 1),), ()),))
    engine = sa.create_engine(f"sqlite:///{tmp_path / 'missions.db'}")
    with engine.begin() as connection:
        connection.execute(sa.text("update missions set record = :row"), {"row": FORMER_ROW})
    engine.dispose()
    [kept] = journal.load().missions
    journal.close()
    former = json.loads(FORMER_ROW)
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


def test_the_writer_reports_safe_only_what_is_written(tmp_path: Path) -> None:
    journal = MissionJournal.in_home(tmp_path)
    safe: list[int] = []
    written = threading.Event()

    def done(entry: int) -> None:
        safe.append(entry)
        if entry == 5:
            written.set()

    writer = JournalWriter(journal, done, lambda why: None)
    for number in range(1, 6):
        writer.write(PendingEntry(Journal(number, (mission("a", 1, step=number),), ())))
    assert written.wait(10.0)
    writer.close()
    assert safe == sorted(safe)
    after = MissionJournal.in_home(tmp_path)
    assert after.load().missions[0].step == 5
    after.close()


def test_a_disk_that_refuses_is_tried_again_and_nothing_is_called_safe(tmp_path: Path) -> None:
    journal = MissionJournal.in_home(tmp_path)
    lock = sa.create_engine(f"sqlite:///{tmp_path / 'missions.db'}").connect()
    lock.execute(sa.text("drop table facts"))
    lock.commit()
    safe: list[int] = []
    failed, done = threading.Event(), threading.Event()

    def on_done(entry: int) -> None:
        safe.append(entry)
        done.set()

    writer = JournalWriter(journal, on_done, lambda why: failed.set())
    writer.write(PendingEntry(Journal(1, (mission("a", 1),), ())))
    assert failed.wait(10.0)
    assert safe == []
    lock.execute(sa.text("create table facts (name varchar(32) primary key, value text not null)"))
    lock.commit()
    assert done.wait(10.0)
    assert safe == [1]
    writer.close()
    lock.close()
    lock.engine.dispose()


WRITE = """
from planner.mission.effects import Journal
from planner.mission.journal import MissionJournal
from tests.planner.mission.test_mission_journal import mission
from planner.plan import GoalState

def write(home):
    journal = MissionJournal.in_home(home)
    number = 0
    while True:
        number += 1
        pair = (mission("a", 1, GoalState.RUNNING, number), mission("b", 2, step=number))
        journal.write((Journal(number, pair, ("b",)),))
        yield number
"""


def test_kill_at_any_instant_keeps_whole_entries(tmp_path: Path, repository: Path) -> None:
    for home, last in kill_writers(WRITE, tmp_path, repository):
        check_whole(home, last)


def check_whole(home: Path, last: int) -> None:
    journal = MissionJournal.in_home(home)
    kept = {m.id: m for m in journal.load().missions}
    journal.close()
    assert kept["a"].step == kept["b"].step, "both records of one entry, or neither"
    assert kept["a"].step >= last, "what was reported written is there"
