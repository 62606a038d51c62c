"""Read an Intel RealSense by its own library, an extra that is loaded when one is asked for.

Written by the library's documentation and never tried: no RealSense was there. Depth is brought
into the colours' camera, so that each pixel of both is of one ray.
"""

from __future__ import annotations

import importlib
from typing import TYPE_CHECKING, Any

import cv2
import numpy as np

from sensors.camera.shot import CameraShot, CameraTrouble

if TYPE_CHECKING:
    from wire import CameraConfig

LIBRARY = "pyrealsense2"
WAIT_MS = 2_000


class RealsenseSource:
    """Take colour and depth of one instant."""

    def __init__(self, config: CameraConfig, library: Any = None) -> None:
        """Open it.

        Args:
            config: [camera] of robot.toml.
            library: in place of the installed one.

        Raises:
            CameraTrouble: ``camera_library_missing`` or ``camera_missing``.
        """
        rs = library or load_library()
        self._config = config
        self._pipeline, wanted = rs.pipeline(), rs.config()
        if config.serial is not None:
            wanted.enable_device(config.serial)
        size, hz = (config.width_px, config.height_px), round(config.rate_hz)
        wanted.enable_stream(rs.stream.color, *size, rs.format.bgr8, hz)
        wanted.enable_stream(rs.stream.depth, *size, rs.format.z16, hz)
        try:
            profile = self._pipeline.start(wanted)
        except RuntimeError as error:
            raise CameraTrouble("camera_missing", f"realsense: {error}") from None
        lens = profile.get_stream(rs.stream.color).as_video_stream_profile().get_intrinsics()
        self._focal_px, self._center_px = float(lens.fx), (float(lens.ppx), float(lens.ppy))
        self._mm = 1000.0 * float(profile.get_device().first_depth_sensor().get_depth_scale())
        self._align = rs.align(rs.stream.color)

    def read(self) -> CameraShot:
        """Wait for the next pair and return it.

        Raises:
            CameraTrouble: ``camera_gone``.
        """
        try:
            frames = self._align.process(self._pipeline.wait_for_frames(WAIT_MS))
        except RuntimeError as error:
            raise CameraTrouble("camera_gone", f"realsense: {error}") from None
        color, depth = frames.get_color_frame(), frames.get_depth_frame()
        if not color or not depth:
            raise CameraTrouble("camera_gone", "realsense: a picture without its depth")
        picture = np.asanyarray(color.get_data()).copy()
        steps = np.asanyarray(depth.get_data())
        millimetres = np.minimum(steps * self._mm + 0.5, 65_535).astype(np.uint16)
        center = self._center_px
        if self._config.upside_down:
            picture = np.asarray(cv2.rotate(picture, cv2.ROTATE_180))
            millimetres = np.asarray(cv2.rotate(millimetres, cv2.ROTATE_180))
            height, width = picture.shape[:2]
            center = (width - center[0], height - center[1])
        return CameraShot(picture, self._focal_px, center, millimetres)

    def close(self) -> None:
        """Give the camera back."""
        self._pipeline.stop()


def load_library() -> Any:
    """Return Intel's library.

    Raises:
        CameraTrouble: ``camera_library_missing``.
    """
    try:
        return importlib.import_module(LIBRARY)
    except ImportError:
        text = f"{LIBRARY} is not installed; pip install {LIBRARY} (aarch64: build librealsense)"
        raise CameraTrouble("camera_library_missing", text) from None
