"""Keep the things remembered over a restart, as a table of ``$PONS_HOME``.

What is seen can be seen again: a row that is damaged or of another map is said and left behind,
never a reason not to start. Ages are kept by the wall clock, since a monotonic one ends with its
host; a wall clock that was set back makes nothing younger than now.
"""

from __future__ import annotations

import logging
import time
from typing import TYPE_CHECKING, Annotated

from pydantic import Field

from maps.yaml_records import SiteRecord, parse_json, read_bytes
from planner.perception.object_tracker import MOST_THINGS
from planner.perception.snapshot import Thing
from planner.site import SiteError
from planner.state_database import StateDatabase, StateUnavailable
from wire.bounded_types import Count, Fingerprint, Ratio
from wire.geometry import Metres

if TYPE_CHECKING:
    import sqlite3
    from collections.abc import Callable
    from pathlib import Path

log = logging.getLogger(__name__)

FILE = "objects.json"
"""Of the layout before: taken in, where it lies in the home folder."""
OLDEST_S = 365.0 * 86_400.0

Word = Annotated[str, Field(min_length=1, max_length=120)]
Wall = Annotated[float, Field(ge=0.0, le=1e11)]


class StoredThing(SiteRecord):
    """Mirror a thing; times are seconds of the wall clock."""

    id: Word
    label: Word
    color: Word | None
    x_m: Metres
    y_m: Metres
    z_m: Metres
    sigma_m: Annotated[float, Field(gt=0.0, le=100.0)]
    confidence: Ratio
    seen: Wall
    first: Wall
    sightings: Count
    room: Word | None = None


class StoredThings(SiteRecord):
    """Hold all that is kept, which is of one map; mirror objects.json of the layout before."""

    version: Annotated[int, Field(ge=1, le=1)] = 1
    map_id: Fingerprint
    things: Annotated[tuple[StoredThing, ...], Field(max_length=MOST_THINGS)] = ()


class ThingStore:
    """Be the table. Reads and writes the disk: call it off the event loop."""

    def __init__(
        self,
        database: StateDatabase,
        old_file: Path,
        map_id: str,
        *,
        wall: Callable[[], float] = time.time,
    ) -> None:
        self._database, self._old_file = database, old_file
        self._map_id, self._wall = map_id, wall

    @classmethod
    def in_home(cls, home: Path, map_id: str, database: StateDatabase | None = None) -> ThingStore:
        """Return what a home folder keeps."""
        return cls(database or StateDatabase(home), home / FILE, map_id)

    def load(self, now_s: float) -> tuple[Thing, ...]:
        """Return what was remembered on this map; nothing where it is not to be trusted."""
        try:
            kept = self._read_kept()
        except SiteError as error:
            log.warning("objects_unreadable: %s; what was seen before is forgotten", error)
            return ()
        except StateUnavailable as error:
            told = "objects_unreadable: %s: %s; what was seen before is forgotten"
            log.warning(told, self._database.path, error.strerror)
            return ()
        if kept is None:
            return ()
        if kept.map_id != self._map_id:
            log.warning("objects_of_another_map: %s of %s, here is %s; forgotten",
                        self._database.path, kept.map_id, self._map_id)  # fmt: skip
            return ()
        offset_s = now_s - self._wall()
        return tuple(_from_stored(thing, now_s, offset_s) for thing in kept.things)

    def save(self, things: tuple[Thing, ...], now_s: float) -> bool:
        """Put these in place of the stored ones; return whether they are on the disk."""
        offset_s = self._wall() - now_s
        kept = StoredThings(
            map_id=self._map_id, things=tuple(_to_stored(thing, offset_s) for thing in things)
        )
        try:
            self._database.take_over(self._old_file, self._import)  # where the start could not
            with self._database.change() as connection:
                _replace(connection, kept)
        except OSError as error:
            log.warning("objects_unwritable: %s: %s", self._database.path, error.strerror)
            return False
        return True

    def _read_kept(self) -> StoredThings | None:
        """Return what is kept, of whichever map; None where nothing is."""
        try:
            self._database.take_over(self._old_file, self._import)
        except StateUnavailable:  # a disk that can't be written at present can be read all the same
            return self._old_things()
        path = self._database.path
        rows = self._database.read("SELECT map_id, record FROM objects ORDER BY position")
        if not rows:
            return None
        things = tuple(parse_json(record.encode(), StoredThing, path) for _, record in rows)
        return StoredThings(map_id=rows[0][0], things=things[:MOST_THINGS])

    def _import(self, connection: sqlite3.Connection) -> None:
        """Take objects.json in; one that can't be read is said, and put beside all the same."""
        try:
            _replace(connection, self._old_things())
        except SiteError as error:
            log.warning("objects_unreadable: %s; what was seen before is forgotten", error)

    def _old_things(self) -> StoredThings:
        kept = parse_json(read_bytes(self._old_file), StoredThings, self._old_file)
        if len({thing.id for thing in kept.things}) != len(kept.things):
            text, zh = f"{self._old_file} gives an id twice", f"{self._old_file} 中有编号出现了两次"
            raise SiteError("value_malformed", text, zh)
        return kept


def _replace(connection: sqlite3.Connection, kept: StoredThings) -> None:
    rows = [(kept.map_id, thing.id, thing.model_dump_json()) for thing in kept.things]
    connection.execute("DELETE FROM objects")
    connection.executemany("INSERT INTO objects (map_id, id, record) VALUES (?, ?, ?)", rows)


def _to_stored(thing: Thing, offset_s: float) -> StoredThing:
    return StoredThing(
        id=thing.id, label=thing.label, color=thing.color, x_m=thing.x_m, y_m=thing.y_m,
        z_m=thing.z_m, sigma_m=thing.sigma_m, confidence=thing.confidence,
        seen=max(0.0, thing.seen_s + offset_s), first=max(0.0, thing.first_s + offset_s),
        sightings=thing.sightings, room=thing.room,
    )  # fmt: skip


def _from_stored(stored: StoredThing, now_s: float, offset_s: float) -> Thing:
    seen_s = max(now_s - OLDEST_S, min(now_s, stored.seen + offset_s))
    return Thing(
        id=stored.id, label=stored.label, color=stored.color, x_m=stored.x_m, y_m=stored.y_m,
        z_m=stored.z_m, sigma_m=stored.sigma_m, confidence=stored.confidence, seen_s=seen_s,
        first_s=min(seen_s, stored.first + offset_s), sightings=stored.sightings, room=stored.room,
    )  # fmt: skip
