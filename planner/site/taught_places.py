"""Keep the places that people taught, as a table of ``$PONS_HOME``. Judges nothing.

All of a change is on disk or nothing changed. Each place keeps the fingerprint of the map it was
taught on. ``places.json``, as it was before and as people may write it, is taken in where it lies
in the home folder at a start.
"""

from __future__ import annotations

import errno
from datetime import datetime
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Literal

from pydantic import Field

from maps.errors import SiteError
from maps.file_errors import system_reason_zh
from maps.yaml_records import SiteRecord, parse_json, read_bytes
from planner.site.fence import Outline
from planner.site.places import Names, Place, PlaceId
from planner.site.taught_place_errors import PlaceRefusal
from planner.state_database import StateDatabase, StateUnavailable
from wire.bounded_types import Fingerprint, Name
from wire.geometry import Pose2

if TYPE_CHECKING:
    import sqlite3

FILE = "places.json"
MAX_HERE = 32
"""On one map: each costs a prompt about 20 tokens."""
MAX_KEPT = 512
"""On all maps together."""


class TaughtPlace(SiteRecord):
    """Hold one taught place: its names, where it is, on which map, by whom and when."""

    id: PlaceId
    name: Names
    pose: Pose2  # in ``map``
    map_id: Fingerprint
    by: Name
    taught: datetime
    polygon: Outline | None = None
    """In ``map`` [m], where a room that was proposed got a name; None for a spot."""

    def as_place(self) -> Place:
        """Return it as any other room or place of the site."""
        kind: Literal["room", "place"] = "place" if self.polygon is None else "room"
        outline = self.polygon
        return Place(id=self.id, kind=kind, name=self.name, pose=self.pose, polygon=outline)


class TaughtFile(SiteRecord):
    """Mirror places.json."""

    version: Annotated[int, Field(ge=1, le=1)] = 1
    places: Annotated[tuple[TaughtPlace, ...], Field(max_length=MAX_KEPT)] = ()


class TaughtPlaces:
    """Be the table. Reads and writes the disk: call it off the event loop."""

    def __init__(self, database: StateDatabase, old_file: Path) -> None:
        """Say where they are kept, and where ``places.json`` may lie."""
        self._database, self._old_file = database, old_file

    @classmethod
    def in_home(cls, home: Path, database: StateDatabase | None = None) -> TaughtPlaces:
        """Return the places of a home folder."""
        return cls(database or StateDatabase(home), home / FILE)

    def load(self) -> tuple[TaughtPlace, ...]:
        """Return the taught places; none where nothing ever was taught.

        Raises:
            SiteError: a file or a row can't be read or is not ours. It is never passed over: what a
                person taught must not be lost by the next write.
        """
        try:
            self._database.take_over(self._old_file, self._import)
        except StateUnavailable:  # a disk that can't be written at present can be read all the same
            return self._old_places()
        path = self._database.path
        try:
            rows = self._database.read("SELECT record FROM places ORDER BY position")
        except StateUnavailable as error:
            text, zh = f"cannot read {path}: {error.strerror}", system_reason_zh(error)
            raise SiteError("site_file_missing", text, f"无法读取 {path}：{zh}") from error
        return tuple(parse_json(record.encode(), TaughtPlace, path) for (record,) in rows)

    def save(self, places: tuple[TaughtPlace, ...]) -> None:
        """Put these in place of the taught ones; either all are on disk, or nothing changed.

        Raises:
            PlaceRefusal: ``disk_full`` or ``places_unwritable``.
        """
        try:
            self._database.take_over(self._old_file, self._import)  # where the start could not
            with self._database.change() as connection:
                _replace(connection, places)
        except OSError as error:
            full = error.errno in (errno.ENOSPC, errno.EDQUOT)
            code = "disk_full" if full else "places_unwritable"
            raise PlaceRefusal(code, f"{self._database.path}: {error.strerror}") from None

    def _import(self, connection: sqlite3.Connection) -> None:
        _replace(connection, self._old_places())

    def _old_places(self) -> tuple[TaughtPlace, ...]:
        record = parse_json(read_bytes(self._old_file), TaughtFile, self._old_file)
        ids = [(place.map_id, place.id) for place in record.places]
        if len(set(ids)) != len(ids):
            text, zh = f"{self._old_file}: an id is given twice", f"{self._old_file}：有编号"
            raise SiteError("place_duplicate_id", text, f"{zh}出现了两次")
        return record.places


def _replace(connection: sqlite3.Connection, places: tuple[TaughtPlace, ...]) -> None:
    rows = [(place.map_id, place.id, place.model_dump_json()) for place in places]
    connection.execute("DELETE FROM places")
    connection.executemany("INSERT INTO places (map_id, id, record) VALUES (?, ?, ?)", rows)
