"""The twin's topics say of the body what the wire's messages say, and the relay moves it."""

from __future__ import annotations

from collections.abc import Iterator

import pytest

from ros2.messages import read_imu, read_odometry, read_scan
from ros2.relay import RelayCommand, decode_state, encode_command
from sim.twin.ros2 import EPOCH_S, Ros2Twin
from sim.twin.rosbridge_server import RosbridgeServer
from tests.ros2.frames import robot
from wire import ConfigError, DriveCommand, DriveState, Imu, RobotDescription, Scan


class Published(Ros2Twin):
    """Keep what goes to the server."""

    def __init__(self) -> None:
        super().__init__(robot(), 0)
        self.said: dict[str, list[dict[str, object]]] = {}
        self.server.publish = (  # type: ignore[method-assign]
            lambda topic, message: self.said.setdefault(topic, []).append(message)
        )


@pytest.fixture
def twin() -> Iterator[Published]:
    made = Published()
    yield made
    made.close()


def body(left_rad: float, right_rad: float, seq: int = 1) -> DriveState:
    return DriveState(
        boot_id="sim", seq=seq, stamp_s=10.0, echo_boot=None, echo_seq=0, enabled=True,
        timed_out=False, left_rad=left_rad, right_rad=right_rad, left_radps=2.0, right_radps=4.0,
    )  # fmt: skip


def order(twin: Published, seq: int, now_s: float) -> str:
    drive = DriveCommand(boot="boot1", seq=seq, left_radps=0.0, right_radps=0.0, enable=True)
    words = RelayCommand(drive, twin.relay.boot, now_s, 0.2, v_mps=0.3, w_radps=0.4)
    return str(encode_command(words)["data"])


def say(twin: Published, text: str) -> None:
    assert isinstance(twin.server, RosbridgeServer)
    twin.server._heard.append(("/pons/command", {"data": text}))


def test_a_twist_turns_the_wheels_until_its_end(twin: Published) -> None:
    assert not twin.command(10.0).enable
    say(twin, order(twin, 1, 10.0))
    command = twin.command(10.01)
    assert command.enable
    assert command.left_radps == pytest.approx((0.3 - 0.4 * 0.25) / 0.1)
    assert command.right_radps == pytest.approx((0.3 + 0.4 * 0.25) / 0.1)
    after = twin.command(10.21)
    assert (after.enable, after.left_radps) == (False, 0.0)


def test_what_came_while_it_was_frozen_counts_for_nothing(twin: Published) -> None:
    say(twin, order(twin, 1, 10.0))
    twin.discard()
    assert not twin.command(10.01).enable


def test_odometry_is_where_the_wheels_brought_it(twin: Published) -> None:
    for tick in range(5):
        twin.command(10.0)
        twin.report(body(0.1 * tick, 0.1 * tick, tick + 1), 10.0)
    assert len(twin.said["/pons/state"]) == 5
    assert decode_state(twin.said["/pons/state"][-1]).timed_out
    read = read_odometry(twin.said["/odom"][-1])
    assert len(twin.said["/odom"]) == 2
    assert read.x_m == pytest.approx(0.03)
    assert read.v_mps == pytest.approx(0.3)
    assert read.w_radps == pytest.approx(0.4)
    assert read.stamp_s == pytest.approx(EPOCH_S + 10.0, abs=1e-5)


def test_scan_and_gyro_come_through_as_they_were(twin: Published) -> None:
    scan = Scan(
        boot_id="sim", seq=1, stamp_s=9.9, angle_min_rad=-1.0, angle_increment_rad=0.5,
        range_min_m=0.1, range_max_m=8.0, ranges_m=(1.0, None, 2.0), time_increment_s=0.001,
    )  # fmt: skip
    twin.hear_scan(scan)
    read = read_scan(twin.said["/scan"][0])
    assert (read.ranges_m, read.angle_min_rad) == (scan.ranges_m, -1.0)
    imu = Imu(boot_id="sim", seq=1, stamp_s=9.9, yaw_rate_radps=0.2, accel_x_mps2=0.1,
              accel_y_mps2=0.0)  # fmt: skip
    twin.hear_imu(imu)
    assert read_imu(twin.said["/imu"][0]).yaw_rate_radps == 0.2


def test_a_robot_that_is_no_ros2_base_has_no_such_twin() -> None:
    with pytest.raises(ConfigError, match="twin_unknown"):
        Ros2Twin(RobotDescription(), 0)
