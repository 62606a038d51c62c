"""Hold every drawn thing as a small MuJoCo model in its own frame, and cast rays at one of them.

The only file of the camera that calls MuJoCo. A thing stands still here; rays are turned into its
frame instead, so that moving it costs nothing. One model of a whole home took 70 ms a picture:
each body costs every ray 10 ns, and a tree of 200 boxes little less. A thing alone is asked only
by the rays of the part of the picture where it can be.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import mujoco
import numpy as np
from numpy.typing import NDArray

if TYPE_CHECKING:
    from collections.abc import Sequence

    from sim.camera.primitives import GeomPart

FAR_M = 60.0
"""Beyond this nothing is drawn."""
Floats = NDArray[np.float64]


class MeshBody:
    """Stand for one thing: its parts, and the box that holds them."""

    def __init__(self, parts: Sequence[GeomPart]) -> None:
        geoms = "".join(f"<geom {part.form}/>" for part in parts)
        xml = f'<mujoco><compiler angle="radian"/><worldbody>{geoms}</worldbody></mujoco>'
        # mujoco-core carries no type information: Any ends at this class.
        self._model: Any = mujoco.MjModel.from_xml_string(xml)
        self._data: Any = mujoco.MjData(self._model)
        mujoco.mj_kinematics(self._model, self._data)
        self.corners = self._bounds()

    def _bounds(self) -> Floats:
        """Return the eight corners of the box around all parts, shape (8, 3)."""
        turn = np.abs(self._data.geom_xmat.reshape(-1, 3, 3))
        middle = self._data.geom_xpos  # a primitive's own box is centred on it
        half = np.einsum("nij,nj->ni", turn, self._model.geom_aabb[:, 3:])
        return corners((middle - half).min(axis=0), (middle + half).max(axis=0))

    def cast(self, eye: Floats, rays: Floats) -> tuple[NDArray[np.int32], Floats, Floats]:
        """Cast unit rays, shape (n, 3), from a point, both in the thing's frame.

        Returns:
            The part that was hit or -1, its distance [m], and its normal (n, 3).
        """
        count = len(rays)
        hit, range_m = np.empty(count, dtype=np.int32), np.empty(count)
        normal = np.empty(3 * count)
        mujoco.mj_multiRay(
            self._model, self._data, eye, np.ascontiguousarray(rays).reshape(-1), None, True, -1,
            hit, range_m, normal, count, FAR_M,
        )  # fmt: skip
        return hit, range_m, normal.reshape(-1, 3)


def corners(low: Floats, high: Floats) -> Floats:
    """Return the corners of a box, shape (8, 3)."""
    picks = np.array([[(i >> axis) & 1 for axis in range(3)] for i in range(8)], dtype=np.bool_)
    found: Floats = np.where(picks, high, low)
    return found
