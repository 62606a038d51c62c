"""Check the lidar of robot.toml: what its process says, or what its port brings where none runs."""

from __future__ import annotations

import time
from pathlib import Path
from typing import TYPE_CHECKING

from devices import PORT_CURES, LastingPort, PortTrouble
from pons.doctor.finding import BilingualWords, HealthFinding, fail, ok, warn
from pons.doctor.running_process import hear_state, says_nothing
from sensors.lidar.health import CODES, STARTING, LidarVerdict
from sensors.lidar.kinds import kind_of
from sensors.lidar.reader import LidarReader
from wire import keys
from wire.doors import SCANS_DOOR
from wire.sockets import Endpoints, is_listening

if TYPE_CHECKING:
    from wire import RobotDescription

READ_S = 5.0
PERIOD_S = 0.005


def lidar(home: Path, robot: RobotDescription) -> HealthFinding:
    """Look how well the lidar is read; sends it nothing but the requests that start its scans."""
    config = robot.lidar
    if config.is_simulated and robot.drive.virtual:
        return ok("lidar", "simulated", "模拟")
    if not (config.is_simulated or config.has_line):
        return ok("lidar", "a topic of ROS 2: see the line ros2", "ROS 2 话题：见 ros2 一行")
    if config.is_simulated:
        return warn(
            "lidar",
            BilingualWords(
                f"lidar.kind is 'sim' beside drive.kind {robot.drive.kind!r}: nothing reads one",
                f"drive.kind 为 {robot.drive.kind!r}，而 lidar.kind 为 'sim'：没有读取激光雷达",
            ),
            BilingualWords(
                "name its kind and port (docs/lidars.md); the robot stands until scans come",
                "请填写型号和端口（docs/lidars.md）；没有扫描数据机器人不会动",
            ),
        )
    if is_listening(Endpoints(home).socket(SCANS_DOOR)):
        return _hear_process(home, robot)
    return _read_port(robot)


def _hear_process(home: Path, robot: RobotDescription) -> HealthFinding:
    """Report what the running process says."""
    status = hear_state(home, robot, keys.LIDAR_STATE)
    if status is None:
        return says_nothing("lidar")
    if status.code is None:
        lost = f"{status.spoilt} of {status.frames + status.spoilt} frames spoilt"
        said = f"{status.model}, {status.rate_hz:.1f} turns/s, {lost}"
        chinese = f"{status.model}，每秒 {status.rate_hz:.1f} 圈，坏帧 {status.spoilt}"
        return ok("lidar", said, chinese)
    return _wrong(LidarVerdict(status.code, f"{status.code}: {status.detail}"))


def _read_port(robot: RobotDescription) -> HealthFinding:
    """Read the port for some seconds, as the process would."""
    kind, path = kind_of(robot.lidar), robot.lidar.port or ""
    try:
        port = LastingPort(Path(path), kind.baud, dtr=kind.dtr)
    except PortTrouble as trouble:
        return _wrong(LidarVerdict(trouble.code, trouble.fact))
    reader = LidarReader(kind, port, path, "doctor")
    end_s = time.monotonic() + READ_S
    verdict: LidarVerdict | None = LidarVerdict(STARTING, "not read yet")
    try:
        while verdict is not None and time.monotonic() < end_s and port.trouble is None:
            now_s = time.monotonic()
            reader.turn(now_s)
            verdict = reader.judge(now_s)
            time.sleep(PERIOD_S)
        if port.trouble is not None:
            verdict = LidarVerdict(port.trouble.code, port.trouble.fact)
        reader.close()
    finally:
        port.close()
    if verdict is None:
        said = f"{kind.name} at {path}"
        return ok("lidar", f"{said} turns and is read", f"{said}：旋转正常，读取正常")
    return _wrong(verdict)


def _wrong(verdict: LidarVerdict) -> HealthFinding:
    english, chinese = (
        CODES.get(verdict.code) or PORT_CURES.get(verdict.code) or ("see docs/lidars.md",) * 2
    )
    found = verdict.found if verdict.code in verdict.found else f"{verdict.code}: {verdict.found}"
    return fail("lidar", BilingualWords(found, found), BilingualWords(english, chinese))
