"""Hold each ray's nearest hit so far: part, distance and normal.

Arrays keep one plane for each of x, y, z: sums along a last axis of three cost ten times as much.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

if TYPE_CHECKING:
    from sim.camera.view import CameraView

Floats = NDArray[np.float32]


@dataclass(frozen=True, slots=True, eq=False)
class Canvas:
    """Give arrays of (rows, columns), or of (3, rows, columns) for directions."""

    aimed: Floats
    """Where each ray goes in ``map``, a unit vector."""
    over: Floats
    """One over each of its parts."""
    hit: NDArray[np.int32]
    """Number of the part that was met."""
    range_m: Floats
    normal: Floats


def blank(rays: Floats, view: CameraView) -> Canvas:
    """Return a canvas for the rays of a camera, shape (3, rows, columns), turned as it looks."""
    shape = rays.shape[1:]
    aimed = (view.turn.astype(np.float32) @ rays.reshape(3, -1)).reshape(3, *shape)
    # A ray along an axis would divide zero by zero on a wall's own face.
    aimed[np.abs(aimed) < 1e-9] = 1e-9
    return Canvas(
        aimed=aimed,
        over=np.float32(1.0) / aimed,
        hit=np.empty(shape, dtype=np.int32),
        range_m=np.empty(shape, dtype=np.float32),
        normal=np.empty((3, *shape), dtype=np.float32),
    )
