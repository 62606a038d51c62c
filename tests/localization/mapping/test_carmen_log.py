"""A CARMEN log gives its scans with the laser's pose; what is no log is refused by line."""

from __future__ import annotations

import gzip
from pathlib import Path

import numpy as np
import pytest

from localization.mapping.carmen_log import CarmenError, read_carmen

TAIL = "0 pippo 0"


def flaser(ranges: list[float], pose: str = "1.0 2.0 0.5", tail: str = f"9 9 9 {TAIL}") -> str:
    return f"FLASER {len(ranges)} {' '.join(map(str, ranges))} {pose} {tail}\n"


def robotlaser(ranges: list[float]) -> str:
    count = len(ranges)
    head = f"ROBOTLASER1 0 -1.0 2.0 1.0 6.0 0.01 0 {count}"
    return f"{head} {' '.join(map(str, ranges))} 2 7 7 1 2 0.5 1.1 2 0.5 0 0 0.4 0.3 0 12.5 h 1\n"


def written(folder: Path, text: str) -> Path:
    path = folder / "a.log"
    path.write_text(text, "ascii")
    return path


def test_the_first_format_spans_half_a_circle(tmp_path: Path) -> None:
    log = "# a comment\nPARAM robot_length 0.4 h 0\n" + flaser([1.0, 2.0, 3.0]) + "NEFF 3\n"
    (scan,) = read_carmen(written(tmp_path, log))
    assert scan.laser_in_odom == pytest.approx((1.0, 2.0, 0.5))
    assert scan.points_m == pytest.approx(np.array(((0.0, -1.0), (2.0, 0.0), (0.0, 3.0))))


def test_an_even_number_of_beams_leaves_the_last_end_out(tmp_path: Path) -> None:
    (scan,) = read_carmen(written(tmp_path, flaser([1.0, 1.0])))
    assert scan.points_m == pytest.approx(np.array(((0.0, -1.0), (1.0, 0.0))))


def test_the_second_format_says_its_angles_and_farthest_range(tmp_path: Path) -> None:
    (scan,) = read_carmen(written(tmp_path, robotlaser([1.0, 6.0, 2.0])))
    assert scan.points_m == pytest.approx(
        np.array(((np.cos(1.0), -np.sin(1.0)), (2 * np.cos(1.0), 2 * np.sin(1.0))))
    )
    assert (scan.stamp_s, scan.laser_in_odom[1]) == (12.5, 2.0)


def test_ranges_that_say_nothing_are_left_out(tmp_path: Path) -> None:
    (scan,) = read_carmen(written(tmp_path, flaser([0.0, 81.91, 1.0])))
    assert len(scan.points_m) == 1


def test_a_packed_log_is_read_as_well(tmp_path: Path) -> None:
    path = tmp_path / "a.log.gz"
    path.write_bytes(gzip.compress(flaser([1.0, 2.0, 3.0]).encode() * 3))
    assert len(list(read_carmen(path))) == 3


def test_a_last_line_that_was_cut_off_is_passed_over(tmp_path: Path) -> None:
    path = written(tmp_path, flaser([1.0, 2.0, 3.0]) + "FLASER 3 1.0 2.0")
    assert len(list(read_carmen(path))) == 1


@pytest.mark.parametrize(
    ("text", "told"),
    [
        ("", "no line"),
        ("ODOM 0 0 0 0 0 0 0 h 0\n", "no line"),
        (flaser([1.0, float("nan"), 1.0]) * 2, "line 1"),
        (flaser([1.0, float("inf"), 1.0]) * 2, "line 1"),
        (flaser([1.0, 2.0, 3.0], pose="nan 0 0") * 2, "line 1"),
        ("FLASER 3 1.0 2.0\n" + flaser([1.0, 2.0, 3.0]), "line 1"),
        ("FLASER x 1.0\n" * 2, "line 1"),
        ("FLASER -5 1.0\n" * 2, "readings"),
        ("FLASER 1000000000 1.0\n" * 2, "readings"),
        ("FLASER\n" * 2, "line 1"),
        ("ROBOTLASER1 0 -1 2 1 6 0.01 0 3 1 1 1 -7 1 2 0\n" * 2, "remissions"),
        ("FLASER 3 " + "1" * 300_000 + "\n", "too long"),
        ("\x00\x01\x02" * 99, "no line"),
    ],
)
def test_what_is_no_log_is_refused(text: str, told: str, tmp_path: Path) -> None:
    with pytest.raises(CarmenError, match=told):
        list(read_carmen(written(tmp_path, text)))


@pytest.mark.parametrize(
    "data",
    [
        b"\x1f\x8b",
        b"\x1f\x8b\x08 no gzip",
        gzip.compress(b"F" * 99, mtime=0)[:30],
        gzip.compress(b"", mtime=0)[:10] + b"\xff" * 40,
    ],
)
def test_a_spoilt_archive_is_refused(data: bytes, tmp_path: Path) -> None:
    path = tmp_path / "a.log.gz"
    path.write_bytes(data)
    with pytest.raises(CarmenError):
        list(read_carmen(path))


def test_a_missing_log_is_refused(tmp_path: Path) -> None:
    with pytest.raises(CarmenError, match="No such file"):
        list(read_carmen(tmp_path / "none.log"))
