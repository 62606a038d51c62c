"""Record ticks from inside the loop: turn them into lines and hand them to the writer's pipe.

Owns the order of lines and the count of what is missing. Never waits and never raises: a full pipe
or a dead writer costs ticks of the record, never of the robot. The robot drives on without a
record; it is armed only with one.

Ticks are handed over five at a time: turning one into a line costs 11 us where the code for it is
warm and 80 us where ten milliseconds of other work lie between, the writer's waking included. A
bridge that is killed loses at most the last 40 ms of its record, one that raises loses nothing.
"""

from __future__ import annotations

import logging
from typing import TYPE_CHECKING

from bridge.recorder.format import TickFrame, segment_lines, tick_line
from bridge.recorder.pipe import WANTED_BYTES, LinePipe
from bridge.recorder.process import CAP_BYTES, ROTATE_BYTES, WriterProcess

if TYPE_CHECKING:
    from pathlib import Path

    from bridge.core import BridgeState, CoreConfig, Decision, Inbox

log = logging.getLogger("bridge.recorder")

SEGMENT_TICKS = 6_000
"""A minute: how much of a file is lost to replay at most when its beginning is damaged."""
TOGETHER = 5
"""Ticks handed over at once."""
REVIVE_EVERY_S = 1.0


class Recorder:
    """Be the one door to recordings for the loop."""

    def __init__(
        self,
        folder: Path,
        config: CoreConfig,
        *,
        rotate_bytes: int = ROTATE_BYTES,
        cap_bytes: int = CAP_BYTES,
        pipe_bytes: int = WANTED_BYTES,
    ) -> None:
        self._folder = folder
        self._config = config
        self._sizes = (rotate_bytes, cap_bytes, pipe_bytes)
        self._missing = 0
        """Ticks lost since the last one that was taken."""
        self._until_segment = 0
        self._kept: list[TickFrame] = []
        """Ticks not handed over yet."""
        self._before: BridgeState | None = None
        """The state before the first of them."""
        self._tried_s = float("-inf")
        self.gaps = 0
        """Ticks lost since start."""
        self._pipe, self._writer = self._start()

    @property
    def ok(self) -> bool:
        """Say whether ticks are being taken now."""
        return self._missing == 0 and not self._pipe.broken and self._running()

    @property
    def writer_pid(self) -> int | None:
        """Return the writer's process id, if one was ever started."""
        return None if self._writer is None else self._writer.pid

    def tick(self, state: BridgeState, inbox: Inbox, now_s: float, decision: Decision) -> None:
        """Take one tick: what the step was given and what it decided."""
        if not self._kept:
            self._before = state
        self._kept.append(
            TickFrame(
                tick=state.tick,
                now_s=now_s,
                inbox=inbox,
                command=decision.command,
                mode=decision.state.mode,
                reasons=decision.reasons,
            )
        )
        if len(self._kept) >= TOGETHER:
            self._hand_over()

    def rest(self, now_s: float) -> None:
        """Use a moment in which the robot has no torque: replace a dead writer, once a second.

        Dead means reaped: one that hangs over a failing disk would hang again.
        """
        if self._running() or not now_s - self._tried_s >= REVIVE_EVERY_S:
            return
        self._tried_s = now_s
        log.warning("recorder_revived: the writer had died")
        self._pipe.close()
        self._pipe, self._writer = self._start()
        self._until_segment = 0

    def close(self) -> bool:
        """Let the writer finish; say whether it did. After the loop only: it waits."""
        self._hand_over()
        self._pipe.flush()
        self._pipe.close()
        return self._writer is not None and self._writer.join()

    def _running(self) -> bool:
        return self._writer is not None and self._writer.alive()

    def _room(self) -> bool:
        """After a gap, wait until half the pipe is free: a segment is long, gaps come in rows."""
        if not self._pipe.flush():
            return False
        return self._missing == 0 or 2 * self._pipe.waiting_bytes() <= self._pipe.capacity_bytes

    def _hand_over(self) -> None:
        """Give the writer what was kept, all of it or nothing."""
        kept, before = self._kept, self._before
        if not kept or before is None:
            return
        if self._room() and self._pipe.send(self._lines(before, kept)):
            self._missing = 0
            self._until_segment -= len(kept)
        else:
            self._missing += len(kept)
            self.gaps += len(kept)
            self._until_segment = 0  # what was lost may have changed the state: say it anew
        kept.clear()

    def _lines(self, before: BridgeState, kept: list[TickFrame]) -> bytes:
        lines = [tick_line(frame) for frame in kept]
        if self._until_segment <= 0:
            self._until_segment = SEGMENT_TICKS
            lines.insert(0, segment_lines(self._config, self._missing, before))
        return b"".join(lines)

    def _start(self) -> tuple[LinePipe, WriterProcess | None]:
        rotate_bytes, cap_bytes, pipe_bytes = self._sizes
        pipe = LinePipe(pipe_bytes)
        writer = None
        try:
            writer = WriterProcess(
                self._folder,
                self._config.boot,
                pipe.read_fd,
                rotate_bytes=rotate_bytes,
                cap_bytes=cap_bytes,
            )
        except OSError as error:
            log.warning("recorder_not_started: %s", error)
        pipe.release_reader()
        return pipe, writer
