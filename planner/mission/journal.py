"""Keep missions on disk: every transition appended, the newest record of each beside it.

SQLAlchemy Core; SQLite with WAL and synchronous=FULL. One transaction per entry, so that a crash at
any instant leaves each mission as one entry wrote it.
Knows no event loop: ``JournalSync`` calls it from its one thread.
"""

from __future__ import annotations

import json
import logging
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path

import sqlalchemy as sa
from pydantic import ValidationError
from sqlalchemy.dialects import sqlite

from planner.mission import goal_history
from planner.mission.effects import Journal
from planner.mission.journal_records import read_mission
from planner.mission.state import MAX_ENDED, GoalKey, Mission
from planner.plan import ENDED
from wire import ConfigError, Unwritable

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

_meta = sa.MetaData()
_transitions = sa.Table(
    "transitions",
    _meta,
    sa.Column("seq", sa.Integer, primary_key=True, autoincrement=True),
    sa.Column("mission", sa.String(64), nullable=False, index=True),
    sa.Column("state", sa.String(32), nullable=False),
    sa.Column("at_unix_s", sa.Float, nullable=False),
    sa.Column("record", sa.Text, nullable=False),
)
_missions = sa.Table(
    "missions",
    _meta,
    sa.Column("id", sa.String(64), primary_key=True),
    sa.Column("order", sa.Integer, nullable=False, index=True),
    sa.Column("ended", sa.Boolean, nullable=False, index=True),
    sa.Column("record", sa.Text, nullable=False),
)
_facts = sa.Table(
    "facts",
    _meta,
    sa.Column("name", sa.String(32), primary_key=True),
    sa.Column("value", sa.Text, nullable=False),
)
_keys = sa.Table(
    "idempotency_keys",
    _meta,
    sa.Column("seq", sa.Integer, primary_key=True, autoincrement=True),
    sa.Column("key", sa.String(256), nullable=False, unique=True),
    sa.Column("body", sa.String(64), nullable=False),
    sa.Column("goal", sa.String(64), nullable=False),
)


@dataclass(frozen=True, slots=True)
class JournalContents:
    """Hold what a journal gives a new process."""

    missions: tuple[Mission, ...]
    queue: tuple[str, ...]
    keys: tuple[GoalKey, ...]


class MissionJournal:
    """Be one database. Not for two threads at once."""

    def __init__(self, url: str) -> None:
        """Open or make the database.

        Raises:
            ConfigError: it is no database, or another version wrote it.
            Unwritable: it can't be opened or written at present.
        """
        self._engine = sa.create_engine(url)
        self._queue: tuple[str, ...] | None = None  # as it is on disk; None: not known
        self._ended = 0  # since the journal was last pruned
        sa.event.listen(self._engine, "connect", _sqlite_pragmas)
        try:
            _meta.create_all(self._engine)
            goal_history.meta.create_all(self._engine)
            self._check_schema()
            self._add_missing_rows()
        except sa.exc.SQLAlchemyError as error:
            # Operational: what the database's surroundings refuse, a damaged file is none of them.
            wrong = Unwritable if isinstance(error, sa.exc.OperationalError) else ConfigError
            detail = f"{url}: {error.__class__.__name__}: {str(error).splitlines()[0]}"
            raise wrong("journal_unavailable", detail) from None

    @classmethod
    def in_home(cls, home: Path) -> MissionJournal:
        """Open the journal of a home folder."""
        home.mkdir(parents=True, exist_ok=True)
        return cls(f"sqlite:///{home.absolute() / goal_history.FILE}")

    def write(self, entries: tuple[Journal, ...], keys: tuple[GoalKey, ...] = ()) -> None:
        """Write entries, in order, in one transaction; on return they are on disk."""
        queue = self._queue
        with self._engine.begin() as connection:
            for entry in entries:
                self._append(connection, entry, queue)
                queue = entry.queue
            for key in keys:
                # A request that got a 503 for a slow disk comes again, with its key, as a new goal.
                row = {"key": key.key, "body": key.body, "goal": key.goal}
                connection.execute(_PUT_KEY, row)
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
        with self._engine.connect() as connection:
            newest = sa.select(_missions).order_by(_missions.c.order.desc())
            open_ = connection.execute(newest.where(_missions.c.ended.is_(False))).all()
            ended = connection.execute(
                newest.where(_missions.c.ended.is_(True)).limit(MAX_ENDED)
            ).all()
            queue = connection.execute(
                sa.select(_facts.c.value).where(_facts.c.name == "queue")
            ).scalar()
            kept = connection.execute(
                sa.select(_keys).order_by(_keys.c.seq.desc()).limit(MAX_KEYS)
            ).all()
        missions = sorted(
            (self._mission(row.record) for row in (*open_, *ended)), key=lambda m: m.order
        )
        keys = tuple(GoalKey(row.key, row.body, row.goal) for row in reversed(kept))
        return JournalContents(tuple(missions), tuple(json.loads(queue or "[]")), keys)

    def close(self) -> None:
        """Give the connections back."""
        self._engine.dispose()

    def _prune(self) -> None:
        """Remove the oldest goals that ended beyond those kept; a failure leaves them for later."""
        ended = sa.select(_missions.c.id).where(_missions.c.ended.is_(True))
        kept = ended.order_by(_missions.c.order.desc()).limit(MAX_KEPT)
        oldest = ended.where(_missions.c.id.not_in(kept)).order_by(_missions.c.order)
        whole = ended.order_by(_missions.c.order.desc()).limit(KEPT_WHOLE)
        changed = sa.select(_transitions.c.mission).group_by(_transitions.c.mission)
        has_more = _missions.c.id.in_(changed.having(sa.func.count() > 1))
        past = ended.where(_missions.c.id.not_in(whole), has_more).order_by(_missions.c.order)
        newest_key = sa.select(sa.func.max(_keys.c.seq)).scalar_subquery()
        try:
            with self._engine.begin() as connection:
                gone = connection.execute(oldest.limit(PRUNE_MOST)).scalars().all()
                shortened = connection.execute(past.limit(PRUNE_MOST)).scalars().all()
                of = _transitions.c.mission
                connection.execute(sa.delete(_transitions).where(of.in_(gone)))
                last = sa.select(sa.func.max(_transitions.c.seq)).where(of.in_(shortened))
                before = _transitions.c.seq.not_in(last.group_by(of))
                connection.execute(sa.delete(_transitions).where(of.in_(shortened), before))
                connection.execute(
                    sa.delete(goal_history.rows).where(goal_history.rows.c.id.in_(gone))
                )
                connection.execute(sa.delete(_missions).where(_missions.c.id.in_(gone)))
                connection.execute(sa.delete(_keys).where(_keys.c.seq <= newest_key - KEPT_KEYS))
        except sa.exc.SQLAlchemyError as error:
            log.warning("the journal was not pruned: %s", str(error).splitlines()[0][:200])

    def _append(
        self, connection: sa.Connection, entry: Journal, before: tuple[str, ...] | None
    ) -> None:
        for mission in entry.missions:
            record = mission.model_dump_json()
            row = {
                "mission": mission.id,
                "state": mission.state.value,
                "at_unix_s": mission.updated_unix_s,
                "record": record,
            }
            connection.execute(_ADD_TRANSITION, row)
            ended = mission.state in ENDED
            newest = {"id": mission.id, "order": mission.order, "ended": ended, "record": record}
            connection.execute(_PUT_MISSION, newest)
            connection.execute(_PUT_ROW, goal_history.row_of(mission))
        if entry.queue != before:
            connection.execute(_PUT_FACT, {"name": "queue", "value": json.dumps(entry.queue)})

    def _add_missing_rows(self) -> None:
        """Make the rows of goals that a former program wrote, once."""
        listed = sa.select(goal_history.rows.c.id)
        with self._engine.begin() as connection:
            missing = sa.select(_missions.c.record).where(_missions.c.id.not_in(listed))
            for record in connection.execute(missing).scalars().all():
                with suppress(ValidationError):  # what is malformed is told by load
                    connection.execute(_PUT_ROW, goal_history.row_of(read_mission(record)))

    def _mission(self, record: str) -> Mission:
        try:
            return read_mission(record)
        except ValidationError as error:
            raise ConfigError("journal_malformed", str(error).splitlines()[0]) from None

    def _check_schema(self) -> None:
        with self._engine.begin() as connection:
            found = connection.execute(
                sa.select(_facts.c.value).where(_facts.c.name == "schema")
            ).scalar()
            if found is None:
                connection.execute(sa.insert(_facts).values(name="schema", value=SCHEMA))
            elif found in FORMER_SCHEMAS:  # from now on a former program refuses it, and says so
                here = _facts.c.name == "schema"
                connection.execute(sa.update(_facts).where(here).values(value=SCHEMA))
            elif found != SCHEMA:
                known = ", ".join(sorted({*FORMER_SCHEMAS, SCHEMA}))
                detail = f"the journal has schema {found}, this program reads {known}"
                raise ConfigError("journal_version", detail)


def _upsert(table: sa.Table, unique: sa.Column[str] | None = None) -> sa.Insert:
    """Return what inserts a row or puts it in the place of the one with its key.

    ``unique`` is that key where it is not the primary one, which the database then gives.
    """
    [primary] = table.primary_key.columns
    key = unique if unique is not None else primary
    put, keys = sqlite.insert(table), {key.name, primary.name}
    others = {c.name: put.excluded[c.name] for c in table.columns if c.name not in keys}
    return put.on_conflict_do_update(index_elements=[key], set_=others)


# Built once: putting a statement together costs as much as running it.
_ADD_TRANSITION = sa.insert(_transitions)
_PUT_MISSION, _PUT_ROW = _upsert(_missions), _upsert(goal_history.rows)
_PUT_FACT, _PUT_KEY = _upsert(_facts), _upsert(_keys, _keys.c.key)


def _sqlite_pragmas(connection: object, record: object) -> None:
    cursor = connection.cursor()  # type: ignore[attr-defined]  # a DB-API connection
    # WAL: readers never wait for the writer. FULL: a commit is on disk before it returns.
    for pragma in ("journal_mode=WAL", "synchronous=FULL", "busy_timeout=2000"):
        cursor.execute(f"PRAGMA {pragma}")
    cursor.close()
