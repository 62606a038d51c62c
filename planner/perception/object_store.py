"""Keep the things remembered over a restart, in one file of ``$PONS_HOME``. Owns the file alone.

What is seen can be seen again: a file that is damaged or of another map is said and left behind,
never a reason not to start. Ages are kept by the wall clock, since a monotonic one ends with its
host; a wall clock that was set back makes nothing younger than now.
"""

from __future__ import annotations

import logging
import os
import time
from typing import TYPE_CHECKING, Annotated

from pydantic import Field

from maps.yaml_records import Record, parse_json, read_bytes
from planner.perception.object_tracker import MOST_THINGS
from planner.perception.snapshot import Thing
from planner.site import SiteError
from wire.bounded_types import Count, Fingerprint, Ratio
from wire.geometry import Metres

if TYPE_CHECKING:
    from collections.abc import Callable
    from pathlib import Path

log = logging.getLogger(__name__)

FILE = "objects.json"
PRIVATE = 0o600
"""Where people were seen in a home is its owner's business, whatever the umask is."""
OLDEST_S = 365.0 * 86_400.0

Word = Annotated[str, Field(min_length=1, max_length=120)]
Wall = Annotated[float, Field(ge=0.0, le=1e11)]


class StoredThing(Record):
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


class StoredThings(Record):
    """Mirror objects.json."""

    version: Annotated[int, Field(ge=1, le=1)] = 1
    map_id: Fingerprint
    things: Annotated[tuple[StoredThing, ...], Field(max_length=MOST_THINGS)] = ()


class ThingStore:
    """Be the file. Reads and writes the disk: call it off the event loop."""

    def __init__(self, path: Path, map_id: str, *, wall: Callable[[], float] = time.time) -> None:
        self._path, self._map_id, self._wall = path, map_id, wall

    @classmethod
    def in_home(cls, home: Path, map_id: str) -> ThingStore:
        """Return the file of a home folder."""
        return cls(home / FILE, map_id)

    def load(self, now_s: float) -> tuple[Thing, ...]:
        """Return what was remembered on this map; nothing where the file is not to be trusted."""
        if not self._path.exists():
            return ()
        try:
            kept = parse_json(read_bytes(self._path), StoredThings, self._path)
        except SiteError as error:
            log.warning("objects_unreadable: %s; what was seen before is forgotten", error)
            return ()
        if kept.map_id != self._map_id:
            log.warning("objects_of_another_map: %s of %s, here is %s; forgotten",
                        self._path, kept.map_id, self._map_id)  # fmt: skip
            return ()
        if len({thing.id for thing in kept.things}) != len(kept.things):
            log.warning("objects_unreadable: %s gives an id twice; forgotten", self._path)
            return ()
        offset_s = now_s - self._wall()
        return tuple(_recalled(thing, now_s, offset_s) for thing in kept.things)

    def save(self, things: tuple[Thing, ...], now_s: float) -> bool:
        """Put these in place of what was kept; say whether they are on the disk."""
        offset_s = self._wall() - now_s
        record = StoredThings(
            map_id=self._map_id, things=tuple(_stored(thing, offset_s) for thing in things)
        )
        beside = self._path.with_suffix(".new")
        try:
            self._path.parent.mkdir(parents=True, exist_ok=True)
            with open(beside, "wb", opener=_private) as file:
                file.write(record.model_dump_json().encode() + b"\n")
                file.flush()
                os.fsync(file.fileno())
            beside.replace(self._path)
        except OSError as error:
            log.warning("objects_unwritable: %s: %s", self._path, error.strerror)
            return False
        return True


def _private(path: str, flags: int) -> int:
    """Open a file that nobody else may read, one that was left there too."""
    descriptor = os.open(path, flags, PRIVATE)
    try:
        os.fchmod(descriptor, PRIVATE)
    except OSError:  # another user's
        os.close(descriptor)
        raise
    return descriptor


def _stored(thing: Thing, offset_s: float) -> StoredThing:
    return StoredThing(
        id=thing.id, label=thing.label, color=thing.color, x_m=thing.x_m, y_m=thing.y_m,
        z_m=thing.z_m, sigma_m=thing.sigma_m, confidence=thing.confidence,
        seen=max(0.0, thing.seen_s + offset_s), first=max(0.0, thing.first_s + offset_s),
        sightings=thing.sightings, room=thing.room,
    )  # fmt: skip


def _recalled(stored: StoredThing, now_s: float, offset_s: float) -> Thing:
    seen_s = max(now_s - OLDEST_S, min(now_s, stored.seen + offset_s))
    return Thing(
        id=stored.id, label=stored.label, color=stored.color, x_m=stored.x_m, y_m=stored.y_m,
        z_m=stored.z_m, sigma_m=stored.sigma_m, confidence=stored.confidence, seen_s=seen_s,
        first_s=min(seen_s, stored.first + offset_s), sightings=stored.sightings, room=stored.room,
    )  # fmt: skip
