"""Hold what the fence lets through: of 32 parts as many as stop clear, and not one more."""

from __future__ import annotations

from itertools import product
from math import cos, inf, nan, pi, sin

import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from bridge.core.geometry.fence import build_fence
from bridge.core.geometry.kinematics import along_arc
from bridge.core.geometry.stopping import stop_length_m
from bridge.core.motion.motion_gates import FENCE_MARGIN_M, INWARD_MPS, fence_scale
from tests.bridge.core.table import table
from tests.laws import at_least
from wire import Pose2, RobotDescription, Twist2

ROBOT = RobotDescription()
BASE, LIMITS = ROBOT.base, ROBOT.limits
WALL_M = 2.0
ROOM = build_fence("0" * 16, (((-9, -9), (WALL_M, -9), (WALL_M, 9), (-9, 9)),))
"""Nothing but the wall at x = 2 m is near."""
EDGE = build_fence("0" * 16, (((-0.15, -9), (9, -9), (9, 9), (-0.15, 9)),))
"""At x = 0 the margin is 0.15 m, to the last bit."""


def scale_in(room: object, pose: Pose2, twist: Twist2, late_s: float, share: float = 1.0) -> float:
    return fence_scale(room, pose, twist, BASE, LIMITS, late_s, share)  # type: ignore[arg-type]


def x_after(pose: Pose2, twist: Twist2, length_m: float) -> float:
    """Return where a way along the motion's circle ends, by the circle's centre."""
    gone = length_m if twist.v_mps > 0.0 else -length_m
    if twist.w_radps == 0.0:
        return pose.x_m + gone * cos(pose.yaw_rad)
    radius = twist.v_mps / twist.w_radps
    return pose.x_m + radius * (sin(pose.yaw_rad + gone / radius) - sin(pose.yaw_rad))


def stops_clear(pose: Pose2, twist: Twist2, k: float, late_s: float, share: float) -> bool:
    """Tell whether a share ``k`` of a motion stops clear, all the way to its end."""
    v, w = abs(twist.v_mps), abs(twist.w_radps)
    rims_mps2 = LIMITS.max_decel_mps2 * share
    length_m = k * v * late_s + k * k * v * (v + w * BASE.wheel_separation_m / 2) / (2 * rims_mps2)
    way = [x_after(pose, twist, part / 100 * length_m) for part in range(101)]
    return all(WALL_M - x >= FENCE_MARGIN_M for x in way)


@table("share", [1.0, 0.2])
@table("late_s", [0.05, 0.4])
def test_of_32_parts_so_many_pass_as_stop_clear_and_not_one_more(
    late_s: float, share: float
) -> None:
    seen = set()
    ways = ((0.5, 0.0), (-0.5, 0.0), (0.4, 0.3), (-0.3, 0.5), (0.5, 1.0), (0.2, -1.0))
    for x, yaw, (v, w) in product((1.21, 1.5, 1.7, 1.8), [i * pi / 7 for i in range(14)], ways):
        pose, twist = Pose2(x, 0.0, yaw), Twist2(v, w)
        parts = scale_in(ROOM, pose, twist, late_s, share) * 32
        seen.add(parts)
        assert parts == round(parts)
        if parts:
            assert stops_clear(pose, twist, parts / 32, late_s, share)
        if parts < 32:  # what is too slow to be a speed stands
            more = max(parts + 1, -(-0.02 // (abs(v) / 32)))
            assert not stops_clear(pose, twist, more / 32, late_s, share)
    assert len(seen) > 10


@table(
    ("pose", "twist", "scale"),
    [
        (Pose2(1.9, 0, 0), Twist2(1e-4, 0.0), 0.0),  # the slowest that is no turn in place
        (Pose2(1.9, 0, 0), Twist2(0.99e-4, 1.0), 1.0),
        (Pose2(1.9, 0, pi), Twist2(0.5, 0.0), INWARD_MPS / 0.5),
        (Pose2(1.9, 0, 0), Twist2(-0.5, 0.0), INWARD_MPS / 0.5),
        (Pose2(1.9, 0, 0), Twist2(0.5, 0.0), 0.0),
        (Pose2(1.9, 0, pi), Twist2(-0.5, 0.0), 0.0),
        (Pose2(2.1, 0, pi), Twist2(0.1, 0.0), 1.0),
        (Pose2(2.1, 0, pi), Twist2(0.15, 0.0), 1.0),
        (Pose2(1.9, 0, pi / 2), Twist2(0.5, 0.0), 0.0),  # along: no nearer, and no further
        # in 5 cm a tight curve swings past the way along, a wide one not
        (Pose2(1.9, 0, pi / 2 - 0.2), Twist2(0.1, 1.0), 1.0),
        (Pose2(1.9, 0, pi / 2 - 0.2), Twist2(0.1, 0.5), 0.0),
        (Pose2(1.9, 0, pi / 2 - 0.2), Twist2(0.3, 1.0), 0.0),
        (Pose2(1.9, 0, -pi / 2 + 0.2), Twist2(0.1, -1.0), 1.0),
        (Pose2(1.9, 0, pi / 2 + 0.2), Twist2(-0.1, -1.0), 1.0),
        (Pose2(1.9, 0, -pi / 2 - 0.2), Twist2(-0.1, -1.0), 0.0),
        # half the turn of those 5 cm, 0.25 rad, is what decides
        (Pose2(1.9, 0, pi / 2 - 0.24), Twist2(0.1, 1.0), 1.0),
        (Pose2(1.9, 0, pi / 2 - 0.26), Twist2(0.1, 1.0), 0.0),
        (Pose2(4.0, 0, pi), Twist2(0.5, 0.0), 0.0),  # further out than is known: a hand alone
        (Pose2(1.0, 0, 0), Twist2(inf, 0.0), 0.0),
        (Pose2(1.0, 0, 0), Twist2(nan, 0.0), 0.0),
        (Pose2(1.0, 0, 0), Twist2(0.5, nan), 0.0),
        (Pose2(1.0, 0, 0), Twist2(0.1, inf), 0.0),
        (Pose2(1.0, 0, 0), Twist2(0.0, inf), 0.0),
    ],
)
def test_beside_the_fence_only_what_gains_distance_passes(
    pose: Pose2, twist: Twist2, scale: float
) -> None:
    assert scale_in(ROOM, pose, twist, 0.2) == scale


def test_a_way_that_leads_through_the_margin_and_out_again_is_none() -> None:
    # its end is clear and a third of it too; half way it is 0.136 m from the wall
    pose, twist = Pose2(1.65, 0.0, 0.608), Twist2(0.5, 1.0)
    assert 0 < scale_in(ROOM, pose, twist, 0.05, share=0.2) < 1


def test_exactly_at_the_margin_one_is_clear() -> None:
    along = build_fence("0" * 16, (((-9, -0.15), (9, -0.15), (9, 9), (-9, 9)),))
    assert scale_in(along, Pose2(0.0, 0.0, 0.0), Twist2(0.5, 0.0), 0.2) == 1.0
    assert scale_in(along, Pose2(0.0, -0.05, 0.0), Twist2(0.5, 0.0), 0.2) == 0.0  # gains nothing
    assert scale_in(EDGE, Pose2(0.0, 0.0, 0.0), Twist2(0.5, 0.0), 0.2) == 1.0


def test_a_speed_of_just_a_standing_robot_still_passes() -> None:
    assert 0.64 / 32 == 0.02
    assert scale_in(ROOM, Pose2(1.844, 0.0, 0.0), Twist2(0.64, 0.0), 0.2) == 1 / 32
    assert scale_in(ROOM, Pose2(1.844, 0.0, 0.0), Twist2(0.639, 0.0), 0.2) == 0.0


FAST = RobotDescription.model_validate(
    {"base": {"wheel_radius_m": 0.3}, "limits": {"max_speed_mps": 2.0}}
)
LATE_S = 0.3
HALL = ((-4.0, -4.0), (4.0, -4.0), (4.0, 4.0), (-4.0, 4.0))


def box(x: float, y: float, wide: float, deep: float) -> tuple[tuple[float, float], ...]:
    return ((x, y), (x + wide, y), (x + wide, y + deep), (x, y + deep))


@pytest.mark.parametrize("thin_m", [0.01, 0.2, 0.5])
@pytest.mark.parametrize("ahead_m", [0.2, 0.5, 0.8, 1.1, 1.4, 1.7, 2.0, 2.3])
def test_no_keep_out_is_too_thin_to_stop_before(thin_m: float, ahead_m: float) -> None:
    """From 2 m/s a stop takes 2.6 m."""
    fence = build_fence("0" * 16, (HALL,), (box(ahead_m, -1.0, thin_m, 2.0),))
    scale = fence_scale(fence, Pose2(0, 0, 0), Twist2(2.0, 0.0), FAST.base, FAST.limits, LATE_S)
    stop_m = 2 * scale * LATE_S + (2 * scale) ** 2 / 2
    assert ahead_m - 0.15 - 0.26 <= stop_m <= ahead_m - 0.15


def test_what_is_too_far_off_to_look_at_is_not_driven_at() -> None:
    """Along a wall, at its very margin, 100 looks reach 5 m; these brakes take 10 m."""
    along = build_fence("0" * 16, (((-1, -0.15), (30, -0.15), (30, 9), (-1, 9)),))
    weak = FAST.limits.model_copy(update={"max_decel_mps2": 0.2})
    for y, parts in ((0.0, 21), (1.0, 32)):
        scale = fence_scale(along, Pose2(0, y, 0), Twist2(2.0, 0.0), FAST.base, weak, 0.2)
        assert scale == parts / 32


@table("late_s", [inf, nan, 1e300])
def test_a_way_without_an_end_is_none(late_s: float) -> None:
    assert scale_in(ROOM, Pose2(0.0, 0.0, 0.0), Twist2(0.5, 0.0), late_s) == 0.0


boxes = st.builds(box, *[st.floats(-3, 3)] * 2, *[st.floats(0.01, 0.6)] * 2)


@at_least(60)
@given(
    st.lists(boxes, min_size=1, max_size=4),
    st.floats(-pi, pi),
    st.floats(0.05, 2.0),
    st.floats(-2.0, 2.0),
    st.booleans(),
)
def test_the_whole_way_of_a_stop_keeps_clear_and_no_more_would(
    keep_outs: list[tuple[tuple[float, float], ...]], yaw: float, v: float, w: float, back: bool
) -> None:
    fence = build_fence("0" * 16, (HALL,), tuple(keep_outs))
    start, twist = Pose2(0.0, 0.0, yaw), Twist2(-v if back else v, w)
    assume(fence.margin_m(0.0, 0.0) >= FENCE_MARGIN_M)
    scale = fence_scale(fence, start, twist, FAST.base, FAST.limits, LATE_S)
    whole_m = stop_length_m(twist, FAST.base, FAST.limits, LATE_S, 1.0)

    def least_m(share: float) -> float:
        """Look every centimetre or closer, and at the end."""
        length_m = share * v * LATE_S + (whole_m - v * LATE_S) * share * share
        count = 1 + int(length_m / 0.01)
        gone = [length_m * index / count for index in range(count + 1)]
        way = [along_arc(start, -one if back else one, w / v * one) for one in gone]
        return min(fence.margin_m(place.x_m, place.y_m) for place in way)

    assert least_m(scale) >= FENCE_MARGIN_M - 0.025 - 1e-6
    if scale < 1.0:
        assert least_m(max(scale, 0.02 / v) + 1 / 32) <= FENCE_MARGIN_M + 2e-6
