"""Keep missions on disk: every transition appended, the newest record of each beside it.

SQLite with WAL and synchronous=FULL. One transaction per entry, so that a crash at any instant
leaves each mission as one entry wrote it. Knows no event loop: ``JournalSync`` calls it from its
one thread.
"""

from __future__ import annotations

import json
import logging
import sqlite3
from contextlib import suppress
from dataclasses import dataclass
from typing import TYPE_CHECKING

from pydantic import ValidationError

from planner.mission import goal_history
from planner.mission.journal_records import read_mission
from planner.mission.state import MAX_ENDED, GoalKey, Mission
from planner.plan import ENDED
from wire import ConfigError, Unwritable

if TYPE_CHECKING:
    from pathlib import Path

    from planner.mission.effects import Journal

log = logging.getLogger(__name__)

SCHEMA = "2"
FORMER_SCHEMAS = frozenset({"1"})
"""Those that are read as well: a record stays as it was written until its goal changes."""
MAX_KEYS = 10_000
"""Of requests, known at once; an older key is looked up (`GoalHistory.find_key`)."""
KEPT_KEYS = 1_000_000
"""On disk, 0.2 kB each: a key is as good as never used again by another request."""
MAX_KEPT = 10_000
"""Ended goals on disk; older ones are removed, open ones never."""
KEPT_WHOLE = 2_000
"""Of these, so many of the newest with all their transitions, which are most of the bytes; of an
older one its last, by which a reader of changes finds it."""
PRUNE_EVERY, PRUNE_MOST = 100, 500
"""After so many goals that ended, so many are removed at most: the writer is not held up."""

_SCHEMA = f"""
CREATE TABLE IF NOT EXISTS transitions (
    seq INTEGER PRIMARY KEY NOT NULL, mission VARCHAR(64) NOT NULL,
    state VARCHAR(32) NOT NULL, at_unix_s FLOAT NOT NULL, record TEXT NOT NULL);
CREATE INDEX IF NOT EXISTS ix_transitions_mission ON transitions (mission);
CREATE TABLE IF NOT EXISTS missions (
    id VARCHAR(64) PRIMARY KEY NOT NULL, "order" INTEGER NOT NULL, ended BOOLEAN NOT NULL,
    record TEXT NOT NULL);
CREATE INDEX IF NOT EXISTS ix_missions_order ON missions ("order");
CREATE INDEX IF NOT EXISTS ix_missions_ended ON missions (ended);
CREATE TABLE IF NOT EXISTS facts (name VARCHAR(32) PRIMARY KEY NOT NULL, value TEXT NOT NULL);
CREATE TABLE IF NOT EXISTS idempotency_keys (
    seq INTEGER PRIMARY KEY NOT NULL, key VARCHAR(256) NOT NULL UNIQUE,
    body VARCHAR(64) NOT NULL, goal VARCHAR(64) NOT NULL);
{goal_history.SCHEMA}"""
_PRAGMAS = "PRAGMA busy_timeout=2000; PRAGMA journal_mode=WAL; PRAGMA synchronous=FULL;"
"""WAL: readers never wait for the writer. FULL: a commit is on disk before it returns."""


@dataclass(frozen=True, slots=True)
class JournalContents:
    """Hold what a journal gives a new process."""

    missions: tuple[Mission, ...]
    queue: tuple[str, ...]
    keys: tuple[GoalKey, ...]


class MissionJournal:
    """Be one database. Not for two threads at once."""

    def __init__(self, path: Path) -> None:
        """Open or make the database.

        Raises:
            ConfigError: it is no database, or another version wrote it.
            Unwritable: it can't be opened or written at present.
        """
        self._queue: tuple[str, ...] | None = None  # as it is on disk; None: not known
        self._ended = 0  # since the journal was last pruned
        try:
            self._connection = sqlite3.connect(path, check_same_thread=False)
            self._connection.executescript(_PRAGMAS + _SCHEMA)
            self._check_schema()
            self._add_missing_rows()
        except sqlite3.Error as error:
            # Operational: what the database's surroundings refuse, a damaged file is none of them.
            wrong = Unwritable if isinstance(error, sqlite3.OperationalError) else ConfigError
            detail = f"{path}: {error.__class__.__name__}: {error}"
            raise wrong("journal_unavailable", detail) from None

    @classmethod
    def in_home(cls, home: Path) -> MissionJournal:
        """Open the journal of a home folder."""
        home.mkdir(parents=True, exist_ok=True)
        return cls(home.absolute() / goal_history.FILE)

    def write(self, entries: tuple[Journal, ...], keys: tuple[GoalKey, ...] = ()) -> None:
        """Write entries, in order, in one transaction; on return they are on disk."""
        queue = self._queue
        with self._connection:
            for entry in entries:
                self._append(entry, queue)
                queue = entry.queue
            for key in keys:
                # A request that got a 503 for a slow disk comes again, with its key, as a new goal.
                self._connection.execute(_PUT_KEY, (key.key, key.body, key.goal))
        self._queue = queue
        self._ended += sum(m.state in ENDED for entry in entries for m in entry.missions)
        if self._ended >= PRUNE_EVERY:
            self._ended = 0
            self._prune()

    def load(self) -> JournalContents:
        """Read what a new process needs: all open missions, the newest ended ones, the keys.

        Raises:
            ConfigError: a record is not one of ours.
        """
        read = self._connection.execute
        open_ = read("SELECT record FROM missions WHERE NOT ended").fetchall()
        ended = read(
            'SELECT record FROM missions WHERE ended ORDER BY "order" DESC LIMIT ?', (MAX_ENDED,)
        ).fetchall()
        queue = self._fact("queue")
        kept = read(
            "SELECT key, body, goal FROM idempotency_keys ORDER BY seq DESC LIMIT ?", (MAX_KEYS,)
        ).fetchall()
        missions = sorted(
            (self._mission(record) for (record,) in (*open_, *ended)), key=lambda m: m.order
        )
        keys = tuple(GoalKey(*row) for row in reversed(kept))
        return JournalContents(tuple(missions), tuple(json.loads(queue or "[]")), keys)

    def close(self) -> None:
        """Give the connection back."""
        self._connection.close()

    def _prune(self) -> None:
        """Remove the oldest goals that ended beyond those kept; a failure leaves them for later."""
        bounds = {"kept": MAX_KEPT, "whole": KEPT_WHOLE, "most": PRUNE_MOST, "keys": KEPT_KEYS}
        try:
            with self._connection as connection:
                for statement in _PRUNE:
                    connection.execute(statement, bounds)
        except sqlite3.Error as error:
            log.warning("the journal was not pruned: %s", str(error)[:200])

    def _append(self, entry: Journal, before: tuple[str, ...] | None) -> None:
        execute = self._connection.execute
        for mission in entry.missions:
            record, ended = mission.model_dump_json(), mission.state in ENDED
            execute(
                "INSERT INTO transitions (mission, state, at_unix_s, record) VALUES (?, ?, ?, ?)",
                (mission.id, mission.state.value, mission.updated_unix_s, record),
            )
            execute(
                "REPLACE INTO missions VALUES (?, ?, ?, ?)",
                (mission.id, mission.order, ended, record),
            )
            execute(goal_history.PUT_ROW, goal_history.row_of(mission))
        if entry.queue != before:
            self._put_fact("queue", json.dumps(entry.queue))

    def _add_missing_rows(self) -> None:
        """Make the rows of goals that a former program wrote, once."""
        missing = "SELECT record FROM missions WHERE id NOT IN (SELECT id FROM history)"
        with self._connection as connection:
            for (record,) in connection.execute(missing).fetchall():
                with suppress(ValidationError):  # what is malformed is told by load
                    row = goal_history.row_of(read_mission(record))
                    connection.execute(goal_history.PUT_ROW, row)

    def _mission(self, record: str) -> Mission:
        try:
            return read_mission(record)
        except ValidationError as error:
            raise ConfigError("journal_malformed", str(error).splitlines()[0]) from None

    def _check_schema(self) -> None:
        found = self._fact("schema")
        if found is None or found in FORMER_SCHEMAS:
            with self._connection:  # from now on a former program refuses it, and says so
                self._put_fact("schema", SCHEMA)
        elif found != SCHEMA:
            known = ", ".join(sorted({*FORMER_SCHEMAS, SCHEMA}))
            detail = f"the journal has schema {found}, this program reads {known}"
            raise ConfigError("journal_version", detail)

    def _fact(self, name: str) -> str | None:
        found = self._connection.execute("SELECT value FROM facts WHERE name = ?", (name,))
        row = found.fetchone()
        return None if row is None else str(row[0])

    def _put_fact(self, name: str, value: str) -> None:
        self._connection.execute("REPLACE INTO facts VALUES (?, ?)", (name, value))


_PUT_KEY = """
INSERT INTO idempotency_keys (key, body, goal) VALUES (?, ?, ?)
    ON CONFLICT (key) DO UPDATE SET body = excluded.body, goal = excluded.goal
"""
_NEWEST = 'SELECT id FROM missions WHERE ended ORDER BY "order" DESC LIMIT'
_GONE = f"""
SELECT id FROM missions WHERE ended AND id NOT IN ({_NEWEST} :kept) ORDER BY "order" LIMIT :most
"""
_SHORTENED = f"""
SELECT id FROM missions WHERE ended AND id NOT IN ({_NEWEST} :whole) AND id IN
    (SELECT mission FROM transitions GROUP BY mission HAVING COUNT(*) > 1)
    ORDER BY "order" LIMIT :most
"""
_PRUNE = (
    f"""DELETE FROM transitions WHERE mission IN ({_SHORTENED}) AND EXISTS
        (SELECT 1 FROM transitions AS t WHERE t.mission = transitions.mission
         AND t.seq > transitions.seq)""",
    f"DELETE FROM transitions WHERE mission IN ({_GONE})",
    f"DELETE FROM history WHERE id IN ({_GONE})",
    f"DELETE FROM missions WHERE id IN ({_GONE})",
    "DELETE FROM idempotency_keys WHERE seq <= (SELECT MAX(seq) FROM idempotency_keys) - :keys",
)
"""Of an old goal all transitions but the last; then the oldest goals whole, and the oldest keys."""
