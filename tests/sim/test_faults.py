"""Every fault does what its name says, to hardware or to a sensor, and nothing to the truth."""

from __future__ import annotations

from collections.abc import Callable
from itertools import pairwise
from math import pi
from pathlib import Path
from typing import Any

import pytest

from sim import Report, SimRobot
from tests.known import known
from wire import DriveCommand, DriveState, Imu, Pose2, Scan, SimControl, SimFault, SimTruth

MIDDLE = Pose2(1.5, 1.9, pi / 2)
SPEED_RADPS = 3.0


class Driven:
    """Drive straight on, tick by tick, while things break."""

    def __init__(self, site: Path) -> None:
        self.robot = SimRobot(site, seed=3, start=MIDDLE)
        self._seq = 0

    def go(self, seconds: float, speed_radps: float = SPEED_RADPS) -> list[Report]:
        reports = []
        for _ in range(round(seconds / 0.01)):
            self._seq += 1
            command = DriveCommand(
                boot="b", seq=self._seq, left_radps=speed_radps, right_radps=speed_radps,
                enable=True,
            )  # fmt: skip
            self.robot.command(command, self.robot.time_s)
            reports.append(self.robot.tick(self.robot.time_s + 0.01))
        return reports


@pytest.fixture
def driven(repository: Path) -> Driven:
    return Driven(repository / "sites" / "two_room")


def drives(reports: list[Report]) -> list[DriveState]:
    return [report.drive for report in reports if report.drive is not None]


def scans(reports: list[Report]) -> list[Scan]:
    return [report.scan for report in reports if report.scan is not None]


def readings(reports: list[Report]) -> list[Imu]:
    return [report.imu for report in reports if report.imu is not None]


def truths(reports: list[Report]) -> list[SimTruth]:
    return [report.truth for report in reports if report.truth is not None]


SENSORS: dict[str, tuple[Callable[[list[Report]], list[Any]], str, float]] = {
    "encoder": (lambda told: list(drives(told)), "left_rad", 0.01),
    "lidar": (lambda told: list(scans(told)), "ranges_m", 0.1),
    "gyro": (lambda told: list(readings(told)), "yaw_rate_radps", 0.01),
}


@pytest.mark.parametrize("sensor", SENSORS)
class TestSensors:
    """Hold each trouble of each sensor."""

    def test_off_says_nothing(self, driven: Driven, sensor: str) -> None:
        name = "drive_off" if sensor == "encoder" else f"{sensor}_off"
        driven.robot.break_down(SimFault(name))
        assert SENSORS[sensor][0](driven.go(0.5)) == []

    def test_stuck_repeats_one_reading_freshly_stamped(self, driven: Driven, sensor: str) -> None:
        heard, field, period_s = SENSORS[sensor]
        driven.go(0.3)
        driven.robot.break_down(SimFault(f"{sensor}_stuck"))
        told = heard(driven.go(0.5))
        assert len({getattr(one, field) for one in told}) == 1
        assert len({one.seq for one in told}) == len(told) == round(0.5 / period_s)
        driven.robot.break_down()
        assert len({getattr(one, field) for one in heard(driven.go(0.5))}) > 1

    def test_garbage_is_far_from_the_truth(self, driven: Driven, sensor: str) -> None:
        heard, field, _ = SENSORS[sensor]
        sane = heard(driven.go(0.3))[-1]
        driven.robot.break_down(SimFault(f"{sensor}_garbage"))
        told = [getattr(one, field) for one in heard(driven.go(0.3))]
        assert len(set(told)) == len(told)
        assert getattr(sane, field) not in told

    def test_delayed_comes_late_with_the_stamp_of_its_making(
        self, driven: Driven, sensor: str
    ) -> None:
        heard, _, _ = SENSORS[sensor]
        driven.go(0.3)
        driven.robot.break_down(SimFault(f"{sensor}_delayed"))
        ages = []
        for _ in range(80):
            reports = driven.go(0.01)
            ages += [driven.robot.time_s - one.stamp_s for one in heard(reports)]
        assert ages
        assert {round(age, 3) for age in ages} == {0.3}
        driven.robot.break_down()
        seqs = [one.seq for one in heard(driven.go(0.4))]
        assert seqs == sorted(seqs), "what was still on its way does not come after newer"

    def test_intermittent_comes_and_goes(self, driven: Driven, sensor: str) -> None:
        heard, _, period_s = SENSORS[sensor]
        driven.robot.break_down(SimFault(f"{sensor}_intermittent"))
        told = heard(driven.go(1.6))
        assert len(told) == pytest.approx(0.8 / period_s, abs=1)
        stamps = [one.stamp_s for one in told]
        gaps = [b - a for a, b in pairwise(stamps)]
        assert max(gaps) >= 0.4


def test_a_blind_lidar_sees_nothing_but_speaks(driven: Driven) -> None:
    driven.robot.break_down(SimFault.LIDAR_BLIND)
    told = scans(driven.go(0.5))
    assert len(told) == 5
    assert all(beam is None for scan in told for beam in scan.ranges_m)


def test_a_blocked_wheel_turns_the_robot_about_it(driven: Driven) -> None:
    driven.robot.break_down(SimFault.WHEEL_STUCK)
    before = drives(driven.go(0.02))[-1]
    after = drives(driven.go(1.0))[-1]
    assert abs(after.left_rad - before.left_rad) < 0.2, "a jam of 200 Nm gives a little"
    assert after.right_rad - before.right_rad > 1.0
    assert driven.robot.twist.w_radps > 0.3
    driven.robot.break_down()
    assert drives(driven.go(1.0))[-1].left_radps == pytest.approx(SPEED_RADPS, rel=0.05)


def test_on_ice_wheels_turn_more_than_the_robot_moves(driven: Driven) -> None:
    driven.robot.break_down(SimFault.SLIP)
    last = driven.go(0.5)[-1]
    assert known(last.drive).left_radps == pytest.approx(SPEED_RADPS, rel=0.1)
    assert driven.robot.twist.v_mps < 0.5 * SPEED_RADPS * driven.robot.robot.base.wheel_radius_m


def test_a_runaway_heeds_no_speed_but_the_torque(driven: Driven) -> None:
    driven.robot.break_down(SimFault.RUNAWAY)
    assert drives(driven.go(0.5, 0.0))[-1].left_radps == pytest.approx(12.0, rel=0.05)
    for _ in range(60):  # silence: the drive's own dead-man takes the torque
        driven.robot.tick(driven.robot.time_s + 0.01)
    assert driven.robot.twist.v_mps == pytest.approx(0.0, abs=0.01)


def test_reversed_wheels_turn_the_other_way(driven: Driven) -> None:
    driven.robot.break_down(SimFault.REVERSED)
    assert drives(driven.go(0.5))[-1].left_radps == pytest.approx(-SPEED_RADPS, rel=0.05)


def test_a_battery_runs_down_by_driving_and_sags_under_load(driven: Driven) -> None:
    assert drives(driven.go(0.1))[-1].battery == 1.0
    driven.robot.break_down(SimFault.BATTERY_LOW)
    assert drives(driven.go(0.1))[-1].battery == 0.15
    driven.robot.break_down(SimFault.BATTERY_SAG)
    assert drives(driven.go(0.1))[-1].battery == 0.05
    assert drives(driven.go(0.1, 0.0))[-1].battery == 1.0


@pytest.mark.parametrize("name", ["bumper_front", "bumper_rear", "cliff", "estop_pressed"])
def test_an_input_is_pressed_alone(driven: Driven, name: str) -> None:
    inputs = {"bumper_front", "bumper_rear", "cliff", "estop_pressed"}
    driven.robot.break_down(SimFault(name))
    state = drives(driven.go(0.02))[-1]
    assert {one for one in inputs if getattr(state, one)} == {name}


def test_truth_stays_true_and_names_what_is_broken(driven: Driven) -> None:
    wish = (SimFault.GYRO_OFF, SimFault.LIDAR_GARBAGE)
    driven.robot.control(SimControl(id="c1", faults=wish))
    told = truths(driven.go(0.1))[-1]
    assert set(told.faults) == set(wish)
    assert told.twist.v_mps == pytest.approx(driven.robot.twist.v_mps, abs=0.05)
    driven.robot.control(SimControl(id="c2", place_obstacle=(0.5, 0.5)))
    assert set(truths(driven.go(0.1))[-1].faults) == set(wish), "a wish for something else"
    driven.robot.control(SimControl(id="c3", faults=()))
    assert truths(driven.go(0.1))[-1].faults == ()
