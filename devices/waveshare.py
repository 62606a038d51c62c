"""Read and write the JSON lines of a Waveshare UGV base (firmware ugv_base_ros).

115 200 baud, one JSON object a line, no checksum. Told to, the base prints each line that it
understood before it obeys it, unknown keys included: a tag that travels with a command comes back
and shows which one it has. Its own report is ``T`` 1001: speeds of both wheels [m/s] and the way of
each since its start in whole centimetres. Nothing tells that its heartbeat has stopped it.
"""

from __future__ import annotations

import json
from dataclasses import dataclass
from math import isfinite, radians
from typing import TYPE_CHECKING, Any, Final, TypeGuard

from devices.inertial import InertialReading, mps2_of
from devices.port_probe import PortAnswer, PortProbe

if TYPE_CHECKING:
    from collections.abc import Iterator

BAUD: Final = 115_200
LONGEST: Final = 512
"""Bytes of a line; a report has 180, with an arm on the base 300."""

T_SPEED: Final = 1
T_HEARTBEAT: Final = 136
T_REPORT: Final = 1001
_PRINT, _ECHO, _REPORTS_ON, _REPORT_DELAY = 605, 143, 131, 142

FASTEST_MPS: Final = 2.0
"""A command beyond is ignored without a word."""
_POSSIBLE_MPS: Final = 4.0
_POSSIBLE_CM: Final = 1e8
_RAW: Final = 32_768.0
_RADPS_A_STEP: Final = radians(1.0 / 16.4)
_MPS2_A_STEP: Final = mps2_of(1.0 / 8192.0)
"""Its chip is set to 2 000 degrees a second and to 4 g."""
START_WORDS: Final = ("Device connected!", "UGV started.")
"""What a base prints while it starts."""


@dataclass(frozen=True, slots=True)
class UgvReport:
    """Hold what a base says of its wheels and battery."""

    left_mps: float
    right_mps: float
    ways_cm: tuple[int, int] | None
    """Of left and right since its start; None: not told, or not as today's firmware does."""
    is_old: bool
    """It tells ways, but in metres: its firmware is older than 0.96."""
    volts: float | None
    inertial: InertialReading | None
    """In its board's axes; None where it tells none."""
    size: int
    """Bytes of the line, which took their time to come."""


@dataclass(frozen=True, slots=True)
class UgvEcho:
    """Hold a speed command as the base has read it."""

    tag: str
    left_mps: float
    right_mps: float


@dataclass(frozen=True, slots=True)
class UgvSetting:
    """Hold a setting that the base has read."""

    kind: int
    value: int


@dataclass(frozen=True, slots=True)
class UgvText:
    """Hold a line of words, as a base prints while it starts."""

    words: str


UgvLine = UgvReport | UgvEcho | UgvSetting | UgvText


def encode_speed(left_mps: float, right_mps: float, tag: str) -> bytes:
    """Return the line that sets both wheels' speeds and feeds the heartbeat."""
    return _line({"T": T_SPEED, "L": left_mps, "R": right_mps, "s": tag})


def encode_settings(heartbeat_ms: int) -> bytes:
    """Return the lines that a base must have heard since its last start: it keeps none of them."""
    return b"".join(
        _line({"T": kind, "cmd": value})
        for kind, value in (
            (_PRINT, 1), (_ECHO, 1), (T_HEARTBEAT, heartbeat_ms), (_REPORTS_ON, 1),
            (_REPORT_DELAY, 0),
        )
    )  # fmt: skip


class UgvReader:
    """Find the lines in a stream of bytes. Keeps at most one unfinished line between calls."""

    def __init__(self) -> None:
        self._rest = b""
        self.spoilt_lines = 0

    def reset(self) -> None:
        """Forget the unfinished line: what comes next is of another time."""
        self._rest = b""

    def read(self, data: bytes) -> list[UgvLine]:
        """Return what the whole lines in what came before and now say, oldest first."""
        *whole, rest = (self._rest + data).split(b"\n")
        if len(rest) > LONGEST:
            rest = b""  # no line is so long: what follows is none either, up to its end
            self.spoilt_lines += 1
        self._rest = rest
        return list(self._read_whole(whole))

    def _read_whole(self, whole: list[bytes]) -> Iterator[UgvLine]:
        for raw in whole:
            line = raw.strip()
            if not line:
                continue
            said = _read_line(line) if len(line) <= LONGEST else None
            if said is None:
                self.spoilt_lines += 1
            else:
                yield said


def _line(fields: dict[str, int | float | str]) -> bytes:
    return json.dumps(fields, separators=(",", ":")).encode() + b"\n"


def _read_line(line: bytes) -> UgvLine | None:
    if not line.startswith(b"{"):
        is_words = line.isascii() and line.decode("ascii").isprintable()
        return UgvText(line.decode("ascii")) if is_words else None
    try:
        said = json.loads(line, parse_constant=_refuse)
    except (ValueError, RecursionError):
        return None
    kind = said.get("T")
    if type(kind) is not int:
        return None
    if kind == T_REPORT:
        return _report(said, len(line) + 2)
    if kind == T_SPEED:
        return _echo(said)
    value = said.get("cmd")
    return UgvSetting(kind, value) if type(value) is int else None


def _echo(said: dict[str, Any]) -> UgvEcho | None:
    tag = said.get("s")
    left, right = _number(said.get("L"), _POSSIBLE_MPS), _number(said.get("R"), _POSSIBLE_MPS)
    if left is None or right is None or not isinstance(tag, str):
        return None
    return UgvEcho(tag, left, right)


def _report(said: dict[str, Any], size: int) -> UgvReport | None:
    left, right = _number(said.get("L"), _POSSIBLE_MPS), _number(said.get("R"), _POSSIBLE_MPS)
    if left is None or right is None:
        return None
    ways = (said.get("odl"), said.get("odr"))
    if any(_number(way, _POSSIBLE_CM) is None for way in ways if way is not None):
        return None
    hundredths = _number(said.get("v"), 10_000.0)
    left_cm, right_cm = ways
    return UgvReport(
        left_mps=left,
        right_mps=right,
        ways_cm=(left_cm, right_cm) if _is_whole(left_cm) and _is_whole(right_cm) else None,
        is_old=any(type(way) is float for way in ways),
        volts=None if hundredths is None else hundredths / 100.0,
        inertial=_inertial(said),
        size=size,
    )


def _inertial(said: dict[str, Any]) -> InertialReading | None:
    """Return what its IMU says; a value that no 16 bits hold makes it none."""
    raw = [_number(said.get(key), _RAW) for key in ("gx", "gy", "gz", "ax", "ay", "az")]
    gx, gy, gz, ax, ay, az = raw
    if gx is None or gy is None or gz is None or ax is None or ay is None or az is None:
        return None
    return InertialReading(
        (gx * _RADPS_A_STEP, gy * _RADPS_A_STEP, gz * _RADPS_A_STEP),
        (ax * _MPS2_A_STEP, ay * _MPS2_A_STEP, az * _MPS2_A_STEP),
    )


def _number(value: object, most: float) -> float | None:
    """Return a number of JSON, None for what is none or beyond what can be."""
    if isinstance(value, bool) or not isinstance(value, int | float):
        return None
    return float(value) if abs(value) <= most and isfinite(value) else None


def _is_whole(value: object) -> TypeGuard[int]:
    return type(value) is int


def _refuse(constant: str) -> float:
    """Refuse NaN and Infinity, which JSON does not have and Python reads.

    Raises:
        ValueError: always.
    """
    raise ValueError(constant)


_ENOUGH_REPORTS: Final = 3


def recognise(data: bytes) -> PortAnswer | None:
    """Return what a base says of itself; it reports about 20 times a second, unasked."""
    reports = [line for line in UgvReader().read(data) if isinstance(line, UgvReport)]
    if len(reports) < _ENOUGH_REPORTS:
        return None
    last = reports[-1]
    words = "Waveshare UGV base"
    if last.ways_cm is None:
        words += (
            ", with firmware older than ugv_base_ros 0.96: update it"
            if last.is_old
            else " that counts no wheel turns (a WAVE ROVER, or its firmware): Pons refuses it"
        )
    elif last.volts is not None:
        words += f", battery {last.volts:.1f} V"
    return PortAnswer(f"{words}; wheels and track: robots/waveshare_*.toml")


PROBES: Final = (PortProbe("drive", "waveshare", BAUD, recognise),)
