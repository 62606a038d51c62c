"""Keep the places that people taught, in one file of ``$PONS_HOME``. Owns the file, judges nothing.

The file is whole at every instant: a new text is written beside it, brought to the disk and put in
its place by one rename. Each place keeps the fingerprint of the map it was taught on.
"""

from __future__ import annotations

import errno
import logging
import os
from datetime import datetime
from pathlib import Path
from typing import Annotated

from pydantic import Field

from maps.errors import SiteError
from maps.yaml_records import Record, parse_json, read_bytes
from planner.site.places import Names, Place, PlaceId
from planner.site.taught_place_errors import PlaceRefused
from wire.bounded_types import Fingerprint, Name
from wire.geometry import Pose2

log = logging.getLogger(__name__)

FILE = "places.json"
MAX_HERE = 32
"""On one map: each costs a prompt about 20 tokens."""
MAX_KEPT = 512
"""On all maps together."""


class TaughtPlace(Record):
    """Hold one taught place: its names, where it is, on which map, by whom and when."""

    id: PlaceId
    name: Names
    pose: Pose2  # in ``map``
    map_id: Fingerprint
    by: Name
    taught: datetime

    def as_place(self) -> Place:
        """Return it as any other place of the site."""
        return Place(id=self.id, kind="place", name=self.name, pose=self.pose)


class TaughtFile(Record):
    """Mirror places.json."""

    version: Annotated[int, Field(ge=1, le=1)] = 1
    places: Annotated[tuple[TaughtPlace, ...], Field(max_length=MAX_KEPT)] = ()


class TaughtPlaces:
    """Be the file. Reads and writes the disk: call it off the event loop."""

    def __init__(self, path: Path) -> None:
        self._path = path

    @classmethod
    def in_home(cls, home: Path) -> TaughtPlaces:
        """Return the file of a home folder."""
        return cls(home / FILE)

    def load(self) -> tuple[TaughtPlace, ...]:
        """Return what was taught; nothing where nothing ever was.

        Raises:
            SiteError: the file can't be read or is not ours. It is never passed over: what a person
                taught must not be lost by the next write.
        """
        if not self._path.exists():
            return ()
        record = parse_json(read_bytes(self._path), TaughtFile, self._path)
        ids = [(place.map_id, place.id) for place in record.places]
        if len(set(ids)) != len(ids):
            raise SiteError("place_duplicate_id", f"{self._path}: an id is given twice")
        return record.places

    def save(self, places: tuple[TaughtPlace, ...]) -> None:
        """Put these in place of what was taught; either all of it is on disk, or nothing changed.

        Raises:
            PlaceRefused: ``disk_full`` or ``places_unwritable``.
        """
        text = TaughtFile(places=places).model_dump_json(indent=1) + "\n"
        beside = self._path.with_suffix(".new")
        try:
            _write(beside, text.encode())
            beside.replace(self._path)
        except OSError as error:
            _drop(beside)
            full = error.errno in (errno.ENOSPC, errno.EDQUOT)
            code = "disk_full" if full else "places_unwritable"
            raise PlaceRefused(code, f"{self._path}: {error.strerror}") from None
        _settle(self._path.parent)


def _write(path: Path, data: bytes) -> None:
    path.parent.mkdir(parents=True, exist_ok=True)
    with path.open("wb") as file:
        file.write(data)
        file.flush()
        os.fsync(file.fileno())


def _drop(path: Path) -> None:
    try:
        path.unlink(missing_ok=True)
    except OSError as error:
        log.warning("%s is left over: %s", path, error.strerror)


def _settle(folder: Path) -> None:
    """Bring the rename itself to the disk; it is done for every reader already."""
    try:
        descriptor = os.open(folder, os.O_RDONLY)
        try:
            os.fsync(descriptor)
        finally:
            os.close(descriptor)
    except OSError as error:
        log.warning("the rename in %s may not outlive a power cut: %s", folder, error.strerror)
