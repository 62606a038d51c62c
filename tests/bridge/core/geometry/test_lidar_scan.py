"""Hold the picture of a scan: what a beam means, and which beams lie in a sector."""

from __future__ import annotations

from math import cos, hypot, pi, radians, sin, tau

import pytest
from hypothesis import given
from hypothesis import strategies as st
from pydantic import TypeAdapter

from bridge.core.geometry.lidar_scan import ScanPicture
from wire.geometry import IDENTITY
from wire.robot import LidarConfig
from wire.sensors import Scan

LIDAR = LidarConfig()


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


def picture(ranges: list[float | None], lidar: LidarConfig = LIDAR, **kind: float) -> ScanPicture:
    return ScanPicture.from_scan(scan(ranges, **kind), IDENTITY, lidar)


def test_a_beam_is_a_point_nothing_or_too_near() -> None:
    made = picture([1.0, None, 0.05, 9.0, 0.0, 8.0, 0.12, 2.0])
    step = tau / 8
    expected = [(1.0, 0), (0.12, 2), (0.12, 4), (8.0, 5), (0.12, 6), (2.0, 7)]
    assert made.xs_m == pytest.approx([r * cos(i * step) for r, i in expected])
    assert made.ys_m == pytest.approx([r * sin(i * step) for r, i in expected])
    assert (made.beams, made.returns) == (8, 6)
    assert made.nearest_m == pytest.approx(0.12)


def test_the_lidar_stands_where_the_robot_says() -> None:
    made = picture([1.0, None], LidarConfig(x_m=0.2, y_m=-0.1, yaw_rad=pi / 2), step=0.1)
    assert made.xs_m == pytest.approx([0.2])
    assert made.ys_m == pytest.approx([0.9])
    assert made.nearest_m is not None
    assert made.nearest_m <= 0.9


def test_an_empty_scan_is_a_picture_of_nothing() -> None:
    made = picture([])
    assert (made.beams, made.returns, made.nearest_m) == (0, 0, None)
    assert not made.sector(0.0, 1.0).is_known
    assert not made.sector(0.0, 1.0).covered


@given(
    st.lists(st.none() | st.floats(0, 12), max_size=60),
    st.floats(-6, 6),
    st.floats(-10, 10),
    st.floats(0, 3.1),
)
def test_a_sector_counts_its_beams(
    ranges: list[float | None], first: float, middle: float, half: float
) -> None:
    made = picture(ranges, first=first)
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


def test_all_round_counts_no_beam_twice() -> None:
    made = picture([1.0] * 360)
    assert made.sector(0.3, pi).beams == 360
    assert made.sector(0.3, 4.0).returned == 360


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


@pytest.mark.parametrize(
    ("middle", "half", "covered"),
    [(0.0, 1.0, True), (0.0, 2.3, True), (0.0, 2.5, False), (pi, 0.1, False), (2.0, 0.3, True)],
)
def test_a_lidar_of_three_quarters_covers_only_its_field(
    middle: float, half: float, covered: bool
) -> None:
    made = picture([1.0] * 270, first=radians(-135), step=radians(1))
    assert made.sector(middle, half).covered is covered


@given(st.lists(st.none() | st.floats(0, 1000), max_size=20))
def test_a_picture_survives_json(ranges: list[float | None]) -> None:
    adapter = TypeAdapter(ScanPicture)
    made = picture(ranges)
    assert adapter.validate_json(adapter.dump_json(made)) == made
