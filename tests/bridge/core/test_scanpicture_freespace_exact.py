"""Hold what a lidar has seen of a way to beams that are counted one by one: sector and field."""

from __future__ import annotations

from math import degrees, radians

import pytest

from bridge.core.geometry.lidar_scan import Sector
from bridge.core.motion import free_distance
from bridge.core.motion.free_distance import FreeLength, free_length
from tests.bridge.core.table import table
from tests.bridge.core.test_freespace_exact import (
    AHEAD,
    BACK,
    DISC_M,
    EPS,
    RADIUS_M,
    REACH_M,
    picture,
)
from wire import IDENTITY, Pose2, Twist2
from wire.robot import LidarConfig


def counted(
    back: set[int], twist: Twist2, start: Pose2 = IDENTITY, lidar: LidarConfig | None = None
) -> bool:
    """Tell whether a way is known where these beams alone came back."""
    seen: dict[int, float | None] = dict.fromkeys([i % 360 for i in back], 7.0)
    made = picture(seen, lidar, others=None)
    return free_length(made, start, twist, RADIUS_M).known


def span(low: int, high: int) -> set[int]:
    return set(range(low, high + 1))


# half way, 1 m ahead, the disc fills asin(0.35) = 20.49 degrees to either side; 41 beams in all
# along an arc of 1 m the sector is from 22.50 - 27.21 to 45.00 + 14.33 degrees: 64 beams
LEFT, ASIDE = Pose2(0.0, 0.0, radians(90)), LidarConfig(x_m=0.3, y_m=0.1)


@table(
    ("twist", "start", "lidar", "low", "high"),
    [
        (AHEAD, IDENTITY, None, -20, 20),
        (AHEAD, LEFT, None, 70, 110),
        (Twist2(0.5, 0.5), LEFT, None, 86, 149),
        (AHEAD, IDENTITY, ASIDE, -37, 21),  # from 0.3 m on and 0.1 m left: 0.71 m half way
        (BACK, IDENTITY, None, 160, 200),
        (Twist2(0.5, 0.5), IDENTITY, None, -4, 59),
        (Twist2(0.5, -0.5), IDENTITY, None, -59, 4),
        (Twist2(-0.5, -0.5), IDENTITY, None, 121, 184),
        (Twist2(-0.5, 0.5), IDENTITY, None, 176, 239),
    ],
)
def test_a_way_is_known_where_half_of_its_beams_came_back(
    twist: Twist2, start: Pose2, lidar: LidarConfig | None, low: int, high: int
) -> None:
    need = (high - low + 2) // 2
    elsewhere = span(high + 1, low + 359)
    for back, known in (
        (span(low, low + need - 1) | elsewhere, True),
        (span(low + 1, low + need - 1) | elsewhere, False),
        (span(high - need + 1, high) | elsewhere, True),
        (span(high - need + 1, high - 1) | elsewhere, False),
        (span(low, high), True),
        (elsewhere, False),
    ):
        assert counted(back, twist, start, lidar) is known


def test_an_end_within_the_disc_is_seen_all_around() -> None:
    # a circle of 8 cm ends after a quarter turn, 11 cm off: half a turn, about its direction
    tight = Twist2(0.08, 1.0)
    low, high = -67, 135  # 90 degrees right of 22.5, half way, and 90 left of 45, at the end
    need = (high - low + 2) // 2
    assert counted(span(low, low + need - 1), tight)
    assert not counted(span(low - 9, low + need - 2), tight)
    assert counted(span(high - need + 1, high), tight)
    assert not counted(span(high - need + 2, high + 9), tight)


def test_what_lies_within_a_tenth_of_the_disc_has_no_direction() -> None:
    # the circle's end is 3.3 cm off: no direction but ahead
    tight = Twist2(0.0235, 1.0)
    assert counted(span(-60, 35), tight)  # 96 of the 180 ahead
    assert counted(span(-35, 60), tight)
    assert not counted(span(-40, 45), tight)


@table(
    ("missing", "disc", "moved", "lidar_x", "few"),
    [
        (0, 0.35, 0.0, 0.0, True),
        (18, 0.35, 0.0, 0.0, True),  # 2 x 20.49 - 3 = 37.97 degrees
        (19, 0.35, 0.0, 0.0, False),
        (14, 0.35, 0.1, 0.2, True),  # 2 x asin(0.35 / 1.3) = 31.24 degrees
        (15, 0.35, 0.1, 0.2, False),
        (14, 0.35, 0.1, -0.2, True),
        (15, 0.35, 0.1, -0.2, False),
        (88, 1.5, 0.0, 0.0, True),
        (89, 1.5, 0.0, 0.0, False),
    ],
)
def test_so_few_are_missing_that_no_sector_lacks_half(
    missing: int, disc: float, moved: float, lidar_x: float, few: bool
) -> None:
    gone: dict[int, float | None] = dict.fromkeys(range(missing), None)
    made = picture(gone, LidarConfig(x_m=lidar_x))
    assert free_distance._few_missing(made, disc, moved) is few
    turned = picture(gone, LidarConfig(y_m=lidar_x))
    assert free_distance._few_missing(turned, disc, moved) is few


def test_of_no_beams_none_is_missing_and_nothing_known() -> None:
    assert not free_distance._few_missing(picture({}, count=0), DISC_M, 0.0)
    assert free_distance._few_missing(picture({}, count=1), DISC_M, 0.0)


@table(
    ("first", "count", "twist", "covered"),
    [
        (-21, 43, AHEAD, True),
        (-19, 40, AHEAD, False),
        (-21, 40, AHEAD, False),
        (-6, 68, Twist2(0.5, 0.5), True),
        (-2, 68, Twist2(0.5, 0.5), False),
        (-60, 66, Twist2(0.5, -0.5), True),
        (159, 43, BACK, True),
        (161, 43, BACK, False),
    ],
)
def test_a_way_out_of_the_field_is_not_entered(
    first: int, count: int, twist: Twist2, covered: bool
) -> None:
    made = picture({}, first=first, count=count)
    free = free_length(made, IDENTITY, twist, RADIUS_M)
    assert free == FreeLength(REACH_M if covered else 0.0, True, covered, False)


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


def test_a_whole_turn_is_a_turn() -> None:
    assert picture({}).whole
    assert picture({}, count=400).whole
    assert not picture({}, count=359).whole
    assert degrees(picture({}).step_rad) == pytest.approx(1.0)


def test_a_point_is_kept_for_where_the_robot_is_not_for_where_its_lidar_is() -> None:
    lidar = LidarConfig(x_m=0.3, y_m=0.1)
    made = picture({180: 0.75}, lidar, sight_m=0.5)  # 0.46 m from the middle of the robot
    assert made.xs_m == pytest.approx((-0.45,))
    assert made.ys_m == pytest.approx((0.1,))
    again_xs, again_ys = made.points(0.5 + EPS)
    assert (again_xs[180], again_ys[180]) == pytest.approx((-0.45, 0.1))
    assert (len(made.points(0.5)[0]), len(again_xs)) == (1, 360)
