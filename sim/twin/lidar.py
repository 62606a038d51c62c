"""Act as a lidar at the far end of a serial line: turn, cast rays, send bytes at its own rate.

Firmware and line are apart: the firmware is told the time and what came, casts its beams by a
function that it is given, and returns what it sends. A host that opened the line with another baud
reads noise, and is not understood.
"""

from __future__ import annotations

from collections import deque
from dataclasses import dataclass
from random import Random
from typing import TYPE_CHECKING

import numpy as np

from sim.sensor_channel import DELAY_TICKS, OPEN_TICKS, SHUT_TICKS, Trouble
from sim.twin.lidar_formats import (
    SHIFTS,
    BeamFormat,
    Ld08Format,
    LdFormat,
    RpDenseFormat,
    RpExpressFormat,
    RpStandardFormat,
    YdFormat,
)
from sim.twin.line import TwinLine
from wire import ConfigError

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping
    from pathlib import Path

    from numpy.typing import NDArray

    from wire.lidar_config import LidarConfig

    Look = Callable[[NDArray[np.float64]], tuple[float | None, ...]]
    """Cast beams in directions of the lidar's frame [rad], counter-clockwise; None: no return."""

MOST_BEHIND_S = 0.25
"""After a freeze of the simulator: what a lidar sent meanwhile would be lost in the host's port."""
BOOT_S = 0.6
_START, _NONE = 0xA5, frozenset[Trouble]()
_DESCRIBED = bytes.fromhex("a55a")


@dataclass(frozen=True, slots=True)
class TwinLidarModel:
    """Hold what a data sheet says of one model."""

    baud: int
    beams_per_s: float
    form: str
    talks: bool = False
    """It sends by itself from power on."""
    sets_speed: bool = False
    number: int = 0
    """By which it names its model when asked."""


LIDAR_TWINS: Mapping[tuple[str, str | None], TwinLidarModel] = {
    ("ld08", None): TwinLidarModel(115_200, 2_300.0, "ld08", talks=True),
    ("ld19", None): TwinLidarModel(230_400, 4_500.0, "ld", talks=True),
    ("rplidar", "a1"): TwinLidarModel(115_200, 2_000.0, "rp81", number=0x18),
    ("rplidar", "a2"): TwinLidarModel(115_200, 4_000.0, "rp82", number=0x28),
    ("rplidar", "a2m12"): TwinLidarModel(256_000, 4_000.0, "rp82", number=0x2C),
    ("rplidar", "a3"): TwinLidarModel(256_000, 4_000.0, "rp82", sets_speed=True, number=0x31),
    ("rplidar", "c1"): TwinLidarModel(460_800, 5_000.0, "rp81", sets_speed=True, number=0x41),
    ("rplidar", "s1"): TwinLidarModel(460_800, 9_200.0, "rp82", sets_speed=True, number=0x61),
    ("rplidar", "s2"): TwinLidarModel(1_000_000, 32_000.0, "rp85", sets_speed=True, number=0x71),
    ("ydlidar", "x2"): TwinLidarModel(115_200, 3_000.0, "yd", talks=True),
    ("ydlidar", "x4"): TwinLidarModel(128_000, 5_000.0, "yd", number=6),
    ("ydlidar", "g2"): TwinLidarModel(230_400, 5_000.0, "yd3", number=15),
    ("ydlidar", "g4"): TwinLidarModel(230_400, 9_000.0, "yd", number=5),
    ("ydlidar", "tg15"): TwinLidarModel(512_000, 20_000.0, "yd_mm", number=100),
}
"""By kind and model of robot.toml."""


class LidarFirmware:
    """Turn at robot.toml's ``scan_s``, obey requests, send beams."""

    def __init__(self, config: LidarConfig) -> None:
        """Boot it.

        Raises:
            ConfigError: ``twin_unknown``.
        """
        model = LIDAR_TWINS.get((config.kind, config.model))
        if model is None:
            known = ", ".join("_".join(filter(None, key)) for key in LIDAR_TWINS)
            raise ConfigError(
                "twin_unknown", f"lidar.kind {config.kind!r} has no twin; these have: {known}"
            )
        self.model = model
        self.family = config.kind
        self._turn_hz = 1.0 / config.scan_s
        self._sign = 1.0 if config.upside_down else -1.0
        self._format = self._form()
        self._scanning = model.talks
        self._quiet_until_s = 0.0
        self._began_s: float | None = None
        self._sent = 0
        self._heard = bytearray()
        self._memory: deque[float | None] = deque(maxlen=round(model.beams_per_s / self._turn_hz))

    def tick(
        self, heard: bytes, now_s: float, look: Look, troubles: frozenset[Trouble] = _NONE
    ) -> bytes:
        """Return what it sends now: answers, and the frames that became whole."""
        said = self._answer(heard, now_s)
        if not self._scanning or now_s < self._quiet_until_s:
            self._began_s = None
            return said
        if self._began_s is None:
            self._began_s, self._sent = now_s, 0
            said += self._format.head()
        due = int((now_s - self._began_s) * self.model.beams_per_s) - self._sent
        behind = due - int(MOST_BEHIND_S * self.model.beams_per_s)
        if behind > 0:
            self._sent, due = self._sent + behind, due - behind
        if due > 0:
            said += self._sweep(due, look, troubles)
        return said

    def _sweep(self, due: int, look: Look, troubles: frozenset[Trouble]) -> bytes:
        numbers = np.arange(self._sent, self._sent + due)
        self._sent += due
        step_deg = 360.0 * self._turn_hz / self.model.beams_per_s
        heads_deg = np.asarray(((numbers + 0.5) * step_deg) % 360.0, np.float64)
        ranges = self._cast(heads_deg, look)
        if Trouble.STUCK in troubles and len(self._memory) >= due:
            ranges = tuple(self._memory)[:due]
            self._memory.rotate(-due)
        else:
            self._memory.extend(ranges)
        began_s = self._began_s or 0.0
        return b"".join(
            self._format.add(head_deg, far or 0.0, began_s + (number + 1) / self.model.beams_per_s)
            for number, head_deg, far in zip(
                numbers.tolist(), heads_deg.tolist(), ranges, strict=True
            )
        )

    def _cast(self, heads_deg: NDArray[np.float64], look: Look) -> tuple[float | None, ...]:
        """Cast the beams; one that triangulates looks beside its head, by what it sees there."""
        ranges = look(self._sign * np.radians(heads_deg))
        shift = SHIFTS.get(self.model.form)
        if shift is None:
            return ranges
        for _ in range(2):
            shifts_deg = np.array([shift(far or 0.0) for far in ranges])
            ranges = look(self._sign * np.radians(heads_deg + shifts_deg))
        return ranges

    def _answer(self, heard: bytes, now_s: float) -> bytes:
        """Carry out the requests among what came."""
        self._heard += heard
        said = b""
        while (at := self._heard.find(_START)) >= 0 and len(self._heard) - at >= 2:
            kind = self._heard[at + 1]
            size = 2
            if kind & 0x80 and self.family == "rplidar":
                if len(self._heard) - at < 3:
                    break
                size = 4 + self._heard[at + 2]
                if len(self._heard) - at < size:
                    break
            body = bytes(self._heard[at + 3 : at + size - 1])
            del self._heard[: at + size]
            said += self._obey(kind, body, now_s)
        del self._heard[: at if at >= 0 else len(self._heard)]
        return said

    def _obey(self, kind: int, body: bytes, now_s: float) -> bytes:
        if now_s < self._quiet_until_s or self._is_one_way():
            return b""
        stop, scans = (0x25, (0x20, 0x82)) if self.family == "rplidar" else (0x65, (0x60,))
        if kind == stop:
            self._scanning = False
        elif kind in scans:
            self._scanning, self._began_s, self._format = True, None, self._form()
        elif kind == 0x40 and self.family == "rplidar":
            self._scanning, self._quiet_until_s = False, now_s + BOOT_S
            return b"RP LIDAR System.\r\n"
        elif kind == 0xA8 and self.model.sets_speed and len(body) == 2:
            self._turn_hz = max(1.0, int.from_bytes(body, "little") / 60.0)
        elif kind == (0x50 if self.family == "rplidar" else 0x90):
            body = bytes((self.model.number, 29, 1, 7, *range(16)))
            return _DESCRIBED + bytes((20, 0, 0, 0, 4)) + body
        elif kind == (0x52 if self.family == "rplidar" else 0x92):
            return _DESCRIBED + bytes((3, 0, 0, 0, 6)) + bytes(3)
        return b""

    def _is_one_way(self) -> bool:
        return self.family != "rplidar" and self.model.talks

    def _form(self) -> BeamFormat:
        form = self.model.form
        if form == "ld":
            return LdFormat(360.0 * self._turn_hz)
        if form == "ld08":
            return Ld08Format(360.0 * self._turn_hz)
        if form == "rp81":
            return RpStandardFormat()
        if form == "rp82":
            return RpExpressFormat()
        if form == "rp85":
            return RpDenseFormat()
        return YdFormat(unit_m=0.001 if form == "yd_mm" else 0.000_25, intensity=form == "yd3")


class LidarTwin:
    """Hold one lidar's firmware and its line."""

    def __init__(self, config: LidarConfig, link: Path) -> None:
        """Boot the lidar of robot.toml at a line that ``link`` leads to.

        Raises:
            ConfigError: ``twin_unknown`` or ``twin_line``.
        """
        self.firmware = LidarFirmware(config)
        self._noise = Random(1)
        self._delayed: deque[bytes] = deque()
        self._ticks = 0
        try:
            self.line = TwinLine(link)
        except OSError as error:
            raise ConfigError("twin_line", f"{link}: {error.strerror}") from None

    def tick(self, now_s: float, look: Look, troubles: frozenset[Trouble] = _NONE) -> None:
        """Hear the host and send what is due, as the lidar's faults let it."""
        self._ticks += 1
        speaks_alike = self.line.baud() == self.firmware.model.baud
        heard = self.line.read()
        said = self.firmware.tick(heard if speaks_alike else b"", now_s, look, troubles)
        if not speaks_alike:
            said = self._noise.randbytes(len(said))
        shut = self._ticks % (OPEN_TICKS + SHUT_TICKS) >= OPEN_TICKS
        if Trouble.OFF in troubles or (Trouble.INTERMITTENT in troubles and shut):
            said = b""
        if Trouble.DELAYED in troubles:
            self._delayed.append(said)
            said = self._delayed.popleft() if len(self._delayed) > DELAY_TICKS else b""
        else:
            self._delayed.clear()
        if said:
            self.line.write(said)

    def close(self) -> None:
        """Take the line away."""
        self.line.close()
