"""What a camera gives is judged by what came, how often, and whether it changed."""

from __future__ import annotations

from dataclasses import dataclass
from typing import cast

import pytest

from sensors.camera.grabber import CameraGrabber
from sensors.camera.health import CODES, FROZEN_S, SILENT_S, START_S, CameraHealth
from sensors.camera.shot import CameraTrouble
from wire import CameraConfig


@dataclass
class Counted:
    """Be what is counted of a camera."""

    opened: int = 1
    pictures: int = 0
    changed_s: float = 0.0
    began_s: float = 0.0
    trouble: CameraTrouble | None = None


def judged(
    health: CameraHealth,
    seen: Counted,
    hz: float,
    seconds: float,
    start_s: float = 0.0,
    **more: bool,
) -> str | None:
    """Let pictures come, and say what is judged at the end."""
    code: str | None = None
    before = seen.pictures
    for step in range(1, round(seconds * 20) + 1):
        now_s = start_s + step / 20
        seen.pictures = before + int(step / 20 * hz)
        if not more.get("frozen"):
            seen.changed_s = now_s
        verdict = health.judge(cast("CameraGrabber", seen), now_s)
        code = verdict.code if verdict else None
        assert code is None or code in CODES
    return code


@pytest.fixture
def health() -> CameraHealth:
    return CameraHealth(CameraConfig(kind="uvc", device="/dev/video0", rate_hz=10.0))


def test_a_camera_in_good_order_is_not_spoken_of(health: CameraHealth) -> None:
    assert judged(health, Counted(), 10.0, 10.0) is None
    assert health.rate_hz == pytest.approx(10.0, abs=0.5)


def test_it_is_given_time_to_start_and_then_called_silent(health: CameraHealth) -> None:
    seen = Counted()
    assert judged(health, seen, 0.0, START_S - 0.5) == "camera_starting"
    assert judged(health, seen, 0.0, 1.0, START_S) == "camera_silent"


def test_one_that_falls_silent_or_slow_or_freezes_is_named(health: CameraHealth) -> None:
    seen = Counted()
    assert judged(health, seen, 10.0, 8.0) is None
    assert judged(health, seen, 4.0, 8.0, 8.0) == "camera_slow"
    assert judged(health, seen, 10.0, 8.0, 16.0) is None
    assert judged(health, seen, 10.0, FROZEN_S + 0.5, 24.0, frozen=True) == "camera_frozen"
    assert judged(health, seen, 0.0, SILENT_S + 0.5, 40.0) == "camera_silent"


@pytest.mark.parametrize(
    "config",
    [CameraConfig(kind="stream", url="file:///x.avi"), CameraConfig(kind="ros2")],
)
def test_a_still_film_and_a_simulated_room_are_not_frozen(config: CameraConfig) -> None:
    health = CameraHealth(config)
    assert judged(health, Counted(), 10.0, 20.0, frozen=True) is None


def test_its_own_trouble_comes_first_and_goes(health: CameraHealth) -> None:
    seen = Counted()
    assert judged(health, seen, 10.0, 3.0) is None
    seen.trouble = CameraTrouble("camera_gone", "x gives no picture any more")
    assert judged(health, seen, 0.0, 1.0, 3.0) == "camera_gone"
    seen.trouble, seen.opened = None, 2
    assert judged(health, seen, 0.0, 1.0, 4.0) == "camera_starting"
    assert judged(health, seen, 10.0, 1.0, 5.0) is None


def test_a_picture_that_the_wire_has_no_room_for_is_named(health: CameraHealth) -> None:
    health.too_large_bytes = 5_000_000
    assert judged(health, Counted(), 10.0, 3.0) == "camera_too_large"


@pytest.mark.parametrize("words", CODES.values())
def test_each_cure_is_told_in_both_languages(words: tuple[str, str]) -> None:
    assert words[0]
    assert any(ord(letter) > 0x2E80 for letter in words[1])
