"""Thin finished recordings out, so that incidents are kept for weeks: ``FOLDER BOOT CAP_BYTES``.

A file is rewritten in two stages, each under a name that says so. ``NAME.idle.mcap``: of each
minute in which the robot was neither to move nor near an incident only the first second is left.
``NAME.kept.mcap``: only the minutes round incidents are left. What is kept begins where a segment
begins, with the whole state, and is kept message for message, so that it replays exactly as before;
what is missing shows as a gap. Chunks are larger than the loop's and packed harder: nobody waits.

Runs as a process of its own at the lowest priority, started by the writer when a file has ended. It
may be killed at any instant: a file is replaced by one that is whole and on the disk, or not.
"""

from __future__ import annotations

import fcntl
import logging
import os
import signal
import sys
import time
from contextlib import suppress
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Final

from bridge.recording.incidents import EVENT, incidents_of, is_incident
from bridge.recording.mcap_copy import McapCopy
from bridge.recording.mcap_reader import BadRecording, McapReader
from bridge.recording.rotation import IDLE_SUFFIX, KEPT_SUFFIX, SUFFIX, Stage, stage_of
from processes.priority import add_nice

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from bridge.recording.mcap_reader import Raw

log = logging.getLogger("bridge.recording.thinning")

ROUND_NS: Final = 60_000_000_000
"""So long before and after an incident all is kept."""
IDLE_KEPT_NS: Final = 1_000_000_000
"""Of each idle minute."""
KEPT_DAYS: Final = 30
KEPT_SHARE: Final = 0.75
"""Of all bytes, for what was reduced to incidents; the rest is for whole files."""
SPARE_FILES: Final = 3
"""So many whole files' room is made ahead, so that the writer's own pruning finds nothing to do."""
PART: Final = ".part"
_BOOT, _DECISION = "/pons/boot", "/pons/decision"
_MOVING: Final = (
    b'"mode":"ACTIVE"',
    b'"mode":"TELEOP"',
    b'"mode":"STOPPING"',
    b'"mode":"SELFTEST"',
)
_NICE: Final = 19


@dataclass(slots=True)
class RecordedSegment:
    """Hold what decides on a minute: when it began and ended, and whether the robot was to move."""

    begin_ns: int
    end_ns: int = 0
    is_idle: bool = True
    incidents: list[int] = field(default_factory=list)


def survey(path: Path) -> list[RecordedSegment]:
    """Return a recording's segments in order; what comes before the first is in none.

    Raises:
        BadRecording: it can't be read.
    """
    found: list[RecordedSegment] = []
    with McapReader(path) as box:
        for raw in box.messages():
            if raw.topic == _BOOT:
                found.append(RecordedSegment(raw.at_ns))
            if not found:
                continue
            now = found[-1]
            now.end_ns = raw.at_ns
            if raw.topic == _DECISION and now.is_idle:
                now.is_idle = not any(mode in raw.data for mode in _MOVING)
            elif raw.topic == EVENT and is_incident(raw.data):
                now.incidents.append(raw.at_ns)
    return found


def kept_until(
    segments: Sequence[RecordedSegment], incidents: Sequence[int], stage: Stage
) -> list[int]:
    """Return for each segment up to which time it is kept; 0: nothing of it.

    Args:
        segments: of one file.
        incidents: of that file and its neighbours, as times in ns.
        stage: what the file is to become.
    """
    kept = []
    for segment in segments:
        near = [
            at_ns + ROUND_NS
            for at_ns in incidents
            if at_ns - ROUND_NS <= segment.end_ns and segment.begin_ns <= at_ns + ROUND_NS
        ]
        until_ns = max(near, default=0)
        if stage is Stage.IDLE_THINNED:
            alone_ns = segment.begin_ns + IDLE_KEPT_NS if segment.is_idle else segment.end_ns
            until_ns = max(until_ns, alone_ns)
        kept.append(until_ns)
    return kept


def rewrite(path: Path, stage: Stage, incidents: Sequence[int]) -> Path | None:
    """Put a thinned file in a recording's place; return it, None where nothing is left.

    Raises:
        BadRecording: it can't be read; it stays.
        OSError: the disk refuses; it stays.
    """
    segments = survey(path)
    limits = kept_until(
        segments, [*incidents, *(at for s in segments for at in s.incidents)], stage
    )
    if not any(limits):
        path.unlink()
        return None
    info = path.stat()
    name = path.name.removesuffix(SUFFIX).removesuffix(IDLE_SUFFIX.removesuffix(SUFFIX))
    target = path.with_name(name + (IDLE_SUFFIX if stage is Stage.IDLE_THINNED else KEPT_SUFFIX))
    part = target.with_name(target.name + PART)
    part.unlink(missing_ok=True)
    with McapReader(path) as box:
        copy = McapCopy(part, box.definitions())
        try:
            for raw in _read_kept(box, limits):
                copy.add(raw)
            copy.close()
        except BaseException:
            copy.abandon()
            raise
    os.utime(part, ns=(info.st_atime_ns, info.st_mtime_ns))  # files go by their age
    part.replace(target)
    path.unlink()
    return target


def _read_kept(box: McapReader, limits: Sequence[int]) -> Iterator[Raw]:
    """Yield what is kept, whole ticks: a tick's messages have one time."""
    number = -1
    for raw in box.messages():
        number += raw.topic == _BOOT
        if number >= 0 and raw.at_ns <= limits[number]:
            yield raw


class Thinner:
    """Thin one folder of recordings out, as far as it needs it."""

    def __init__(self, folder: Path, boot: str, cap_bytes: int, file_bytes: int) -> None:
        """Look after a folder.

        Args:
            folder: of the recordings.
            boot: of the bridge that runs: its newest files may still go on.
            cap_bytes: of all together.
            file_bytes: of one whole file.
        """
        self._folder, self._boot = folder, boot
        self._cap_bytes, self._spare_bytes = cap_bytes, SPARE_FILES * file_bytes
        self._kept_bytes = min(
            KEPT_SHARE * cap_bytes, cap_bytes - 2 * file_bytes - self._spare_bytes
        )
        self._incidents: dict[Path, list[int]] = {}

    def run(self, now_unix_s: float) -> None:
        """Thin idle time out, reduce the oldest where room is short, forget what is too old."""
        for part in self._folder.glob(f"*{PART}"):
            part.unlink()
        for path in self._list_ended():
            if stage_of(path) is Stage.WHOLE:
                self._rewrite(path, Stage.IDLE_THINNED)
        for path in self._list_ended():
            if self._total() + self._spare_bytes <= self._cap_bytes:
                break
            if stage_of(path) is not Stage.KEPT:
                self._rewrite(path, Stage.KEPT)
        self._forget(now_unix_s)

    def _list_ended(self) -> list[Path]:
        """Return the files that have ended and whose next one is known, oldest first."""
        every = sorted(self._folder.glob(f"*{SUFFIX}"), key=_age)
        own = [path for path in every if f"-{self._boot}-" in path.name]
        return [path for path in every if path not in own[-2:]]

    def _rewrite(self, path: Path, stage: Stage) -> None:
        try:
            near = [at for other in self._neighbours(path) for at in self._incidents_of(other)]
            rewrite(path, stage, near)
        except (BadRecording, OSError) as error:
            log.warning("not_thinned: %s: %s", path.name, error)

    def _neighbours(self, path: Path) -> list[Path]:
        """Return the files of the same run just before and after one."""
        boot = path.name.split("-")[1:2]
        every = sorted(self._folder.glob(f"*{SUFFIX}"), key=_age)
        run = [other for other in every if other.name.split("-")[1:2] == boot]
        at = run.index(path)
        return run[max(0, at - 1) : at] + run[at + 1 : at + 2]

    def _incidents_of(self, path: Path) -> list[int]:
        """Return when its incidents were; none of one that can't be read."""
        if path not in self._incidents:
            with suppress(BadRecording, OSError), McapReader(path) as box:
                self._incidents[path] = [raw.at_ns for raw in incidents_of(box)]
        return self._incidents.get(path, [])

    def _forget(self, now_unix_s: float) -> None:
        kept = [path for path in self._list_ended() if stage_of(path) is Stage.KEPT]
        sizes = {path: path.stat().st_size for path in kept}
        for path in kept:
            is_old = now_unix_s - path.stat().st_mtime > KEPT_DAYS * 86_400.0
            if is_old or sum(sizes.values()) > self._kept_bytes:
                path.unlink()
                del sizes[path]

    def _total(self) -> int:
        return sum(path.stat().st_size for path in self._folder.glob(f"*{SUFFIX}"))


def _age(path: Path) -> tuple[float, str]:
    try:
        return path.stat().st_mtime, path.name
    except OSError:
        return 0.0, path.name  # a person removed it meanwhile


def main(arguments: list[str]) -> int:
    """Thin a folder out, unless another process is at it; 0."""
    folder, boot, cap_bytes, file_bytes = arguments
    signal.signal(signal.SIGTERM, signal.SIG_DFL)  # the writer, whose child this is, ignores it
    add_nice(_NICE, own_session=True)
    lock = os.open(folder, os.O_RDONLY | os.O_DIRECTORY | os.O_CLOEXEC)
    with suppress(BlockingIOError):
        fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
        Thinner(Path(folder), boot, int(cap_bytes), int(file_bytes)).run(time.time())
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
