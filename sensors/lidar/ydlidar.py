"""Decode YDLidar X2, X4, G and TG: packets of a few beams with a check over 16-bit words.

Layout: the development manuals and YDLidar-SDK: ``AA 55 | CT | LSN | FSA u16 | LSA u16 | CS u16
| LSN samples``. CT bit 0: a turn begins. The angle of the first and the last beam is the upper
15 bits in 1/64 degree, the others lie evenly between. A sample is u16, or 3 bytes where an
intensity comes first. Those that triangulate send 1/4 mm and see each beam under an angle that
depends on the distance d [mm]: atan(21.8 (155.3 - d) / (155.3 d)) is added. CS is the xor of
55AA, FSA, each sample's words, CT with LSN, and LSA. Angles grow clockwise. Distance 0: nothing.
"""

from __future__ import annotations

import struct
from dataclasses import dataclass
from math import atan, degrees

from devices.clock import SensorClock
from devices.port_probe import PortAnswer, PortProbe
from sensors.lidar.turn import COUNTED_WINDOW_S, MAX_GAP_DEG, Beams

HEAD = b"\xaa\x55"
SCAN, STOP, INFO, HEALTH = b"\xa5\x60", b"\xa5\x65", b"\xa5\x90", b"\xa5\x92"
HEAD_BYTES = 10
_WORD = struct.Struct("<H")


@dataclass(frozen=True, slots=True)
class YdlidarModel:
    """Hold what differs between the models."""

    baud: int
    talks: bool
    """It sends by itself and takes no request."""
    sample_bytes: int
    unit_m: float
    triangulates: bool
    beams_per_s: float
    dtr: bool | None = None
    """The motor turns while this line is so; None: it turns by itself or by request."""


MODELS = {
    "x2": YdlidarModel(115_200, True, 2, 0.000_25, True, 3_000.0, dtr=True),
    "x4": YdlidarModel(128_000, False, 2, 0.000_25, True, 5_000.0, dtr=True),
    "g2": YdlidarModel(230_400, False, 3, 0.000_25, True, 5_000.0),
    "g4": YdlidarModel(230_400, False, 2, 0.000_25, True, 9_000.0),
    "tg15": YdlidarModel(512_000, False, 2, 0.001, False, 20_000.0),
}
"""Bauds and rates: the data sheets and the SDK's list of models."""


class YdlidarDecoder:
    """Turn the sensor's bytes into beams; what does not check is dropped and counted."""

    max_gap_deg = MAX_GAP_DEG
    rescue = b""

    def __init__(self, model: YdlidarModel) -> None:
        self.baud = model.baud
        self.opening: tuple[bytes, ...] = () if model.talks else (STOP, SCAN)
        self.closing: tuple[bytes, ...] = () if model.talks else (STOP,)
        self._model = model
        self._clock = SensorClock(COUNTED_WINDOW_S)
        self._kept = bytearray()
        self._counted = 0
        self.frames = 0
        self.spoilt = 0
        self.lost_bytes = 0

    def forget(self) -> None:
        """Drop the unfinished packet: what comes next is of another time."""
        self._kept.clear()
        self._counted = 0
        self._clock.reset()

    def feed(self, data: bytes, arrival_s: float) -> list[Beams]:
        """Take bytes as they came, read at ``arrival_s`` on our clock; return the beams in them."""
        kept = self._kept
        kept += data
        found: list[Beams] = []
        while (start := kept.find(HEAD)) >= 0 and len(kept) - start >= HEAD_BYTES:
            size = HEAD_BYTES + kept[start + 3] * self._model.sample_bytes
            if len(kept) - start < size:
                break
            packet = bytes(kept[start : start + size])
            if packet[3] and packet_check(packet, self._model.sample_bytes) == 0:
                found.append(self._beams(packet, arrival_s))
                self.frames += 1
                self.lost_bytes += start
                del kept[: start + size]
            else:
                self.spoilt += 1
                self.lost_bytes += start + 1
                self._counted = 0
                self._clock.reset()  # how many beams were lost is not known
                del kept[: start + 1]
        skipped = start if start >= 0 else max(0, len(kept) - 1)
        self.lost_bytes += skipped
        del kept[:skipped]
        return found

    def _beams(self, packet: bytes, arrival_s: float) -> Beams:
        model, count = self._model, packet[3]
        first, last = (_WORD.unpack_from(packet, at)[0] >> 1 for at in (4, 6))
        swept_deg = ((last - first) / 64.0) % 360.0
        step_deg = swept_deg / (count - 1) if count > 1 else 0.0
        distances = [
            _WORD.unpack_from(packet, at + model.sample_bytes - 2)[0]
            for at in range(HEAD_BYTES, len(packet), model.sample_bytes)
        ]
        if model.sample_bytes == 3:
            distances = [raw & 0xFFFC for raw in distances]  # two bits belong to the intensity
        swept = [(first / 64.0 + index * step_deg) % 360.0 for index in range(count)]
        angles = swept
        if model.triangulates:
            angles = [
                angle + _triangulation_deg(raw * model.unit_m * 1000.0)
                for angle, raw in zip(swept, distances, strict=True)
            ]
        self._counted += count
        period_s = 1.0 / model.beams_per_s
        last_s = self._clock.note(self._counted * period_s, arrival_s)
        return Beams(
            angles_deg=tuple(angle % 360.0 for angle in angles),
            swept_deg=tuple(swept),
            distances_m=tuple(raw * model.unit_m for raw in distances),
            first_s=last_s - (count - 1) * period_s,
            period_s=period_s,
        )


def packet_check(packet: bytes, sample_bytes: int = 2) -> int:
    """Return the xor of a packet's words, its own check among them: 0 where it is good."""
    words = [_WORD.unpack_from(packet, at)[0] for at in range(0, HEAD_BYTES, 2)]
    check = 0
    for word in words:
        check ^= word
    for at in range(HEAD_BYTES, len(packet), sample_bytes):
        if sample_bytes == 3:
            check ^= packet[at]
        check ^= _WORD.unpack_from(packet, at + sample_bytes - 2)[0]
    return check


def _triangulation_deg(distance_mm: float) -> float:
    if not distance_mm > 0.0:
        return 0.0
    return degrees(atan(21.8 * (155.3 - distance_mm) / (155.3 * distance_mm)))


_INFO_HEAD = b"\xa5\x5a\x14\x00\x00\x00\x04"
"""Of the answer to INFO: model, firmware minor and major, hardware, serial number of 16 bytes."""
_INFO_BYTES = 20
_NUMBERS = {5: "g4", 6: "x4", 15: "g2", 100: "tg15"}
"""As YDLidar-SDK numbers its models; 15 is its G2B."""
_ENOUGH_PACKETS = 5
"""Whose check of 16 bits all pass by chance: odds of 2^-80."""


def recognise_talker(data: bytes) -> PortAnswer | None:
    """Return the X2 that sends its packets unasked."""
    decoder = YdlidarDecoder(MODELS["x2"])
    decoder.feed(data, 0.0)
    if decoder.frames < _ENOUGH_PACKETS:
        return None
    return PortAnswer("YDLidar X2 (or another that speaks unasked)", keys={"model": "x2"})


def recognise(data: bytes) -> PortAnswer | None:
    """Return which YDLidar answered INFO; it neither turns nor stops for that."""
    start = data.find(_INFO_HEAD)
    body = data[start + len(_INFO_HEAD) :][:_INFO_BYTES] if start >= 0 else b""
    if len(body) < _INFO_BYTES:
        return None
    name = _NUMBERS.get(body[0])
    if name is None:
        words = f"a YDLidar of model {body[0]}, which Pons does not read"
        return PortAnswer(words, missing={"model": f"one of {', '.join(MODELS)}"})
    words = f"YDLidar {name.upper()}, firmware {body[2]}.{body[1]}, serial {body[4:].hex()}"
    return PortAnswer(words, keys={"model": name})


PROBES = (
    PortProbe("lidar", "ydlidar", MODELS["x2"].baud, recognise_talker),
    *(
        PortProbe("lidar", "ydlidar", baud, recognise, INFO)
        for baud in sorted({model.baud for model in MODELS.values() if not model.talks})
    ),
)
