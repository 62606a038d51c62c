"""Be a base with its relay on a graph without ROS: by DDS, or by rmw_zenoh's twin, in real time."""

from __future__ import annotations

import threading
import time
from collections.abc import Collection
from typing import Any

from ros2 import cdr
from sim.twin.ros2_relay import RelayFirmware
from tests.ros2.frames import ROS_S, TYPES, imu, odometry, scan

HEARD = ("/cmd_vel", "/pons/command")


class DdsPeer:
    """Hold a participant with the topics of a robot; its face is that of the twins' servers."""

    def __init__(self, domain: int, types: dict[str, str], heard: Collection[str] = HEARD) -> None:
        from ros2.dds_entities import DdsDomain  # of an extra

        self._domain, self._types = DdsDomain(domain, "lo"), types
        self._readers = {
            topic: self._domain.reader(f"rt{topic}", kind, keeps=False)
            for topic, kind in types.items()
            if topic in heard
        }
        self._writers = {
            topic: self._domain.writer(f"rt{topic}", kind)
            for topic, kind in types.items()
            if topic not in heard
        }

    def take(self) -> list[tuple[str, dict[str, Any]]]:
        return [
            (topic, cdr.decode(self._types[topic], payload))
            for topic, reader in self._readers.items()
            for payload in reader.take()
        ]

    def publish(self, topic: str, message: dict[str, Any]) -> None:
        writer = self._writers[topic]
        writer.write(cdr.encode(writer.kind, message))

    def close(self) -> None:
        self._readers.clear()
        self._writers.clear()
        self._domain.close()


def with_frame(message: dict[str, Any]) -> dict[str, Any]:
    message["header"]["frame_id"] = "base_link"
    return message


def whole_odometry(at_s: float) -> dict[str, Any]:
    """Return odometry with all that ROS has in it."""
    said = with_frame(odometry(at_s)) | {"child_frame_id": "base_link"}
    for part in ("pose", "twist"):
        said[part]["covariance"] = [0.0] * 36
    for part in ("linear", "angular"):
        said["twist"]["twist"][part] = dict.fromkeys("xyz", 0.0) | said["twist"]["twist"][part]
    return said


def whole_scan(at_s: float) -> dict[str, Any]:
    """Return a scan of a beam too near, one without return and one of 1.5 m."""
    more = {"angle_max": -2.8, "scan_time": 0.1, "intensities": []}
    return with_frame(scan(at_s, ranges=[float("-inf"), float("inf"), 1.5], **more))


class PeerBase(threading.Thread):
    """Run a relay beside a server, and say odometry, scans and gyro."""

    def __init__(self, server: Any, types: dict[str, str]) -> None:
        super().__init__(daemon=True)
        self.server, self.types = server, types
        self.relay = RelayFirmware(types.get("/cmd_vel", TYPES["/cmd_vel"]))
        self.accepted: list[tuple[float, float]] = []
        self.odometry_more: dict[str, Any] = {}
        self.clock_s = 0.0
        """By how much the stamps of odometry are off."""
        self._ending = threading.Event()

    def run(self) -> None:
        ticks = 0
        while not self._ending.wait(0.01):
            now_s = time.monotonic()
            for topic, message in self.server.take():
                if topic == "/pons/command" and self.relay.hear(message["data"], now_s):
                    self.accepted.append((now_s, self.relay.twist(now_s)[0]))
            ticks += 1
            self._say("/pons/state", {"data": self.relay.state(now_s, now_s + ROS_S)})
            if ticks % 2 == 0:
                self._say("/odom", whole_odometry(now_s + self.clock_s) | self.odometry_more)
            if ticks % 10 == 0:
                self._say("/scan", whole_scan(now_s))
            self._say("/imu", with_frame(imu(now_s)))

    def stands(self) -> bool:
        return self.relay.twist(time.monotonic()) == (0.0, 0.0, False)

    def end(self) -> None:
        self._ending.set()
        self.join()
        self.server.close()

    def _say(self, topic: str, message: dict[str, Any]) -> None:
        if topic in self.types:
            self.server.publish(topic, message)
