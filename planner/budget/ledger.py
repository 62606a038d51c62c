"""Keep what was spent on disk, as a table: each change before its call goes. Knows no limit.

One row for each goal and day. Another program of the same home (an exam, a replay) spends from the
same rows: what a call may cost is judged and written in one transaction. All of it is done by one
thread, in order; what is told of sums comes from memory, so that the event loop waits for no disk.
"""

from __future__ import annotations

import asyncio
import json
import logging
import re
import time
from collections import deque
from collections.abc import Callable
from concurrent.futures import Future, ThreadPoolExecutor
from contextlib import suppress
from dataclasses import dataclass, field, fields
from datetime import date, timedelta
from typing import TYPE_CHECKING, Any

from planner.budget.totals import Expense, Overrun
from planner.state_database import StateDatabase, StateUnavailable
from wire import ConfigError, Unwritable

if TYPE_CHECKING:
    import sqlite3
    from pathlib import Path

log = logging.getLogger(__name__)

FOLDER = "spent"
"""Of the layout before, a file a day: taken in, where it lies in the home folder."""
LOOK_BACK_DAYS = 8
"""How old a goal's first spending may be to be remembered by a new process."""
KEPT_DAYS = 92
MAX_GOALS = 20_000
MAX_ID = 80
SYNC_EVERY_S = 1.0
"""A power cut takes at most calls that followed another one so soon: cards wear out by writing."""
MAX_DAY_BYTES = 64_000_000
NOT_YET = ".not-yet"
"""Ends a day that a clock, which had leapt ahead, counted to: it counts no more."""
_NAME = re.compile(r"(\d{4}-\d\d-\d\d)\.jsonl")
_FIELDS = tuple(each.name for each in fields(Expense))
_SUMS = ", ".join(f"total({name})" for name in _FIELDS)
_ADD = (
    f"INSERT INTO spent VALUES (?, ?, {', '.join('?' for _ in _FIELDS)}) ON CONFLICT DO UPDATE SET "
    + ", ".join(f"{name} = {name} + excluded.{name}" for name in _FIELDS)
)
_IS_DAY = "day GLOB '????-??-??'"
_UNREADABLE = Expense(calls=1)

Judge = Callable[[Expense, Expense], Overrun | None]
"""Tells, of the sums of a day and of a goal, the limit that a change would pass."""


@dataclass(frozen=True, slots=True)
class _Move:
    """Ask the thread for one thing: to add a change, where there is one, and to read the sums."""

    day: date
    goal: str
    change: Expense = field(default_factory=Expense)
    judge: Judge | None = None
    """None: a correction, which is never refused."""

    @property
    def corrects(self) -> Expense:
        """Return what is told before it is kept."""
        return self.change if self.judge is None else Expense()


@dataclass(frozen=True, slots=True)
class Balance:
    """Hold the sums of a day and a goal as the disk has them; ``overrun``: nothing was spent."""

    day: date
    today: Expense
    goal: str
    mine: Expense
    overrun: Overrun | None = None


class Ledger:
    """Be one home's ledger. For one thread, beside its own."""

    def __init__(self, database: StateDatabase, old_folder: Path, *, owned: bool = False) -> None:
        """Take up the newest day; nothing is made yet.

        Args:
            database: where it is kept.
            old_folder: where files of the layout before may lie.
            owned: nobody else has this database, so it is closed with the ledger.

        Raises:
            ConfigError: ``budget_unreadable``, ``state_version``.
        """
        self._database, self._old_folder, self._owned = database, old_folder, owned
        self._days: dict[date, Expense] = {}
        self._goals: dict[str, Expense] = {}
        self._queue: deque[tuple[Future[Balance], _Move]] = deque()
        self._closed = False
        self._thread = ThreadPoolExecutor(1, "budget")
        self._syncer = ThreadPoolExecutor(1, "spent")
        self._syncing: Future[None] | None = None
        self._synced_s = float("-inf")
        try:
            self._take_over()
            [(newest,)] = database.read(f"SELECT max(day) FROM spent WHERE {_IS_DAY}") or [(None,)]
        except OSError as error:
            raise self._unreadable(error) from None
        self.newest = None if newest is None else _date(newest)
        """The newest day of which something is kept."""

    @classmethod
    def in_home(cls, home: Path) -> Ledger:
        """Return the ledger of a home folder, with a connection of its own."""
        return cls(StateDatabase(home), home / FOLDER, owned=True)

    def remember(self, today: date) -> None:
        """Read the expense of the last days' goals, and throw very old days away.

        Raises:
            ConfigError: ``budget_unreadable``.
        """
        begin = (today - timedelta(days=LOOK_BACK_DAYS)).isoformat()
        goals = f"SELECT goal, {_SUMS} FROM spent WHERE {_IS_DAY} AND day >= ? AND goal != ''"
        try:
            self._forget(today - timedelta(days=KEPT_DAYS), begin)
            rows = self._database.read(f"{goals} GROUP BY goal LIMIT {MAX_GOALS}", (begin,))
            self._days[today] = _sum(
                self._database.read(f"SELECT {_SUMS} FROM spent WHERE day = ?", (str(today),))
            )
        except OSError as error:
            raise self._unreadable(error) from None
        self._goals = {goal: _amounts_of(sums) for goal, *sums in rows}

    def prepare(self) -> None:
        """Make the database and open it; where it can't be, each call will say so."""
        with suppress(OSError), self._database.change(sync=False):
            pass

    def of_day(self, day: date) -> Expense:
        """Return what was spent on a day, as of the last time that the disk was asked."""
        self._collect()
        waiting = (move.corrects for _, move in self._queue if move.day == day)
        return sum(waiting, self._days.get(day, Expense()))

    def of_goal(self, goal: str) -> Expense:
        """Return what a goal has spent, likewise."""
        self._collect()
        goal = goal[:MAX_ID]
        waiting = (move.corrects for _, move in self._queue if move.goal == goal)
        return sum(waiting, self._goals.get(goal, Expense()))

    async def spend(self, day: date, goal: str, change: Expense, judge: Judge) -> Overrun | None:
        """Keep a change unless it is too much; on return it outlives this process.

        Args:
            day: to which it counts.
            goal: whose spending.
            change: what to add.
            judge: holds the sums of day and goal against the limits.

        Raises:
            OSError: it can't be kept.
        """
        future = self._ask(_Move(day, goal[:MAX_ID], change, judge))
        return (await asyncio.wrap_future(future)).overrun

    def settle(self, day: date, goal: str, change: Expense) -> None:
        """Correct what was spent; it is told at once and kept soon."""
        self._ask(_Move(day, goal[:MAX_ID], change))

    def look(self, day: date, goal: str = "") -> Future[Balance] | None:
        """Have the sums read anew, as another program may have spent; None: that is under way."""
        move = _Move(day, goal[:MAX_ID])
        if self._closed or any(each == move for _, each in self._queue):
            return None
        return self._ask(move)

    def set_aside(self, after: date) -> None:
        """Let days that have not come yet count no more, soon."""
        self._thread.submit(self._set_aside, after)

    def close(self) -> None:
        """Keep what waits, and end the threads."""
        self._closed = True
        self._thread.shutdown()
        self._syncer.shutdown()
        self._collect()
        if self._owned:
            self._database.close()

    # In the thread ------------------------------------------------------------------------------

    def _do(self, move: _Move) -> Balance:
        """Read the sums and, where it is asked for and within the limits, add a change to them."""
        day, goal, change = move.day, move.goal, move.change
        if change == Expense():
            return Balance(day, *self._balance(self._database.read, day, goal))
        self._database.take_over(self._old_folder, self._import)  # where the start could not
        with self._database.change(sync=False) as connection:
            today, goal, mine = self._balance(_reader(connection), day, goal)
            over = None if move.judge is None else move.judge(today, mine)
            if over is not None:
                return Balance(day, today, goal, mine, over)
            _add(connection, day.isoformat(), goal, change)
        if move.judge is not None:
            self._sync_soon()
        return Balance(day, today + change, goal, mine + change)

    def _sync_soon(self) -> None:
        """Have the disk synced beside the call, which does not wait for it."""
        now_s = time.monotonic()
        busy = self._syncing is not None and not self._syncing.done()
        if not busy and now_s - self._synced_s >= SYNC_EVERY_S:
            self._synced_s = now_s
            self._syncing = self._syncer.submit(self._sync)

    def _sync(self) -> None:
        try:
            self._database.sync()
        except OSError as error:
            log.warning("what was spent is not safe from a power cut: %s", error.strerror)

    def _balance(
        self, read: Callable[..., list[tuple[Any, ...]]], day: date, goal: str
    ) -> tuple[Expense, str, Expense]:
        today = read(f"SELECT {_SUMS} FROM spent WHERE day = ?", (day.isoformat(),))
        mine = read(f"SELECT {_SUMS} FROM spent WHERE goal = ? AND {_IS_DAY}", (goal,))
        return _sum(today), goal, _sum(mine)

    def _set_aside(self, after: date) -> None:
        statement = f"UPDATE OR REPLACE spent SET day = day || ? WHERE {_IS_DAY} AND day > ?"
        try:
            with self._database.change() as connection:
                connection.execute(statement, (NOT_YET, after.isoformat()))
        except OSError as error:
            log.warning("later days could not be set aside: %s", error.strerror)

    # Beside it ----------------------------------------------------------------------------------

    def _ask(self, move: _Move) -> Future[Balance]:
        future = self._thread.submit(self._do, move)
        self._queue.append((future, move))
        return future

    def _collect(self) -> None:
        """Take in what the thread has done: in its order, so that nothing counts twice."""
        while self._queue and self._queue[0][0].done():
            future, move = self._queue.popleft()
            if future.cancelled():
                continue
            if (error := future.exception()) is not None:
                if move.corrects != Expense():  # it stays counted at its worst
                    log.warning("what a call came to can't be written: %s", error)
                continue
            found = future.result()
            self._days[found.day] = found.today
            if found.goal:
                self._goals.pop(found.goal, None)
                self._goals[found.goal] = found.mine
        while len(self._goals) > MAX_GOALS:
            del self._goals[next(iter(self._goals))]

    def _forget(self, oldest: date, begin: str) -> None:
        """Throw very old days away, and of days before ``begin`` what the goals spent apart."""
        old = self._database.read(
            "SELECT 1 FROM spent WHERE day < ? OR (day < ? AND goal != '') LIMIT 1",
            (oldest.isoformat(), begin),
        )
        if not old:
            return
        sums = f"SELECT day, '', {_SUMS} FROM spent WHERE day < ? GROUP BY day"
        try:
            with self._database.change() as connection:
                connection.execute("DELETE FROM spent WHERE day < ?", (oldest.isoformat(),))
                whole = connection.execute(sums, (begin,)).fetchall()
                connection.execute("DELETE FROM spent WHERE day < ?", (begin,))
                connection.executemany(_ADD, whole)
        except OSError as error:  # a later start does it
            log.warning("old spending is kept for now: %s", error.strerror)

    def _take_over(self) -> None:
        try:
            self._database.take_over(self._old_folder, self._import)
        except StateUnavailable as error:  # nothing can be spent either, and each call says so
            log.warning("%s can't be taken over: %s", self._old_folder, error.strerror)

    def _import(self, connection: sqlite3.Connection) -> None:
        """Take in the files of days; a line that can't be read counts as a call."""
        found = [(path, _NAME.fullmatch(path.name)) for path in sorted(self._old_folder.iterdir())]
        days = [(path, _date(name[1])) for path, name in found if name is not None]
        newest = max((day for _, day in days if day is not None), default=date.min)
        for path, day in days:
            if day is None or newest.toordinal() - day.toordinal() > KEPT_DAYS:
                continue
            with path.open("rb") as file:
                lines = file.read(MAX_DAY_BYTES).split(b"\n")
            for line in filter(bytes.strip, lines):
                goal, change = _read_line(line)
                _add(connection, day.isoformat(), goal[:MAX_ID], change)

    def _unreadable(self, error: OSError) -> ConfigError:
        """Return what refuses the start; a disk that may be mended by itself is tried again."""
        passing = isinstance(error, StateUnavailable) and not error.spoilt
        wrong = Unwritable if passing else ConfigError
        where = self._database.path if isinstance(error, StateUnavailable) else self._old_folder
        return wrong("budget_unreadable", f"{where}: {error.strerror}")


def _reader(connection: sqlite3.Connection) -> Callable[..., list[tuple[Any, ...]]]:
    return lambda query, values: connection.execute(query, values).fetchall()


def _add(connection: sqlite3.Connection, day: str, goal: str, change: Expense) -> None:
    amounts = (round(getattr(change, name), 9) for name in _FIELDS)
    connection.execute(_ADD, (day, goal, *amounts))


def _sum(rows: list[tuple[Any, ...]]) -> Expense:
    return _amounts_of(rows[0]) if rows else Expense()


def _amounts_of(sums: Any) -> Expense:
    calls, prompt_tokens, reply_tokens, seconds, money = sums
    return Expense(int(calls), int(prompt_tokens), int(reply_tokens), seconds, money)


def _read_line(line: bytes) -> tuple[str, Expense]:
    """Return the goal and change of a line of the layout before."""
    try:
        record = json.loads(line)
        goal = record.pop("goal")
        right = isinstance(goal, str) and all(
            isinstance(value, int | float) and abs(value) <= 1e12 for value in record.values()
        )
        return (goal, Expense(**record)) if right else ("", _UNREADABLE)
    except (ValueError, TypeError, KeyError, AttributeError, RecursionError):
        return "", _UNREADABLE


def _date(text: str) -> date | None:
    try:
        return date.fromisoformat(text)
    except ValueError:
        return None
