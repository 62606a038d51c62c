"""Check the camera: ask its running process, or open it oneself for some seconds."""

from __future__ import annotations

import time
from functools import partial
from typing import TYPE_CHECKING

from pons.doctor.finding import BilingualWords, HealthFinding, ok, warn
from pons.doctor.running_process import hear_state, says_nothing
from ros2.trouble import CODES as ROS2_CODES
from sensors.camera.health import CODES, STARTING, CameraHealth, CameraVerdict
from wire import keys
from wire.doors import CAMERA_DOOR
from wire.sockets import Endpoints, is_listening

if TYPE_CHECKING:
    from pathlib import Path

    from wire import RobotDescription

READ_S = 8.0
PERIOD_S = 0.05


def camera(home: Path, robot: RobotDescription) -> HealthFinding:
    """Look how well the camera is read."""
    config = robot.camera
    if config.kind == "none":
        return ok("camera", "none", "无")
    if config.kind == "node":
        return ok("camera", "another program's", "由其他程序提供")
    if config.kind == "sim":
        if robot.drive.virtual:
            return ok("camera", "simulated", "模拟")
        return warn(
            "camera",
            BilingualWords(
                f"camera.kind is 'sim' beside drive.kind {robot.drive.kind!r}: nothing draws",
                f"drive.kind 为 {robot.drive.kind!r}，而 camera.kind 为 'sim'：没有画面",
            ),
            BilingualWords(
                'name the camera, or kind = "none" (docs/sensors.md)',
                '请填写摄像头，或 kind = "none"（docs/sensors.md）',
            ),
        )
    if is_listening(Endpoints(home).socket(CAMERA_DOOR)):
        return _hear_process(home, robot)
    return _open_camera(robot)


def _hear_process(home: Path, robot: RobotDescription) -> HealthFinding:
    """Report what the running process says."""
    status = hear_state(home, robot, keys.CAMERA_STATE)
    if status is None:
        return says_nothing("camera")
    if status.code is not None:
        return _wrong(CameraVerdict(status.code, status.detail))
    said = f"{status.model}, {status.width} x {status.height}, {status.rate_hz:.1f} pictures/s"
    return ok("camera", said, f"{status.model}，{status.width} x {status.height}")


def _open_camera(robot: RobotDescription) -> HealthFinding:
    """Open the camera for some seconds, as the process would."""
    from sensors.camera.grabber import CameraGrabber
    from sensors.camera.source import open_source

    config = robot.camera
    grabber = CameraGrabber(partial(open_source, config, robot.ros2))
    health = CameraHealth(config)
    verdict: CameraVerdict | None = CameraVerdict(STARTING, "not read yet")
    end_s = time.monotonic() + READ_S
    try:
        while verdict is not None and verdict.code == STARTING and time.monotonic() < end_s:
            time.sleep(PERIOD_S)
            verdict = health.judge(grabber, time.monotonic())
    finally:
        grabber.close()
    if verdict is not None:
        return _wrong(verdict)
    width, height = grabber.size
    said = f"{config.kind}, {width} x {height}"
    return ok("camera", f"{said} is read", f"{said}：读取正常")


def _wrong(verdict: CameraVerdict) -> HealthFinding:
    unknown = ("see docs/sensors.md",) * 2
    english, chinese = (ROS2_CODES | CODES).get(verdict.code, unknown)
    found = f"{verdict.code}: {verdict.detail}"
    return warn("camera", BilingualWords(found, found), BilingualWords(english, chinese))
