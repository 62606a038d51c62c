"""The twin says of the body what the wire's messages say, and its dead-man moves it."""

from __future__ import annotations

import json
from collections.abc import Iterator

import pytest

from pons.robot_processes import free_port
from ros2.robot_words import (
    ImuWords,
    OdometryWords,
    RelayCommand,
    RelayState,
    ScanWords,
    encode_command,
    read_words,
)
from sim.twin.ros2 import EPOCH_S, Ros2Twin
from tests.ros2.words import robot
from wire import ConfigError, DriveCommand, DriveState, Imu, Scan


class Said(Ros2Twin):
    """Keep what goes to the link."""

    def __init__(self, port: int) -> None:
        super().__init__(robot(), port)
        self.said: dict[str, list[bytes]] = {}

        def keep(name: str, words: object) -> None:
            text = words if isinstance(words, str) else json.dumps(words)
            self.said.setdefault(name, []).append(text.encode())

        self.link.say = keep  # type: ignore[method-assign]


@pytest.fixture
def port() -> int:
    return free_port()


@pytest.fixture
def twin(port: int) -> Iterator[Said]:
    made = Said(port)
    yield made
    made.close()


def body(left_rad: float, right_rad: float, seq: int = 1) -> DriveState:
    return DriveState(
        boot_id="sim", seq=seq, stamp_s=10.0, echo_boot=None, echo_seq=0, enabled=True,
        timed_out=False, left_rad=left_rad, right_rad=right_rad, left_radps=2.0, right_radps=4.0,
    )  # fmt: skip


def order(twin: Said, seq: int, now_s: float) -> str:
    drive = DriveCommand(boot="boot1", seq=seq, left_radps=0.0, right_radps=0.0, enable=True)
    words = RelayCommand(drive, twin.dead_man.boot, now_s, 0.2, v_mps=0.3, w_radps=0.4)
    return encode_command(words).decode()


def test_a_twist_turns_the_wheels_until_its_end(twin: Said) -> None:
    assert not twin.command(10.0).enable
    twin._heard.append(order(twin, 1, 10.0))
    command = twin.command(10.01)
    assert command.enable
    assert command.left_radps == pytest.approx((0.3 - 0.4 * 0.25) / 0.1)
    assert command.right_radps == pytest.approx((0.3 + 0.4 * 0.25) / 0.1)
    after = twin.command(10.21)
    assert (after.enable, after.left_radps) == (False, 0.0)


def test_what_came_while_it_was_frozen_counts_for_nothing(twin: Said) -> None:
    twin._heard.append(order(twin, 1, 10.0))
    twin.discard()
    assert not twin.command(10.01).enable


def test_odometry_is_where_the_wheels_brought_it(twin: Said) -> None:
    for tick in range(5):
        twin.command(10.0)
        twin.report(body(0.1 * tick, 0.1 * tick, tick + 1), 10.0)
    assert len(twin.said["state"]) == 5
    assert read_words(RelayState, twin.said["state"][-1]).timed_out
    read = read_words(OdometryWords, twin.said["odom"][-1])
    assert len(twin.said["odom"]) == 2
    assert read.x_m == pytest.approx(0.03)
    assert read.v_mps == pytest.approx(0.3)
    assert read.w_radps == pytest.approx(0.4)
    assert read.stamp_s == EPOCH_S + 10.0
    assert (read.estop, read.cliff) == (False, False)


def test_scan_and_gyro_come_through_as_they_were(twin: Said) -> None:
    scan = Scan(
        boot_id="sim", seq=1, stamp_s=9.9, angle_min_rad=-1.0, angle_increment_rad=0.5,
        range_min_m=0.1, range_max_m=8.0, ranges_m=(1.0, None, 2.0), time_increment_s=0.001,
    )  # fmt: skip
    twin.hear_scan(scan)
    read = read_words(ScanWords, twin.said["scan"][0])
    assert (read.ranges_m, read.angle_min_rad) == (scan.ranges_m, -1.0)
    imu = Imu(boot_id="sim", seq=1, stamp_s=9.9, yaw_rate_radps=0.2, accel_x_mps2=0.1,
              accel_y_mps2=0.0)  # fmt: skip
    twin.hear_imu(imu)
    assert read_words(ImuWords, twin.said["imu"][0]).yaw_rate_radps == 0.2


def test_a_port_that_is_taken_is_named(twin: Said, port: int) -> None:
    assert twin.said == {}
    with pytest.raises(ConfigError, match="twin_port"):
        Ros2Twin(robot(), port)
