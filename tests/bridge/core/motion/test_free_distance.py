"""Hold free distance to points placed one by one, to beams counted one by one, and to its laws."""

from __future__ import annotations

from dataclasses import replace
from functools import lru_cache
from math import asin, cos, hypot, inf, pi, radians, sin

import pytest
from hypothesis import assume, example, given
from hypothesis import strategies as st

from bridge.core.geometry.lidar_scan import ScanPicture
from bridge.core.motion import free_distance
from bridge.core.motion.braking import speed_scale
from bridge.core.motion.free_distance import NOTHING_KNOWN, FreeLength, free_length
from bridge.core.sensing.sensor_update import MARGIN_M, REACH_M
from tests.bridge.core.beams import picture
from tests.bridge.core.table import table
from tests.laws import at_least
from wire import IDENTITY, Pose2, Twist2
from wire.lidar_config import LidarConfig
from wire.robot import Base, Limits

RADIUS, DISC = Base().radius_m, Base().radius_m + MARGIN_M
EPS = 1e-6
AHEAD, BACK = Twist2(0.5, 0.0), Twist2(-0.5, 0.0)


@lru_cache(maxsize=64)
def one_point(degree: int, range_m: float) -> ScanPicture:
    return picture({degree: range_m})


def centre(start: Pose2, twist: Twist2, gone_m: float) -> tuple[float, float]:
    """Return where the disc is after so much of the arc, by the circle's centre."""
    sign = 1.0 if twist.v_mps > 0.0 else -1.0
    if abs(twist.w_radps) < 1e-6:
        along = sign * gone_m
        return start.x_m + along * cos(start.yaw_rad), start.y_m + along * sin(start.yaw_rad)
    radius = twist.v_mps / twist.w_radps
    yaw = start.yaw_rad + sign * gone_m / radius
    return (
        start.x_m + radius * (sin(yaw) - sin(start.yaw_rad)),
        start.y_m - radius * (cos(yaw) - cos(start.yaw_rad)),
    )


def walked_m(points: list[tuple[float, float]], start: Pose2, twist: Twist2) -> float:
    """Walk the arc until the disc touches a point, and halve the last step until it is told."""

    def touches(gone_m: float) -> bool:
        x, y = centre(start, twist, gone_m)
        return any(hypot(px - x, py - y) < DISC for px, py in points)

    for step in range(201):
        if touches(step * 0.01):
            low, high = (step - 1) * 0.01, step * 0.01
            for _ in range(40):
                middle = (low + high) / 2
                low, high = (low, middle) if touches(middle) else (middle, high)
            return high
    return REACH_M


directions = st.floats(-pi, pi)


@at_least(60)
@given(
    st.dictionaries(st.integers(0, 359), st.floats(0.36, 3.0), min_size=1, max_size=6),
    st.sampled_from([0.4, -0.4]),
    st.floats(-3, 3),
    st.builds(Pose2, st.floats(-0.1, 0.1), st.floats(-0.1, 0.1), directions),
)
def test_free_length_is_that_of_walking_the_arc(
    returns: dict[int, float], v: float, w: float, start: Pose2
) -> None:
    made = picture(dict(returns))
    points = list(zip(made.xs_m, made.ys_m, strict=True))
    assume(all(hypot(x - start.x_m, y - start.y_m) >= DISC + 0.003 for x, y in points))
    walked = walked_m(points, start, Twist2(v, w))
    free = free_length(made, start, Twist2(v, w), RADIUS).s_m
    assert free == pytest.approx(walked, abs=0.004) or free <= walked <= free + 0.05


@given(st.floats(-1.4, 1.4), st.sampled_from([0.4, -0.4]), st.floats(-3, 3), directions)
def test_at_contact_there_is_no_way_round_the_circle(
    aside: float, v: float, w: float, yaw: float
) -> None:
    toward = yaw + aside if v > 0 else yaw + pi + aside
    for from_m, most_m in ((DISC, 1e-6), (DISC * (1 + 1e-12), 1e-4)):
        x, y = from_m * cos(toward), from_m * sin(toward)
        made = replace(picture({}), xs_m=(x,), ys_m=(y,), nearest_m=from_m)
        assert free_length(made, Pose2(0.0, 0.0, yaw), Twist2(v, w), RADIUS).s_m <= most_m


@at_least(200)
@given(
    st.sets(st.integers(0, 359), max_size=40),
    st.integers(0, 359),
    st.integers(0, 60),
    st.floats(-0.2, 0.2),
    directions,
    st.floats(-6, 6),
    st.sampled_from([0.4, -0.4]),
)
def test_what_is_known_without_counting_is_known_by_counting(
    single: set[int], first: int, run: int, x: float, yaw: float, w: float, v: float
) -> None:
    missing = single | {(first + i) % 360 for i in range(run)}
    made = picture(dict.fromkeys(missing))
    start = Pose2(x, 0.1, yaw)
    quick = free_length(made, start, Twist2(v, w), RADIUS)
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(free_distance, "_few_missing", lambda *_: False)
        assert free_length(made, start, Twist2(v, w), RADIUS) == quick


@given(st.floats(), st.floats(), st.floats(-2, 2), st.floats(-2, 2), st.floats(-7, 7))
@example(0.5, 8.98846567431158e307, 0.0, 0.0, 0.0)  # w / v is infinite
@example(0.5, 8.9e307, 0.0, 0.0, 0.0)
def test_no_motion_raises(v: float, w: float, x: float, y: float, yaw: float) -> None:
    made = picture(dict.fromkeys(range(20, 95), 0.6))
    way, twist = free_length(made, Pose2(x, y, yaw), Twist2(v, w), RADIUS), Twist2(v, w)
    assert 0.0 <= way.s_m <= REACH_M
    assert 0.0 <= speed_scale(way.s_m, twist, Base(), Limits(), 0.3, touching=way.touching) <= 1.0


STARTS = (IDENTITY, Pose2(0.1, -0.05, 0.4), Pose2(-0.6, 0.5, -2.0))
WAYS = (
    AHEAD, BACK, Twist2(0.5, 0.5), Twist2(0.5, -0.5), Twist2(-0.4, 0.6), Twist2(0.3, 1.0),
    Twist2(0.3, -1.0), Twist2(-0.3, -1.0), Twist2(0.1, 1.0), Twist2(-0.1, 0.8),
)  # fmt: skip
PLACED = ((0, 0.6), (8, 1.2), (352, 1.9), (30, 0.8), (75, 0.55), (110, 0.7), (180, 1.0),
          (200, 0.6), (265, 0.7), (330, 1.5), (45, 2.3), (300, 0.5))  # fmt: skip


@table(("start", "twist"), [(STARTS[i % 3], way) for i, way in enumerate(WAYS + WAYS[::2])])
def test_a_point_ends_the_arc_where_the_disc_touches_it(start: Pose2, twist: Twist2) -> None:
    for degree, range_m in PLACED:
        point = (range_m * cos(radians(degree)), range_m * sin(radians(degree)))
        if hypot(point[0] - start.x_m, point[1] - start.y_m) < DISC:
            continue
        free = free_length(one_point(degree, range_m), start, twist, RADIUS)
        expected = walked_m([point], start, twist)
        assert free.s_m == pytest.approx(expected, abs=1e-5), (degree, range_m)
        assert (free.covered, free.touching) == (True, False)
        nearer = free_length(one_point(degree, range_m), start, twist, RADIUS, 0.4)
        assert nearer.s_m == pytest.approx(min(0.4, expected), abs=1e-5), (degree, range_m)
    several = {degree: range_m for degree, range_m in PLACED if range_m >= 0.7}
    points = [(r * cos(radians(d)), r * sin(radians(d))) for d, r in several.items()]
    assert free_length(picture(dict(several)), start, twist, RADIUS).s_m == pytest.approx(
        walked_m(points, start, twist), abs=1e-5
    )


@lru_cache(maxsize=64)
def sighted(degree: int, range_m: float, sight_m: float | None, *, beside: bool) -> ScanPicture:
    lidar = LidarConfig(x_m=0.2, y_m=-0.1) if beside else LidarConfig()
    return picture({degree: range_m}, lidar, sight_m=sight_m)


@table("beside", [False, True])
@table("twist", [*WAYS[::2], Twist2(0.0, 1.0), Twist2(0.01, 0.9)])
def test_points_out_of_sight_are_found_where_they_matter(twist: Twist2, beside: bool) -> None:
    here = Pose2(0.15, -0.1, 0.3)
    for degree, range_m in ((0, 2.2), (14, 0.52), (180, 0.6), (300, 1.5)):
        for reach_m in (0.5, 2.0):
            whole = sighted(degree, range_m, None, beside=beside)
            free = free_length(whole, here, twist, RADIUS, reach_m)
            for sight_m in (0.2, 0.5, 0.9, 1.4, 1.9):
                near = sighted(degree, range_m, sight_m, beside=beside)
                assert free_length(near, here, twist, RADIUS, reach_m) == free, (degree, sight_m)


def test_half_a_millimetre_of_a_graze_counts() -> None:
    beside = replace(picture({}), xs_m=(0.05,), ys_m=(-0.3495,), nearest_m=0.35)
    for twist in (AHEAD, Twist2(0.5, 0.005)):
        free = free_length(beside, IDENTITY, twist, RADIUS)
        assert free.s_m == pytest.approx(0.05 - (0.35**2 - 0.3495**2) ** 0.5, abs=1e-4)


@table(("bend_per_m", "touched"), [(0.95e-3, False), (1.05e-3, True)])
def test_a_way_is_straight_that_bends_by_a_thousandth_per_metre(
    bend_per_m: float, touched: bool
) -> None:
    # a point half a millimetre beside the lane: after 1.8 m a bend has come 1.5 to 1.7 mm nearer
    beside = replace(picture({}), xs_m=(1.8,), ys_m=(DISC + 5e-4,), nearest_m=1.8)
    free = free_length(beside, IDENTITY, Twist2(0.5, 0.5 * bend_per_m), RADIUS)
    assert (free.s_m < REACH_M) is touched


def test_of_what_is_not_known_nothing_is_free_or_seen() -> None:
    assert FreeLength(s_m=0.0, known=False, covered=False, touching=False) == NOTHING_KNOWN


@table(
    ("twist", "moved", "known"),
    [
        (AHEAD, 1.0, True),
        (AHEAD, 1.0 + EPS, False),
        (Twist2(inf, 0.0), 0.0, False),
        (Twist2(0.5, inf), 0.0, False),
        (Twist2(0.5, 0.52e9), 0.0, False),
        (Twist2(0.5, 0.49e9), 0.0, True),
        (Twist2(1e-4, 0.0), 0.0, True),
    ],
)
def test_what_cannot_be_judged_is_not_free(twist: Twist2, moved: float, known: bool) -> None:
    free = free_length(picture({}), Pose2(0.0, moved, 0.0), twist, RADIUS)
    assert free == (FreeLength(REACH_M, True, True, False) if known else NOTHING_KNOWN)


def test_the_slowest_that_is_no_turn_in_place_has_a_way() -> None:
    assert free_length(picture({0: 0.6}), IDENTITY, Twist2(1e-4, 0.0), RADIUS).s_m == (
        pytest.approx(0.25)
    )


def test_a_turn_in_place_is_free_and_says_what_touches() -> None:
    for degree, range_m, touching in ((90, 0.36, False), (90, 0.349, True), (0, 0.35, False)):
        made = picture({degree: range_m})
        for twist in (Twist2(0.0, 1.0), Twist2(0.99e-4, 0.0), Twist2(0.0, -1.0)):
            free = free_length(made, IDENTITY, twist, RADIUS, 1.5)
            assert free == FreeLength(1.5, True, True, touching)
    there = Pose2(0.0, 0.5, 0.0)  # a turn where it is now, not where it was at the scan
    assert free_length(picture({90: 0.8}), there, Twist2(0.0, 1.0), RADIUS).touching
    assert not free_length(picture({90: 0.2}), there, Twist2(0.0, 1.0), 0.2).touching


def test_a_loss_of_a_fifth_of_a_millimetre_is_none_but_at_contact() -> None:
    """Beside a point, 2 cm on, a way that leans towards it by an angle comes that much nearer."""
    for side, clearance_m, lost_m, free in (
        (90, 0.34, 1.5e-4, True), (90, 0.34, 2.5e-4, False), (270, 0.34, 1.5e-4, True),
        (90, 0.34, 1.95e-4, True), (90, 0.34, 2.05e-4, False),
        (90, 0.3105, 1.5e-4, True), (90, 0.3095, 1.5e-4, False), (90, 0.3095, -1e-5, True),
    ):  # fmt: skip
        made = picture({side: clearance_m})
        lean = asin(lost_m / 0.02 + 0.02 / (2 * clearance_m))
        start = Pose2(0.0, 0.0, lean if side == 90 else -lean)
        gone = free_length(made, start, AHEAD, RADIUS)
        assert gone.touching is free, (side, clearance_m, lost_m)
        assert (gone.s_m == 0.0) is not free


@table(
    ("bend", "free"),
    [(1.02, True), (1.052, True), (1.057, False), (1.2, False), (-1.2, True)],
)
def test_a_loss_that_begins_after_5_cm_is_one(bend: float, free: bool) -> None:
    # a circle whose centre lies 0.34 m / bend aside, where the point is: it draws in with the path,
    # by (bend - 1) (5 cm)^2 / 0.68 m: a fifth of a millimetre at 1.0544
    twist = Twist2(0.1, 0.1 * bend / 0.34)
    assert free_length(picture({90: 0.34}), IDENTITY, twist, RADIUS).touching is free


def test_having_passed_beside_something_it_touches_no_nearer() -> None:
    # 0.34 m aside: what is clear now may stay so, less a millimetre
    made = picture({90: 0.34, 20: 0.9})
    x, y = 0.9 * cos(radians(20)), 0.9 * sin(radians(20))
    expected = x - ((0.34 - 1e-3) ** 2 - y**2) ** 0.5
    free = free_length(made, IDENTITY, AHEAD, RADIUS)
    assert free.s_m == pytest.approx(expected)
    assert free.touching


def counted(
    back: set[int], twist: Twist2, start: Pose2 = IDENTITY, lidar: LidarConfig | None = None
) -> bool:
    """Tell whether a way is known where these beams alone came back."""
    seen: dict[int, float | None] = dict.fromkeys([i % 360 for i in back], 7.0)
    made = picture(seen, lidar, others=None)
    return free_length(made, start, twist, RADIUS).known


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
    assert not free_distance._few_missing(picture({}, count=0), DISC, 0.0)
    assert free_distance._few_missing(picture({}, count=1), DISC, 0.0)


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
    free = free_length(made, IDENTITY, twist, RADIUS)
    assert free == FreeLength(REACH_M if covered else 0.0, True, covered, False)


@table(
    ("radius_m", "twist", "clear"),
    [
        (0.34, AHEAD, True),  # 0.34 m ahead: nearer at once
        (0.34, BACK, False),
        (0.34, Twist2(0.5, 1.0), True),
        (0.34, Twist2(-0.5, 1.0), False),
        (0.305, AHEAD, True),
    ],
)
def test_inside_the_margin_only_what_loses_nothing_goes_on(
    radius_m: float, twist: Twist2, clear: bool
) -> None:
    free = free_length(picture({0: radius_m}), IDENTITY, twist, RADIUS)
    assert free == FreeLength(0.0 if clear else REACH_M, True, True, not clear)
