"""Name recordings and remove the oldest when there are too many.

A name holds the UTC time at which the file began, the bridge's boot, and its number within that, so
names sort by time. The oldest go first, and this boot's own last, for a host without a clock may
believe that it is 1970. What was reduced to incidents goes after all others: thinning.py bounds it.
"""

from __future__ import annotations

import os
import time
from enum import IntEnum
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from pathlib import Path

SUFFIX = ".mcap"
IDLE_SUFFIX, KEPT_SUFFIX = ".idle.mcap", ".kept.mcap"
"""Of recordings that were thinned out (thinning.py): what was idle, all but incidents."""
OLD_SUFFIX = ".jsonl.gz"
"""Written before there were MCAP files; they count, and go first by their age."""
KEEP_FREE_BYTES = 64 << 20
"""Left to everybody else on this disk before old recordings are."""
ALWAYS_KEPT = 2
"""Finished files that stay, however full the disk is."""


class Stage(IntEnum):
    """Name how much of a recording is left."""

    WHOLE = 0
    IDLE_THINNED = 1
    KEPT = 2
    """The minutes round incidents alone."""


def stage_of(path: Path) -> Stage:
    """Return how much of a recording is left, by its name."""
    if path.name.endswith(KEPT_SUFFIX):
        return Stage.KEPT
    return Stage.IDLE_THINNED if path.name.endswith(IDLE_SUFFIX) else Stage.WHOLE


def next_path(folder: Path, boot: str, unix_s: float) -> Path:
    """Return a name that is not taken yet."""
    began = time.strftime("%Y%m%dT%H%M%SZ", time.gmtime(unix_s))
    number = sum(1 for _ in folder.glob(f"*-{boot}-*{SUFFIX}"))
    while True:
        path = folder / f"{began}-{boot}-{number:03d}{SUFFIX}"
        if not path.exists():
            return path
        number += 1


def free_bytes(folder: Path) -> int:
    """Return the bytes that an ordinary user may still write there."""
    info = os.statvfs(folder)
    return info.f_bavail * info.f_frsize


def prune(folder: Path, boot: str, cap_bytes: int, room_bytes: int) -> list[Path]:
    """Remove the oldest recordings until they fit under the cap with room for one more file.

    Where the disk itself is nearly full, old recordings go too, but never the newest few.
    """
    kept = _oldest_first(folder, boot)
    total_bytes = sum(size for _, size in kept)
    gone = []
    while kept and (
        total_bytes + room_bytes > cap_bytes
        or (len(kept) > ALWAYS_KEPT and free_bytes(folder) < KEEP_FREE_BYTES)
    ):
        path, size = kept.pop(0)
        path.unlink(missing_ok=True)
        total_bytes -= size
        gone.append(path)
    return gone


def _oldest_first(folder: Path, boot: str) -> list[tuple[Path, int]]:
    found = []
    for suffix in (SUFFIX, OLD_SUFFIX):
        for path in folder.glob(f"*{suffix}"):
            try:
                info = path.stat()
            except FileNotFoundError:
                continue  # a person removed it meanwhile
            own = f"-{boot}-" in path.name
            kept = stage_of(path) is Stage.KEPT  # little, and all that is left of its day
            found.append((kept, own, info.st_mtime_ns, path.name, path, info.st_size))
    return [(path, size) for *_, path, size in sorted(found)]
