"""Open what ``[camera]`` names, and take pictures from it one after the other.

Each source may make its user wait, so none runs where anything else is to be done: see
sensors/camera/grabber.py.
"""

from __future__ import annotations

import errno
import os
import stat
import time
from pathlib import Path
from typing import TYPE_CHECKING, Any
from urllib.parse import urlsplit, urlunsplit

import cv2

from sensors.camera.shot import CameraTrouble, shot_of

if TYPE_CHECKING:
    from sensors.camera.shot import CameraShot, PictureSource
    from wire import CameraConfig
    from wire.ros2_config import Ros2Config

OPEN_MS, READ_MS = 5_000, 3_000
"""A stream that takes longer to be opened, or to give its next picture, counts as gone."""
OVER_TCP = "rtsp_transport;tcp"
"""RTSP by UDP loses packets, which smear half a picture."""
DEFAULT_HZ = 25.0
"""Of a film that does not say how fast it is."""
V4L2_MAJOR = 81


def open_source(config: CameraConfig, ros2: Ros2Config | None = None) -> PictureSource:
    """Open the camera of robot.toml; may take seconds.

    Args:
        config: [camera].
        ros2: [ros2], whose node passes on the pictures of a camera of kind "ros2".

    Raises:
        CameraTrouble: it can't be opened now.
    """
    if config.kind == "realsense":
        from sensors.camera.realsense import RealsenseSource

        return RealsenseSource(config)
    if config.kind == "ros2" and ros2 is not None:
        from sensors.camera.ros2_source import Ros2Source

        return Ros2Source(config, ros2.node)
    if config.kind == "uvc":
        return _open_device(config)
    return _open_stream(config)


class OpenCvSource:
    """Read a device, a network stream or a film through OpenCV."""

    def __init__(
        self, capture: cv2.VideoCapture, config: CameraConfig, name: str, period_s: float = 0.0
    ) -> None:
        """Take an opened capture over.

        Args:
            capture: OpenCV's.
            config: [camera] of robot.toml.
            name: what is said of it where it fails; holds no password.
            period_s: of a film, which is played at its own pace and begins again at its end.
        """
        self._capture, self._config, self._name = capture, config, name
        self._period_s, self._next_s = period_s, time.monotonic()

    def read(self) -> CameraShot:
        """Wait for the next picture and return it.

        Raises:
            CameraTrouble: ``camera_gone``.
        """
        if self._period_s > 0.0:
            time.sleep(max(0.0, self._next_s - time.monotonic()))
            self._next_s = max(self._next_s + self._period_s, time.monotonic())
        done, picture = self._read()
        if not done or picture is None or picture.ndim != 3:
            raise CameraTrouble("camera_gone", f"{self._name} gives no picture any more")
        return shot_of(picture, self._config)

    def close(self) -> None:
        """Give the camera back."""
        self._capture.release()

    def _read(self) -> tuple[bool, Any]:
        done, picture = self._capture.read()
        if not done and self._period_s > 0.0:
            self._capture.set(cv2.CAP_PROP_POS_FRAMES, 0)
            done, picture = self._capture.read()
        return done, picture


def without_password(url: str) -> str:
    """Return a URL that may stand in a log."""
    parts = urlsplit(url)
    if "@" not in parts.netloc:
        return url
    return urlunsplit(parts._replace(netloc=f"***@{parts.netloc.rpartition('@')[2]}"))


def _open_device(config: CameraConfig) -> PictureSource:
    path = Path(config.device or "")
    _check_device(path)
    capture = cv2.VideoCapture(str(path.resolve()), cv2.CAP_V4L2)
    if not capture.isOpened():
        raise CameraTrouble("camera_busy", f"{path} opens, and gives no pictures")
    # In this order: the packing decides which sizes and rates there are. Exposure stays its own.
    capture.set(cv2.CAP_PROP_FOURCC, cv2.VideoWriter.fourcc(*config.fourcc))
    capture.set(cv2.CAP_PROP_FRAME_WIDTH, config.width_px)
    capture.set(cv2.CAP_PROP_FRAME_HEIGHT, config.height_px)
    capture.set(cv2.CAP_PROP_FPS, config.rate_hz)
    capture.set(cv2.CAP_PROP_BUFFERSIZE, 1)
    return OpenCvSource(capture, config, str(path))


def _check_device(path: Path) -> None:
    """Say why a device can't be opened; OpenCV says only that it can't."""
    try:
        found = path.stat()
    except OSError:
        raise CameraTrouble("camera_missing", f"{path} is not there") from None
    if not (stat.S_ISCHR(found.st_mode) and os.major(found.st_rdev) == V4L2_MAJOR):
        raise CameraTrouble("camera_not_video", f"{path} is no device of Video4Linux")
    try:
        os.close(os.open(path, os.O_RDWR | os.O_NONBLOCK | os.O_CLOEXEC))
    except OSError as error:
        code = "camera_forbidden" if error.errno in (errno.EACCES, errno.EPERM) else "camera_busy"
        raise CameraTrouble(code, f"{path}: {error.strerror}") from None


def _open_stream(config: CameraConfig) -> PictureSource:
    url = config.url or ""
    name, is_film = without_password(url), url.startswith("file://")
    os.environ.setdefault("OPENCV_FFMPEG_CAPTURE_OPTIONS", OVER_TCP)
    if is_film and not Path(url.removeprefix("file://")).is_file():
        raise CameraTrouble("camera_missing", f"{name} is not there")
    limits = [cv2.CAP_PROP_OPEN_TIMEOUT_MSEC, OPEN_MS, cv2.CAP_PROP_READ_TIMEOUT_MSEC, READ_MS]
    capture = cv2.VideoCapture(url.removeprefix("file://"), cv2.CAP_FFMPEG, limits)
    if not capture.isOpened():
        code = "camera_not_video" if is_film else "camera_unreachable"
        raise CameraTrouble(code, f"{name} can't be opened as a video")
    told_hz = capture.get(cv2.CAP_PROP_FPS)
    hz = told_hz if 0.1 <= told_hz <= 240.0 else DEFAULT_HZ
    return OpenCvSource(capture, config, name, 1.0 / hz if is_film else 0.0)
