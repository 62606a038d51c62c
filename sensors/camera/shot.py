"""Say what a camera is asked for: one picture after the other, or why there is none."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Protocol

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray


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


class PictureSource(Protocol):
    """Be an open camera."""

    def read(self) -> CameraShot:
        """Wait for the next picture and return it.

        Raises:
            CameraTrouble: none came; the source is of no more use.
        """

    def close(self) -> None:
        """Give the camera back."""
