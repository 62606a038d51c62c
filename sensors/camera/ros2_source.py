"""Read the pictures that the node on a robot of ROS 2 passes on, packed or raw, with depth.

Knows no ROS: ``ros2.pictures`` is the one door to it (.importlinter).
"""

from __future__ import annotations

import time
from dataclasses import replace
from typing import TYPE_CHECKING, Any, cast

import cv2
import numpy as np

from ros2.pictures import RosPictureStream, TopicFailure
from sensors.camera.packed_picture import MAX_PIXELS, TOO_LARGE, UNREADABLE, unpack
from sensors.camera.shot import CameraTrouble, shot_of
from wire.image_header import read_header

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from ros2.pictures import PictureHead, RosPicture
    from sensors.camera.shot import CameraShot
    from wire import CameraConfig

OPEN_S, READ_S = 5.0, 3.0
"""As a camera on the network: until its first picture, and until its next."""
TO_BGR = {
    "rgb8": cv2.COLOR_RGB2BGR, "rgba8": cv2.COLOR_RGBA2BGR, "bgra8": cv2.COLOR_BGRA2BGR,
    "mono8": cv2.COLOR_GRAY2BGR,
}  # fmt: skip
CHANNELS = {"rgb8": 3, "bgr8": 3, "rgba8": 4, "bgra8": 4, "mono8": 1}
DEPTHS = {"16UC1": np.uint16, "mono16": np.uint16, "32FC1": np.float32}
NAME, DEPTH_NAME = "picture", "depth"


class Ros2Source:
    """Take the newest picture of a robot, again and again."""

    def __init__(self, config: CameraConfig, locator: str) -> None:
        """Begin to dial the node."""
        self._config, self._stream = config, RosPictureStream(locator)
        self._has_given = False

    def read(self) -> CameraShot:
        """Wait for the next picture and return it; a spoilt one is passed over.

        Raises:
            CameraTrouble: ``camera_gone``, where pictures came before; else why none comes: a code
                of ``ros2.trouble``, ``camera_picture_unreadable`` or ``camera_too_large``.
        """
        end_s = time.monotonic() + (READ_S if self._has_given else OPEN_S)
        spoilt: CameraTrouble | None = None
        while True:
            try:
                picture = self._stream.take(end_s - time.monotonic())
            except TopicFailure as why:
                raise spoilt or self._trouble_of(why) from None
            try:
                shot = self._shot_of(picture)
            except CameraTrouble as why:
                spoilt = why
                if time.monotonic() >= end_s:
                    raise
                continue
            self._has_given = True
            return shot

    def close(self) -> None:
        """Leave."""
        self._stream.close()

    def _shot_of(self, picture: RosPicture) -> CameraShot:
        shot = shot_of(color_of(picture.head, picture.data), self._config, picture.at_s)
        if picture.depth is None:
            return shot
        depth = depth_of(*picture.depth)
        if self._config.upside_down:
            depth = cast("NDArray[np.uint16]", cv2.rotate(depth, cv2.ROTATE_180))
        if depth.shape != shot.color.shape[:2]:
            found = f"depth is {depth.shape[1]} x {depth.shape[0]}, expected the picture's size"
            raise CameraTrouble(UNREADABLE, f"{found}: name the depth that is aligned to it")
        return replace(shot, depth_mm=depth)

    def _trouble_of(self, why: TopicFailure) -> CameraTrouble:
        trouble = why.trouble
        if self._has_given:
            return CameraTrouble("camera_gone", f"no picture in {READ_S:g} s: {trouble.found}")
        return CameraTrouble(trouble.code, trouble.found)


def color_of(head: PictureHead, data: bytes) -> NDArray[np.uint8]:
    """Return a picture, blue green red.

    Raises:
        CameraTrouble: it is none.
    """
    if head.kind == "packed":
        return unpack(data, head.format, NAME)
    if head.format not in CHANNELS:
        raise CameraTrouble(UNREADABLE, f"{NAME}: raw, of encoding {head.format!r}")
    rows = _rows(head, data, np.uint8, CHANNELS[head.format], NAME)
    how = TO_BGR.get(head.format)
    return cast("NDArray[np.uint8]", rows if how is None else cv2.cvtColor(rows, how))


def depth_of(head: PictureHead, data: bytes) -> NDArray[np.uint16]:
    """Return depth in millimetres; 0 where none was measured.

    Raises:
        CameraTrouble: it is none.
    """
    if head.kind == "packed":
        return _unpack_depth(data)
    if head.format not in DEPTHS:
        raise CameraTrouble(UNREADABLE, f"{DEPTH_NAME}: raw, of encoding {head.format!r}")
    rows = _rows(head, data, DEPTHS[head.format], 1, DEPTH_NAME)
    if head.format != "32FC1":
        return cast("NDArray[np.uint16]", rows)
    millimetres = np.nan_to_num(rows * 1000.0, nan=0.0, posinf=0.0, neginf=0.0)
    return cast("NDArray[np.uint16]", np.clip(millimetres, 0.0, 65535.0).astype(np.uint16))


def _unpack_depth(data: bytes) -> NDArray[np.uint16]:
    header = read_header(data)
    if header is None or header.bits != 16 or not header.whole:
        raise CameraTrouble(UNREADABLE, f"{DEPTH_NAME}: no whole PNG of 16 bits")
    if not header.width * header.height <= MAX_PIXELS:
        raise CameraTrouble(TOO_LARGE, f"{DEPTH_NAME}: {header.width} x {header.height}")
    try:
        depth: Any = cv2.imdecode(np.frombuffer(data, np.uint8), cv2.IMREAD_UNCHANGED)
    except cv2.error:
        depth = None
    if depth is None or depth.dtype != np.uint16 or depth.ndim != 2:
        raise CameraTrouble(UNREADABLE, f"{DEPTH_NAME}: a PNG that can't be unpacked")
    return cast("NDArray[np.uint16]", depth)


def _rows(head: PictureHead, data: bytes, kind: Any, channels: int, name: str) -> Any:
    wide, high = head.width, head.height
    if not 0 < wide * high <= MAX_PIXELS:
        raise CameraTrouble(TOO_LARGE, f"{name}: {wide} x {high}")
    if len(data) != wide * high * channels * np.dtype(kind).itemsize:
        raise CameraTrouble(UNREADABLE, f"{name}: {wide} x {high}, and {len(data)} bytes")
    shape = (high, wide) if channels == 1 else (high, wide, channels)
    return np.frombuffer(data, kind).reshape(shape)
