"""A camera of a ROS 2 robot gives its newest picture, and says why where it gives none."""

from __future__ import annotations

import threading
import time
from collections.abc import Callable, Iterator
from math import tan
from typing import Any

import numpy as np
import pytest

from pons.robot_processes import free_port
from ros2.pictures import PictureHead
from ros2.pons_ros2.pons_ros2.link import PlannerLink
from sensors.camera import ros2_source
from sensors.camera.ros2_source import color_of, depth_of
from sensors.camera.shot import CameraTrouble, PictureSource
from sensors.camera.source import open_source
from tests.sensors.camera.test_packed_picture import (
    HEIGHT,
    JPEG,
    PICTURE,
    PNG,
    WIDTH,
    packed,
)
from wire import CameraConfig
from wire.ros2_config import Ros2Config

pytestmark = pytest.mark.nightly(keep=6)


DEPTH = np.array([[0, 500, 65535]], np.uint16)


class RosCamera(threading.Thread):
    """Say pictures as the node on a robot does, 30 a second."""

    def __init__(self, data: bytes = JPEG, **head: Any) -> None:
        super().__init__(daemon=True)
        self.node = f"tcp/127.0.0.1:{free_port()}"
        self.link = PlannerLink(self.node, has_key=False)
        self.data, self.head = data, {"kind": "packed", "format": "jpeg"} | head
        self.speaks = True
        self._ending = threading.Event()
        self.start()

    def run(self) -> None:
        while not self._ending.wait(1 / 30):
            if self.speaks:
                self.link.say_bytes("picture", self.head | {"stamp_s": time.time()}, self.data)

    def close(self) -> None:
        self._ending.set()
        self.join()
        self.link.close()


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
    return CameraConfig(kind="ros2", **more)


def trouble(node: str) -> CameraTrouble:
    source = open_source(config(), Ros2Config(node=node))
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
    source = open_source(config(fov_rad=1.0, upside_down=True), Ros2Config(node=said().node))
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
    source = open_source(config(), Ros2Config(node=camera.node))
    source.read()
    camera.data = JPEG[:-200]
    assert ended(source).code == "camera_picture_unreadable"
    camera.data = JPEG
    assert source.read().color.shape == (HEIGHT, WIDTH, 3)
    source.close()


def test_a_stream_that_stops_is_gone_and_is_read_again(said: Callable[..., RosCamera]) -> None:
    camera = said()
    source = open_source(config(), Ros2Config(node=camera.node))
    source.read()
    camera.speaks = False
    told = ended(source)
    assert told.code == "camera_gone"
    camera.speaks = True
    source.read()
    source.close()


@pytest.mark.parametrize(
    ("more", "code"),
    [
        ({"code": "ros2_topic_missing", "found": "no /camera"}, "ros2_topic_missing"),
        ({"code": "of_a_newer_package"}, "ros2_relay_silent"),
        ({"kind": "odd"}, "ros2_unreadable"),
        ({"data": b""}, "ros2_unreadable"),
        ({"data": b"GIF89a"}, "camera_picture_unreadable"),
    ],
)
def test_a_robot_that_gives_none_says_why(
    said: Callable[..., RosCamera], more: dict[str, Any], code: str
) -> None:
    assert trouble(said(**more).node).code == code


@pytest.mark.usefixtures("said")
def test_a_node_that_is_not_there_says_so() -> None:
    assert trouble(f"tcp/127.0.0.1:{free_port()}").code == "ros2_no_node"


def raw(form: str, width: int = 3, height: int = 1) -> PictureHead:
    return PictureHead(kind="raw", format=form, width=width, height=height)


def test_packed_and_raw_colours_are_blue_green_red() -> None:
    assert np.abs(color_of(PictureHead(format="jpeg"), JPEG).astype(int) - PICTURE).mean() < 3
    pixels = bytes(range(12))
    for form, first in (("bgr8", [0, 1, 2]), ("rgb8", [2, 1, 0]), ("rgba8", [2, 1, 0]),
                        ("bgra8", [0, 1, 2]), ("mono8", [0, 0, 0])):  # fmt: skip
        wide = {"rgb8": 4, "bgr8": 4, "mono8": 12}.get(form, 3)
        assert color_of(raw(form, wide), pixels)[0, 0].tolist() == first


def test_depth_is_in_millimetres_whatever_it_came_as() -> None:
    assert depth_of(raw("16UC1"), DEPTH.tobytes()).tolist() == DEPTH.tolist()
    metres = np.array([[np.nan, 0.5, np.inf]], np.float32)
    assert depth_of(raw("32FC1"), metres.tobytes()).tolist() == [[0, 500, 0]]
    png = packed(".png", DEPTH)
    assert depth_of(PictureHead(format="16UC1; compressedDepth"), png).tolist() == DEPTH.tolist()


@pytest.mark.parametrize(
    ("head", "data"),
    [
        (raw("rgb8"), b"short"),
        (raw("bayer"), bytes(9)),
        (raw("mono8", 8192, 8192), b""),
        (raw("mono8", 0, 0), b""),
        (PictureHead(format="jpeg"), b"none"),
    ],
)
def test_what_is_no_picture_is_refused(head: PictureHead, data: bytes) -> None:
    with pytest.raises(CameraTrouble):
        color_of(head, data)


@pytest.mark.parametrize(
    ("head", "data"),
    [(raw("rgb8"), bytes(9)), (raw("16UC1"), b"x"), (PictureHead(), PNG), (PictureHead(), b"x")],
)
def test_what_is_no_depth_is_refused(head: PictureHead, data: bytes) -> None:
    with pytest.raises(CameraTrouble):
        depth_of(head, data)
