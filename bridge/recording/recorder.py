"""Record ticks from inside the loop: turn them into frames and hand them to the writing process.

Owns the order of frames and the count of what is missing. Never waits and never raises: a full
pipe, a full disk or a dead writer costs ticks of the record, never of the robot. The robot drives
on without a record, says so, and is armed only with one.

Ticks are handed over twenty at a time: turning one into bytes costs a quarter of what it does where
ten milliseconds of other work lie between, the writer's waking included. A bridge that is killed
loses at most the last 190 ms of its record, one that raises loses nothing.
"""

from __future__ import annotations

import logging
import time
from typing import TYPE_CHECKING

from bridge.recording.encode import schema_frame, segment_frames, tick_frames
from bridge.recording.format import core_of, schemas
from bridge.recording.health import DOWN, Health
from bridge.recording.writer_process import Sizes, WriterProcess
from processes.pipe import WANTED_BYTES, Pipe

if TYPE_CHECKING:
    from pathlib import Path

    from bridge.core import BridgeState, CoreConfig, Decision, Inbox

log = logging.getLogger("bridge.recording")

SEGMENT_TICKS = 6_000
"""A minute: how much of a file is lost to replay at most when its beginning is damaged."""
TOGETHER = 20
"""Ticks handed over at once."""
CLOSES_WITHIN_S = 1.0
REVIVE_FIRST_S, REVIVE_MOST_S = 1.0, 30.0
"""A writer that dies is replaced after so long, twice as long each time it dies young."""


class Recorder:
    """Take ticks from the loop and hand them to the writing process in batches."""

    def __init__(
        self,
        folder: Path,
        config: CoreConfig,
        sizes: Sizes | None = None,
        *,
        pipe_bytes: int = WANTED_BYTES,
    ) -> None:
        self._folder = folder
        self._config = config
        self._sizes = sizes or Sizes.of(config.robot.recording)
        self._pipe_bytes = pipe_bytes
        said = schemas()
        self._core = core_of(said)
        self._schemas = schema_frame(said)
        self._offset_s = time.time() - time.monotonic()  # one for all files of this run
        self._missing = 0
        """Ticks lost since the last one that was taken."""
        self._until_segment = 0
        self._kept: list[tuple[BridgeState, Inbox, float, Decision]] = []
        """Ticks not handed over yet."""
        self._now_s: float | None = None
        self._revive_s: float | None = None
        self._wait_s = REVIVE_FIRST_S
        self._born_s = 0.0
        """When the writer was started; the first one's is before the first tick."""
        self.gaps = 0
        """Ticks lost since start, as far as this end knows."""
        self.trouble = f"{DOWN}: the writing process begins a file"
        """Why no ticks are being written, by code and sentence; empty where they are. Looked at
        when ticks are handed over: each look costs a system call."""
        self._schemas_due = True
        self._health = Health(None)
        self._pipe, self._writer = self._start_writer()

    @property
    def writer_pid(self) -> int | None:
        """Return the writer's process id, if one was ever started."""
        return None if self._writer is None else self._writer.pid

    @property
    def backlog_bytes(self) -> int:
        """Return how many bytes the writer has not taken yet."""
        return self._pipe.waiting_bytes()

    def tick(self, state: BridgeState, inbox: Inbox, now_s: float, decision: Decision) -> None:
        """Take one tick: the step's arguments and its decision."""
        self._kept.append((state, inbox, now_s, decision))
        self._now_s = now_s
        if len(self._kept) >= TOGETHER:
            alive = self._look_after(now_s)
            self._hand_over()
            self.trouble = self._judge(now_s, alive=alive)

    def close(self) -> bool:
        """Let the writer finish; say whether it did. After the loop only: it waits."""
        self._hand_over()
        end_s = time.monotonic() + CLOSES_WITHIN_S
        while not (self._pipe.flush() or self._pipe.broken) and time.monotonic() < end_s:
            time.sleep(0.01)
        self._pipe.close()
        return self._writer is not None and self._writer.join()

    def _judge(self, now_s: float, *, alive: bool) -> str:
        if not alive or self._pipe.broken:
            return f"{DOWN}: the writing process has died"
        said = self._health.trouble(now_s)
        if not said and self._missing:
            return f"{DOWN}: the writing process lags, {self._missing} ticks are missing"
        return said

    def _look_after(self, now_s: float) -> bool:
        """Read the writer's answers and replace a dead one; return whether it lives.

        Dead means reaped: one that hangs over a failing disk would hang again.
        """
        writer = self._writer
        if writer is not None:
            if words := writer.words():
                self._health.hear(words, now_s)
            if writer.alive() and not self._pipe.broken:
                if now_s - self._born_s >= REVIVE_MOST_S:
                    self._wait_s = REVIVE_FIRST_S
                return True
        if self._revive_s is None:
            self._revive_s = now_s + self._wait_s
            log.warning("recorder_died: the next is started in %.0f s", self._wait_s)
        elif now_s >= self._revive_s:
            self._wait_s = min(2 * self._wait_s, REVIVE_MOST_S)
            self._born_s = now_s
            self._restart()
            return self._writer is not None
        return False

    def _room(self) -> bool:
        """After a gap, wait until half the pipe is free: a segment is long, gaps come in rows."""
        if not self._pipe.flush():
            return False
        return self._missing == 0 or 2 * self._pipe.waiting_bytes() <= self._pipe.capacity_bytes

    def _hand_over(self) -> None:
        """Send the writer all kept ticks, or none."""
        kept = self._kept
        if not kept:
            return
        if not self._health.failing and self._room() and self._pipe.send(self._frames()):
            self._missing = 0
            self._until_segment -= len(kept)
            self._schemas_due = False
        else:
            self._missing += len(kept)
            self.gaps += len(kept)
            self._until_segment = 0  # what was lost may have changed the state: say it anew
        kept.clear()

    def _frames(self) -> bytes:
        out: list[bytes] = []
        if self._schemas_due:
            out.append(self._schemas)
        if self._until_segment <= 0 or self._health.wants_segment:
            self._until_segment = SEGMENT_TICKS
            self._health.wants_segment = False
            out.append(segment_frames(self._config, self._core, self._kept[0][0]))
        for state, inbox, now_s, decision in self._kept:
            tick_frames(out, state, inbox, now_s, decision)
        return b"".join(out)

    def _restart(self) -> None:
        self._pipe.close()
        if self._writer is not None:
            self._writer.forget()
        self._revive_s = None
        self._until_segment = 0
        self._schemas_due = True
        self._health = Health(self._now_s)
        self._pipe, self._writer = self._start_writer()

    def _start_writer(self) -> tuple[Pipe, WriterProcess | None]:
        pipe, writer = Pipe(self._pipe_bytes), None
        try:
            writer = WriterProcess(
                self._folder, self._config.boot, pipe.read_fd, self._sizes, self._offset_s
            )
        except OSError as error:
            log.warning("recorder_not_started: %s", error)
        else:
            log.info("recorder_started: pid %d", writer.pid)
        pipe.release_reader()
        return pipe, writer
