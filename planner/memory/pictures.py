"""Keep the pictures that patrols took, one of each stop, in a table of ``state.sqlite``.

Laws: what was forgotten is never returned again, and a thing that is forgotten takes every picture
of its kind along; nothing older than the owner set is returned, and a picture of somebody grows as
old as a memory of somebody; count and bytes are bounded, the oldest go first. The table is made by
the first picture. Blocks on the disk: never called in the event loop.
"""

from __future__ import annotations

import json
from typing import TYPE_CHECKING, Any

from planner.memory.records import PERSON, THING, KeptPicture, MemoryLimits

if TYPE_CHECKING:
    import sqlite3
    from collections.abc import Sequence

    from planner.state_database import StateDatabase

MAX_PICTURE_BYTES = 1_000_000
"""A larger one is not kept: at 640 by 480 a JPEG has a tenth of it."""
_TABLE = "pictures"
_SCHEMA = f"""
CREATE TABLE IF NOT EXISTS {_TABLE} (
    id INTEGER PRIMARY KEY AUTOINCREMENT, goal TEXT NOT NULL, step INTEGER NOT NULL,
    stop INTEGER NOT NULL, place TEXT NOT NULL, taken_s REAL NOT NULL, media_type TEXT NOT NULL,
    labels TEXT NOT NULL, size INTEGER NOT NULL, data BLOB NOT NULL, UNIQUE (goal, step, stop))
"""
_COLUMNS = "id, goal, step, stop, place, taken_s, media_type, labels, size"
MEDIA_TYPES = {b"\xff\xd8": "image/jpeg", b"\x89P": "image/png"}
"""By the first two bytes of a picture as a camera gives it."""


class PictureStore:
    """Write and read the table. Any thread may use it, in turns."""

    def __init__(self, database: StateDatabase, limits: MemoryLimits) -> None:
        self._database, self._limits = database, limits

    def keep(self, picture: KeptPicture, data: bytes) -> bool:
        """Keep a stop's picture in place of one that shows less; return whether it was kept.

        Raises:
            StateUnavailable: the disk refuses.
        """
        limits, size = self._limits, len(data)
        most = min(MAX_PICTURE_BYTES, limits.most_picture_bytes)
        if not (0 < size <= most and limits.most_pictures > 0 and self._age_s(picture) > 0.0):
            return False
        key = (picture.goal, picture.step, picture.stop)
        with self._database.change(sync=False) as connection:
            connection.execute(_SCHEMA)
            before = connection.execute(
                f"SELECT labels, taken_s FROM {_TABLE} WHERE goal = ? AND step = ? AND stop = ?",
                key,
            ).fetchone()
            if before is not None and _shows_more(before, picture):
                return False
            connection.execute(
                f"REPLACE INTO {_TABLE} (goal, step, stop, place, taken_s, media_type, labels,"
                " size, data) VALUES (?, ?, ?, ?, ?, ?, ?, ?, ?)",
                (*key, picture.place, picture.taken_unix_s, picture.media_type,
                 json.dumps(picture.labels), size, data),
            )  # fmt: skip
            _drop_oldest(connection, limits)
        return True

    def list(self, now_unix_s: float, goal: str | None = None) -> tuple[KeptPicture, ...]:
        """Return what is kept, the newest patrol first and its stops in their order.

        Raises:
            StateUnavailable: the disk refuses.
        """
        if not self._exists():
            return ()
        where, values = ("WHERE goal = ?", (goal,)) if goal is not None else ("", ())
        rows = self._database.read(
            f"SELECT {_COLUMNS} FROM {_TABLE} {where} ORDER BY goal DESC, step, stop", values
        )
        kept = (each for each in map(_picture, rows) if self._is_kept(each, now_unix_s))
        newest: dict[str, float] = {}
        found = tuple(kept)
        for each in found:
            newest[each.goal] = max(newest.get(each.goal, 0.0), each.taken_unix_s)
        return tuple(sorted(found, key=lambda p: (-newest[p.goal], p.goal, p.step, p.stop)))

    def get(self, picture_id: int, now_unix_s: float) -> tuple[KeptPicture, bytes] | None:
        """Return one picture with its bytes, or None.

        Raises:
            StateUnavailable: the disk refuses.
        """
        if not self._exists():
            return None
        rows = self._database.read(
            f"SELECT {_COLUMNS}, data FROM {_TABLE} WHERE id = ?", (picture_id,)
        )
        if not rows:
            return None
        picture = _picture(rows[0][:-1])
        return (picture, bytes(rows[0][-1])) if self._is_kept(picture, now_unix_s) else None

    def forget(self, picture_id: int) -> bool:
        """Forget one picture; return whether there was one.

        Raises:
            StateUnavailable: the disk refuses.
        """
        return self._delete("id = ?", (picture_id,)) > 0

    def forget_kinds(self, labels: Sequence[str]) -> int:
        """Forget every picture that shows such a kind of thing, or a person; return how many.

        Raises:
            StateUnavailable: the disk refuses.
        """
        tests = " OR ".join("labels LIKE ? ESCAPE '!'" for _ in labels)
        patterns = tuple(f"%{_escape(json.dumps(label))}%" for label in labels)
        return self._delete(tests, patterns) if labels else 0

    def forget_all(self, kinds: Sequence[str]) -> int:
        """Forget what memories of these kinds would show; a picture always shows things.

        Raises:
            StateUnavailable: the disk refuses.
        """
        if THING in kinds:
            return self._delete("1", ())
        return self.forget_kinds((PERSON,)) if PERSON in kinds else 0

    def prune(self, now_unix_s: float) -> int:
        """Forget what is older than the owner set; return how many went.

        Raises:
            StateUnavailable: the disk refuses.
        """
        if not self._exists():
            return 0
        rows = self._database.read(f"SELECT {_COLUMNS} FROM {_TABLE}")
        old = [each.id for each in map(_picture, rows) if not self._is_kept(each, now_unix_s)]
        return sum(self._delete("id = ?", (each,)) for each in old)

    def _delete(self, where: str, values: tuple[object, ...]) -> int:
        if not self._exists():
            return 0
        with self._database.change() as connection:
            gone = connection.execute(f"DELETE FROM {_TABLE} WHERE {where}", values).rowcount
        if gone:
            self._database.compact()
        return int(gone)

    def _exists(self) -> bool:
        return bool(self._database.read("SELECT 1 FROM sqlite_master WHERE name = ?", (_TABLE,)))

    def _age_s(self, picture: KeptPicture) -> float:
        """Return how old a picture may become [s]."""
        things_s, people_s = self._limits.age_s(THING), self._limits.age_s(PERSON)
        return min(things_s, people_s) if PERSON in picture.labels else things_s

    def _is_kept(self, picture: KeptPicture, now_unix_s: float) -> bool:
        return now_unix_s - picture.taken_unix_s < self._age_s(picture)


def _shows_more(before: tuple[Any, ...], picture: KeptPicture) -> bool:
    """Tell whether the picture before shows more, and is of the same stay at the stop."""
    labels, taken_s = json.loads(before[0]), float(before[1])
    same_stay = picture.taken_unix_s - taken_s < STAY_S
    return same_stay and len(labels) >= len(picture.labels)


STAY_S = 120.0
"""A look round at one stop takes less; a later picture is of another round."""


def _drop_oldest(connection: sqlite3.Connection, limits: MemoryLimits) -> None:
    rows = connection.execute(f"SELECT id, size FROM {_TABLE} ORDER BY taken_s DESC, id DESC")
    total, gone = 0, []
    for number, (id_, size) in enumerate(rows.fetchall(), 1):
        total += size
        if number > limits.most_pictures or total > limits.most_picture_bytes:
            gone.append((id_,))
    connection.executemany(f"DELETE FROM {_TABLE} WHERE id = ?", gone)


def _escape(text: str) -> str:
    return text.replace("!", "!!").replace("%", "!%").replace("_", "!_")


def _picture(row: tuple[Any, ...]) -> KeptPicture:
    id_, goal, step, stop, place, taken_s, media_type, labels, size = row
    return KeptPicture(
        goal=goal, step=step, stop=stop, place=place, labels=tuple(json.loads(labels)),
        media_type=media_type, taken_unix_s=taken_s, id=id_, size=size,
    )  # fmt: skip
