"""Decode RPLidar A1, A2, A3, C1, S1, S2: standard, express and dense answers.

Layouts: Slamtec's interface protocol and its SDK (rplidar_sdk, BSD-2): requests ``A5 command``,
with a payload ``A5 command length payload xor``; an answer begins with ``A5 5A | length, 30
bits, and mode | type``. Type 81 (standard), 5 bytes a beam: quality and start bit with its
inverse, angle of 15 bits in 1/64 degree above a check bit, distance in 1/4 mm. Type 82 (express)
and 85 (dense), 84 bytes: the xor of bytes 2 on in the low nibbles of two bytes with high nibbles
A and 5, the start angle in 1/64 degree with bit 15 where the stream began anew, then 16 cabins
of 2 beams or 40 beams in mm. The beams of one such frame lie between its start angle and the
next frame's. Angles grow clockwise. Distance 0: nothing came back. A cabin's six bits of angle
are taken from the beam's place without a sign, as the SDK does; the protocol's text calls the
highest a sign.
"""

from __future__ import annotations

import struct
from dataclasses import dataclass

from devices.clock import SensorClock
from devices.port_probe import PortAnswer, PortProbe
from sensors.lidar.turn import COUNTED_WINDOW_S, MAX_GAP_DEG, MAX_SHIFTED_GAP_DEG, Beams

STOP, RESET, SCAN, EXPRESS = b"\xa5\x25", b"\xa5\x40", b"\xa5\x20", b"\xa5\x82"
INFO, HEALTH = b"\xa5\x50", b"\xa5\x52"
_DESCRIPTOR = b"\xa5\x5a"
_STANDARD, _EXPRESS, _DENSE = 0x81, 0x82, 0x85
STANDARD_HEAD, EXPRESS_HEAD = bytes.fromhex("a55a0500004081"), bytes.fromhex("a55a5400004082")
"""With which these answers begin."""
_LONGEST_FRAME_DEG = 40.0
"""Between the start angles of two frames: 40 beams at 10 turns and 4 000 beams a second are 36;
more means that frames were lost between."""
RESYNC = 3
"""Beams of the standard answer that must follow each other rightly before the first is believed:
its check is two bits, so bytes read from the wrong place pass in one of 4 cases, three of them
in 1 of 64."""


def request(command: int, payload: bytes = b"") -> bytes:
    """Return a request; with a payload its xor follows."""
    if not payload:
        return bytes((0xA5, command))
    body = bytes((0xA5, command, len(payload))) + payload
    check = 0
    for byte in body:
        check ^= byte
    return body + bytes((check,))


def motor_speed(rpm: int) -> bytes:
    """Return the request that sets the motor of an A3, C1 or S model."""
    return request(0xA8, struct.pack("<H", rpm))


def motor_pwm(duty: int) -> bytes:
    """Return the request that sets the duty of the motor on an A2's adapter, 0 to 1023."""
    return request(0xF0, struct.pack("<H", duty))


USUAL_DUTY = 660
"""With which Slamtec's SDK starts it: ten turns a second."""


@dataclass(frozen=True, slots=True)
class RplidarModel:
    """Hold what differs between the models."""

    baud: int
    express: bool
    """Ask for the express answer; which of the types comes then is the model's choice."""
    beams_per_s: float
    sets_speed: bool
    """The motor takes a speed by request."""
    dtr: bool | None = None
    """The motor turns while this line is so; None: it has no say."""
    has_pwm: bool = False
    """The adapter's board makes the motor's PWM, by request."""


MODELS = {
    "a1": RplidarModel(115_200, express=False, beams_per_s=2_000.0, sets_speed=False, dtr=False),
    "a2": RplidarModel(
        115_200, express=True, beams_per_s=4_000.0, sets_speed=False, dtr=False, has_pwm=True
    ),
    "a2m12": RplidarModel(
        256_000, express=True, beams_per_s=4_000.0, sets_speed=False, dtr=False, has_pwm=True
    ),
    "a3": RplidarModel(256_000, express=True, beams_per_s=4_000.0, sets_speed=True),
    "c1": RplidarModel(460_800, express=False, beams_per_s=5_000.0, sets_speed=True),
    "s1": RplidarModel(460_800, express=True, beams_per_s=9_200.0, sets_speed=True),
    "s2": RplidarModel(1_000_000, express=True, beams_per_s=32_000.0, sets_speed=True),
}
"""Bauds: Slamtec's data sheets. Beams a second: each model's usual mode; the true figure is
measured."""


class RplidarDecoder:
    """Turn a stream that begins with an answer's head into beams."""

    rescue = RESET
    """Begins the sensor anew, which it needs once it has shut its laser off by itself."""

    def __init__(self, model: RplidarModel, rpm: int = 600) -> None:
        self.baud = model.baud
        self.max_gap_deg = MAX_GAP_DEG if model.express else MAX_SHIFTED_GAP_DEG
        speed: tuple[bytes, ...] = ()
        rest: tuple[bytes, ...] = ()
        if model.sets_speed:
            speed, rest = (motor_speed(rpm),), (motor_speed(0),)
        elif model.has_pwm:
            speed, rest = (motor_pwm(USUAL_DUTY),), (motor_pwm(0),)
        scan = request(0x82, bytes(5)) if model.express else SCAN
        self.opening: tuple[bytes, ...] = (STOP, *speed, scan)
        self.closing: tuple[bytes, ...] = (STOP, *rest)
        self._period_s = 1.0 / model.beams_per_s
        self._clock = SensorClock(COUNTED_WINDOW_S)
        self._kept = bytearray()
        self._type = 0
        self._trusted = 0
        self._before: tuple[float, tuple[float, ...]] | None = None
        """The start angle and the raw beams of the express or dense frame that came last."""
        self._counted = 0
        self.frames = 0
        self.spoilt = 0
        self.lost_bytes = 0

    def forget(self) -> None:
        """Drop the unfinished: what comes next is of another time, though of the same answer."""
        self._kept.clear()
        self._lose()

    def feed(self, data: bytes, arrival_s: float) -> list[Beams]:
        """Take bytes as they came, read at ``arrival_s`` on our clock; return the beams in them."""
        self._kept += data
        found: list[Beams] = []
        while True:
            before = len(self._kept)
            if self._type == 0:
                self._find_answer()
            elif self._type == _STANDARD:
                found += self._read_standard(arrival_s)
            else:
                found += self._read_frame(arrival_s)
            if len(self._kept) == before:
                return found

    def _find_answer(self) -> None:
        kept = self._kept
        start = kept.find(_DESCRIPTOR)
        skipped = start if start >= 0 else max(0, len(kept) - 1)
        self.lost_bytes += skipped
        del kept[:skipped]
        if start < 0:
            return
        if len(kept) < 7:
            return
        length = int.from_bytes(kept[2:6], "little") & 0x3FFF_FFFF
        kind = kept[6]
        known = {_STANDARD: 5, _EXPRESS: 84, _DENSE: 84}
        if known.get(kind) == length:
            del kept[:7]
            self._type, self._trusted, self._before = kind, 0, None
            self._clock.reset()
            self._counted = 0
        else:
            self.lost_bytes += 2
            del kept[:2]  # the answer to another question, or noise

    def _read_standard(self, arrival_s: float) -> list[Beams]:
        kept, angles, distances = self._kept, [], []
        at = 0
        need = 5 * RESYNC if self._trusted < RESYNC else 5
        while len(kept) - at >= need:
            if not _reads_as_beam(kept, at):
                self.spoilt += self._trusted > 0
                self._lose()
                self.lost_bytes += 1
                at += 1
                need = 5 * RESYNC
                continue
            if self._trusted < RESYNC and not all(
                _reads_as_beam(kept, at + 5 * ahead) for ahead in range(1, RESYNC)
            ):
                self.lost_bytes += 1
                at += 1
                continue
            self._trusted, need = RESYNC, 5
            angles.append((((kept[at + 2] << 8 | kept[at + 1]) >> 1) / 64.0) % 360.0)
            distances.append((kept[at + 4] << 8 | kept[at + 3]) / 4000.0)
            at += 5
        del kept[:at]
        return [self._beams(angles, angles, distances, arrival_s)] if angles else []

    def _read_frame(self, arrival_s: float) -> list[Beams]:
        kept = self._kept
        if len(kept) < 84:
            return []
        if not (kept[0] >> 4 == 0xA and kept[1] >> 4 == 0x5) or _xor(kept[2:84]) != (
            kept[0] & 0x0F | (kept[1] & 0x0F) << 4
        ):
            self.spoilt += self._before is not None
            self._lose()
            self.lost_bytes += 1
            del kept[0]
            return []
        frame = bytes(kept[:84])
        del kept[:84]
        start = int.from_bytes(frame[2:4], "little")
        first_deg = (start & 0x7FFF) / 64.0
        if start & 0x8000:
            self._lose()  # the stream began anew: what came before does not join
        before, self._before = self._before, (first_deg, _raw(frame, self._type))
        self.frames += 1
        if before is None:
            return []
        swept_deg = (first_deg - before[0]) % 360.0
        if not 0.0 < swept_deg <= _LONGEST_FRAME_DEG:
            self._lose()
            self._before = (first_deg, _raw(frame, self._type))
            return []
        return [self._between(before, swept_deg, arrival_s)]

    def _between(
        self, before: tuple[float, tuple[float, ...]], swept_deg: float, arrival_s: float
    ) -> Beams:
        first_deg, raw = before
        if self._type == _DENSE:
            step_deg = swept_deg / len(raw)
            angles = [(first_deg + k * step_deg) % 360.0 for k in range(len(raw))]
            return self._beams(angles, angles, list(raw), arrival_s)
        distances, offsets = raw[0::2], raw[1::2]
        step_deg = swept_deg / len(distances)
        swept = [(first_deg + k * step_deg) % 360.0 for k in range(len(distances))]
        angles = [(at - offset) % 360.0 for at, offset in zip(swept, offsets, strict=True)]
        return self._beams(angles, swept, list(distances), arrival_s)

    def _beams(
        self, angles: list[float], swept: list[float], distances: list[float], arrival_s: float
    ) -> Beams:
        """Return beams timed by their number: these sensors send no clock."""
        if self._type == _STANDARD:
            self.frames += len(angles)
        self._counted += len(angles)
        last_s = self._clock.note(self._counted * self._period_s, arrival_s)
        first_s = last_s - (len(angles) - 1) * self._period_s
        return Beams(tuple(angles), tuple(swept), tuple(distances), first_s, self._period_s)

    def _lose(self) -> None:
        """Begin counting anew: how many beams were lost is not known."""
        self._trusted, self._before, self._counted = 0, None, 0
        self._clock.reset()


def _reads_as_beam(data: bytearray, at: int) -> bool:
    start, inverse = data[at] & 1, data[at] >> 1 & 1
    return start != inverse and bool(data[at + 1] & 1)


def _xor(data: bytes | bytearray) -> int:
    check = 0
    for byte in data:
        check ^= byte
    return check


def _raw(frame: bytes, kind: int) -> tuple[float, ...]:
    """Return a dense frame's distances [m]; an express frame's distances and angle offsets in
    turn.
    """
    if kind == _DENSE:
        return tuple(mm / 1000.0 for mm in struct.unpack_from("<40H", frame, 4))
    found: list[float] = []
    for cabin in range(16):
        first, second, fine = struct.unpack_from("<HHB", frame, 4 + 5 * cabin)
        found += (
            (first >> 2) / 1000.0,
            ((first & 3) << 4 | fine & 0x0F) / 8.0,
            (second >> 2) / 1000.0,
            ((second & 3) << 4 | fine >> 4) / 8.0,
        )
    return tuple(found)


INFO_HEAD = b"\xa5\x5a\x14\x00\x00\x00\x04"
"""Of the answer to INFO: model, firmware minor and major, hardware, serial number of 16 bytes."""
_INFO_BYTES = 20
_FAMILIES = {1: "a1", 2: "a2", 3: "a3", 4: "c1", 6: "s1", 7: "s2"}
"""By the high nibble of the model; Slamtec's SDK names them so."""
_A2M12 = 0x2C


def recognise(data: bytes) -> PortAnswer | None:
    """Return which RPLidar answered INFO; it neither turns nor stops for that."""
    start = data.find(INFO_HEAD)
    body = data[start + len(INFO_HEAD) :][:_INFO_BYTES] if start >= 0 else b""
    if len(body) < _INFO_BYTES:
        return None
    number, minor, major = body[0], body[1], body[2]
    name = "a2m12" if number == _A2M12 else _FAMILIES.get(number >> 4)
    serial = body[4:].hex()
    if name is None:
        words = f"an RPLidar of model {number:#04x}, which Pons does not read"
        return PortAnswer(words, missing={"model": f"one of {', '.join(MODELS)}"})
    words = f"RPLidar {name.upper()}, firmware {major}.{minor:02}, serial {serial}"
    return PortAnswer(words, keys={"model": name})


PROBES = tuple(
    PortProbe("lidar", "rplidar", baud, recognise, INFO)
    for baud in sorted({model.baud for model in MODELS.values()})
)
