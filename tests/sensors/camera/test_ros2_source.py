"""A camera of a ROS 2 graph gives its newest picture, and says why where it gives none."""

from __future__ import annotations

import base64
import threading
import time
from collections.abc import Callable, Iterator
from math import tan
from typing import Any

import numpy as np
import pytest

from pons.robot_processes import free_port
from sensors.camera import ros2_source
from sensors.camera.shot import CameraTrouble, PictureSource
from sensors.camera.source import open_source
from sim.twin.rosbridge_server import RosbridgeServer
from tests.sensors.camera.test_packed_picture import HEIGHT, JPEG, PICTURE, WIDTH
from wire import CameraConfig
from wire.ros2_config import Ros2Config

TOPIC = "/camera/compressed"
COMPRESSED, RAW = "sensor_msgs/msg/CompressedImage", "sensor_msgs/msg/Image"


class RosCamera(threading.Thread):
    """Say pictures on a twin of rosbridge, 30 a second."""

    def __init__(self, kind: str = COMPRESSED, data: bytes = JPEG, form: str = "jpeg") -> None:
        super().__init__(daemon=True)
        self.server = RosbridgeServer(0, {TOPIC: kind})
        self.data, self.form = data, form
        self.speaks = True
        self._ending = threading.Event()
        self.start()

    @property
    def ros2(self) -> Ros2Config:
        return Ros2Config(url=f"ws://127.0.0.1:{self.server.port}")

    def run(self) -> None:
        while not self._ending.wait(1 / 30):
            now_s = time.time()
            stamp = {"sec": int(now_s), "nanosec": int(now_s % 1.0 * 1e9)}
            data = base64.b64encode(self.data).decode()
            message = {"header": {"stamp": stamp}, "format": self.form, "data": data}
            if self.speaks:
                self.server.publish(TOPIC, message)

    def close(self) -> None:
        self._ending.set()
        self.join()
        self.server.close()


@pytest.fixture
def said(monkeypatch: pytest.MonkeyPatch) -> Iterator[Callable[..., RosCamera]]:
    monkeypatch.setattr(ros2_source, "OPEN_S", 1.5)
    monkeypatch.setattr(ros2_source, "READ_S", 0.5)
    made: list[RosCamera] = []

    def start(**more: Any) -> RosCamera:
        made.append(RosCamera(**more))
        return made[-1]

    yield start
    for camera in made:
        camera.close()


def config(**more: Any) -> CameraConfig:
    return CameraConfig(kind="ros2", topic=TOPIC, **more)


def trouble(ros2: Ros2Config) -> CameraTrouble:
    source = open_source(config(), ros2)
    try:
        with pytest.raises(CameraTrouble) as told:
            source.read()
    finally:
        source.close()
    return told.value


def ended(source: PictureSource) -> CameraTrouble:
    """Return why it gives no more, once those that were on their way are read."""
    for _ in range(9):
        try:
            source.read()
        except CameraTrouble as told:
            return told
    raise AssertionError("it gives pictures")


def test_pictures_are_given_with_the_lens_of_robot_toml_and_dated_when_they_came(
    said: Callable[..., RosCamera],
) -> None:
    source = open_source(config(fov_rad=1.0, upside_down=True), said().ros2)
    shots = [source.read() for _ in range(5)]
    source.close()
    for shot in shots:
        assert np.abs(shot.color.astype(int) - PICTURE[::-1, ::-1]).mean() < 3
        assert shot.focal_px == pytest.approx(WIDTH / 2 / tan(0.5))
        assert shot.center_px == (WIDTH / 2, HEIGHT / 2)
        assert shot.depth_mm is None
    times = [shot.at_s for shot in shots if shot.at_s is not None]
    assert times == sorted(set(times))
    assert 0.0 <= time.monotonic() - times[-1] < 2.0


def test_a_spoilt_picture_is_passed_over_and_a_stream_of_them_is_named(
    said: Callable[..., RosCamera],
) -> None:
    camera = said()
    source = open_source(config(), camera.ros2)
    source.read()
    camera.data = JPEG[:-200]
    assert ended(source).code == "camera_picture_unreadable"
    camera.data = JPEG
    assert source.read().color.shape == (HEIGHT, WIDTH, 3)
    source.close()


def test_a_stream_that_stops_is_gone_and_is_read_again(said: Callable[..., RosCamera]) -> None:
    camera = said()
    source = open_source(config(), camera.ros2)
    source.read()
    camera.speaks = False
    told = ended(source)
    assert told.code == "camera_gone"
    assert TOPIC in told.detail
    camera.speaks = True
    source.read()
    source.close()


@pytest.mark.parametrize(
    ("more", "code"),
    [
        ({"kind": ""}, "ros2_topic_missing"),
        ({"kind": RAW}, "ros2_image_raw"),
        ({"kind": "std_msgs/msg/String"}, "ros2_topic_type"),
        ({"form": "16UC1; compressedDepth"}, "ros2_image_depth"),
        ({"data": b"GIF89a"}, "camera_picture_unreadable"),
    ],
)
def test_a_topic_that_gives_none_says_why(
    said: Callable[..., RosCamera], more: dict[str, Any], code: str
) -> None:
    assert trouble(said(**more).ros2).code == code


@pytest.mark.usefixtures("said")
def test_a_server_that_is_not_there_says_so() -> None:
    assert trouble(Ros2Config(url=f"ws://127.0.0.1:{free_port()}")).code == "ros2_no_server"
