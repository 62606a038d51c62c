"""List what the robot was told, years back: a short row of each goal beside its record.

The journal writes the rows in its own transactions; ``GoalHistory`` reads them on connections of
its own, in a thread, so that neither the loop nor the journal's writer waits. One row is a hundred
bytes where a record is three thousand, so ten thousand are searched in milliseconds. The black box
is read for a mission by a process, for the planner knows no recordings: one at a time, and only as
long as a person would wait.
"""

from __future__ import annotations

import asyncio
import json
import sqlite3
from contextlib import closing
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from pydantic import ValidationError

from planner.mission.errors import UnknownGoal
from planner.mission.journal_records import read_mission
from planner.mission.state import GoalKey, Mission
from planner.plan import ENDED, Frozen, GoalState, Language
from processes.parent_death import child_command

if TYPE_CHECKING:
    from pathlib import Path


FILE = "missions.db"
"""The journal of a home."""
SCHEMA = """
CREATE TABLE IF NOT EXISTS history (
    id VARCHAR(64) PRIMARY KEY NOT NULL, "order" INTEGER NOT NULL, created_unix_s FLOAT NOT NULL,
    updated_unix_s FLOAT NOT NULL, state VARCHAR(32) NOT NULL, reason VARCHAR(64),
    text TEXT NOT NULL, language VARCHAR(8) NOT NULL, source VARCHAR(64) NOT NULL,
    metres FLOAT NOT NULL, told TEXT NOT NULL);
CREATE INDEX IF NOT EXISTS ix_history_order ON history ("order");
CREATE INDEX IF NOT EXISTS ix_history_created_unix_s ON history (created_unix_s);
"""
"""One row a goal; the journal makes the table and writes it."""
PUT_ROW = """
REPLACE INTO history VALUES (:id, :order, :created_unix_s, :updated_unix_s, :state, :reason,
    :text, :language, :source, :metres, :told)
"""
FIRST_CHARACTERS = 300
"""Of a sentence and of how it ended: the whole stands in its record."""


class HistoryRow(Frozen):
    """Show one goal in short: when, what, by whom, how it ended and how far it went."""

    id: str
    order: int
    """Rises with every goal given; the cursor of a list."""
    created_unix_s: float
    seconds: float | None
    """From its giving to its end; None of an open goal."""
    state: GoalState
    reason: str | None
    text: str
    language: Language
    source: str
    metres: float
    told: dict[str, str]
    """How it ended, in both languages; empty of an open goal."""


class HistoryPage(Frozen):
    """Hold one page of a list, newest first."""

    goals: tuple[HistoryRow, ...]
    next: int | None
    """Where the next page begins, as ``before``; None: this is the last one."""


@dataclass(frozen=True, slots=True, kw_only=True)
class HistoryQuery:
    """Say which goals are wanted; None: all."""

    since_unix_s: float | None = None
    until_unix_s: float | None = None
    state: GoalState | None = None
    search: str | None = None
    before: int | None = None
    limit: int = 50


@dataclass(frozen=True, slots=True)
class ChangedGoals:
    """Hold goals as they stand after their newest changes, the change of longest ago first."""

    missions: tuple[Mission, ...]
    cursor: int
    """Of the last of these changes: what comes after it is new."""


class StateChange(Frozen):
    """Show when a goal came into a state."""

    state: GoalState
    at_unix_s: float


class GoalStory(Frozen):
    """Show what stands behind a goal: who gave it, what was asked, and when its state changed."""

    source: str
    questions: tuple[str, ...]
    replies: tuple[str, ...]
    """What people answered, each to the question of the same place in the row."""
    map_id: str
    metres: float
    changes: tuple[StateChange, ...]
    """Of a goal so old that only its last record is kept: the last one."""


def row_of(mission: Mission) -> dict[str, Any]:
    """Return a goal's row."""
    told = {}
    if mission.outcome is not None and mission.state in ENDED:
        message = mission.outcome.message
        told = {"en": message.en[:FIRST_CHARACTERS], "zh": message.zh[:FIRST_CHARACTERS]}
    return {
        "id": mission.id,
        "order": mission.order,
        "created_unix_s": mission.created_unix_s,
        "updated_unix_s": mission.updated_unix_s,
        "state": mission.state.value,
        "reason": mission.reason,
        "text": mission.text[:FIRST_CHARACTERS],
        "language": mission.language.value,
        "source": mission.by,
        "metres": mission.metres,
        "told": json.dumps(told, ensure_ascii=False),
    }


class GoalHistory:
    """Read the rows, and what stands behind one goal, from a journal's file."""

    def __init__(self, path: Path) -> None:
        self._path = path
        self.tracks = TrackReader(path.parent)

    @classmethod
    def in_home(cls, home: Path) -> GoalHistory:
        """Return the history of a home folder, whose journal may come later."""
        return cls(home / FILE)

    async def find(self, query: HistoryQuery) -> HistoryPage:
        """Return the goals that a query asks for, newest first."""
        return await asyncio.to_thread(self._find, query)

    async def story(self, goal_id: str) -> tuple[Mission, GoalStory]:
        """Return a goal's record and its story.

        Raises:
            UnknownGoal: the journal has none of that id.
        """
        return await asyncio.to_thread(self._story, goal_id)

    async def changed_since(self, cursor: int, limit: int) -> ChangedGoals:
        """Return the goals that changed after a cursor, each once, at most ``limit``."""
        return await asyncio.to_thread(self._changed_since, cursor, limit)

    async def find_key(self, key: str) -> GoalKey | None:
        """Return the request that came with a key, however long ago; None: it is a new one."""
        found = await asyncio.to_thread(self._read, _KEY, key=key)
        return GoalKey(*found[0]) if found else None

    def _find(self, query: HistoryQuery) -> HistoryPage:
        where, values = _conditions(query)
        wanted = f'SELECT * FROM history WHERE {where} ORDER BY "order" DESC LIMIT :limit'
        found = self._read(wanted, limit=query.limit + 1, **values)
        shown = tuple(_show(dict(row)) for row in found[: query.limit])
        return HistoryPage(goals=shown, next=shown[-1].order if len(found) > len(shown) else None)

    def _read(self, asked: str, **values: str | float) -> list[sqlite3.Row]:
        """Return the rows that are asked for; none where nothing was ever ordered here."""
        if not self._path.exists():
            return []
        with closing(sqlite3.connect(self._path)) as connection:
            connection.row_factory = sqlite3.Row
            return connection.execute(asked, values).fetchall()

    def _changed_since(self, cursor: int, limit: int) -> ChangedGoals:
        found = self._read(_CHANGED, cursor=cursor, limit=limit)
        missions = tuple(read_mission(record) for record, _ in found)
        return ChangedGoals(missions, found[-1]["seq"] if found else cursor)

    def _story(self, goal_id: str) -> tuple[Mission, GoalStory]:
        found = self._read(_RECORD, goal=goal_id)
        if not found:
            raise UnknownGoal(goal_id, ())
        mission, changed = read_mission(found[0]["record"]), self._read(_CHANGES, goal=goal_id)
        changes: list[StateChange] = []
        for state, at_unix_s in changed:
            if not changes or changes[-1].state != state:
                changes.append(StateChange(state=GoalState(state), at_unix_s=at_unix_s))
        return mission, GoalStory(
            source=mission.by,
            questions=mission.questions,
            replies=mission.replies,
            map_id=mission.map_id,
            metres=mission.metres,
            changes=tuple(changes),
        )


_RECORD = "SELECT record FROM missions WHERE id = :goal"
_CHANGED = """
SELECT record, seq FROM missions JOIN (SELECT mission, MAX(seq) AS seq FROM transitions
WHERE seq > :cursor GROUP BY mission ORDER BY seq LIMIT :limit) ON id = mission ORDER BY seq
"""
_KEY = "SELECT key, body, goal FROM idempotency_keys WHERE key = :key"
_CHANGES = "SELECT state, at_unix_s FROM transitions WHERE mission = :goal ORDER BY seq"


def _conditions(query: HistoryQuery) -> tuple[str, dict[str, str | float]]:
    """Return what a row must be, in SQL, and the values in it."""
    found = ["TRUE"]
    values: dict[str, str | float] = {}
    for name, condition, value in (
        ("since", "created_unix_s >= :since", query.since_unix_s),
        ("until", "created_unix_s < :until", query.until_unix_s),
        ("state", "state = :state", query.state),
        ("before", '"order" < :before', query.before),
    ):
        if value is not None:
            found.append(condition)
            values[name] = value
    for number, word in enumerate((query.search or "").split()):
        found.append(f"instr(lower(text), lower(:word{number})) > 0")
        values[f"word{number}"] = word
    return " AND ".join(found), values


def _show(row: dict[str, Any]) -> HistoryRow:
    fields = {name: row[name] for name in HistoryRow.model_fields if name in row}
    ended = GoalState(row["state"]) in ENDED
    lasted_s = round(row["updated_unix_s"] - row["created_unix_s"], 1) if ended else None
    return HistoryRow.model_validate(
        {**fields, "state": GoalState(row["state"]), "language": Language(row["language"]),
         "seconds": lasted_s, "told": json.loads(row["told"])}
    )  # fmt: skip


MODULE = "pons.mission_track"
MARGIN_S = 5.0
"""So much of the recording before and after a mission is shown with it."""
LIMIT_S = 20.0
NICE = 10
"""Of the session that it leads: it stands behind the planner's own loop."""


class TrackSample(Frozen):
    """Show where the robot was and how fast, at a time since the track's beginning."""

    s: float
    x_m: float | None
    """In ``map``; None: the robot did not know."""
    y_m: float | None
    yaw_rad: float | None
    asked_mps: float
    measured_mps: float
    mode: str
    rows: tuple[str, ...]


class TrackEvent(Frozen):
    """Show what the bridge said at a time."""

    s: float
    code: str
    detail: str


class RecordedTrack(Frozen):
    """Show a mission as the black box has it; empty where nothing of it is kept, or may be read."""

    samples: tuple[TrackSample, ...] = ()
    events: tuple[TrackEvent, ...] = ()
    gaps: tuple[tuple[float, float], ...] = ()
    """From when to when nothing is kept."""
    way_m: float = 0.0


class TrackReader:
    """Read tracks out of a home's recordings."""

    def __init__(self, home: Path) -> None:
        self._home = home
        self._one = asyncio.Lock()

    async def read(self, since_unix_s: float, until_unix_s: float) -> RecordedTrack:
        """Return the track between two times; an empty one where it can't be read in time."""
        words = (str(self._home), repr(since_unix_s - MARGIN_S), repr(until_unix_s + MARGIN_S))
        async with self._one:
            process = await asyncio.create_subprocess_exec(
                *child_command(MODULE, *words, session_nice=NICE),
                stdin=asyncio.subprocess.DEVNULL,
                stdout=asyncio.subprocess.PIPE,
                stderr=asyncio.subprocess.DEVNULL,
                start_new_session=True,
            )
            try:
                told, _ = await asyncio.wait_for(process.communicate(), LIMIT_S)
                return RecordedTrack.model_validate_json(told, strict=False)
            except (TimeoutError, ValidationError):
                return RecordedTrack()
            finally:
                if process.returncode is None:
                    process.kill()
                    await process.wait()
