"""Write frames into MCAP files and report trouble. Owns which file is open.

It never gives up: where the disk is full or gone, what comes is thrown away and said so, and every
second it is tried again. A new file begins with a segment only, so one is asked for.
"""

from __future__ import annotations

import json
import logging
from errno import EDQUOT, ENOSPC
from typing import TYPE_CHECKING

from bridge.recording import foxglove_messages, pipe_frames
from bridge.recording.mcap_file import McapFile
from bridge.recording.rotation import free_bytes, next_path, prune
from bridge.recording.topics import OF_KIND, topics

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable
    from pathlib import Path

    from bridge.recording.topics import RecordedTopic

log = logging.getLogger("bridge.recording")

MIN_FREE_BYTES = 4 << 20
"""Less is a full disk: what fits into it would be written and fail within seconds."""

_FULL = frozenset({ENOSPC, EDQUOT})


class Writer:
    """Hold the open file and the last tick's time, ranges and lidar pose."""

    def __init__(
        self,
        folder: Path,
        boot: str,
        rotate_bytes: int,
        cap_bytes: int,
        clock: foxglove_messages.UnixClock,
        on_new_file: Callable[[], None] = lambda: None,
    ) -> None:
        """Write into a folder; ``on_new_file`` is called when one was begun."""
        self._on_new_file = on_new_file
        self._folder, self._boot = folder, boot
        self._rotate_bytes, self._cap_bytes = rotate_bytes, cap_bytes
        self._clock = clock
        self._topics: dict[str, RecordedTopic] = {}
        self._file: McapFile | None = None
        self._failing = ""
        self._tick, self._now_s, self._at_ns = 0, 0.0, 0
        self._ranges: bytes | None = None
        self._lidar = (0.0, 0.0, 0.0)
        self._unsaid: set[str] = set()

    def take(self, kind: bytes, payload: bytes, unix_s: float) -> None:
        """Write one frame. Never raises for the disk's failures."""
        if kind == pipe_frames.TICK:
            self._tick, self._now_s = pipe_frames.TICK_OF.unpack(payload)
            self._at_ns = max(self._at_ns, self._clock.ns(self._now_s))
            self._ranges = None
        elif kind == pipe_frames.RANGES:
            self._ranges = payload
        elif kind == pipe_frames.SCHEMAS:
            self._topics = topics(json.loads(payload))
        else:
            if kind == pipe_frames.BOOT:
                self._begin(unix_s)
            if self._file is not None:
                for topic, data in self._worth(kind, payload):
                    self._file.add(topic, self._at_ns, self._tick & 0xFFFFFFFF, data)

    def beat(self) -> bytes:
        """Flush the file and return the answer for the loop."""
        if self._file is not None:
            try:
                self._file.flush()
            except OSError as error:
                self._fail(error)
        if self._file is None and not self._failing:
            return pipe_frames.word(pipe_frames.NEXT)  # nothing came yet, or all is well again
        if self._file is not None:
            full = self._file.size_bytes >= self._rotate_bytes
            return pipe_frames.word(pipe_frames.FULL if full else pipe_frames.WRITING)
        word = pipe_frames.word(pipe_frames.FAILING, self._failing)
        self._failing = self._still_failing()
        return word

    def sync(self) -> None:
        """Bring the flushed bytes to the disk itself."""
        if self._file is not None:
            try:
                self._file.sync()
            except OSError as error:
                self._fail(error)

    def close(self) -> None:
        """End the last file."""
        file, self._file = self._file, None
        if file is not None:
            try:
                file.close()
            except OSError as error:
                file.abandon()
                self._failing = _describe_failure(error, self._folder)

    def _worth(self, kind: bytes, payload: bytes) -> list[tuple[str, bytes]]:
        """Return a frame's messages: Foxglove's first, then its own.

        The record matters more than its looks: what can't be said again is left out, and said once.
        """
        try:
            made = list(self._well_known(kind, payload))
        except (KeyError, TypeError, ValueError) as error:
            made = []
            if OF_KIND[kind] not in self._unsaid:
                self._unsaid.add(OF_KIND[kind])
                log.warning("recorder_unsaid: %s is not shown to viewers: %r", OF_KIND[kind], error)
        return [*made, (OF_KIND[kind], payload)]

    def _well_known(self, kind: bytes, payload: bytes) -> Iterable[tuple[str, bytes]]:
        clock, now_s = self._clock, self._now_s
        if kind == pipe_frames.INBOX:
            return foxglove_messages.from_inbox(payload, self._ranges, self._lidar, clock, now_s)
        if kind == pipe_frames.ODOMETRY:
            return [foxglove_messages.from_odometry(payload, clock, now_s)]
        if kind == pipe_frames.STATUS:
            return foxglove_messages.from_status(payload, clock, now_s)
        if kind == pipe_frames.EVENT:
            return [foxglove_messages.from_event(payload, clock, now_s)]
        if kind == pipe_frames.BOOT:
            self._lidar = foxglove_messages.from_boot(payload)
        return ()

    def _begin(self, unix_s: float) -> None:
        """Go on in the open file, or begin one where there is none or it is full."""
        if self._file is not None:
            if self._file.size_bytes < self._rotate_bytes:
                return
            self.close()
        try:
            self._folder.mkdir(parents=True, exist_ok=True)
            prune(self._folder, self._boot, self._cap_bytes, self._rotate_bytes)
            self._demand_room()
            self._file = McapFile(next_path(self._folder, self._boot, unix_s), self._topics)
            self._failing = ""
            self._on_new_file()
        except OSError as error:
            self._fail(error)

    def _demand_room(self) -> None:
        if (free := free_bytes(self._folder)) < MIN_FREE_BYTES:
            raise OSError(
                ENOSPC, f"disk full, {free >> 10} KiB free of {MIN_FREE_BYTES >> 10} needed"
            )

    def _still_failing(self) -> str:
        """Return why writing still can't work; empty where the next segment may try."""
        try:
            self._folder.mkdir(parents=True, exist_ok=True)
            prune(self._folder, self._boot, self._cap_bytes, self._rotate_bytes)
            self._demand_room()
        except OSError as error:
            return _describe_failure(error, self._folder)
        return ""

    def _fail(self, error: OSError) -> None:
        file, self._file = self._file, None
        if file is not None:
            file.abandon()
        self._failing = _describe_failure(error, self._folder)


def _describe_failure(error: OSError, folder: Path) -> str:
    code = "disk_full" if error.errno in _FULL else "recorder_down"
    return f"{code}: {error.strerror or error} in {folder}"
