"""Play a ROS 2 robot with the simulated body: server or router, relay, base, lidar and gyro.

Everything between the bridge and the frames of the socket is what runs with a real one. The base
takes a twist and says odometry, as a diff_drive_controller does.
"""

from __future__ import annotations

from math import cos, sin
from typing import TYPE_CHECKING, Any

from sim.twin.rmw_zenoh_peer import RmwZenohPeer
from sim.twin.ros2_relay import RelayFirmware
from sim.twin.rosbridge_server import RosbridgeServer
from wire import ConfigError, DriveCommand

if TYPE_CHECKING:
    from wire import DriveState, Imu, RobotDescription, Scan

TWIST_STAMPED = "geometry_msgs/msg/TwistStamped"
STRING = "std_msgs/msg/String"
ODOM_TICKS = 2
"""50 Hz, the default of diff_drive_controller."""
EPOCH_S = 1_800_000_000.0
"""The robot's ROS clock is another than ours."""


class Ros2Twin:
    """Hold the graph of one ROS 2 robot."""

    def __init__(self, robot: RobotDescription, port: int) -> None:
        """Serve the topics that robot.toml names.

        Raises:
            ConfigError: ``twin_unknown`` or ``twin_port``.
        """
        ros2 = robot.ros2
        if ros2 is None:
            raise ConfigError(
                "twin_unknown", f"drive.kind {robot.drive.kind!r} is no base of ROS 2"
            )
        self._ros2, self._base = ros2, robot.base
        types = {
            ros2.cmd_vel: TWIST_STAMPED,
            ros2.odom: "nav_msgs/msg/Odometry",
            ros2.state: STRING,
            ros2.command: STRING,
        }
        if ros2.scan is not None:
            types[ros2.scan] = "sensor_msgs/msg/LaserScan"
        if ros2.imu is not None:
            types[ros2.imu] = "sensor_msgs/msg/Imu"
        self.server: RosbridgeServer | RmwZenohPeer
        if ros2.transport == "zenoh":
            self.server = RmwZenohPeer(port, types, (ros2.cmd_vel, ros2.command), ros2.domain)
        else:  # DDS is no matter of a port: there the twin speaks rosbridge
            self.server = RosbridgeServer(port, types)
        self.relay = RelayFirmware(TWIST_STAMPED)
        self._x_m = self._y_m = self._yaw_rad = 0.0
        self._wheels: tuple[float, float] | None = None
        self._seq = 0

    def command(self, now_s: float) -> DriveCommand:
        """Return what the relay has the base do in this tick."""
        for topic, message in self.server.take():
            if topic == self._ros2.command:
                self.relay.hear(message.get("data"), now_s)
        v_mps, w_radps, _ = self.relay.twist(now_s)
        across_mps = w_radps * self._base.wheel_separation_m / 2.0
        self._seq += 1
        return DriveCommand(
            boot="twin",
            seq=self._seq,
            left_radps=(v_mps - across_mps) / self._base.wheel_radius_m,
            right_radps=(v_mps + across_mps) / self._base.wheel_radius_m,
            enable=self.relay.has_torque(now_s),
        )

    def report(self, body: DriveState, now_s: float) -> None:
        """Say what the relay does, and the odometry that the body's encoders make."""
        state = self.relay.state(now_s, now_s + EPOCH_S)
        self.server.publish(self._ros2.state, {"data": state})
        self._integrate(body)
        if self._seq % ODOM_TICKS == 0:
            self.server.publish(self._ros2.odom, self._odometry(body))

    def hear_imu(self, imu: Imu) -> None:
        """Say what the gyro reads."""
        if self._ros2.imu is not None:
            nothing = {"x": 0.0, "y": 0.0, "z": 0.0}
            accel = {"x": imu.accel_x_mps2, "y": imu.accel_y_mps2, "z": 9.81}
            self.server.publish(
                self._ros2.imu,
                {
                    "header": _header(imu.stamp_s, "imu_link"),
                    "angular_velocity": nothing | {"z": imu.yaw_rate_radps},
                    "linear_acceleration": accel,
                },
            )

    def hear_scan(self, scan: Scan) -> None:
        """Say what the lidar sees; where nothing came back it says infinity, which JSON lacks."""
        if self._ros2.scan is not None:
            beams = len(scan.ranges_m)
            message: dict[str, Any] = {
                "header": _header(scan.stamp_s, "laser"),
                "angle_min": scan.angle_min_rad,
                "angle_max": scan.angle_min_rad + scan.angle_increment_rad * (beams - 1),
                "angle_increment": scan.angle_increment_rad,
                "time_increment": scan.time_increment_s,
                "scan_time": scan.time_increment_s * beams,
                "range_min": scan.range_min_m,
                "range_max": scan.range_max_m,
                "ranges": list(scan.ranges_m),
                "intensities": [],
            }
            self.server.publish(self._ros2.scan, message)

    def discard(self) -> None:
        """Throw away what came while this process was frozen."""
        self.server.take()

    def close(self) -> None:
        """Stop serving."""
        self.server.close()

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
        v_mps = half_m * (body.left_radps + body.right_radps)
        w_radps = 2.0 * half_m * (body.right_radps - body.left_radps)
        nothing = {"x": 0.0, "y": 0.0, "z": 0.0}
        turned = {"z": sin(self._yaw_rad / 2.0), "w": cos(self._yaw_rad / 2.0)}
        position = {"x": self._x_m, "y": self._y_m, "z": 0.0}
        turning = nothing | {"z": w_radps / self._base.wheel_separation_m}
        return {
            "header": _header(body.stamp_s, "odom"),
            "child_frame_id": "base_link",
            "pose": {
                "pose": {"position": position, "orientation": {"x": 0.0, "y": 0.0} | turned},
                "covariance": [0.0] * 36,
            },
            "twist": {
                "twist": {"linear": nothing | {"x": v_mps}, "angular": turning},
                "covariance": [0.0] * 36,
            },
        }


def _header(stamp_s: float, frame: str) -> dict[str, Any]:
    whole = int(stamp_s + EPOCH_S)
    nanosec = int((stamp_s + EPOCH_S - whole) * 1e9)
    return {"stamp": {"sec": whole, "nanosec": nanosec}, "frame_id": frame}
