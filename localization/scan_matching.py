"""Align scans with a map by Gauss-Newton on its distance field.

Minimizes the sum of rho(d(T p)) over a scan's points p and poses T, where d is the distance to the
nearest obstacle and rho Cauchy's loss c^2/2 log(1 + (d/c)^2): people and cartons that the map does
not know lie far from its walls and weigh little. Works on many start poses at once, so
that the tracker (one) and the searches (dozens) share one implementation. Pure numpy.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from localization.distance_field import DistanceField

    Floats = NDArray[np.float64]

LOSS_M = 0.1
"""c of Cauchy's loss: two cells, ten times the noise of a good lidar."""
ITERATIONS = 20
SETTLED_M, SETTLED_RAD = 2e-4, 2e-4
"""A step below these changes nothing that a robot could notice."""
LARGEST_STEP_M, LARGEST_STEP_RAD = 0.2, 0.2
"""Of one iteration: beyond it the linearization of the field says nothing."""
LEAST_VARIANCE_M2 = 0.01**2
"""Of a residual: a map of cells is no better, however well a scan fits it."""
FLAT_SHARE = 0.02
"""A direction in which the weighted normals hold less than this share of a point each is free: the
axis of a corridor. There the scan says nothing, and the predicted pose is kept."""


def thin(points_m: Floats, count: int) -> Floats:
    """Return at most so many points, evenly taken from all directions."""
    if len(points_m) <= count:
        return points_m
    return points_m[np.linspace(0, len(points_m) - 1, count).round().astype(np.int64)]


@dataclass(frozen=True, slots=True)
class Alignment:
    """Hold where Gauss-Newton ended, for each start."""

    poses: Floats
    """Shape (starts, 3): x [m], y [m], yaw [rad] in ``map``."""
    free_axis: Floats
    """Shape (starts, 2): unit vector in ``map`` along which the scan holds nothing; else zeros."""
    information: Floats
    """Shape (starts, 3, 3): J^T W J over the residuals' weighted variance, in x, y [1/m2] and yaw.
    What one scan would tell if its beams erred independently, which they do not."""


def to_map(poses: Floats, points_m: Floats) -> tuple[Floats, Floats]:
    """Return points (n, 2) of ``base`` in ``map``, by each pose: x and y, each (poses, n)."""
    cosine, sine = np.cos(poses[:, 2:3]), np.sin(poses[:, 2:3])
    x_m, y_m = points_m[:, 0], points_m[:, 1]
    return (
        poses[:, 0:1] + cosine * x_m - sine * y_m,
        poses[:, 1:2] + sine * x_m + cosine * y_m,
    )


def align(
    field: DistanceField,
    points_m: Floats,
    starts: Floats,
    *,
    loss_m: float = LOSS_M,
    iterations: int = ITERATIONS,
    redescending: bool = False,
) -> Alignment:
    """Return the poses in ``map`` that fit a scan's points best, each near its start.

    Args:
        field: of the map.
        points_m: returns in ``base``, shape (n, 2).
        starts: shape (starts, 3).
        loss_m: c of Cauchy's loss; wide for starts that are far off.
        iterations: at most so many; all starts end together, once none moves any more.
        redescending: for a start that is known to a few centimetres, Welsch's loss in place of
            Cauchy's: what lies 0.3 m from all walls then weighs nothing, not a tenth.
    """
    poses = np.array(starts, np.float64).reshape(-1, 3)
    free_axis = np.zeros((len(poses), 2))
    information = np.zeros((len(poses), 3, 3))
    if not len(points_m):
        return Alignment(poses, free_axis, information)
    for _ in range(iterations):
        hessian, gradient, variance_m2 = _normal_equations(
            field, points_m, poses, loss_m, redescending
        )
        information = hessian / np.maximum(variance_m2, LEAST_VARIANCE_M2)[:, None, None]
        step, free_axis = _solve(hessian, gradient, len(points_m))
        poses += step
        if np.all(np.abs(step[:, :2]) < SETTLED_M) and np.all(np.abs(step[:, 2]) < SETTLED_RAD):
            break
    poses[:, 2] = np.arctan2(np.sin(poses[:, 2]), np.cos(poses[:, 2]))
    return Alignment(poses, free_axis, information)


def _normal_equations(
    field: DistanceField, points_m: Floats, poses: Floats, loss_m: float, redescending: bool
) -> tuple[Floats, Floats, Floats]:
    """Return J^T W J (starts, 3, 3), J^T W d (starts, 3) and the weighted mean of d^2 (starts).

    Of the iteratively reweighted sum.
    """
    x_m, y_m = to_map(poses, points_m)
    distance, by_x, by_y = field.distance_and_gradient(x_m, y_m)
    by_yaw = by_y * (x_m - poses[:, 0:1]) - by_x * (y_m - poses[:, 1:2])
    scaled = (distance / loss_m) ** 2
    weight = np.exp(-0.5 * scaled) if redescending else 1.0 / (1.0 + scaled)
    jacobian = np.stack((by_x, by_y, by_yaw), axis=1)
    weighted = jacobian * weight[:, None, :]
    total = np.maximum(weight.sum(axis=1), 1e-9)
    return (
        weighted @ jacobian.transpose(0, 2, 1),
        (weighted @ distance[:, :, None])[:, :, 0],
        (weight * distance * distance).sum(axis=1) / total,
    )


def _solve(hessian: Floats, gradient: Floats, count: int) -> tuple[Floats, Floats]:
    """Return each start's step and free axis; nothing moves along the free axis.

    The free direction of translation is found with yaw eliminated (Schur complement), and the
    step's part along it is left out, as in degeneracy-aware state estimation (Zhang et al. 2016).
    """
    # Yaw is always held where any two points are; the damping keeps an empty view solvable.
    yaw = hessian[:, 2, 2] + 1e-6 * count
    cross = hessian[:, :2, 2]
    held = hessian[:, :2, :2] - cross[:, :, None] * cross[:, None, :] / yaw[:, None, None]
    right = gradient[:, :2] - cross * (gradient[:, 2] / yaw)[:, None]
    values, vectors = np.linalg.eigh(held)
    # Along eigenvectors: those that too little holds stay where they are.
    inward = (vectors.transpose(0, 2, 1) @ right[:, :, None])[:, :, 0]
    holds = values > FLAT_SHARE * count
    move = np.where(holds, -inward / np.where(holds, values, 1.0), 0.0)
    shift = (vectors @ move[:, :, None])[:, :, 0]
    turn = -(gradient[:, 2] + (cross * shift).sum(axis=1)) / yaw
    length = np.maximum(np.hypot(shift[:, 0], shift[:, 1]), 1e-12)
    shift *= np.minimum(1.0, LARGEST_STEP_M / length)[:, None]
    step = np.column_stack((shift, np.clip(turn, -LARGEST_STEP_RAD, LARGEST_STEP_RAD)))
    free = np.where(holds[:, 0:1], 0.0, vectors[:, :, 0])
    return step, free
