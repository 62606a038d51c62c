"""Keep what was seen and told as one table of ``$PONS_HOME/state.sqlite``, with its FTS5 index.

Laws: what was forgotten is never returned again; nothing older than the owner set is returned; the
newest comes first; no more rows than the bounds, the oldest go first. Blocks on the disk: never
called in the event loop.
"""

from __future__ import annotations

from math import hypot
from typing import TYPE_CHECKING, Any

from planner.memory.fact_check import clean_fact, refuse_fact
from planner.memory.index_terms import index_text, match_query
from planner.memory.pictures import PictureStore
from planner.memory.records import FACT, KINDS, PERSON, THING, Memo, MemoryLimits

if TYPE_CHECKING:
    import sqlite3
    from collections.abc import Iterable, Sequence

    from planner.memory.records import MemoryQuery, ObjectSighting
    from planner.state_database import StateDatabase

SAME_SPOT_M = 0.6
"""A thing of the same kind and colour so near is the same, and where it was."""
THING_GAP_S = 6 * 3600.0
"""Not seen for longer, a thing makes a new memory: "yesterday" then means what was seen then."""
PERSON_GAP_S = 600.0
"""Somebody in the same room within this is one visit."""
MOST_FOUND = 200
_COLUMNS = (
    "id, kind, first_s, last_s, words, label, color, map_id, room, support, x_m, y_m, confidence,"
    " sightings, step, said_by, thing_id"
)
_IMPORTED = "objects table"


class MemoryStore:
    """Write and read the table. Any thread may use it, in turns."""

    def __init__(self, database: StateDatabase, limits: MemoryLimits | None = None) -> None:
        self._database, self.limits = database, limits or MemoryLimits()
        self.pictures = PictureStore(database, self.limits)

    # In -----------------------------------------------------------------------------------------

    def see(self, sightings: Iterable[ObjectSighting], *, sync: bool = False) -> int:
        """Keep sightings, each joined to what is the same; return how many were new.

        Raises:
            StateUnavailable: the disk refuses.
        """
        wanted = [each for each in sightings if self.limits.age_s(each.kind) > 0.0]
        if not wanted:
            return 0
        with self._database.change(sync=sync) as connection:
            new = sum(_join_or_add(connection, each) for each in wanted)
            if new:
                _drop_oldest(connection, (THING, PERSON), self.limits.most_sightings)
        return new

    def see_once(self, sightings: Sequence[ObjectSighting]) -> bool:
        """Take in what the objects table of an older version holds, once; return whether it did.

        Raises:
            StateUnavailable: the disk refuses.
        """
        done = self._database.read("SELECT 1 FROM imports WHERE path = ?", (_IMPORTED,))
        if done:
            return False
        with self._database.change() as connection:
            for each in sightings:
                if self.limits.age_s(each.kind) > 0.0:
                    _join_or_add(connection, each)
            connection.execute("REPLACE INTO imports VALUES (?, 'taken')", (_IMPORTED,))
        return True

    def teach(
        self,
        text: str,
        now_unix_s: float,
        *,
        said_by: str,
        room: str | None = None,
        map_id: str = "",
    ) -> Memo:
        """Keep a fact; the same words again renew it.

        Raises:
            FactRefusal: its words can't be kept, or there are too many.
            StateUnavailable: the disk refuses.
        """
        words = clean_fact(text)
        if not self.limits.facts_days > 0.0:
            raise refuse_fact("facts_off", "[memory] facts_days = 0")
        with self._database.change() as connection:
            connection.execute(
                "DELETE FROM memory WHERE kind = ? AND words = ? COLLATE NOCASE", (FACT, words)
            )
            (count,) = connection.execute(
                "SELECT count(*) FROM memory WHERE kind = ?", (FACT,)
            ).fetchone()
            if not count < self.limits.most_facts:
                raise refuse_fact("facts_full", f"{count} facts are kept", most=count)
            row = connection.execute(
                "INSERT INTO memory (kind, first_s, last_s, words, map_id, room, said_by)"
                " VALUES (?, ?, ?, ?, ?, ?, ?)",
                (FACT, now_unix_s, now_unix_s, words, map_id, room, said_by[:80]),
            ).lastrowid
            _index(connection, int(row or 0), index_text(words))
        return Memo(
            id=int(row or 0), kind=FACT, first_unix_s=now_unix_s, last_unix_s=now_unix_s,
            words=words, room=room, map_id=map_id, said_by=said_by[:80],
        )  # fmt: skip

    # Out ----------------------------------------------------------------------------------------

    def find(self, query: MemoryQuery, now_unix_s: float) -> tuple[Memo, ...]:
        """Return what fits, the newest first; where nothing fits whole, what fits in part.

        A memo that fits whole has ``fits``. Words that say nothing ask for everything.

        Raises:
            StateUnavailable: the disk refuses.
        """
        if not query.words.strip():
            return self._select(query, now_unix_s, None, fits=False)
        exact = match_query(query.words)
        if exact is None:
            return ()
        found = self._select(query, now_unix_s, exact, fits=True)
        loose = match_query(query.words, loosely=True)
        return found or (self._select(query, now_unix_s, loose, fits=False) if loose else ())

    def get(self, memo_id: int) -> Memo | None:
        """Return one memory, or None.

        Raises:
            StateUnavailable: the disk refuses.
        """
        rows = self._database.read(f"SELECT {_COLUMNS} FROM memory WHERE id = ?", (memo_id,))
        return _memo(rows[0], fits=False) if rows else None

    def counts(self) -> dict[str, int]:
        """Return how many memories of each kind are kept.

        Raises:
            StateUnavailable: the disk refuses.
        """
        rows = self._database.read("SELECT kind, count(*) FROM memory GROUP BY kind")
        return dict.fromkeys(KINDS, 0) | {str(kind): int(count) for kind, count in rows}

    def _select(
        self, query: MemoryQuery, now_unix_s: float, match: str | None, *, fits: bool
    ) -> tuple[Memo, ...]:
        where, values = _conditions(query, self.limits, now_unix_s)
        table = "memory"
        if match is not None:  # the join's order is ours: the index of words goes first
            table = "memory_terms CROSS JOIN memory ON memory.id = memory_terms.rowid"
            where.insert(0, "memory_terms MATCH ?")
            values.insert(0, match)
        limit = max(0, min(query.limit, MOST_FOUND))
        rows = self._database.read(
            f"SELECT {_COLUMNS} FROM {table} WHERE {' AND '.join(where)}"
            " ORDER BY last_s DESC, id DESC LIMIT ?",
            (*values, limit),
        )
        return tuple(_memo(row, fits=fits) for row in rows)

    # Away ---------------------------------------------------------------------------------------

    def forget(self, memo_ids: Sequence[int]) -> tuple[Memo, ...]:
        """Forget these for good; return those that were there.

        Raises:
            StateUnavailable: the disk refuses.
        """
        gone = [memo for each in memo_ids if (memo := self.get(each)) is not None]
        if gone:
            with self._database.change() as connection:
                connection.executemany(
                    "DELETE FROM memory WHERE id = ?", [(memo.id,) for memo in gone]
                )
                _compact(connection)
            self._database.compact()
            self.pictures.forget_kinds(sorted({memo.label for memo in gone if memo.label}))
        return tuple(gone)

    def forget_about(self, words: str, kinds: tuple[str, ...] = KINDS) -> tuple[Memo, ...]:
        """Forget all that these words name whole; return it.

        Raises:
            StateUnavailable: the disk refuses.
        """
        match = match_query(words)
        if match is None:
            return ()
        marks = ", ".join("?" for _ in kinds)
        rows = self._database.read(
            f"SELECT id FROM memory WHERE kind IN ({marks})"
            " AND id IN (SELECT rowid FROM memory_terms WHERE memory_terms MATCH ?)",
            (*kinds, match),
        )
        return self.forget([int(each) for (each,) in rows])

    def forget_things(self, thing_ids: Sequence[str]) -> tuple[Memo, ...]:
        """Forget what was seen of tracked things; return it.

        Raises:
            StateUnavailable: the disk refuses.
        """
        rows: list[tuple[Any, ...]] = []
        for thing in thing_ids:
            rows += self._database.read("SELECT id FROM memory WHERE thing_id = ?", (thing,))
        return self.forget([int(each) for (each,) in rows])

    def forget_all(self, kinds: tuple[str, ...] = KINDS) -> int:
        """Forget all of these kinds; return how many there were.

        Raises:
            StateUnavailable: the disk refuses.
        """
        marks = ", ".join("?" for _ in kinds)
        with self._database.change() as connection:
            gone = connection.execute(f"DELETE FROM memory WHERE kind IN ({marks})", kinds).rowcount
            _compact(connection)
        self._database.compact()
        self.pictures.forget_all(kinds)
        return int(gone)

    def prune(self, now_unix_s: float) -> int:
        """Forget what is older than the owner set; return how many went.

        Raises:
            StateUnavailable: the disk refuses.
        """
        self.pictures.prune(now_unix_s)
        old = [(kind, now_unix_s - self.limits.age_s(kind)) for kind in KINDS]
        test = " OR ".join("(kind = ? AND NOT last_s > ?)" for _ in old)
        values = tuple(value for pair in old for value in pair)
        if not self._database.read(f"SELECT 1 FROM memory WHERE {test} LIMIT 1", values):
            return 0
        with self._database.change() as connection:
            gone = connection.execute(f"DELETE FROM memory WHERE {test}", values).rowcount
            _compact(connection)
        return int(gone)


def _conditions(
    query: MemoryQuery, limits: MemoryLimits, now_unix_s: float
) -> tuple[list[str], list[Any]]:
    """Return the tests of a question besides its words; nothing that is too old passes."""
    kinds = [kind for kind in KINDS if kind in query.kinds]
    oldest = {kind: now_unix_s - limits.age_s(kind) for kind in kinds}
    # A plus keeps SQLite from any index but that of time, which ends early with the newest.
    aged = [f"(+kind = '{kind}' AND last_s > ?)" for kind in kinds]
    where = ["last_s >= ?", f"({' OR '.join(aged) or '0'})"]
    since = query.since_unix_s if query.since_unix_s is not None else float("-inf")
    first = max(min(oldest.values(), default=now_unix_s), since)
    values: list[Any] = [first, *oldest.values()]
    if query.place is not None:
        where.append("+room = ?")
        values.append(query.place)
    if query.until_unix_s is not None:
        where.append("first_s <= ?")
        values.append(query.until_unix_s)
    return where, values


def _join_or_add(connection: sqlite3.Connection, seen: ObjectSighting) -> bool:
    """Join a sighting to the memory of the same thing at the same spot, or add one."""
    gap_s = PERSON_GAP_S if seen.kind == PERSON else THING_GAP_S
    rows = connection.execute(
        "SELECT id, x_m, y_m FROM memory WHERE kind = ? AND label = ? AND map_id = ?"
        " AND color IS ? AND room IS ? AND last_s >= ? AND first_s <= ?"
        " ORDER BY last_s DESC LIMIT 50",
        (seen.kind, seen.label, seen.map_id, _color(seen), seen.room,
         seen.first_unix_s - gap_s, seen.seen_unix_s + gap_s),
    ).fetchall()  # fmt: skip
    for row, x_m, y_m in rows:
        if seen.kind == PERSON or hypot(x_m - seen.x_m, y_m - seen.y_m) <= SAME_SPOT_M:
            connection.execute(
                "UPDATE memory SET last_s = max(last_s, ?), sightings = sightings + 1,"
                " confidence = max(confidence, ?), x_m = ?, y_m = ?, thing_id = ?,"
                " support = coalesce(?, support) WHERE id = ?",
                (seen.seen_unix_s, seen.confidence, seen.x_m, seen.y_m, seen.thing_id,
                 seen.support, row),
            )  # fmt: skip
            return False
    row = connection.execute(
        "INSERT INTO memory (kind, first_s, last_s, label, color, map_id, room, support, x_m, y_m,"
        " confidence, step, thing_id) VALUES (?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?)",
        (seen.kind, min(seen.first_unix_s, seen.seen_unix_s), seen.seen_unix_s, seen.label,
         _color(seen), seen.map_id, seen.room, seen.support, seen.x_m, seen.y_m, seen.confidence,
         seen.step[:40], seen.thing_id),
    ).lastrowid  # fmt: skip
    _index(connection, int(row or 0), index_text("", seen.label, _color(seen)))
    return True


def _color(seen: ObjectSighting) -> str | None:
    """Return a thing's colour; a shirt's is not a person's."""
    return None if seen.kind == PERSON else seen.color


def _index(connection: sqlite3.Connection, row: int, terms: str) -> None:
    connection.execute("INSERT INTO memory_terms (rowid, terms) VALUES (?, ?)", (row, terms))


def _drop_oldest(connection: sqlite3.Connection, kinds: tuple[str, ...], most: int) -> None:
    marks = ", ".join("?" for _ in kinds)
    connection.execute(
        f"DELETE FROM memory WHERE id IN (SELECT id FROM memory WHERE kind IN ({marks})"
        " ORDER BY last_s DESC, id DESC LIMIT -1 OFFSET ?)",
        (*kinds, most),
    )


def _compact(connection: sqlite3.Connection) -> None:
    """Write the index anew, so that no word of what was forgotten is left in its old segments."""
    connection.execute("INSERT INTO memory_terms (memory_terms) VALUES ('optimize')")


def _memo(row: tuple[Any, ...], *, fits: bool) -> Memo:
    (id_, kind, first_s, last_s, words, label, color, map_id, room, support, x_m, y_m, confidence,
     sightings, step, said_by, thing_id) = row  # fmt: skip
    return Memo(
        id=id_, kind=kind, first_unix_s=first_s, last_unix_s=last_s, words=words, label=label,
        color=color, map_id=map_id, room=room, support=support, x_m=x_m, y_m=y_m,
        confidence=confidence, sightings=sightings, step=step, said_by=said_by, thing_id=thing_id,
        fits=fits,
    )  # fmt: skip
