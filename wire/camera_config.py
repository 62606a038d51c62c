"""Describe a robot's camera: which it is, where it sits, what its pictures are like."""

from __future__ import annotations

from math import pi
from typing import TYPE_CHECKING, Annotated, Literal

from pydantic import Field, model_validator

from wire.base import Record
from wire.bounded_types import DevicePath

if TYPE_CHECKING:
    from collections.abc import Iterator

REAL_CAMERAS = ("uvc", "stream", "realsense", "ros2")
"""Kinds that a process of ours reads; the simulator stands in for them where it plays the robot."""


class CameraConfig(Record):
    """Place the camera on the robot and state its picture.

    REP-103: x forward, y left, z up from the floor under ``base``; a positive pitch looks down.
    """

    kind: Literal["sim", "uvc", "stream", "realsense", "ros2", "node", "none"] = "sim"
    """``sim``: the simulator draws; ``uvc``: one that Video4Linux knows, at ``device``; ``stream``:
    one on the network, at ``url``; ``realsense``: Intel's, with depth; ``ros2``: what the node of a
    ROS 2 robot passes on; ``node``: a process that is none of ours speaks for it; ``none``:
    there is none, and what needs one is refused."""
    device: DevicePath | None = None
    """Of a ``uvc`` camera; one below /dev/v4l/by-id keeps its name."""
    url: (
        Annotated[str, Field(pattern=r"^(rtsp|rtsps|http|https|file)://.+$", max_length=248)] | None
    ) = None
    """Of a ``stream``; ``file://`` is a film, played over and over, for trials."""
    serial: Annotated[str, Field(pattern=r"^[0-9]{6,20}$")] | None = None
    """Of a ``realsense``, where there are several."""
    fourcc: Annotated[str, Field(pattern=r"^[A-Z0-9 ]{4}$")] = "MJPG"
    """How a ``uvc`` camera is asked to pack its pictures; YUYV fills USB 2 beyond 640x480."""
    upside_down: bool = False
    """It hangs with its head down: its pictures are turned by half a turn."""
    delay_s: float = Field(default=0.0, ge=0.0, le=1.0)
    """A picture was taken so long before it was handed over; UVC cameras need 0.03 to 0.1 s."""
    x_m: float = Field(default=0.15, ge=-2.0, le=2.0)
    y_m: float = Field(default=0.0, ge=-2.0, le=2.0)
    z_m: float = Field(default=1.0, ge=0.02, le=3.0)
    yaw_rad: float = Field(default=0.0, ge=-pi, le=pi)
    pitch_rad: float = Field(default=0.2, ge=-1.4, le=1.4)
    width_px: int = Field(default=320, ge=32, le=4096)
    height_px: int = Field(default=240, ge=32, le=4096)
    fov_rad: float = Field(default=1.2, ge=0.2, le=2.6)
    """Horizontally, of the whole picture; a realsense tells its own."""
    rate_hz: float = Field(default=10.0, ge=0.5, le=60.0)
    depth_min_m: float = Field(default=0.2, ge=0.0, le=2.0)
    """Depth outside these is no measurement."""
    depth_max_m: float = Field(default=8.0, ge=0.5, le=100.0)

    @model_validator(mode="after")
    def _has_the_keys_of_its_kind(self) -> CameraConfig:
        wrong = "; ".join(_wrong_camera_keys(self))
        if wrong:
            raise ValueError(wrong)
        return self

    @property
    def is_real(self) -> bool:
        """Return whether a process of ours reads it."""
        return self.kind in REAL_CAMERAS

    @model_validator(mode="after")
    def _depth_has_a_range(self) -> CameraConfig:
        if not self.depth_min_m < self.depth_max_m:
            raise ValueError(
                f"camera.depth_min_m {self.depth_min_m} must be less than depth_max_m "
                f"{self.depth_max_m}"
            )
        return self


def _wrong_camera_keys(camera: CameraConfig) -> Iterator[str]:
    """Yield what a kind of camera lacks, and what it was given though it can't use it."""
    for key, kind, needed in (
        ("device", "uvc", True),
        ("url", "stream", True),
        ("serial", "realsense", False),
    ):
        given = getattr(camera, key) is not None
        if needed and camera.kind == kind and not given:
            yield f"camera.{key} is missing: kind {kind!r} needs it (docs/sensors.md)"
        if given and camera.kind != kind:
            yield f"camera.{key} is for kind {kind!r}, not for kind {camera.kind!r}"
