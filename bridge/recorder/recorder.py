"""Record ticks from inside the loop: turn them into lines and hand them to the writer's pipe.

Owns the order of lines and the count of what is missing. Never waits and never raises: a full pipe
or a dead writer costs ticks of the record, never of the robot. The robot drives on without a
record; it is armed only with one.
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
        """Hand over one tick: what the step was given and what it decided."""
        if self._room() and self._pipe.send(self._lines(state, inbox, now_s, decision)):
            self._missing = 0
            self._until_segment -= 1
        else:
            self._missing += 1
            self.gaps += 1
            self._until_segment = 0  # what was lost may have changed the state: say it anew

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

    def _lines(self, state: BridgeState, inbox: Inbox, now_s: float, decision: Decision) -> bytes:
        line = tick_line(
            TickFrame(
                tick=state.tick,
                now_s=now_s,
                inbox=inbox,
                command=decision.command,
                mode=decision.state.mode,
                reasons=decision.reasons,
            )
        )
        if self._until_segment > 0:
            return line
        self._until_segment = SEGMENT_TICKS
        return segment_lines(self._config, self._missing, state) + line

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
