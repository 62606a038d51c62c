"""Hold the judging of a horizon to its pieces, one call at a time."""

from __future__ import annotations

from math import hypot, nan

from bridge.core.authority import horizon_checks
from bridge.core.authority.horizon_checks import check_horizon
from bridge.core.geometry.fence import build_fence
from tests.bridge.core.table import table
from wire import Pose2, Waypoint

FENCE = build_fence(
    "0" * 16, (((-9, -9), (9, -9), (9, 9), (-9, 9)),), (((5, -1), (6, -1), (6, 1), (5, 1)),)
)
HERE = Pose2(0.0, 0.0, 0.0)


def line(count: int, gap_m: float) -> list[Waypoint]:
    return [Waypoint(x_m=i * gap_m, y_m=0.0, speed_mps=0.3) for i in range(count)]


def test_fifty_points_are_as_many_as_may_come() -> None:
    assert check_horizon(line(50, 0.0625), HERE, 0.5, FENCE) == ()
    assert check_horizon(line(51, 0.0625), HERE, 0.5, FENCE) == ("too_many_points",)


@table(("where", "codes"), [(0, ["heading_not_last"]), (3, ["heading_not_last"])])
def test_a_heading_in_the_middle_is_refused(where: int, codes: list[str]) -> None:
    points = line(5, 0.1)
    points[where] = points[where].model_copy(update={"heading_rad": 1.0})
    assert list(check_horizon(points, HERE, 0.5, FENCE)) == codes
    points = line(5, 0.1)
    points[-1] = points[-1].model_copy(update={"heading_rad": 1.0})
    assert check_horizon(points, HERE, 0.5, FENCE) == ()


def test_bounds_are_within() -> None:
    assert horizon_checks._all_within([1.0, 2.0], 1.0, 2.0)
    assert horizon_checks._all_within([], 1.0, 2.0)
    for odd in (0.999, 2.001, nan):
        assert not horizon_checks._all_within([1.5, odd], 1.0, 2.0)


@table(
    ("gaps", "spaced"),
    [
        # a millimetre is what coordinates may be rounded by; less in the middle than at the ends
        ([0.1, 0.04905, 0.1], True), ([0.1, 0.04895, 0.1], False),
        ([0.1, 0.25095, 0.1], True), ([0.1, 0.25105, 0.1], False),
        ([0.00905, 0.1], True), ([0.00895, 0.1], False),
        ([0.1, 0.00905], True), ([0.1, 0.00895], False),
        ([0.25105, 0.1], False), ([0.1, 0.25105], False), ([0.25095], True),
    ],
)  # fmt: skip
def test_gaps_are_within_their_bounds_and_a_millimetre(gaps: list[float], spaced: bool) -> None:
    assert horizon_checks._is_well_spaced(gaps) is spaced


@table(
    ("speed_mps", "fits"),
    [
        (0.05 - 0.95e-6, True),
        (0.05 - 1.05e-6, False),
        (0.5 + 0.95e-6, True),
        (0.5 + 1.05e-6, False),
    ],
)
def test_speeds_are_within_their_bounds_and_a_millionth(speed_mps: float, fits: bool) -> None:
    assert horizon_checks._speeds_fit([0.3, speed_mps], 0.5) is fits
    assert horizon_checks._speeds_fit([-speed_mps], 0.5) is fits


Point = tuple[float, float]


@table(
    ("robot", "points", "inside"),
    [
        ((4.9, 0.5), [(5.05, 0.5)], False),  # its only point lies in the keep-out
        ((4.97, 0.9), [(5.1, 1.03)], False),  # the way to it cuts a corner
        ((4.97, 0.9), [(4.97, 1.03)], True),
        ((5.05, 0.0), [(4.95, 0.0)], True),  # a robot outside may come in
        ((5.05, 0.0), [(5.06, 0.0)], False),
        ((5.9, 0.0), [(6.1, 0.0)], True),
        ((-8.9, -8.9), [(-9.05, -8.9)], False),
        ((-8.9, -8.9), [(-8.8, -8.8)], True),
        # far from all: the clearance of its place saves the tests, that of another would not
        ((-4.5, -0.5), [(-4.4, -0.5), (-4.3, -0.5)], True),
        ((4.3, -2.0), [(4.3, -1.6), (5.1, -0.8)], False),
        # its second segment crosses; one that ends elsewhere would not
        ((4.5, 1.5), [(4.5, 1.5), (4.4, 1.6), (6.5, 0.0)], False),
        ((4.5, 1.5), [(4.5, 1.5), (4.4, 1.6), (6.5, 1.5)], True),
        ((4.5, 1.5), [(4.5, 1.5), (4.4, 1.6), (4.5, 0.0)], True),
        ((4.5, 0.0), [(4.5, 0.0), (4.9, 0.0), (5.2, 0.0)], False),
        ((4.5, 0.0), [(4.5, 0.0), (4.9, 0.0), (4.9, 0.3), (4.9, 0.6), (5.1, 0.6)], False),
        ((4.0, 0.0), [(4.0, 0.0), (4.3, 0.0), (4.6, 0.0), (4.9, 0.0), (5.1, 0.0)], False),
    ],
)
def test_every_way_stays_inside(robot: Point, points: list[Point], inside: bool) -> None:
    xs, ys = [x for x, _ in points], [y for _, y in points]
    gaps = [hypot(xs[i + 1] - xs[i], ys[i + 1] - ys[i]) for i in range(len(xs) - 1)]
    assert horizon_checks._keeps_inside(xs, ys, gaps, Pose2(*robot, 0.0), FENCE) is inside


def test_the_way_to_the_first_point_is_measured_from_the_robot() -> None:
    """What is clear around the robot, less the way, is clear around its first point."""
    for x, y in ((8.5, 3.0), (-8.5, 3.0), (3.0, 8.5), (3.0, -8.5)):
        robot = Pose2(x, y, 0.0)
        out_x, out_y = (x * 9.2 / 8.5, y) if abs(x) > 8 else (x, y * 9.2 / 8.5)
        assert not horizon_checks._keeps_inside([out_x], [out_y], [], robot, FENCE)
        in_x, in_y = (x * 8.9 / 8.5, y) if abs(x) > 8 else (x, y * 8.9 / 8.5)
        assert horizon_checks._keeps_inside([in_x], [in_y], [], robot, FENCE)
        assert not horizon_checks._keeps_inside([in_x, out_x], [in_y, out_y], [0.3], robot, FENCE)
