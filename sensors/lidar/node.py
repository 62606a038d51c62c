"""Run one lidar's reader as a process: read the port, say each scan, say how well it is read."""

from __future__ import annotations

import logging
import time
from typing import TYPE_CHECKING

from sensors.lidar.health import STARTING
from wire import keys

if TYPE_CHECKING:
    from collections.abc import Callable

    from sensors.lidar.reader import LidarReader
    from wire.session import Session

log = logging.getLogger("lidar")

PERIOD_S = 0.005
"""Bytes wait so long at most; reading more often than a frame comes costs more than it brings."""
STATE_S = 0.5


class LidarNode:
    """Connect one reader to the wire."""

    def __init__(self, reader: LidarReader, session: Session) -> None:
        self._reader = reader
        self._scan = session.publisher(keys.SCAN)
        self._state = session.publisher(keys.LIDAR_STATE)
        self._said_s = float("-inf")
        self._code: str | None = STARTING
        self._seq = 0

    def run(self, stopped: Callable[[], bool]) -> None:
        """Read until told to stop; missed periods are skipped."""
        next_s = time.monotonic()
        while not stopped():
            time.sleep(max(0.0, next_s - time.monotonic()))
            now_s = time.monotonic()
            next_s = max(next_s + PERIOD_S, now_s)
            self.turn(now_s)

    def turn(self, now_s: float) -> None:
        """Say the scans that became whole, and twice a second how well the lidar is read."""
        for scan in self._reader.turn(now_s):
            self._scan.put(scan)
        verdict = self._reader.judge(now_s)
        code = verdict.code if verdict else None
        if code == self._code and now_s - self._said_s < STATE_S:
            return
        if code != self._code:
            log.log(
                logging.INFO if code in (None, STARTING) else logging.WARNING,
                "%s",
                f"{code}: {verdict.detail}" if verdict else "the lidar is read well",
            )
        self._code, self._said_s = code, now_s
        self._seq += 1
        self._state.put(self._reader.status(self._seq, now_s))
