"""Measure what the readers of bases of others believe of spoilt lines and frames.

Each good line says random values; spoilt are flipped bits, other bytes, bytes missing, bytes too
many. "Believed" counts lines from which something was read that the good one did not say. JSON and
ros_arduino_bridge have no checksum, so some must be; DYNAMIXEL's lets 1 of 65 536 by. What their
protocols refuse of it besides (ways that no wheel can have gone) is not counted here.
"""

from __future__ import annotations

import json
import struct
from functools import partial
from random import Random
from typing import TYPE_CHECKING, Any

from devices.dynamixel import STATUS, DynamixelReader, encode_frame
from devices.ros_arduino import ArduinoReader
from devices.turtlebot3 import BOARD, TABLE_BYTES, decode_table
from devices.waveshare import UgvReader
from tools.bench.figures import none_in
from tools.bench.report import ReportRow

if TYPE_CHECKING:
    from collections.abc import Callable

    from tools.bench.context import BenchLab

NAME = "base_frames"
TITLE = "bases of others: what is believed of spoilt lines"
LONG_ONLY = True
FRAMES = 1_000_000
SLICES = 10


def measure(lab: BenchLab) -> list[ReportRow]:
    """Spoil the lines of each base."""
    each = lab.count(FRAMES // 100, FRAMES) // SLICES
    rows = []
    for kind in LINES:
        take = partial(fuzz, kind, each)
        rows += _rows(kind, list(lab.slices(f"fuzz {kind}", SLICES, take)))
    return rows


def fuzz(kind: str, count: int, index: int) -> dict[str, int]:
    """Spoil so many lines; count crashes of the reader and what it believed."""
    random = Random(f"{kind} {index}")
    make, read = LINES[kind]
    crashes = believed = done = 0
    while done < count:
        good = make(random)
        spoilt = _spoil(good, random)
        if spoilt == good:
            continue
        done += 1
        try:
            told, meant = read(spoilt), read(good)
        except Exception:  # noqa: BLE001  # any is what is counted
            crashes += 1
            continue
        believed += any(one not in meant for one in told)
    return {"frames": done, "crashes": crashes, "believed": believed}


def _ugv_line(random: Random) -> bytes:
    said = {
        "T": 1001,
        "L": round(random.uniform(-2, 2), 5),
        "R": round(random.uniform(-2, 2), 5),
        **{key: random.randint(-32_768, 32_767) for key in ("ax", "ay", "az", "gx", "gy", "gz")},
        "odl": random.randint(-10_000, 10_000),
        "odr": random.randint(-10_000, 10_000),
        "v": random.randint(900, 1300),
    }
    return json.dumps(said, separators=(",", ":")).encode() + b"\r\n"


def _read_ugv(data: bytes) -> list[Any]:
    """Return what is read, without the line's length, which is no claim of the base's."""
    return [str(line).partition("size=")[0] for line in UgvReader().read(data)]


def _arduino_line(random: Random) -> bytes:
    left, right = (random.randint(-(2**31), 2**31 - 1) for _ in range(2))
    return f"{left} {right}\r\n".encode()


def _read_arduino(data: bytes) -> list[Any]:
    return list(ArduinoReader().read(data))


def _board_frame(random: Random) -> bytes:
    table = bytearray(random.randbytes(TABLE_BYTES))
    struct.pack_into("<HIB", table, 0, 0x5000, 1, 4)
    return encode_frame(BOARD, STATUS, b"\x00" + bytes(table))


def _read_board(data: bytes) -> list[Any]:
    tables = (
        decode_table(frame.parameters)
        for frame in DynamixelReader().read(data)
        if (frame.id, frame.instruction) == (BOARD, STATUS)
    )
    return [str(table) for table in tables if table is not None]


LINES: dict[str, tuple[Callable[[Random], bytes], Callable[[bytes], list[Any]]]] = {
    "waveshare": (_ugv_line, _read_ugv),
    "arduino": (_arduino_line, _read_arduino),
    "turtlebot3": (_board_frame, _read_board),
}


def _spoil(line: bytes, random: Random) -> bytes:
    body = bytearray(line)
    way, at = random.randrange(4), random.randrange(len(body))
    if way == 0:
        for _ in range(random.choice((1, 1, 2, 3, 5))):
            body[random.randrange(len(body))] ^= 1 << random.randrange(8)
    elif way == 1:
        end = min(len(body), at + random.randint(1, 20))
        body[at:end] = random.randbytes(end - at)
    elif way == 2:
        del body[at : at + random.randint(1, 20)]
    else:
        body[at:at] = random.randbytes(random.randint(1, 20))
    return bytes(body)


def _rows(kind: str, runs: list[dict[str, int]]) -> list[ReportRow]:
    frames, crashes, believed = (
        sum(run[what] for run in runs) for what in ("frames", "crashes", "believed")
    )
    goal = f"<= {frames / 65_536:.0f} by its CRC" if kind == "turtlebot3" else "no checksum"
    return [
        ReportRow(f"{kind}, spoilt: crashes", "", "0", value=str(crashes), note=none_in(frames)),
        ReportRow(
            f"{kind}, spoilt: believed",
            "",
            goal,
            value=str(believed),
            note=f"{believed / max(1, frames):.4%} of {frames}",
        ),
    ]
