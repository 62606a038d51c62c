"""A scan that no lidar takes does not become a message: it is dropped where it is read, by name."""

from __future__ import annotations

import json
from typing import Any

import pytest

from tests.wire.examples import EXAMPLES
from wire import DecodeFailure, Scan, decode, encode, keys
from wire.bounded_types import MAX_BEAMS


def changed(**values: Any) -> bytes:
    said = json.loads(encode(EXAMPLES[Scan]))
    return json.dumps({**said, **values}).encode()


@pytest.mark.parametrize("beams", [0, 1, 7, MAX_BEAMS])
def test_any_number_of_beams_up_to_the_most_is_a_scan(beams: int) -> None:
    scan = decode(keys.SCAN, changed(ranges_m=[1.0] * beams))
    assert isinstance(scan, Scan)
    assert len(scan.ranges_m) == beams


@pytest.mark.parametrize(
    ("field", "value"),
    [
        ("ranges_m", [1.0] * (MAX_BEAMS + 1)),
        ("ranges_m", [float("nan")]),
        ("ranges_m", [float("inf")]),
        ("ranges_m", [-0.1]),
        ("ranges_m", ["1.0"]),
        ("ranges_m", [True]),
        ("angle_increment_rad", -0.02),
        ("angle_increment_rad", 0.0),
        ("angle_increment_rad", float("nan")),
        ("angle_increment_rad", 7.0),
        ("angle_min_rad", 99.0),
        ("time_increment_s", -0.001),
        ("stamp_s", float("nan")),
        ("seq", -1),
    ],
)
def test_what_no_lidar_says_is_no_scan(field: str, value: object) -> None:
    failed = decode(keys.SCAN, changed(**{field: value}))
    assert isinstance(failed, DecodeFailure)
    assert failed.code
