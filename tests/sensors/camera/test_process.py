"""The camera's process says pictures of a film and of a network camera that comes and goes."""

from __future__ import annotations

import signal
import subprocess
import time
from collections.abc import Callable, Iterator
from contextlib import ExitStack
from pathlib import Path

import cv2
import numpy as np
import pytest

from sensors.camera.__main__ import main
from tests.sensors.camera.films import HEIGHT, TOP, WIDTH, film, network_camera
from tests.sensors.camera.test_packed_picture import PICTURE
from tests.sensors.camera.test_ros2_source import RosCamera
from wire import CameraStatus, Image, keys
from wire.keys import Party
from wire.session import open_session

LIMIT_S = 30.0
SENSOR = "camera"


class Eyes:
    """Look at one camera as a judge does."""

    def __init__(self, home: Path) -> None:
        self.session = open_session(Party.JUDGE, "r1", home)
        self._color = self.session.image_subscriber(keys.CAMERA_COLOR)
        self._state = self.session.subscriber(keys.CAMERA_STATE)
        self.images: list[Image] = []
        self.state: CameraStatus | None = None

    def until(self, done: Callable[[], bool]) -> None:
        end_s = time.monotonic() + LIMIT_S
        while not done():
            assert time.monotonic() < end_s, f"{len(self.images)} pictures, {self.state}"
            time.sleep(0.02)
            newest = self._color.newest()
            if isinstance(newest, Image):
                self.images.append(newest)
            self.state = self._state.newest() or self.state

    def code(self) -> str | None:
        return self.state.code if self.state else "nothing"


@pytest.fixture
def eyes(tmp_path: Path) -> Iterator[Eyes]:
    found = Eyes(tmp_path)
    yield found
    found.session.close()


@pytest.mark.e2e
def test_it_shows_a_film_and_leaves_when_asked(
    tmp_path: Path, eyes: Eyes, started: Callable[[str], subprocess.Popen[str]]
) -> None:
    path = film(tmp_path / "rooms.avi")
    process = started(f'kind = "stream"\nurl = "file://{path}"\nrate_hz = 10.0\ndelay_s = 0.05')
    eyes.until(lambda: len(eyes.images) >= 10)
    eyes.until(lambda: eyes.code() is None)
    assert eyes.state is not None
    assert (eyes.state.width, eyes.state.height, eyes.state.opened) == (WIDTH, HEIGHT, 1)
    headers = [image.header for image in eyes.images]
    assert all(header.boot_id == headers[0].boot_id for header in headers)
    assert sorted({header.seq for header in headers}) == [header.seq for header in headers]
    assert 0.0 < time.monotonic() - headers[-1].stamp_s < 2.0
    color = cv2.imdecode(np.frombuffer(eyes.images[-1].data, np.uint8), cv2.IMREAD_COLOR)
    assert color is not None
    assert color.shape == (HEIGHT, WIDTH, 3)
    assert np.abs(color[5, 5].astype(int) - TOP).max() < 40
    process.send_signal(signal.SIGTERM)
    assert process.wait(LIMIT_S) == 0


@pytest.mark.nightly
@pytest.mark.e2e
def test_a_network_camera_comes_and_goes_and_its_password_stays_secret(
    eyes: Eyes, started: Callable[[str], subprocess.Popen[str]]
) -> None:
    with ExitStack() as stack:
        port = stack.enter_context(network_camera())
        url = f"http://me:secret@127.0.0.1:{port}/video.mjpg"
        process = started(f'kind = "stream"\nurl = "{url}"')
        eyes.until(lambda: len(eyes.images) >= 3 and eyes.code() is None)
    eyes.until(lambda: eyes.code() in {"camera_gone", "camera_unreachable"})
    before = len(eyes.images)
    with network_camera(port):
        eyes.until(lambda: len(eyes.images) >= before + 3 and eyes.code() is None)
    assert eyes.state is not None
    assert eyes.state.opened >= 2
    process.send_signal(signal.SIGTERM)
    _, said = process.communicate(timeout=LIMIT_S)
    assert process.returncode == 0
    assert "secret" not in said


ROS2 = """
[drive]
kind = "ros2"
[inputs]
imu = false
[ros2]
node = "{node}"
"""


@pytest.mark.nightly
@pytest.mark.e2e
def test_a_camera_of_ros_2_is_shown_comes_late_and_goes(
    eyes: Eyes, started: Callable[[str], subprocess.Popen[str]]
) -> None:
    camera = RosCamera(code="ros2_topic_missing", found="no /camera/compressed")
    process = started(f'kind = "ros2"{ROS2.format(node=camera.node)}')
    try:
        eyes.until(lambda: eyes.code() == "ros2_topic_missing")
        assert eyes.images == []
        camera.head["code"] = None
        eyes.until(lambda: len(eyes.images) >= 10 and eyes.code() is None)
        color = cv2.imdecode(np.frombuffer(eyes.images[-1].data, np.uint8), cv2.IMREAD_COLOR)
        assert np.abs(np.asarray(color, int) - PICTURE).mean() < 5
        camera.speaks = False
        eyes.until(lambda: eyes.code() == "camera_gone")
        camera.speaks = True
        before = len(eyes.images)
        eyes.until(lambda: len(eyes.images) >= before + 3 and eyes.code() is None)
        process.send_signal(signal.SIGTERM)
        assert process.wait(LIMIT_S) == 0
    finally:
        camera.close()


@pytest.mark.parametrize(
    ("text", "code"),
    [
        ('kind = "sim"', "camera_not_real"),
        ('kind = "none"', "camera_not_real"),
        ('kind = "realsense"', "camera_library_missing"),
        ('kind = "uvc"', "camera.device is missing"),
        ('kind = "ros2"', "ros2.node is missing: camera.kind 'ros2'"),
        ('kind = "ros2"\ntopic = "/c"', "ros2_former_keys"),
        ('kind = "stream"\nurl = "ftp://x"', "robot_toml_invalid"),
        ('kind = "uvc"\ndevice = "/dev/video0"\nurl = "http://x"', "camera.url is for"),
        ('kind = "uvc"\ndevice = "/dev/video0"\nfourcc = "MJ"', "robot_toml_invalid"),
    ],
)
def test_what_waiting_will_not_mend_refuses_the_start(
    tmp_path: Path,
    write_robot: Callable[[str], Path],
    text: str,
    code: str,
    capsys: pytest.CaptureFixture[str],
) -> None:
    words = ["--robot", str(write_robot(text)), "--home", str(tmp_path)]
    assert main(words) == 2
    assert code in capsys.readouterr().err
