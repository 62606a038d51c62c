"""The stand-in gives what a localizer gives: odom in map, continuous, fresh, or nothing."""

from __future__ import annotations

from math import cos, hypot, sin

import pytest

from localization import NoiseParams, StandIn
from wire import IDENTITY, STILL, Localization, Odometry, Pose2, SimTruth, compose, inverse

MAP_ID = "0123456789abcdef"
NO_NOISE = NoiseParams(position_m=0.0, yaw_rad=0.0)


def circle(stamp_s: float) -> Pose2:
    """Drive a circle of 1 m at 0.5 m/s, in map."""
    angle = 0.5 * stamp_s
    return Pose2(4.0 + cos(angle), 3.0 + sin(angle), angle % 6.0)


def truth(stamp_s: float, pose: Pose2, boot: str = "sim-1") -> SimTruth:
    return SimTruth(
        boot_id=boot, seq=1, stamp_s=stamp_s, base_in_map=pose, twist=STILL, contacts=0,
        contacts_total=0, real_time_factor=1.0,
    )  # fmt: skip


def odom(stamp_s: float, pose: Pose2, odom_id: str = "bridge-1") -> Odometry:
    return Odometry(
        odom_id=odom_id, seq=1, stamp_s=stamp_s, base_in_odom=pose, twist=STILL,
        yaw_rate_radps=None,
    )  # fmt: skip


def in_odom(pose: Pose2, odom_in_map: Pose2) -> Pose2:
    return compose(inverse(odom_in_map), pose)


def robot(answer: Localization, base_in_odom: Pose2) -> Pose2:
    return compose(answer.odom_in_map, base_in_odom)


def test_without_noise_it_gives_the_transform_between_odom_and_truth() -> None:
    stand_in, frame = StandIn(MAP_ID, noise=NO_NOISE), Pose2(1.0, -2.0, 0.7)
    stand_in.hear_truth(truth(1.0, circle(1.0)))
    stand_in.hear_odometry(odom(1.0, in_odom(circle(1.0), frame)))
    answer = stand_in.answer(1.01)
    assert answer is not None
    assert (answer.odom_id, answer.map_id, answer.stamp_s) == ("bridge-1", MAP_ID, 1.0)
    assert 0.0 < answer.quality <= 1.0
    found = answer.odom_in_map
    assert (found.x_m, found.y_m, found.yaw_rad) == pytest.approx((1.0, -2.0, 0.7))


def test_sources_are_compared_at_one_instant() -> None:
    stand_in, frame = StandIn(MAP_ID, noise=NO_NOISE), Pose2(1.0, -2.0, 0.7)
    for tick in range(50):
        at_s = 1.0 + tick * 0.02
        stand_in.hear_truth(truth(at_s, circle(at_s)))
        stand_in.hear_odometry(odom(at_s - 0.013, in_odom(circle(at_s - 0.013), frame)))
    answer = stand_in.answer(2.0)
    assert answer is not None
    assert answer.stamp_s == pytest.approx(1.967)
    # Unaligned, 13 ms at 0.5 m/s would be 6.5 mm.
    error_m = hypot(answer.odom_in_map.x_m - 1.0, answer.odom_in_map.y_m + 2.0)
    assert error_m < 1e-4


def test_it_is_silent_until_both_are_known_and_when_they_grow_old() -> None:
    stand_in = StandIn(MAP_ID)
    assert stand_in.answer(0.0) is None
    stand_in.hear_truth(truth(1.0, IDENTITY))
    assert stand_in.answer(1.0) is None
    stand_in.hear_odometry(odom(1.0, IDENTITY))
    assert stand_in.answer(1.3) is None, "too old"
    assert stand_in.answer(1.2) is not None
    assert stand_in.answer(1.2) is None, "nothing new"
    stand_in.hear_odometry(odom(1.1, IDENTITY))
    assert stand_in.answer(1.2) is None, "truth is silent"


def test_another_odometry_is_another_frame() -> None:
    stand_in = StandIn(MAP_ID, noise=NO_NOISE)
    stand_in.hear_truth(truth(1.0, Pose2(2.0, 2.0, 0.0)))
    stand_in.hear_odometry(odom(1.0, Pose2(1.0, 0.0, 0.0)))
    assert stand_in.answer(1.0) is not None
    stand_in.hear_truth(truth(1.02, Pose2(2.0, 2.0, 0.0)))
    stand_in.hear_odometry(odom(1.01, Pose2(0.0, 0.0, 0.0), "bridge-2"))
    after = stand_in.answer(1.02)
    assert after is not None
    assert after.odom_id == "bridge-2"
    assert (after.odom_in_map.x_m, after.odom_in_map.y_m) == pytest.approx((2.0, 2.0))


def test_another_simulator_is_not_blended_with_the_old_one() -> None:
    stand_in = StandIn(MAP_ID, noise=NO_NOISE)
    stand_in.hear_truth(truth(1.0, Pose2(2.0, 2.0, 0.0)))
    stand_in.hear_truth(truth(1.2, Pose2(9.0, 9.0, 0.0), boot="sim-2"))
    stand_in.hear_odometry(odom(1.1, IDENTITY))
    assert stand_in.answer(1.2) is None, "at 1.1 s nobody's truth is known"
    stand_in.hear_odometry(odom(1.2, IDENTITY))
    answer = stand_in.answer(1.2)
    assert answer is not None
    assert answer.odom_in_map.x_m == pytest.approx(9.0)


@pytest.mark.parametrize("seed", range(5))
def test_the_robot_never_jumps_while_it_drives_over_gaps_and_restarts(seed: int) -> None:
    stand_in, frame = StandIn(MAP_ID, seed=seed), Pose2(1.0, -2.0, 0.7)
    last: Localization | None = None
    steps_m: list[float] = []
    now_s = 0.0
    for turn in range(400):
        now_s += 3.0 if turn % 97 == 96 else 0.05
        odom_id = f"bridge-{turn // 150}"
        pose = in_odom(circle(now_s), frame)
        stand_in.hear_truth(truth(now_s, circle(now_s)))
        stand_in.hear_odometry(odom(now_s, pose, odom_id))
        answer = stand_in.answer(now_s)
        assert answer is not None
        here = robot(answer, pose)
        assert hypot(here.x_m - circle(now_s).x_m, here.y_m - circle(now_s).y_m) < 0.12
        if last is not None and last.odom_id == answer.odom_id:
            then = robot(last, pose)
            steps_m.append(hypot(here.x_m - then.x_m, here.y_m - then.y_m))
        last = answer
    assert max(steps_m) < 0.05, "the bridge calls 0.1 m a jump"
    assert max(steps_m) > 0.001, "noise is there"
