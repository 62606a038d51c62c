"""Say what a camera is asked for: one picture after the other, or why there is none."""

from __future__ import annotations

from dataclasses import dataclass
from math import tan
from typing import TYPE_CHECKING, Any, Protocol

import cv2

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    from wire import CameraConfig


class CameraTrouble(Exception):
    """A camera can't be read at present. The code is stable; ``detail`` says what came."""

    def __init__(self, code: str, detail: str) -> None:
        super().__init__(f"{code}: {detail}")
        self.code, self.detail = code, detail


@dataclass(frozen=True, slots=True, eq=False)
class CameraShot:
    """Hold one picture as a camera gave it."""

    color: NDArray[np.uint8]
    """Blue, green, red in a third axis."""
    focal_px: float
    center_px: tuple[float, float]
    depth_mm: NDArray[np.uint16] | None = None
    """Along the optical axis of the colours' camera; 0 where none was measured."""
    at_s: float | None = None
    """When it came, on our clock; None: as it was handed over."""


def shot_of(picture: Any, config: CameraConfig, at_s: float | None = None) -> CameraShot:
    """Return a picture as robot.toml's camera gave it; its own size counts, not the one asked for.

    ``fov_rad`` is the whole picture's, whatever its size: focal = width / 2 / tan(fov / 2).
    """
    if config.upside_down:
        picture = cv2.rotate(picture, cv2.ROTATE_180)
    height, width = picture.shape[:2]
    focal_px = width / 2.0 / tan(config.fov_rad / 2.0)
    return CameraShot(picture, focal_px, (width / 2.0, height / 2.0), at_s=at_s)


class PictureSource(Protocol):
    """Be an open camera."""

    def read(self) -> CameraShot:
        """Wait for the next picture and return it.

        Raises:
            CameraTrouble: none came; the source is of no more use.
        """

    def close(self) -> None:
        """Give the camera back."""
