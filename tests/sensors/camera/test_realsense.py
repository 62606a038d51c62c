"""What a RealSense's library gives becomes a picture with depth in millimetres.

The library is not here and no camera is: a double of what its documentation promises stands in.
"""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from sensors.camera.realsense import RealsenseSource, load_library
from sensors.camera.shot import CameraTrouble
from wire import CameraConfig


class Library:
    """Promise what pyrealsense2's documentation does."""

    stream = SimpleNamespace(color="color", depth="depth")
    format = SimpleNamespace(bgr8="bgr8", z16="z16")

    def __init__(self, error: str = "") -> None:
        self.error = error
        self.asked: list[tuple[Any, ...]] = []
        self.stopped = False
        self.color: Any = np.full((4, 6, 3), 7, np.uint8)
        self.depth: Any = np.full((4, 6), 1_000, np.uint16)
        self.depth[0, 0] = 0
        self.depth[0, 1] = 65_535

    def config(self) -> Any:
        return SimpleNamespace(
            enable_stream=lambda *words: self.asked.append(words),
            enable_device=lambda serial: self.asked.append((serial,)),
        )

    def pipeline(self) -> Library:
        return self

    def start(self, _wanted: Any) -> Library:
        if self.error:
            raise RuntimeError(self.error)
        return self

    def stop(self) -> None:
        self.stopped = True

    def get_stream(self, _which: str) -> Library:
        return self

    def as_video_stream_profile(self) -> Library:
        return self

    def get_intrinsics(self) -> Any:
        return SimpleNamespace(fx=5.0, ppx=2.0, ppy=1.5)

    def get_device(self) -> Library:
        return self

    def first_depth_sensor(self) -> Library:
        return self

    def get_depth_scale(self) -> float:
        return 0.0005

    def align(self, _which: str) -> Library:
        return self

    def process(self, frames: Any) -> Any:
        return frames

    def wait_for_frames(self, _limit_ms: int) -> Any:
        if self.error:
            raise RuntimeError(self.error)
        return SimpleNamespace(
            get_color_frame=lambda: SimpleNamespace(get_data=lambda: self.color),
            get_depth_frame=lambda: SimpleNamespace(get_data=lambda: self.depth),
        )


def config(**more: Any) -> CameraConfig:
    return CameraConfig(kind="realsense", width_px=640, height_px=480, rate_hz=15.0, **more)


def test_colours_and_depth_are_of_one_ray() -> None:
    library = Library()
    source = RealsenseSource(config(serial="123456789"), library)
    assert library.asked == [
        ("123456789",), ("color", 640, 480, "bgr8", 15), ("depth", 640, 480, "z16", 15),
    ]  # fmt: skip
    shot = source.read()
    assert shot.depth_mm is not None
    assert shot.depth_mm[0].tolist() == [0, 32_768, 500, 500, 500, 500]
    assert (shot.focal_px, shot.center_px) == (5.0, (2.0, 1.5))
    source.close()
    assert library.stopped


def test_one_that_hangs_upside_down_is_turned_with_its_centre() -> None:
    library = Library()
    library.color[0, 0] = 9
    shot = RealsenseSource(config(upside_down=True), library).read()
    assert shot.depth_mm is not None
    assert shot.color[-1, -1].tolist() == [9, 9, 9]
    assert shot.depth_mm[-1, -1] == 0
    assert shot.center_px == (4.0, 2.5)


def test_a_camera_that_is_not_there_or_goes_is_named() -> None:
    with pytest.raises(CameraTrouble, match="camera_missing: realsense: No device"):
        RealsenseSource(config(), Library("No device connected"))
    library = Library()
    source = RealsenseSource(config(), library)
    library.error = "Frame didn't arrive within 2000"
    with pytest.raises(CameraTrouble, match="camera_gone"):
        source.read()


def test_without_the_library_the_cure_is_named() -> None:
    with pytest.raises(CameraTrouble, match="pip install pyrealsense2"):
        load_library()
