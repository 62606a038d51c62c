"""Each base turns its wheels as told, reports in time, and stops in silence, by its drive and twin.

Protocol and firmware twin are joined by memory, with wheels that do at once what motors say.
"""

from __future__ import annotations

from typing import cast

import pytest

from bridge.drive.serial_drive import SERIAL_PROTOCOLS
from pons.settings import CHECKOUT
from sim.twin import FIRMWARES
from sim.twin.twin import GyroFirmware
from tests.wire.examples import EXAMPLES
from wire import DriveCommand, DriveState, Imu, RobotDescription, load_robot
from wire.drive_config import DRIVE_KINDS

ROBOTS: dict[str, RobotDescription] = {
    robot.drive.kind: robot
    for robot in map(load_robot, sorted((CHECKOUT / "robots").glob("*.toml"), reverse=True))
}
KINDS = sorted(set(ROBOTS) & set(SERIAL_PROTOCOLS))
BODY = cast("DriveState", EXAMPLES[DriveState])
GYRO = cast("Imu", EXAMPLES[Imu])
TICK_S = 0.01
START_S = 4.0
STEP_RADPS = 0.32
"""The coarsest base takes 1 cm/s and 0.01 rad/s on wheels of 33 mm."""


class Road:
    """Step a drive and its base, 100 times a second."""

    def __init__(self, kind: str) -> None:
        self.robot: RobotDescription = ROBOTS[kind]
        self.protocol = SERIAL_PROTOCOLS[kind](self.robot, "b1")
        self.firmware = FIRMWARES[kind](self.robot)
        self.now_s, self.seq, self.heard_s = 50.0, 0, 50.0
        self.left_rad = self.right_rad = 0.0
        self.speeds = (0.0, 0.0)
        self.states: list[DriveState] = []
        self.firmware.hear(self.protocol.begin(), self.now_s)

    def tick(self, left: float = 0.0, right: float = 0.0, *, silent: bool = False) -> None:
        self.now_s, self.seq = self.now_s + TICK_S, self.seq + 1
        command = DriveCommand(
            boot="b1", seq=self.seq, left_radps=left, right_radps=right, enable=True
        )
        sent = b"" if silent else self.protocol.encode(command)
        self.firmware.hear(sent, self.now_s)
        left_radps, right_radps, _ = self.firmware.motors(self.now_s)
        self.speeds = left_radps, right_radps
        self.left_rad += left_radps * TICK_S
        self.right_rad += right_radps * TICK_S
        body = BODY.model_copy(
            update={
                "left_rad": self.left_rad, "right_rad": self.right_rad,
                "left_radps": left_radps, "right_radps": right_radps,
            }
        )  # fmt: skip
        if isinstance(self.firmware, GyroFirmware):
            turning = (right_radps - left_radps) * self.robot.base.wheel_radius_m
            yaw_radps = turning / self.robot.base.wheel_separation_m
            self.firmware.feel(GYRO.model_copy(update={"yaw_rate_radps": yaw_radps}))
        for state in self.protocol.decode(self.firmware.say(body, self.now_s), self.now_s):
            self.states.append(state)
            self.heard_s = self.now_s

    def run(self, seconds: float, left: float = 0.0, right: float = 0.0) -> None:
        for _ in range(round(seconds / TICK_S)):
            self.tick(left, right)


@pytest.mark.parametrize("kind", KINDS)
def test_a_gyro_of_its_own_says_what_the_wheels_do(kind: str) -> None:
    road = started(kind)
    gyro = road.protocol.gyro
    assert (gyro is not None) == DRIVE_KINDS[kind].has_gyro
    if gyro is None:
        return
    standing = gyro.take()
    assert standing is not None
    assert standing.yaw_rate_radps == pytest.approx(0.0, abs=0.002), "its offset was learnt"
    assert gyro.take() is None, "a reading counts once"
    road.run(1.0, -2.0, 2.0)
    turning, state = gyro.take(), road.states[-1]
    assert turning is not None
    by_wheels = (state.right_radps - state.left_radps) * road.robot.base.wheel_radius_m
    assert turning.yaw_rate_radps == pytest.approx(
        by_wheels / road.robot.base.wheel_separation_m, abs=0.02
    )
    assert turning.stamp_s == state.stamp_s
    assert turning.boot_id == state.boot_id
    assert turning.seq > standing.seq


def started(kind: str) -> Road:
    road = Road(kind)
    road.run(START_S)
    assert road.states
    return road


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize(("left", "right"), [(4.0, 4.0), (-3.0, 3.0), (2.0, -1.0), (0.0, 5.0)])
def test_wheels_turn_as_told_and_are_reported_as_they_turned(
    kind: str, left: float, right: float
) -> None:
    road = started(kind)
    first, went = road.states[-1], (road.left_rad, road.right_rad)
    road.run(2.0, left, right)
    assert road.speeds == pytest.approx((left, right), abs=STEP_RADPS)
    road.run(0.5)
    assert road.speeds == (0.0, 0.0)
    last = road.states[-1]
    centimetre_rad = 0.02 / road.robot.base.wheel_radius_m if kind == "waveshare" else 0.02
    assert last.left_rad - first.left_rad == pytest.approx(
        road.left_rad - went[0], abs=centimetre_rad
    )
    assert last.right_rad - first.right_rad == pytest.approx(
        road.right_rad - went[1], abs=centimetre_rad
    )
    assert (last.left_radps, last.right_radps) == pytest.approx((0.0, 0.0), abs=0.01)


@pytest.mark.parametrize("kind", KINDS)
def test_it_reports_and_answers_within_its_windows(kind: str) -> None:
    road = started(kind)
    drive = road.robot.drive
    for k in range(300):
        road.tick(3.0, 3.0 - 0.01 * k)
        state = road.states[-1]
        assert road.now_s - road.heard_s < drive.encoder_window_s / 2
        assert road.now_s - state.stamp_s < drive.encoder_window_s
        assert (road.seq - state.echo_seq) * TICK_S < drive.answer_window_s
        assert state.echo_boot == "b1"
        assert state.enabled


@pytest.mark.parametrize("kind", KINDS)
def test_in_silence_the_base_stops_by_its_own_dead_man(kind: str) -> None:
    road = started(kind)
    road.run(1.0, 4.0, 4.0)
    dead_man_s = road.robot.drive.dead_man_s
    silent_s = 0.0
    while road.speeds != (0.0, 0.0):
        road.tick(silent=True)
        silent_s += TICK_S
        assert silent_s < dead_man_s + 0.1
    assert silent_s > dead_man_s - 0.1


@pytest.mark.parametrize("kind", KINDS)
def test_a_base_that_was_reset_under_way_is_another_and_stands(kind: str) -> None:
    road = started(kind)
    road.run(1.0, 4.0, 4.0)
    before = road.states[-1]
    road.firmware = FIRMWARES[kind](road.robot)
    road.run(START_S)
    after = road.states[-1]
    assert after.boot_id != before.boot_id
    assert after.stamp_s > road.now_s - 0.2
    road.run(1.0, 2.0, 2.0)
    assert road.speeds == pytest.approx((2.0, 2.0), abs=STEP_RADPS)
    assert road.states[-1].boot_id == after.boot_id


@pytest.mark.parametrize("kind", KINDS)
def test_only_one_that_reports_its_dead_man_says_that_it_acted(kind: str) -> None:
    road = started(kind)
    told = {state.timed_out for state in road.states}
    assert told <= ({True, False} if road.robot.drive.reports_dead_man else {None})
