"""Hold the picture of a scan to its beams."""

from __future__ import annotations

from math import cos, hypot, pi, radians, sin, tau

import pytest
from hypothesis import given
from hypothesis import strategies as st
from pydantic import TypeAdapter

from bridge.core.geometry.lidar_scan import ScanPicture, Sector
from tests.bridge.core.beams import picture
from tests.bridge.core.table import table
from wire import IDENTITY, Scan
from wire.lidar_config import LidarConfig

LIDAR = LidarConfig()
EPS = 1e-6


def scan(ranges: list[float | None], first: float = 0.0, step: float | None = None) -> Scan:
    return Scan(
        boot_id="a",
        seq=1,
        stamp_s=0.0,
        angle_min_rad=first,
        angle_increment_rad=step or tau / max(len(ranges), 7),
        range_min_m=0.12,
        range_max_m=8.0,
        ranges_m=tuple(ranges),
    )


def taken(ranges: list[float | None], lidar: LidarConfig = LIDAR, **kind: float) -> ScanPicture:
    return ScanPicture.from_scan(scan(ranges, **kind), IDENTITY, lidar)


def test_a_beam_is_a_point_nothing_or_too_near() -> None:
    made = taken([1.0, None, 0.05, 9.0, 0.0, 8.0, 0.12, 2.0])
    step = tau / 8
    expected = [(1.0, 0), (0.12, 2), (0.12, 4), (8.0, 5), (0.12, 6), (2.0, 7)]
    assert made.xs_m == pytest.approx([r * cos(i * step) for r, i in expected])
    assert made.ys_m == pytest.approx([r * sin(i * step) for r, i in expected])
    assert (made.beams, made.returns) == (8, 6)
    assert made.nearest_m == pytest.approx(0.12)


def test_the_lidar_stands_where_the_robot_says() -> None:
    made = taken([1.0, None], LidarConfig(x_m=0.2, y_m=-0.1, yaw_rad=pi / 2), step=0.1)
    assert made.xs_m == pytest.approx([0.2])
    assert made.ys_m == pytest.approx([0.9])
    assert made.nearest_m is not None
    assert made.nearest_m <= 0.9


@given(
    st.lists(st.none() | st.floats(0, 12), max_size=60),
    st.floats(-6, 6),
    st.floats(-10, 10),
    st.floats(0, 3.1),
)
def test_a_sector_counts_its_beams(
    ranges: list[float | None], first: float, middle: float, half: float
) -> None:
    made = taken(ranges, first=first)
    sector = made.sector(middle, half)
    step = tau / max(len(ranges), 7)

    def off(index: int) -> float:
        turned = (first + index * step - middle) % tau
        return min(turned, tau - turned)

    sure = [i for i in range(len(ranges)) if off(i) < half - 1e-6]
    maybe = [i for i in range(len(ranges)) if off(i) < half + 1e-6]
    assert len(sure) <= sector.beams <= len(maybe)
    came = [i for i in maybe if (r := ranges[i]) is not None and r <= 8.0]
    assert sector.returned <= len(came)


@given(
    st.lists(st.none() | st.floats(0, 12), max_size=60),
    st.floats(0.01, 9),
    st.sampled_from([LIDAR, LidarConfig(x_m=0.2, y_m=-0.1), LidarConfig(range_min_m=1.0)]),
)
def test_within_sight_no_return_is_left_out(
    ranges: list[float | None], sight: float, lidar: LidarConfig
) -> None:
    full = ScanPicture.from_scan(scan(ranges), IDENTITY, lidar)
    near = ScanPicture.from_scan(scan(ranges), IDENTITY, lidar, sight)
    everything = set(zip(full.xs_m, full.ys_m, strict=True))
    kept = set(zip(*near.points(sight), strict=True))
    assert kept <= everything
    assert all(hypot(x, y) >= sight - 1e-9 for x, y in everything - kept)
    assert set(zip(*near.points(sight + 0.1), strict=True)) == everything
    assert near.returns == full.returns == len(full.xs_m)
    assert (near.nearest_m is None) is (full.nearest_m is None)
    if near.nearest_m is not None:
        assert all(hypot(x, y) >= near.nearest_m - 1e-9 for x, y in everything)


@given(st.lists(st.none() | st.floats(0, 1000), max_size=20))
def test_a_picture_survives_json(ranges: list[float | None]) -> None:
    adapter = TypeAdapter(ScanPicture)
    made = taken(ranges)
    assert adapter.validate_json(adapter.dump_json(made)) == made


@table(
    ("first", "count", "middle", "half", "beams"),
    [
        (0, 360, 0.0, 10.2, 21), (0, 360, 0.4, 10.2, 20), (0, 360, 180.0, 0.4, 1),
        (0, 360, 359.9, 10.2, 21), (-90, 181, 0.0, 200.0, 181), (-90, 181, 90.0, 10.2, 11),
        (-90, 181, -90.0, 10.2, 11), (-90, 181, 180.0, 10.2, 0), (-90, 181, 120.0, 40.2, 11),
        (200, 360, 195.0, 10.2, 21), (0, 400, 20.0, 10.2, 42), (0, 360, 0.5, -1.0, 0),
        (0, 360, 3.0, 0.0, 1), (350, 30, 5.0, 90.0, 30), (0, 360, 720.4, 10.2, 20),
    ],
)  # fmt: skip
def test_beams_of_a_sector(first: int, count: int, middle: float, half: float, beams: int) -> None:
    made = picture({}, first=first, count=count)
    sector = made.sector(radians(middle), radians(half))
    assert (sector.beams, sector.returned) == (beams, beams)
    gone = picture({}, first=first, count=count, others=None).sector(radians(middle), radians(half))
    assert (gone.beams, gone.returned) == (beams, 0)
    last = picture({}, first=first, count=count, others=8.0)
    assert last.sector(radians(middle), radians(half)).returned == beams
    far = picture({}, first=first, count=count, others=8.0 + EPS)
    assert far.sector(radians(middle), radians(half)).returned == 0


def test_half_of_the_beams_is_enough_and_none_are_not() -> None:
    assert Sector(4, 2, True).is_known
    assert Sector(1, 1, True).is_known
    assert Sector(5, 3, True).is_known
    assert not Sector(5, 2, True).is_known
    assert not Sector(0, 0, True).is_known


@table(
    ("middle", "half", "covered"),
    [
        (0.0, 90.9, True), (0.0, 91.6, False), (45.0, 46.0, True), (45.0, 47.1, False),
        (-45.0, 45.9, True), (-45.0, 46.1, False), (180.0, 1.0, False), (-91.0 + 0.1, 0.0, True),
        (-91.1, 0.0, False),
    ],
)  # fmt: skip
def test_a_field_covers_a_beam_more_than_it_has(middle: float, half: float, covered: bool) -> None:
    made = picture({}, first=-90, count=181)  # from -91 to 92 degrees, the spare beam counted
    assert made.sector(radians(middle), radians(half)).covered is covered


def test_a_point_is_kept_for_where_the_robot_is_not_for_where_its_lidar_is() -> None:
    lidar = LidarConfig(x_m=0.3, y_m=0.1)
    made = picture({180: 0.75}, lidar, sight_m=0.5)  # 0.46 m from the middle of the robot
    assert made.xs_m == pytest.approx((-0.45,))
    assert made.ys_m == pytest.approx((0.1,))
    again_xs, again_ys = made.points(0.5 + EPS)
    assert (again_xs[180], again_ys[180]) == pytest.approx((-0.45, 0.1))
    assert (len(made.points(0.5)[0]), len(again_xs)) == (1, 360)
