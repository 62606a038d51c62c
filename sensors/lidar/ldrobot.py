"""Decode LD06, LD19 and STL-19P: frames of 47 bytes at 230 400 baud, which they send by
themselves.

Layout and check: ldrobot's development manuals and its driver (ldlidar_stl_ros2, MIT): ``54 2C |
speed, degrees/s, u16 | start angle, 0.01 degrees, u16 | 12 x (distance mm u16, intensity u8) |
end angle u16 | time ms u16, begins again at 30 000 | CRC-8, polynomial 4D``. Angles grow
clockwise. Distance 0: nothing came back, or it was nearer than the sensor can measure.
"""

from __future__ import annotations

import struct

from devices.clock import SensorClock, WrappedCounter
from devices.port_probe import PortAnswer, PortProbe
from sensors.lidar.turn import MAX_GAP_DEG, Beams

BAUD = 230_400
FRAME_BYTES = 47
BEAMS = 12
HEAD = b"\x54\x2c"
POINTS_PER_S = 4_500
_TIME_MODULUS_MS = 30_000
_FRAME = struct.Struct("<2xHH" + "HB" * BEAMS + "HHB")


def _crc_table(polynomial: int) -> bytes:
    table = bytearray()
    for byte in range(256):
        rest = byte
        for _ in range(8):
            rest = ((rest << 1) ^ polynomial if rest & 0x80 else rest << 1) & 0xFF
        table.append(rest)
    return bytes(table)


_CRC = _crc_table(0x4D)


def crc8(data: bytes) -> int:
    """Return the frame check of the given bytes: CRC-8, polynomial 4D, beginning at 0."""
    rest = 0
    for byte in data:
        rest = _CRC[rest ^ byte]
    return rest


class LdRobotDecoder:
    """Turn the sensor's bytes into beams; what does not check is dropped and counted."""

    baud = BAUD
    points_per_s = POINTS_PER_S
    max_gap_deg = MAX_GAP_DEG
    opening: tuple[bytes, ...] = ()
    closing: tuple[bytes, ...] = ()
    rescue = b""

    def __init__(self) -> None:
        self._kept = bytearray()
        self._clock = SensorClock()
        self._time = WrappedCounter(_TIME_MODULUS_MS)
        self.frames = 0
        self.spoilt = 0
        """Heads that no good frame followed."""
        self.lost_bytes = 0
        """Bytes of no good frame."""

    def forget(self) -> None:
        """Drop the unfinished frame: what comes next is of another time."""
        self._kept.clear()

    def feed(self, data: bytes, arrival_s: float) -> list[Beams]:
        """Take bytes as they came, read at ``arrival_s`` on our clock; return the beams in them."""
        kept = self._kept
        kept += data
        found: list[Beams] = []
        while (start := kept.find(HEAD)) >= 0 and len(kept) - start >= FRAME_BYTES:
            frame = bytes(kept[start : start + FRAME_BYTES])
            if crc8(frame[:-1]) == frame[-1]:
                found.append(self._beams(frame, arrival_s))
                self.frames += 1
                self.lost_bytes += start
                del kept[: start + FRAME_BYTES]
            else:
                self.spoilt += 1
                self.lost_bytes += start + 1
                del kept[: start + 1]  # the head may have been a distance
        if start < 0:
            start = max(0, len(kept) - 1)  # the last byte may be half a head
        self.lost_bytes += start
        del kept[:start]
        return found

    def _beams(self, frame: bytes, arrival_s: float) -> Beams:
        speed_dps, start, *rest = _FRAME.unpack(frame)
        distances, (end, time_ms, _) = rest[: 2 * BEAMS : 2], rest[2 * BEAMS :]
        swept_deg = ((end - start) % 36_000) / 100.0
        step_deg = swept_deg / (BEAMS - 1)
        period_s = step_deg / speed_dps if speed_dps else 1.0 / self.points_per_s
        last_s = self._clock.note(self._sensor_s(time_ms), arrival_s)
        first_deg = start / 100.0
        angles_deg = tuple((first_deg + index * step_deg) % 360.0 for index in range(BEAMS))
        return Beams(
            angles_deg=angles_deg,
            swept_deg=angles_deg,
            distances_m=tuple(distance / 1000.0 for distance in distances),
            first_s=last_s - (BEAMS - 1) * period_s,
            period_s=period_s,
        )

    def _sensor_s(self, time_ms: int) -> float:
        return self._time.unwrap(time_ms) / 1000.0


_ENOUGH_FRAMES = 5
"""Whose check of 8 bits all pass by chance: odds of 2^-40."""


def recognise(data: bytes) -> PortAnswer | None:
    """Return what a sensor of this family says of itself; it speaks unasked."""
    return describe(data, "lidar LD06, LD19 or STL-19P")


def describe(data: bytes, name: str) -> PortAnswer | None:
    """Return a sensor's name with its speed, where enough of its frames stand in some bytes."""
    decoder = LdRobotDecoder()
    decoder.feed(data, 0.0)
    if decoder.frames < _ENOUGH_FRAMES:
        return None
    start = data.rfind(HEAD, 0, len(data) - FRAME_BYTES)
    speed_degps = struct.unpack_from("<H", data, start + len(HEAD))[0]
    turns = f", {speed_degps / 360:.1f} turns/s" if speed_degps < _FASTEST_DEGPS else ""
    return PortAnswer(f"{name}{turns}")


_FASTEST_DEGPS = 10_000
PROBES = (PortProbe("lidar", "ld19", BAUD, recognise),)
