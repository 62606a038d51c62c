"""Hold what the way of a motion leaves of it, and whether the way is known."""

from __future__ import annotations

from dataclasses import replace
from math import inf, nan, radians, sqrt

import pytest

from bridge.core.geometry.lidar_scan import ScanPicture
from bridge.core.motion import obstacle_gate as gate_module
from bridge.core.motion.obstacle_gate import obstacle_gate, weak_m
from bridge.core.state_motion import Braking
from tests.bridge.core.table import table
from wire import IDENTITY, STILL, RobotDescription, Scan, Twist2

EPS = 1e-9


def robot_of(**parts: dict[str, float]) -> RobotDescription:
    return RobotDescription.model_validate(parts)


ROBOT = robot_of(limits={"max_decel_mps2": 0.8, "stop_jerk_mps3": 5.0})
"""Brakes at 0.8 m/s2 and takes 0.08 s of mean delay to build that up; 0.06 s late; 0.5 m wide."""
LATE_S = 0.1 + 0.1 + 0.06 + 0.08
"""Of a scan 0.1 s old."""


def picture(points: dict[int, float | None]) -> ScanPicture:
    scan = Scan(
        boot_id="a",
        seq=1,
        stamp_s=0.0,
        angle_min_rad=0.0,
        angle_increment_rad=radians(1),
        range_min_m=0.12,
        range_max_m=8.0,
        ranges_m=tuple(points.get(i, 7.0) for i in range(360)),
    )
    return ScanPicture.from_scan(scan, IDENTITY, ROBOT.lidar)


def within(s_m: float, decel: float, late_s: float) -> float:
    """Return the speed of which s = v t + v^2 / 2a, by the school's formula."""
    return decel * (sqrt(late_s * late_s + 2 * s_m / decel) - late_s)


def test_weak_brakes_need_more_path() -> None:
    assert weak_m(Twist2(0.4, 0.8), ROBOT, 1.0) == 0.0
    assert weak_m(Twist2(0.4, 0.8), ROBOT, 0.5) == pytest.approx(0.16 * 0.5 / (2 * 0.8 / 3))
    assert weak_m(Twist2(-0.4, 0.0), ROBOT, 0.25) == pytest.approx(0.16 * 0.75 / 0.4)
    assert weak_m(Twist2(0.0, 0.8), ROBOT, 0.5) == 0.0


@table(
    ("usual", "speed", "along", "share", "reach"),
    [
        (1.0, 0.5, Twist2(0.5, 0.0), 1.0, 1.0),
        # 0.5 x 0.34 + 0.25 / 1.6 is 0.32625 m, and a millimetre
        (0.3273, 0.5, Twist2(0.5, 0.0), 1.0, 0.3273),
        (0.3272, 0.5, Twist2(0.5, 0.0), 1.0, 2.0),
        (0.4, 0.5, Twist2(0.5, 0.0), 0.5, 2.0),
        (0.4, 0.5, Twist2(0.5, 1.0), 1.0, 2.0),
        (0.41, 0.5, Twist2(0.5, 1.0), 1.0, 0.41),
        (1.0, 0.5, Twist2(1.0, 0.0), 1.0, 1.0),
        (1.0, 0.5, Twist2(-1.0, 0.0), 1.0, 1.0),
        (1.0, 0.5, Twist2(1.0 + EPS, 0.0), 1.0, 2.0),
        (1.0, 0.0, Twist2(0.0, 1.0), 1.0, 2.0),
        (1.0, 0.5, Twist2(nan, 0.0), 1.0, 2.0),
    ],
)
def test_one_looks_as_far_as_it_takes(
    usual: float, speed: float, along: Twist2, share: float, reach: float
) -> None:
    assert gate_module._reach_m(usual, speed, along, ROBOT, LATE_S, share) == reach


@table(
    ("a", "b", "same"),
    [
        (Twist2(0.4, 0.2), Twist2(0.2, 0.1), True),
        (Twist2(-0.4, 0.2), Twist2(-0.2, 0.1), True),
        (Twist2(0.4, 0.2), Twist2(-0.2, 0.1), False),
        (Twist2(0.0, 0.2), Twist2(0.0, 0.2), False),
        (Twist2(0.5, 0.025 - EPS), Twist2(0.5, 0.0), True),
        (Twist2(0.5, 0.025 + EPS), Twist2(0.5, 0.0), False),
        (Twist2(0.5, 0.0), Twist2(0.5, 0.025 + EPS), False),
        (Twist2(0.5, -0.015), Twist2(0.25, 0.005 + EPS), False),
        (Twist2(0.5, -0.015), Twist2(0.25, 0.005 - EPS), True),
        (Twist2(-0.5, 0.015), Twist2(-0.25, -0.005 - EPS), False),
        (Twist2(-0.5, 0.015), Twist2(-0.25, -0.005 + EPS), True),
    ],
)
def test_two_motions_of_nearly_the_same_curve(a: Twist2, b: Twist2, same: bool) -> None:
    assert gate_module._same_curve(a, b) is same


def test_what_passes_of_a_turn_where_no_way_does() -> None:
    for asked, scale, passed in (
        (Twist2(0.4, 0.2), 0.5, Twist2(0.2, 0.1)), (Twist2(0.4, 0.3), 0.0, Twist2(0.0, 0.3)),
        (Twist2(0.4, -0.3), 0.0, Twist2(0.0, -0.3)), (Twist2(0.4, 0.31), 0.0, Twist2(0.0, 0.3)),
        (Twist2(-0.4, -0.5), 0.0, Twist2(0.0, -0.3)), (Twist2(0.4, 0.0), 0.0, STILL),
        (Twist2(0.4, nan), 0.0, STILL), (Twist2(0.5, 0.25), 2**-30, Twist2(2**-31, 2**-32)),
    ):  # fmt: skip
        assert gate_module._passes(asked, scale) == passed


def gate(
    seen: ScanPicture, asked: Twist2, measured: Twist2, known_as: Braking | None = None
) -> gate_module.ObstaclePass:
    return obstacle_gate(seen, IDENTITY, asked, measured, 0.1, ROBOT, known_as or Braking())


def test_a_thing_ahead_scales_what_is_asked_and_leaves_room_less_lag() -> None:
    ahead = picture({0: 0.65})  # free for 0.3 m
    way = gate(ahead, Twist2(0.5, 0.0), Twist2(0.4, 0.0))
    assert way.scale == pytest.approx(within(0.3, 0.8, LATE_S) / 0.5)
    assert way.twist.v_mps == pytest.approx(within(0.3, 0.8, LATE_S))
    assert (way.free_m, way.room_m) == pytest.approx((0.3, 0.3 - 0.4 * 0.06))
    weak = gate(ahead, Twist2(0.5, 0.0), Twist2(0.4, 0.0), Braking(0.1, 0.5))
    assert weak.scale == pytest.approx(within(0.3, 0.4, LATE_S + 0.1) / 0.5)
    assert weak.room_m == pytest.approx(0.3 - 0.4 * 0.16 - 0.16 * 0.5 / 0.8)
    back = gate(picture({180: 0.65}), Twist2(-0.5, 0.0), Twist2(-0.4, 0.0))
    assert back == replace(way, twist=Twist2(-way.twist.v_mps, -0.0))
    fast = gate(ahead, Twist2(0.5, 0.0), Twist2(9.0, 0.0))
    assert (fast.scale, fast.room_m) == (way.scale, 0.0)


CURVE = Twist2(0.4, 0.4)
POST = picture({335: 0.63})
"""At (0.571, -0.266): 0.344 m on straight ahead, and beside the way to the left."""
ON_M = 0.63 * 0.906307787 - sqrt(0.35**2 - (0.63 * 0.422618262) ** 2)


def test_the_way_that_the_robot_is_still_on_counts_too() -> None:
    alone = gate(POST, CURVE, STILL)
    assert (alone.scale, alone.room_m) == (1.0, alone.free_m)
    slow = gate(POST, CURVE, Twist2(0.02, 0.0))  # as good as standing
    assert slow.room_m == pytest.approx(alone.room_m - 0.02 * 0.06)
    rolling = gate(POST, CURVE, Twist2(0.021, 0.0))
    assert rolling.room_m == pytest.approx(ON_M - 0.021 * 0.06)
    assert rolling.scale == 1.0
    assert rolling.free_m == alone.free_m
    post, fast = picture({320: 0.5}), Twist2(0.5, 0.5)  # at (0.383, -0.321)
    on_m = 0.5 * 0.766044443 - sqrt(0.35**2 - (0.5 * 0.642787610) ** 2)
    assert gate(post, fast, STILL).scale == 1.0
    near = gate(post, fast, Twist2(0.3, 0.0))
    assert near.scale == pytest.approx(within(on_m, 0.8, LATE_S) / 0.5)
    assert near.twist.w_radps == near.twist.v_mps
    weak = gate(post, fast, Twist2(0.3, 0.0), Braking(0.0, 0.5))
    assert weak.scale == pytest.approx(within(on_m, 0.4, LATE_S) / 0.5)
    back = gate(post, Twist2(-0.4, 0.4), Twist2(0.3, 0.0))
    assert back.scale == 1.0  # it is to brake anyway
    assert back.room_m == pytest.approx(on_m - 0.3 * 0.06)


def test_a_way_half_seen_is_known_only_if_both_are() -> None:
    missing: dict[int, float | None] = dict.fromkeys(range(335, 361), None)
    blind = picture({**missing, **dict.fromkeys(range(16), None)})
    assert not gate(blind, Twist2(0.5, 0.0), STILL).known
    aside = Twist2(0.3, 1.0)
    assert gate(blind, aside, STILL).known
    assert not gate(blind, aside, Twist2(0.5, 0.0)).known
    assert not gate(blind, Twist2(0.5, 0.0), aside).known


def test_beside_something_the_old_way_holds_nobody_back() -> None:
    beside = picture({90: 0.34})
    touching = gate(beside, Twist2(0.1, -0.2), Twist2(0.3, 0.0))
    assert touching.scale == 1.0


def test_shut_is_what_stands() -> None:
    assert gate(picture({0: 0.352}), Twist2(0.5, 0.0), STILL).shut
    assert not gate(picture({0: 0.352}), Twist2(0.5, 0.2), STILL).shut
    assert not gate(picture({}), Twist2(0.5, 0.0), STILL).shut
    assert gate(picture({}), Twist2(inf, 0.0), STILL).shut
