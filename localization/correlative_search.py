"""Find where a scan fits best within a window or a whole map, by trying every pose of a lattice.

Each pose is rated by the sum over beams of a likelihood of the cell that its end falls into
(Olson 2009). For one yaw all positions are rated at once: a beam's end shifts the likelihood image,
so the sum is one addition of whole images a beam, which needs no index arithmetic. Pure numpy.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import radians
from typing import TYPE_CHECKING

import numpy as np

from localization.scan_matching import thin

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from localization.distance_field import DistanceField

    Floats = NDArray[np.float64]

LIKELIHOOD_STEPS = 255
WINDOW_STEP_M, WINDOW_STEP_RAD = 0.05, radians(2.0)
WINDOW_M, WINDOW_RAD = 0.5, radians(20.0)
"""What slipped past the tracker: Gauss-Newton alone catches 0.2 m and 10 degrees."""
WINDOW_BEAMS = 90
WINDOW_SIGMA_M = 0.1


def likelihood(field: DistanceField, sigma_m: float) -> NDArray[np.uint8]:
    """Return each cell's likelihood of a return, 255 on an obstacle's surface."""
    near = np.exp(-0.5 * (field.distance_m / sigma_m) ** 2)
    return np.asarray(np.round(LIKELIHOOD_STEPS * near), np.uint8)


@dataclass(frozen=True, slots=True)
class WindowSearch:
    """Search the poses around one that is roughly known."""

    field: DistanceField
    table: NDArray[np.uint8]

    @classmethod
    def of_field(cls, field: DistanceField) -> WindowSearch:
        """Return a search over a map."""
        return cls(field, likelihood(field, WINDOW_SIGMA_M))

    def best(
        self,
        points_m: Floats,
        around: Floats,
        window_m: float = WINDOW_M,
        window_rad: float = WINDOW_RAD,
    ) -> Floats:
        """Return the pose of the window's lattice that fits best, shape (3,).

        Args:
            points_m: returns in ``base``, shape (n, 2).
            around: x, y, yaw in ``map``.
            window_m: half the window's side.
            window_rad: half its span of yaw.
        """
        found, best_rating = np.array(around, np.float64), -1
        beams = thin(points_m, WINDOW_BEAMS)
        if not len(beams):
            return found
        res_m = self.field.resolution_m
        half = round(window_m / max(WINDOW_STEP_M, res_m))
        stride = max(1, round(WINDOW_STEP_M / res_m))
        cells = stride * half
        margin = cells + 1
        for turn in np.arange(-window_rad, window_rad + 1e-9, WINDOW_STEP_RAD):
            yaw = around[2] + turn
            ends = _rotate(beams, yaw) + around[:2]
            column = np.floor((ends[:, 0] - self.field.origin_m[0]) / res_m).astype(np.int64)
            row = np.floor((ends[:, 1] - self.field.origin_m[1]) / res_m).astype(np.int64)
            inside = (column >= margin) & (column < self.field.columns - margin)
            inside &= (row >= margin) & (row < self.field.rows - margin)
            if not inside.any():
                continue
            shifts = np.arange(-cells, cells + 1, stride)
            offset = (shifts[:, None] * self.field.columns + shifts).ravel()
            start = row[inside] * self.field.columns + column[inside]
            rating = self.table.ravel().take(start[:, None] + offset).sum(axis=0, dtype=np.int64)
            top = int(rating.argmax())
            if rating[top] > best_rating:
                best_rating = int(rating[top])
                down, across = divmod(top, len(shifts))
                found = np.array(
                    (around[0] + shifts[across] * res_m, around[1] + shifts[down] * res_m, yaw)
                )
        return found


def _rotate(points_m: Floats, yaw: float) -> Floats:
    cosine, sine = np.cos(yaw), np.sin(yaw)
    return points_m @ np.array(((cosine, sine), (-sine, cosine)))


class LatticeSearch:
    """Rate every pose of a coarse lattice over a whole map."""

    def __init__(self, field: DistanceField, *, step_m: float, sigma_m: float) -> None:
        """Split the likelihood image into one image for each place within a lattice cell.

        Args:
            field: of the map.
            step_m: between positions of the lattice; whole cells.
            sigma_m: of the likelihood; about the step, or the true pose falls between two.
        """
        self.field = field
        self.stride = max(1, round(step_m / field.resolution_m))
        self._table = likelihood(field, sigma_m)
        self._reach = -1
        self._images: list[list[NDArray[np.uint8]]] = []

    def rate(self, points_m: Floats, yaw: float) -> NDArray[np.uint32]:
        """Return each lattice position's rating at one yaw, shape (lattice rows, columns)."""
        stride, res_m = self.stride, self.field.resolution_m
        ends = np.round(_rotate(points_m, yaw) / res_m).astype(np.int64)
        self._prepare(int(np.abs(ends).max(initial=0)))
        rows, columns = self.shape
        rating = np.zeros((rows, columns), np.uint32)
        shifted = ends + self._reach
        block, phase = np.divmod(shifted, stride)
        for (across, down), (phase_x, phase_y) in zip(block.tolist(), phase.tolist(), strict=True):
            image = self._images[phase_y][phase_x]
            rating += image[down : down + rows, across : across + columns]
        return rating

    @property
    def shape(self) -> tuple[int, int]:
        """Return how many rows and columns of positions the lattice has."""
        return -(-self.field.rows // self.stride), -(-self.field.columns // self.stride)

    def positions(self) -> tuple[NDArray[np.intp], NDArray[np.intp]]:
        """Return the map cells (row, column) of the lattice's positions, each as a grid."""
        rows, columns = self.shape
        row = np.minimum(np.arange(rows) * self.stride, self.field.rows - 1)
        column = np.minimum(np.arange(columns) * self.stride, self.field.columns - 1)
        down, across = np.meshgrid(row, column, indexing="ij")
        return down, across

    def _prepare(self, reach: int) -> None:
        """Pad the image by the farthest beam, so that no addition needs a bounds check."""
        stride = self.stride
        reach = -(-reach // stride) * stride
        if reach <= self._reach:
            return
        self._reach = reach
        padded = np.pad(self._table, ((reach, reach + stride), (reach, reach + stride)))
        self._images = [
            [np.ascontiguousarray(padded[y::stride, x::stride]) for x in range(stride)]
            for y in range(stride)
        ]
