"""Read laser scans with their odometry from a CARMEN log, the text that many older robots wrote.

One message a line: ``FLASER`` of the first years and ``ROBOTLASER1`` of later ones. All else is
passed over. The laser is taken for the robot's ``base``, so no offset needs to be known; stamps are
kept but mean nothing to the mapper (some logs have the same on each line). Plain, or by gzip.
"""

from __future__ import annotations

import gzip
import zlib
from dataclasses import dataclass
from math import isfinite, pi
from typing import TYPE_CHECKING

import numpy as np

from maps.errors import BilingualError
from maps.file_errors import system_reason_zh

if TYPE_CHECKING:
    from collections.abc import Iterator
    from pathlib import Path

    from numpy.typing import NDArray

    Floats = NDArray[np.float64]

LONGEST_LINE = 200_000
"""Characters: 4 000 ranges take 40 000."""
MOST_BYTES = 1_000_000_000
"""Of text, unpacked: a day of driving is a tenth."""
MOST_BEAMS = 4_000
USED_M = 8.0
"""Of a scan: what a home robot's lidar sees, and what the tracker's local map holds. Longer ranges
made revisits of one office worse (0.097 m in place of 0.069) and of another no better."""
NEAREST_M = 0.02
"""Nearer than this a laser says that it saw nothing."""


class CarmenError(BilingualError):
    """Report a file that is no CARMEN log, or a line of it that can't be read."""


@dataclass(frozen=True, slots=True)
class CarmenScan:
    """Hold one scan with the laser's pose by odometry."""

    points_m: Floats
    """Returns in the laser's frame, x forward, shape (n, 2)."""
    laser_in_odom: Floats
    """x [m], y [m], yaw [rad]."""
    stamp_s: float


def read_carmen(path: Path) -> Iterator[CarmenScan]:
    """Yield the scans of a log in order. A last line that was cut off is passed over.

    Raises:
        CarmenError: the file can't be read, is too long, or a scan's line is not whole.
    """
    found = 0
    pending: CarmenError | None = None
    for number, line in enumerate(_lines(path), 1):
        if pending is not None:
            raise pending
        words = line.split()
        try:
            scan = _parse_line(words)
        except (ValueError, IndexError) as error:
            zh = f"第 {number} 行（{words[0]}）中的数值不完整或无法读取"
            pending = CarmenError(f"line {number}, {words[0]}: {error}", zh)
            continue
        if scan is not None:
            found += 1
            yield scan
    if not found:
        text = "it holds no line of FLASER or ROBOTLASER1 with a scan"
        raise CarmenError(text, "其中没有含扫描的 FLASER 或 ROBOTLASER1 行")


def _lines(path: Path) -> Iterator[str]:
    taken = 0
    try:
        with path.open("rb") as raw:
            packed = raw.read(2) == b"\x1f\x8b"
        with gzip.open(path, "rb") if packed else path.open("rb") as file:
            while line := file.readline(LONGEST_LINE):
                taken += len(line)
                if len(line) == LONGEST_LINE or not taken <= MOST_BYTES:
                    text = "a line or the whole of it is too long for a log"
                    raise CarmenError(text, "某一行或整个文件过长，不是日志")
                yield line.decode("ascii", "replace")
    except (OSError, EOFError, zlib.error) as error:  # gzip's BadGzipFile is an OSError
        zh = system_reason_zh(error) if isinstance(error, OSError) else "压缩文件不完整"
        raise CarmenError(str(error), zh) from error


def _parse_line(words: list[str]) -> CarmenScan | None:
    match words[:1]:
        case ["FLASER"]:
            count = _count(words[1])
            ranges, rest = _numbers(words[2 : 2 + count], count), words[2 + count :]
            # 181 readings span 180 degrees with both ends, 180 and 360 without the last.
            step_rad = pi / (count - 1 if count % 2 else count)
            return _scan(ranges, -pi / 2, step_rad, rest[0:3], rest[6])
        case ["ROBOTLASER1"]:
            start_rad, step_rad = _number(words[2]), _number(words[4])
            count = _count(words[8])
            ranges, rest = _numbers(words[9 : 9 + count], count), words[9 + count :]
            most_m = _number(words[5])
            ranges = np.where(ranges < most_m, ranges, np.inf) if most_m > 0.0 else ranges
            remissions = int(rest[0])
            if not 0 <= remissions <= MOST_BEAMS:
                raise ValueError(f"{remissions} remissions")
            rest = rest[1 + remissions :]
            return _scan(ranges, start_rad, step_rad, rest[0:3], rest[11])
    return None


def _scan(
    ranges_m: Floats, start_rad: float, step_rad: float, pose: list[str], stamp: str
) -> CarmenScan:
    used = (ranges_m > NEAREST_M) & (ranges_m < USED_M)
    angles = start_rad + step_rad * np.flatnonzero(used)
    near = ranges_m[used]
    points_m = np.column_stack((near * np.cos(angles), near * np.sin(angles)))
    return CarmenScan(points_m, _numbers(pose, 3), _number(stamp))


def _count(word: str) -> int:
    count = int(word)
    if not 2 <= count <= MOST_BEAMS:
        raise ValueError(f"{count} readings, expected 2 to {MOST_BEAMS}")
    return count


def _numbers(words: list[str], count: int) -> Floats:
    if len(words) != count:
        raise ValueError(f"{len(words)} numbers, expected {count}")
    values = np.array(words, np.float64)
    if not np.isfinite(values).all():
        raise ValueError("a number that is none")
    return values


def _number(word: str) -> float:
    value = float(word)
    if not isfinite(value):
        raise ValueError(f"{word} is no number")
    return value
