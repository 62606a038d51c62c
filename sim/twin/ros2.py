"""Play a ROS 2 robot with the simulated body: its node (the package pons_ros2), base and sensors.

Dead-man and socket are the package's own; in ROS' place stands the body, whose base takes a twist
and says odometry as a diff_drive_controller does.
"""

from __future__ import annotations

import secrets
from collections import deque
from math import cos, remainder, sin, tau
from typing import TYPE_CHECKING, Any

from ros2.pons_ros2.pons_ros2.dead_man import CmdVelDeadMan
from ros2.pons_ros2.pons_ros2.link import PlannerLink
from wire import ConfigError, DriveCommand

if TYPE_CHECKING:
    from wire import DriveState, Imu, RobotDescription, Scan

TWIST_STAMPED = "geometry_msgs/msg/TwistStamped"
ODOM_TICKS = 2
"""50 Hz, the default of diff_drive_controller."""
EPOCH_S = 1_800_000_000.0
"""The robot's ROS clock is another than ours."""
INPUTS = dict.fromkeys(("estop", "bumper_front", "bumper_rear", "cliff"), False)


class Ros2Twin:
    """Hold the node of one ROS 2 robot."""

    def __init__(self, robot: RobotDescription, port: int, key: bytes = b"") -> None:
        """Listen at a port of this computer.

        Raises:
            ConfigError: ``twin_port``: somebody else listens there.
        """
        import zenoh

        self._base = robot.base
        try:
            self.link = PlannerLink(f"tcp/127.0.0.1:{port}", has_key=bool(key))
        except zenoh.ZError as error:
            raise ConfigError("twin_port", f"port {port}: {error}") from None
        self.dead_man = CmdVelDeadMan(f"twin-{secrets.token_hex(4)}", key)
        self._heard: deque[str] = deque(maxlen=64)
        self.link.hear("command", self._heard.append)
        self._x_m = self._y_m = self._yaw_rad = 0.0
        self._wheels: tuple[float, float] | None = None
        self._seq = 0

    def command(self, now_s: float) -> DriveCommand:
        """Return what the node has the base do in this tick."""
        while self._heard:
            self.dead_man.hear(self._heard.popleft(), now_s)
        v_mps, w_radps, timed_out = self.dead_man.twist(now_s)
        across_mps = w_radps * self._base.wheel_separation_m / 2.0
        obeyed = self.dead_man.command
        self._seq += 1
        return DriveCommand(
            boot="twin",
            seq=self._seq,
            left_radps=(v_mps - across_mps) / self._base.wheel_radius_m,
            right_radps=(v_mps + across_mps) / self._base.wheel_radius_m,
            enable=not timed_out and obeyed is not None and obeyed.get("on") is True,
        )

    def report(self, body: DriveState, now_s: float) -> None:
        """Say what the node does, and the odometry that the body's encoders make."""
        graph: dict[str, Any] = {"cmd_vel": TWIST_STAMPED, "others": 0, "code": None, "found": ""}
        self.link.say("state", self.dead_man.state(now_s, now_s + EPOCH_S, **graph))
        self._integrate(body)
        if self._seq % ODOM_TICKS == 0:
            self.link.say("odom", self._odometry(body))

    def hear_imu(self, imu: Imu) -> None:
        """Say what the gyro reads."""
        words = imu.model_dump(exclude={"boot_id", "seq", "stamp_s"})
        self.link.say("imu", words | {"stamp_s": imu.stamp_s + EPOCH_S})

    def hear_scan(self, scan: Scan) -> None:
        """Say what the lidar sees."""
        words = scan.model_dump(exclude={"boot_id", "seq", "stamp_s"})
        self.link.say("scan", words | {"stamp_s": scan.stamp_s + EPOCH_S, "frame": "laser"})

    def discard(self) -> None:
        """Throw away what came while this process was frozen."""
        self._heard.clear()

    def close(self) -> None:
        """Stop listening."""
        self.link.close()

    def _integrate(self, body: DriveState) -> None:
        now = body.left_rad, body.right_rad
        last, self._wheels = self._wheels or now, now
        left_m, right_m = (
            (a - b) * self._base.wheel_radius_m for a, b in zip(now, last, strict=True)
        )
        turned_rad = (right_m - left_m) / self._base.wheel_separation_m
        heading_rad = self._yaw_rad + turned_rad / 2.0
        self._x_m += (left_m + right_m) / 2.0 * cos(heading_rad)
        self._y_m += (left_m + right_m) / 2.0 * sin(heading_rad)
        self._yaw_rad += turned_rad

    def _odometry(self, body: DriveState) -> dict[str, Any]:
        half_m = self._base.wheel_radius_m / 2.0
        return {
            "stamp_s": body.stamp_s + EPOCH_S,
            "x_m": self._x_m,
            "y_m": self._y_m,
            "yaw_rad": remainder(self._yaw_rad, tau),
            "v_mps": half_m * (body.left_radps + body.right_radps),
            "w_radps": 2.0 * half_m * (body.right_radps - body.left_radps)
            / self._base.wheel_separation_m,
            "battery": body.battery,
            **INPUTS,
        }  # fmt: skip
