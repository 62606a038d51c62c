"""Hold one picture: colour, depth and instance of each pixel, with or without noise."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray


@dataclass(frozen=True, slots=True, eq=False)
class Frame:
    """Give one picture, row by row from its upper left corner; every array is (height, width)."""

    color: NDArray[np.uint8]
    """RGB in a third axis."""
    depth_m: NDArray[np.float32]
    """Along the optical axis; 0 where none was measured."""
    ids: NDArray[np.int32]
    """Keys of Renderer.labels; 0 for floor, walls, ceiling and nothing at all."""
    facing: NDArray[np.float32]
    """Cosine between the ray and the surface it met: 1 head on, 0 grazing or nothing."""
