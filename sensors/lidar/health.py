"""Judge how well a lidar is read: what came, how much of it was good, how fast it turns.

Told counts and times; knows no port and no clock of its own. What it says is for people: a bridge
that gets no scan stands still without it.
"""

from __future__ import annotations

from collections import deque
from dataclasses import dataclass
from typing import TYPE_CHECKING

from sensors.lidar.kinds import recognize

if TYPE_CHECKING:
    from devices import PortTrouble
    from sensors.lidar.kinds import LidarKind

WINDOW_S = 2.0
STEP_S = 0.1
SILENT_S = 0.5
"""Five turns."""
START_S = 3.0
"""A motor comes up to speed meanwhile; an RPLidar that was reset answers again."""
READABLE_S = 1.0
"""From the first bytes after an opening to the first good frame, at most."""
TURN_S = 1.0
"""Without a whole turn, though frames come."""
LOST_SHARE = 0.01
"""Of the bytes: a line in order loses none but those before the first frame, and a frame of 38 that
is lost in a turn of an LD19 costs the turn."""
GAP_SHARE = 0.25
"""Of the turns: bytes that never came are lost to no decoder, and show in gaps alone."""
NOISE_SHARE = 0.5
"""Of the bytes: an RPLidar's standard answer finds a beam in noise now and then."""
SLOW_SHARE = 0.8
SAMPLE_BYTES = 2_000

STARTING = "lidar_starting"
CODES: dict[str, tuple[str, str]] = {
    STARTING: ("it was just opened: wait", "刚刚打开：请稍候"),
    "lidar_silent": (
        "is it powered, turning, its TX wired to the adapter's RX, of this kind, and on this port?",
        "请检查供电、旋转、TX 是否接到转接器的 RX，以及端口和型号是否正确",
    ),
    "lidar_other_kind": (
        "name that kind in lidar.kind, or the right port in lidar.port",
        "请在 lidar.kind 中写该型号，或在 lidar.port 中写正确的端口",
    ),
    "lidar_unreadable": (
        "another baud (leave lidar.baud out), another lidar.model, or no lidar on this port",
        "波特率不对（可删去 lidar.baud）、lidar.model 不对，或该端口上不是激光雷达",
    ),
    "lidar_spoilt": (
        "shorten its cable, keep it off the motors' wires, look at its plug and its 5 V",
        "请缩短线缆、远离电机线，并检查插头和 5 V 供电",
    ),
    "lidar_no_turn": (
        "does its head turn evenly? Frames come, but no turn without a gap",
        "雷达头是否匀速旋转？有数据，但没有完整的一圈",
    ),
    "lidar_slow": (
        "give it 5 V that hold, or state its period in lidar.scan_s",
        "请保证 5 V 供电，或在 lidar.scan_s 中写实际周期",
    ),
}
"""What cures each, in English and Chinese; the codes of ports are devices.serial_port's."""


@dataclass(frozen=True, slots=True)
class LidarVerdict:
    """Hold what is wrong: a code, and what came where something else was expected."""

    code: str
    found: str

    @property
    def detail(self) -> str:
        """Return it with its cure, in English."""
        cure = CODES.get(self.code)
        return f"{self.found}; {cure[0]}" if cure else self.found


@dataclass(frozen=True, slots=True)
class LidarCounts:
    """Hold what was read since the process began."""

    received_bytes: int = 0
    frames: int = 0
    spoilt: int = 0
    lost_bytes: int = 0
    turns: int = 0
    broken_turns: int = 0
    gaps: int = 0
    """Broken turns in which beams are missing."""


class LidarHealth:
    """Remember the last seconds of one lidar's counts and judge them."""

    def __init__(self, kind: LidarKind, path: str) -> None:
        self._kind = kind
        self._what = f"{kind.name} at {path}, {kind.baud} baud"
        self._seen: deque[tuple[float, LidarCounts]] = deque()
        self._sample = b""
        self._opened_s: float | None = None
        self._byte_s = self._frame_s = self._turn_s = float("-inf")
        self._last = LidarCounts()
        self.rate_hz = 0.0

    def note_opening(self, now_s: float) -> None:
        """Begin anew: the port was opened, and what is behind it may be another."""
        self._opened_s = now_s
        self._seen.clear()
        self._sample = b""
        self._byte_s = self._frame_s = self._turn_s = now_s

    def note(self, counts: LidarCounts, data: bytes, now_s: float) -> None:
        """Take the counts as they are after ``data`` was read."""
        last, self._last = self._last, counts
        if data:
            self._byte_s = now_s
            self._sample = (self._sample + data)[-SAMPLE_BYTES:]
        if counts.frames > last.frames:
            self._frame_s = now_s
        if counts.turns > last.turns:
            self._turn_s = now_s
        if not self._seen or now_s - self._seen[-1][0] >= STEP_S:
            self._seen.append((now_s, counts))
            while now_s - self._seen[0][0] > WINDOW_S:
                self._seen.popleft()
            self.rate_hz = self._rate_hz()

    def silent_s(self, now_s: float) -> float:
        """Return for how long nothing came from an open port [s]."""
        return now_s - self._byte_s

    def judge(self, trouble: PortTrouble | None, now_s: float) -> LidarVerdict | None:
        """Return what is wrong now; None where nothing is."""
        if trouble is not None:
            return LidarVerdict(trouble.code, trouble.detail)
        if self._opened_s is None:
            return LidarVerdict(STARTING, f"{self._what}: not opened yet")
        young_s = now_s - self._opened_s
        if self.silent_s(now_s) > SILENT_S:
            code = STARTING if young_s < START_S else "lidar_silent"
            return LidarVerdict(code, f"{self._what}: no byte for {self.silent_s(now_s):.1f} s")
        then_s, then = self._seen[0] if self._seen else (now_s, self._last)
        came = self._last.received_bytes - then.received_bytes
        lost = self._last.lost_bytes - then.lost_bytes
        if now_s - self._frame_s > READABLE_S or (
            young_s > READABLE_S and lost > NOISE_SHARE * came
        ):
            return self._name_unreadable()
        if young_s < START_S:
            fine = self._last.turns > then.turns
            return None if fine else LidarVerdict(STARTING, f"{self._what}: no whole turn yet")
        if lost > LOST_SHARE * came:
            return LidarVerdict(
                "lidar_spoilt", f"{self._what}: {100 * lost / came:.0f} % of the bytes are spoilt"
            )
        return self._judge_turns(now_s, then_s, then)

    def _name_unreadable(self) -> LidarVerdict:
        other = recognize(self._sample)
        came = f"{self._what}: {len(self._sample)} bytes came"
        if other is not None and other != self._kind.config.kind:
            return LidarVerdict("lidar_other_kind", f"{came}, frames of kind {other!r}")
        return LidarVerdict("lidar_unreadable", f"{came}, no good frame among them")

    def _judge_turns(self, now_s: float, then_s: float, then: LidarCounts) -> LidarVerdict | None:
        turns, gaps = self._last.turns - then.turns, self._last.gaps - then.gaps
        if gaps > GAP_SHARE * (turns + gaps):
            return LidarVerdict(
                "lidar_spoilt", f"{self._what}: beams are missing in {gaps} of {turns + gaps} turns"
            )
        if now_s - self._turn_s > TURN_S:
            return LidarVerdict(
                "lidar_no_turn", f"{self._what}: no whole turn for {now_s - self._turn_s:.1f} s"
            )
        wanted_hz = 1.0 / self._kind.config.scan_s
        long_enough = now_s - then_s > 0.5 * WINDOW_S and self.silent_s(now_s) < STEP_S
        if long_enough and not self.rate_hz >= SLOW_SHARE * wanted_hz:
            return LidarVerdict(
                "lidar_slow",
                f"{self._what}: {self.rate_hz:.1f} turns a second, lidar.scan_s says {wanted_hz:g}",
            )
        return None

    def _rate_hz(self) -> float:
        (first_s, first), (last_s, last) = self._seen[0], self._seen[-1]
        if not last_s > first_s:
            return 0.0
        return (last.turns - first.turns) / self._kind.shape.cuts / (last_s - first_s)
