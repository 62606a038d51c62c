"""Read one lidar's port: say what it must be told, decode what comes, give whole scans.

Told the time by its caller, and never waits. Knows the port by four members alone, so that tests
and lockstep read from memory.
"""

from __future__ import annotations

import logging
from collections import deque
from typing import TYPE_CHECKING, Protocol

from sensors.lidar.health import LidarCounts, LidarHealth, LidarVerdict
from sensors.lidar.turn import TurnCollector
from wire import LidarStatus

if TYPE_CHECKING:
    from devices import PortTrouble
    from sensors.lidar.kinds import LidarKind
    from sensors.lidar.turn import ScanShape
    from wire import Scan

log = logging.getLogger("lidar")

MOST_READS = 8
"""At 4096 bytes a read, more than the fastest line brings between two turns of the loop."""
GAP_S = 0.005
"""Between two requests: an RPLidar wants 1 ms after STOP."""
GREET_S = 2.0
"""A lidar that is silent for so long is asked again: it may have begun anew."""
RESCUE_EACH = 3
"""Each third time it is begun anew, which clears the fault in which it has shut its laser off."""
FROZEN_S = 0.25
"""After such a pause of this process what lies in the port is thrown away: it is older than any
scan may be, and some of it may be lost."""


class LidarPort(Protocol):
    """Read and write without waiting, as devices.LastingPort does."""

    opened: int
    trouble: PortTrouble | None

    def read(self) -> bytes:
        """Return the bytes that came."""

    def write(self, data: bytes) -> bool:
        """Take a whole message or nothing."""


class LidarReader:
    """Hold one lidar's decoder and turns, and its health."""

    def __init__(self, kind: LidarKind, port: LidarPort, path: str, boot_id: str) -> None:
        self._kind, self._port, self._boot_id = kind, port, boot_id
        self._decoder = kind.decoder()
        self._collector = self._new_collector()
        self._before = LidarCounts()
        """What decoders and collectors before these counted."""
        self._received_bytes = 0
        self._opened = 0
        self._requests: deque[bytes] = deque()
        self._greeted_s = self._sent_s = self._turned_s = float("-inf")
        self._greetings = 0
        self._seq = 0
        self.health = LidarHealth(kind, path)

    @property
    def shape(self) -> ScanShape:
        """Return what its scans look like."""
        return self._kind.shape

    @property
    def counts(self) -> LidarCounts:
        """Return all that was read since the start."""
        decoder, collector, before = self._decoder, self._collector, self._before
        return LidarCounts(
            received_bytes=before.received_bytes + self._received_bytes,
            frames=before.frames + decoder.frames,
            spoilt=before.spoilt + decoder.spoilt,
            lost_bytes=before.lost_bytes + decoder.lost_bytes,
            turns=before.turns + collector.turns,
            broken_turns=before.broken_turns + collector.broken,
            gaps=before.gaps + collector.gaps,
        )

    def turn(self, now_s: float) -> list[Scan]:
        """Read what came, answer what must be answered; return the scans that became whole."""
        slept_s, self._turned_s = now_s - self._turned_s, now_s
        if self._port.opened != self._opened:
            self._opened = self._port.opened
            self._greetings = 0
            self.health.note_opening(now_s)
            self._greet(now_s)
        elif FROZEN_S < slept_s < float("inf"):
            self._skip_old_bytes(slept_s)
        scans = self._read(now_s)
        self._send(now_s)
        return scans

    def judge(self, now_s: float) -> LidarVerdict | None:
        """Return what is wrong now; None where nothing is."""
        return self.health.judge(self._port.trouble, now_s)

    def status(self, seq: int, now_s: float) -> LidarStatus:
        """Return what the lidar's process tells people."""
        counts, verdict = self.counts, self.judge(now_s)
        return LidarStatus(
            boot_id=self._boot_id,
            seq=seq,
            stamp_s=now_s,
            model=self._kind.name,
            code=verdict.code if verdict else None,
            detail=verdict.detail[:400] if verdict else "",
            rate_hz=round(self.health.rate_hz, 2),
            frames=counts.frames,
            spoilt=counts.spoilt,
            lost_bytes=counts.lost_bytes,
            broken_turns=counts.broken_turns,
            opened=self._port.opened,
        )

    def close(self) -> None:
        """Ask the lidar to rest."""
        for request in self._decoder.closing:
            self._port.write(request)

    def _read(self, now_s: float) -> list[Scan]:
        scans = []
        came = b""
        for _ in range(MOST_READS):
            data = self._port.read()
            if not data:
                break
            came += data
            for beams in self._decoder.feed(data, now_s):
                for turn in self._collector.add(beams):
                    self._seq += 1
                    scans.append(self._kind.shape.scan(turn, self._boot_id, self._seq))
        self._received_bytes += len(came)
        self.health.note(self.counts, came, now_s)
        return scans

    def _greet(self, now_s: float) -> None:
        """Forget all that came and send the opening requests, or the one that begins it anew."""
        self._before = self.counts
        self._received_bytes, self._collector = 0, self._new_collector()
        self._decoder = self._kind.decoder()
        self._greeted_s = now_s
        self._greetings += 1
        rescues = self._decoder.rescue and self._greetings % RESCUE_EACH == 0
        self._requests = deque((self._decoder.rescue,) if rescues else self._decoder.opening)

    def _send(self, now_s: float) -> None:
        if self._requests:
            if now_s - self._sent_s >= GAP_S and self._port.write(self._requests[0]):
                self._requests.popleft()
                self._sent_s = now_s
        elif (
            self._decoder.opening
            and self._port.trouble is None
            and now_s - self._greeted_s > GREET_S
            and self.health.silent_s(now_s) > GREET_S
        ):
            self._greet(now_s)

    def _skip_old_bytes(self, slept_s: float) -> None:
        log.warning("frozen for %.2f s; what came meanwhile is thrown away", slept_s)
        for _ in range(MOST_READS):
            skipped = len(self._port.read())
            self._received_bytes += skipped
            if not skipped:
                break
        self._decoder.forget()
        self._collector.forget()

    def _new_collector(self) -> TurnCollector:
        return TurnCollector(self._kind.decoder().max_gap_deg, self._kind.shape.cuts)
