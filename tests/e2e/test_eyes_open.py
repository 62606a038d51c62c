"""The real camera's picture reaches whoever asks, and a camera that lies or is gone is said."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from functools import partial

import pytest

from tests.e2e.polling import until
from tests.e2e.robot import Robot

pytestmark = [pytest.mark.e2e, pytest.mark.nightly]
CAMERA_CODES = ("camera_silent", "camera_frozen")


@contextmanager
def broken(robot: Robot, fault: str) -> Iterator[None]:
    """Have the camera broken for a while."""
    assert robot.system.pons("fault", fault).returncode == 0
    try:
        yield
    finally:
        assert robot.system.pons("fault").returncode == 0


def blind(robot: Robot) -> str | None:
    code = robot.system.http("GET", "/v1/objects").body["blind"]
    return None if code is None else str(code)


def test_a_frozen_or_silent_camera_is_said_and_the_robot_sees_again(robot: Robot) -> None:
    def sees() -> bool:
        answer = robot.system.http("GET", "/v1/camera.jpg")
        return answer.status == 200 and blind(robot) not in CAMERA_CODES

    def is_blind(code: str) -> bool:
        robot.system.http("GET", "/v1/camera.jpg")  # only who looks is told
        return blind(robot) == code

    until(sees, 20.0, "a picture", robot.system.read_log)
    for fault, code in (("camera_stuck", "camera_frozen"), ("camera_off", "camera_silent")):
        with broken(robot, fault):
            until(partial(is_blind, code), 10.0, code, robot.system.read_log)
        until(sees, 10.0, f"a picture after {fault}", robot.system.read_log)
    figures: bytes = robot.system.http("GET", "/metrics").body
    assert b'pons_eyes_skipped{reason="frozen"}' in figures
