"""The track that counts in turns is found by the gyro, and a gyro that lies finds none."""

from __future__ import annotations

from typing import cast

import pytest

from pons.calibrate.errors import WORDS, CalibrationRefusal, RunLost
from pons.calibrate.gyro_track import STANDS_S, TurnSeen, believable, find_track, seen_in
from pons.calibrate.procedure import CalibrationPlan
from pons.calibrate.session import CalibrationRig
from pons.settings import CHECKOUT
from sim.true_parameters import SKID_TIMES
from tools.lockstep import LockstepWorld
from wire import Odometry, Pose2, RobotDescription, Twist2, load_robot, wrap
from wire.keys import Party
from wire.robot import LocalizationConfig

pytestmark = pytest.mark.nightly(keep=3)


APART_M = 0.172


def odometry(
    turn_rad: float = 6.0, share: float = 1.0, bias: float = 0.004, step_s: float = 0.02
) -> list[Odometry]:
    """Stand, turn evenly for ten seconds, stand; the gyro says a share of what the wheels do."""
    said, yaw_rad, at_s = [], 0.0, 100.0
    for k in range(round(12.5 / step_s)):
        turns = STANDS_S < k * step_s <= STANDS_S + 10.0
        rate = turn_rad / 10.0 if turns else 0.0
        yaw_rad, at_s = wrap(yaw_rad + rate * step_s), at_s + step_s
        said.append(
            Odometry(
                odom_id="o-1", seq=k, stamp_s=at_s, base_in_odom=Pose2(0.0, 0.0, yaw_rad),
                twist=Twist2(0.0, rate), yaw_rate_radps=share * rate + bias,
            )
        )  # fmt: skip
    return said


@pytest.mark.parametrize(("turn_rad", "share"), [(6.0, 1.0), (-9.0, 0.6), (4.0, -1.0), (0.0, 1.0)])
def test_a_turn_is_what_wheels_and_gyro_say_without_the_gyros_bias(
    turn_rad: float, share: float
) -> None:
    seen = seen_in(odometry(turn_rad, share))
    assert seen.by_wheels_rad == pytest.approx(turn_rad, abs=0.02)
    assert seen.by_gyro_rad == pytest.approx(share * turn_rad, abs=0.02)


def test_what_was_not_heard_is_no_turn() -> None:
    said = odometry()
    for bad, trouble in (
        (said[:2], RunLost),
        (said[:100] + said[150:], RunLost),
        ([*said[:-1], said[-1].model_copy(update={"odom_id": "o-2"})], RunLost),
        ([one.model_copy(update={"yaw_rate_radps": None}) for one in said], CalibrationRefusal),
        (odometry(bias=0.05), RunLost),
    ):
        with pytest.raises(trouble):
            seen_in(bad)


def rover(*, imu: bool = True) -> RobotDescription:
    robot = load_robot(CHECKOUT / "robots" / "waveshare_ugv_rover.toml")
    return robot.model_copy(
        update={
            "base": robot.base.model_copy(update={"wheel_separation_m": APART_M}),
            "inputs": robot.inputs.model_copy(update={"imu": imu}),
            "localization": LocalizationConfig(kind="stand_in"),
        }
    )


def rig_on(robot: RobotDescription) -> CalibrationRig:
    """Stand the rover's twin in a home: firmware, line and shipped drive, in lockstep."""
    world = LockstepWorld(robot=robot)
    world.run(4.0)
    ports = (world.bus.port(Party.OPERATOR), world.bus.port(Party.JUDGE))
    return CalibrationRig(*ports, lambda: world.now_s, world.tick)  # type: ignore[arg-type]  # ports of the bus


@pytest.mark.slow
def test_a_rover_that_skids_finds_the_track_that_counts() -> None:
    """From the distance of its wheels, as presets had it: it believes 1.6 times its turn."""
    said: list[str] = []
    robot = rover()
    plan = CalibrationPlan(None, turns=1)
    (found,) = find_track(rig_on(robot), robot, plan, "2026-11-25T12:00:00Z", said.append)
    assert found.name == "base.wheel_separation_m"
    assert found.value == pytest.approx(SKID_TIMES * APART_M, rel=0.02)
    assert "1.6" in found.evidence
    assert len(said) == 1


@pytest.mark.parametrize(
    ("wheels_rad", "gyro_rad", "code"),
    [(6.0, -6.0, "gyro_backwards"), (-6.0, 3.0, "gyro_backwards"), (6.0, 0.1, "gyro_stands")],
)
def test_a_gyro_that_lies_is_named(wheels_rad: float, gyro_rad: float, code: str) -> None:
    with pytest.raises(CalibrationRefusal, match=code):
        believable(TurnSeen(wheels_rad, gyro_rad))
    assert believable(TurnSeen(-6.0, -4.0)).by_gyro_rad == -4.0


def test_a_robot_without_a_gyro_is_not_even_turned() -> None:
    robot = rover(imu=False)
    nobody = cast("CalibrationRig", None)
    with pytest.raises(CalibrationRefusal, match="no_gyro"):
        find_track(nobody, robot, CalibrationPlan(None), "now", print)


def test_each_end_is_told_in_both_languages() -> None:
    for code in ("no_gyro", "gyro_stands", "gyro_backwards"):
        assert any(ord(letter) > 0x2E80 for letter in WORDS[code][1])
