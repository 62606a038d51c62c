"""Write beams as the bytes that lidars send, from their manuals and not from our decoders.

LDRobot: development manual of the LD19, ROBOTIS' e-Manual of the LDS-02. RPLidar: Slamtec's
interface protocol v2. YDLidar: the development manuals of X4 and G2. Angles are the sensor's own,
in degrees, growing clockwise; distances in metres, 0 where nothing came back.
"""

from __future__ import annotations

import struct
from math import atan, degrees, sqrt
from typing import Protocol

_BEAM = tuple[float, float]


class BeamFormat(Protocol):
    """Collect beams until they fill a frame."""

    def head(self) -> bytes:
        """Forget the unfinished frame; return what goes before the first one."""

    def add(self, angle_deg: float, distance_m: float, taken_s: float) -> bytes:
        """Take one beam; return the frame that it completes, or nothing."""


def _units(distance_m: float, unit_m: float) -> int:
    units = round(distance_m / unit_m)
    return units if units <= 0xFFFF else 0


class LdFormat:
    """Frames of 12 beams with the sensor's own time and a CRC."""

    def __init__(self, speed_dps: float) -> None:
        self._speed_dps = round(speed_dps)
        self._beams: list[_BEAM] = []

    def head(self) -> bytes:
        """Return nothing: it talks by itself."""
        self._beams = []
        return b""

    def add(self, angle_deg: float, distance_m: float, taken_s: float) -> bytes:
        """Take one beam; return the frame that it completes, or nothing."""
        self._beams.append((angle_deg, distance_m))
        if len(self._beams) < 12:
            return b""
        beams, self._beams = self._beams, []
        frame = bytearray(b"\x54\x2c")
        frame += struct.pack("<HH", self._speed_dps, _hundredths(beams[0][0]))
        for _, distance in beams:
            frame += struct.pack("<HB", _units(distance, 0.001), 200 if distance else 0)
        frame += struct.pack("<HH", _hundredths(beams[-1][0]), int(taken_s * 1000.0) % 30_000)
        return bytes(frame) + bytes((crc_4d(frame),))


class Ld08Format(LdFormat):
    """The same frames with the distance along the lens's own tilted ray."""

    def add(self, angle_deg: float, distance_m: float, taken_s: float) -> bytes:
        """Take one beam; return the frame that it completes, or nothing."""
        return super().add(angle_deg, ld08_raw_mm(distance_m) / 1000.0, taken_s)


def ld08_raw_mm(distance_m: float) -> float:
    """Return what an LD08 measures of a thing so far from its axis: the root of its geometry."""
    far_mm = distance_m * 1000.0
    if not far_mm > 30.0:  # nearer than the lens looks
        return 0.0
    square, half = 1.0 + 0.11923**2, 5.9 - 0.11923 * 20.14
    rest = 5.9**2 + 20.14**2 - far_mm**2
    return (sqrt(half**2 - square * rest) - half) / square


def ld08_shift_deg(distance_m: float) -> float:
    """Return how far an LD08 looks beside where its head stands."""
    raw_mm = ld08_raw_mm(distance_m)
    return -degrees(atan((raw_mm * 0.11923 - 20.14) / (raw_mm + 5.9))) if raw_mm else 0.0


def _hundredths(angle_deg: float) -> int:
    return round(angle_deg * 100.0) % 36_000


def crc_4d(data: bytes | bytearray) -> int:
    """Return the CRC of polynomial 4D bit by bit, as the manual defines it."""
    rest = 0
    for byte in data:
        rest ^= byte
        for _ in range(8):
            rest = (rest << 1 ^ 0x4D) & 0xFF if rest & 0x80 else rest << 1
    return rest


class RpStandardFormat:
    """Five bytes a beam."""

    def __init__(self) -> None:
        self._last_deg = 360.0

    def head(self) -> bytes:
        """Return the answer's descriptor."""
        self._last_deg = 360.0
        return bytes.fromhex("a55a0500004081")

    def add(self, angle_deg: float, distance_m: float, taken_s: float) -> bytes:
        """Return the beam."""
        begins, self._last_deg = angle_deg < self._last_deg, angle_deg
        quality = (47 if distance_m else 0) << 2 | (1 if begins else 2)
        angle = round(angle_deg * 64.0) % (360 * 64)
        return struct.pack("<BHH", quality, angle << 1 | 1, _units(distance_m, 0.000_25))


class RpExpressFormat:
    """Frames of 16 cabins of two beams, behind the angle of the first."""

    size, kind = 32, 0x82

    def __init__(self) -> None:
        self._beams: list[_BEAM] = []
        self._anew = True

    def head(self) -> bytes:
        """Return the answer's descriptor."""
        self._beams, self._anew = [], True
        return bytes((0xA5, 0x5A, 84, 0, 0, 0x40, self.kind))

    def add(self, angle_deg: float, distance_m: float, taken_s: float) -> bytes:
        """Take one beam; return the frame that it completes, or nothing."""
        self._beams.append((angle_deg, distance_m))
        if len(self._beams) < self.size:
            return b""
        beams, self._beams = self._beams, []
        start = round(beams[0][0] * 64.0) % (360 * 64) | (0x8000 if self._anew else 0)
        self._anew = False
        checked = struct.pack("<H", start) + self.body([distance for _, distance in beams])
        check = 0
        for byte in checked:
            check ^= byte
        return bytes((0xA0 | check & 0xF, 0x50 | check >> 4)) + checked

    def body(self, distances_m: list[float]) -> bytes:
        """Return the cabins: no beam lies off its place here."""
        pairs = zip(distances_m[::2], distances_m[1::2], strict=True)
        return b"".join(
            struct.pack("<HHB", _millimetres14(near) << 2, _millimetres14(far) << 2, 0)
            for near, far in pairs
        )


def _millimetres14(distance_m: float) -> int:
    units = round(distance_m * 1000.0)
    return units if units < 1 << 14 else 0


class RpDenseFormat(RpExpressFormat):
    """Frames of 40 beams in millimetres, behind the angle of the first."""

    size, kind = 40, 0x85

    def body(self, distances_m: list[float]) -> bytes:
        """Return the distances."""
        return b"".join(struct.pack("<H", _units(far, 0.001)) for far in distances_m)


class YdFormat:
    """Packets of up to 40 beams that end where a turn does; the turn's first beam has its own."""

    MOST = 40

    def __init__(self, *, unit_m: float, intensity: bool) -> None:
        self._unit_m, self._intensity = unit_m, intensity
        self._beams: list[_BEAM] = []

    def head(self) -> bytes:
        """Return the answer's descriptor."""
        self._beams = []
        return bytes.fromhex("a55a0500004081")

    def add(self, angle_deg: float, distance_m: float, taken_s: float) -> bytes:
        """Take one beam; return the packets that it completes."""
        begins = bool(self._beams) and angle_deg < self._beams[-1][0]
        done = self._packet() if begins else b""
        self._beams.append((angle_deg, distance_m))
        if begins or len(self._beams) == self.MOST:
            done += self._packet(begins=begins)
        return done

    def _packet(self, *, begins: bool = False) -> bytes:
        beams, self._beams = self._beams, []
        first, last = (round(beams[at][0] * 64.0) % (360 * 64) << 1 | 1 for at in (0, -1))
        kind = int(begins) | len(beams) << 8
        check = 0x55AA ^ kind ^ first ^ last
        samples = b""
        for _, distance in beams:
            raw = _units(distance, self._unit_m)
            if self._intensity:
                raw &= 0xFFFC
                samples += b"\x40"
                check ^= 0x40
            samples += struct.pack("<H", raw)
            check ^= raw
        return struct.pack("<HHHHH", 0x55AA, kind, first, last, check) + samples


def triangulated_deg(distance_m: float) -> float:
    """Return how far a YDLidar that triangulates looks beside where its head stands."""
    if not distance_m > 0.0:
        return 0.0
    far_mm = distance_m * 1000.0
    return degrees(atan(21.8 * (155.3 - far_mm) / (155.3 * far_mm)))


SHIFTS = {"yd": triangulated_deg, "yd3": triangulated_deg, "ld08": ld08_shift_deg}
"""By the form of those that triangulate."""
