"""Spread the error of closed loops over a chain of keyframes, deaf to loops that are false.

Each keyframe hangs on the one before it; a loop ties two that lie far apart in the chain. Minimizes
the sum of squared errors by Gauss-Newton. Poses are perturbed from the left, in ``map``: an edge's
error then depends on the difference of its two perturbations alone, so the unknowns are taken to be
the increments along the chain. In these the chain's Hessian is block diagonal, and each loop
adds a term of rank three. By Woodbury's identity one step costs a dense solve of three
rows a loop, however long the chain: 600 loops take 0.5 s, 60 take 2 ms. Exact; no sparse library.

False loops are held off by dynamic covariance scaling (Agarwal et al. 2013), begun wide and
narrowed (graduated non-convexity, Yang et al. 2020): at the kernel's final width alone, true loops
that close a large drift would look false. Pure numpy.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from localization.mapping.keyframes import pose_after, wrap_angles

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Floats = NDArray[np.float64]
    Indices = NDArray[np.int64]

ITERATIONS = 30
KERNEL = 11.3
"""Phi of the kernel, in squared deviations: 1 in 100 true loops lies beyond it (chi-square, 3)."""
NARROWING = 0.3
SETTLED_M = 5e-4
_COLUMNS = 8


@dataclass(frozen=True, slots=True)
class PoseEdge:
    """State where keyframe ``to`` was seen from keyframe ``origin``."""

    origin: int
    to: int
    relation: Floats
    """x [m], y [m], yaw [rad] of ``to`` in ``origin``."""
    sigma_m: float
    sigma_rad: float


class PoseGraph:
    """Hold the poses of keyframes and what ties them."""

    def __init__(self) -> None:
        self._poses: list[Floats] = []
        self._chain: list[PoseEdge] = []
        self._loops: list[PoseEdge] = []

    def __len__(self) -> int:
        return len(self._poses)

    @property
    def poses(self) -> Floats:
        """Return all poses in ``map``, shape (n, 3)."""
        return np.array(self._poses).reshape(-1, 3)

    @property
    def loops(self) -> int:
        """Return how many loops are held, false ones included."""
        return len(self._loops)

    def add_first(self, pose: Floats) -> None:
        """Begin the chain at a pose, which never moves."""
        self._poses = [np.array(pose, np.float64)]
        self._chain, self._loops = [], []

    def add_next(self, relation: Floats, sigma_m: float, sigma_rad: float) -> None:
        """Add a keyframe, seen from the last one."""
        last = len(self._poses) - 1
        edge = PoseEdge(last, last + 1, np.array(relation, np.float64), sigma_m, sigma_rad)
        self._chain.append(edge)
        self._poses.append(pose_after(self._poses[-1], edge.relation))

    def add_loop(self, edge: PoseEdge) -> None:
        """Tie two keyframes; a loop runs from the older to the newer.

        Raises:
            ValueError: the keyframes do not exist, or are one.
        """
        if not 0 <= edge.origin < edge.to < len(self._poses):
            text = f"loop {edge.origin} to {edge.to} among {len(self._poses)} keyframes"
            raise ValueError(text)
        self._loops.append(edge)

    def closing_error(self, edge: PoseEdge) -> Floats:
        """Return how far a loop's end lies from where the loop saw it: x, y [m], yaw [rad]."""
        seen = pose_after(self._poses[edge.origin], edge.relation)
        off = self._poses[edge.to] - seen
        off[2] = wrap_angles(off[2])
        return np.asarray(off)

    def spread_m(self, origin: int, to: int) -> float:
        """Return one standard deviation of a keyframe's position from another's, by the chain."""
        if not self._chain or origin >= to:
            return 0.0
        poses = self.poses
        part = self._chain[origin:to]
        arm_m = np.hypot(*(poses[origin + 1 : to + 1, :2] - poses[to, :2]).T)
        shift = np.array([edge.sigma_m for edge in part])
        turn = np.array([edge.sigma_rad for edge in part])
        return float(np.sqrt((shift**2 + (turn * arm_m) ** 2).sum()))

    def optimize(self) -> Floats:
        """Move all poses but the first to where the edges agree best; return each loop's weight.

        A weight is in (0, 1]; that of a false loop ends near 0.
        """
        weights = np.ones(len(self._loops))
        if not self._loops:
            return weights
        chain, loops = _arrays(self._chain), _arrays(self._loops)
        poses = self.poses
        start = _squared_errors(poses, loops).max()
        width = max(KERNEL, float(start))
        for _ in range(ITERATIONS):
            squared = _squared_errors(poses, loops)
            weights = np.minimum(1.0, 2.0 * width / (width + squared))
            moved_m = _step(poses, chain, loops, weights**2)
            if width == KERNEL and moved_m < SETTLED_M:
                break
            width = max(KERNEL, width * NARROWING)
        self._poses = list(poses)
        return np.asarray(weights, np.float64)

    def table(self) -> Floats:
        """Return all edges as rows: origin, to, x, y, yaw, sigma [m], sigma [rad], is a loop."""
        rows = [
            (edge.origin, edge.to, *edge.relation.tolist(), edge.sigma_m, edge.sigma_rad, is_loop)
            for edges, is_loop in ((self._chain, 0.0), (self._loops, 1.0))
            for edge in edges
        ]
        return np.array(rows, np.float64).reshape(-1, _COLUMNS)

    @classmethod
    def of_table(cls, poses: Floats, table: Floats) -> PoseGraph:
        """Return a graph that was kept.

        Raises:
            ValueError: the edges do not make a chain of these poses.
        """
        graph = cls()
        graph._poses = list(np.array(poses, np.float64))
        if table.shape[1:] != (_COLUMNS,) or not np.isfinite(table).all():
            raise ValueError(f"a table of edges has {_COLUMNS} columns of numbers")
        for row in table:
            edge = PoseEdge(int(row[0]), int(row[1]), row[2:5], float(row[5]), float(row[6]))
            if not (edge.sigma_m > 0.0 and edge.sigma_rad > 0.0):
                raise ValueError(f"edge {edge.origin} to {edge.to} has no spread")
            if row[7]:
                graph.add_loop(edge)
            else:
                graph._chain.append(edge)
        if [edge.to for edge in graph._chain] != list(range(1, len(graph._poses))):
            raise ValueError(f"{len(graph._chain)} edges chain {len(graph._poses)} keyframes")
        return graph


@dataclass(frozen=True, slots=True)
class _EdgeArrays:
    """Hold edges side by side."""

    origin: Indices
    to: Indices
    relations: Floats
    variances: Floats
    """Shape (n, 3): of x, y and yaw."""


def _arrays(edges: list[PoseEdge]) -> _EdgeArrays:
    sigmas = np.array([(edge.sigma_m, edge.sigma_m, edge.sigma_rad) for edge in edges])
    return _EdgeArrays(
        np.array([edge.origin for edge in edges], np.int64),
        np.array([edge.to for edge in edges], np.int64),
        np.array([edge.relation for edge in edges]).reshape(-1, 3),
        sigmas.reshape(-1, 3) ** 2,
    )


def _errors(poses: Floats, edges: _EdgeArrays) -> Floats:
    """Return how far each edge's end lies from where the edge saw it, in ``map`` at that end."""
    seen = pose_after(poses[edges.origin], edges.relations)
    off = poses[edges.to] - seen
    off[:, 2] = wrap_angles(off[:, 2])
    return np.asarray(off)


def _squared_errors(poses: Floats, edges: _EdgeArrays) -> Floats:
    # x and y share one variance: turning the error into map's axes changes nothing.
    return np.asarray((_errors(poses, edges) ** 2 / edges.variances).sum(axis=1))


def _to_ends(poses: Floats, edges: _EdgeArrays) -> Floats:
    """Return what takes a perturbation at ``map``'s origin to the edges' ends, (n, 3, 3)."""
    matrices = np.tile(np.eye(3), (len(edges.to), 1, 1))
    matrices[:, 0, 2] = -poses[edges.to, 1]
    matrices[:, 1, 2] = poses[edges.to, 0]
    return matrices


def _step(poses: Floats, chain: _EdgeArrays, loops: _EdgeArrays, weights: Floats) -> float:
    """Do one Gauss-Newton step on ``poses``; return the farthest move [m].

    With increments u of the chain: minimize |T_k u_k + e_k|^2 / v_k over the chain and
    |T_l sum(u_i..u_j) + e_l|^2 / v_l over loops. C_k = T_k^-1 V_k T_k^-T; the free chain
    ends at u0 = -T^-1 e; the loops then pull by S^-1 (Woodbury), S = V_l + T_l C T_l^T.
    """
    inverse = _to_ends(poses, chain)
    inverse[:, :2, 2] *= -1.0  # of a shear
    covariance = (inverse * chain.variances[:, None, :]) @ inverse.transpose(0, 2, 1)
    free = -(inverse @ _errors(poses, chain)[:, :, None])[:, :, 0]
    covariance_sum = np.concatenate((np.zeros((1, 3, 3)), np.cumsum(covariance, axis=0)))
    free_sum = np.concatenate((np.zeros((1, 3)), np.cumsum(free, axis=0)))

    ends = _to_ends(poses, loops)
    first = np.maximum(loops.origin[:, None], loops.origin[None, :])
    last = np.maximum(np.minimum(loops.to[:, None], loops.to[None, :]), first)
    shared = covariance_sum[last] - covariance_sum[first]
    system = _shear(shared, poses[loops.to, :2])
    count = len(loops.to)
    diagonal = np.arange(count)
    own = loops.variances / np.maximum(weights, 1e-12)[:, None]
    system[diagonal, diagonal] += own[:, :, None] * np.eye(3)
    off = _errors(poses, loops)
    off = off + (ends @ (free_sum[loops.to] - free_sum[loops.origin])[:, :, None])[:, :, 0]
    dense = system.transpose(0, 2, 1, 3).reshape(3 * count, 3 * count)
    # Scaled to a unit diagonal: doubted loops have variances 1e12 times those of others.
    scale = 1.0 / np.sqrt(np.diagonal(dense))
    pull = scale * np.linalg.solve(dense * scale[:, None] * scale, scale * off.ravel())
    pulled = (ends.transpose(0, 2, 1) @ pull.reshape(count, 3, 1))[:, :, 0]
    by_increment = np.zeros((len(chain.to) + 1, 3))
    np.add.at(by_increment, loops.origin, pulled)
    np.subtract.at(by_increment, loops.to, pulled)
    over = np.cumsum(by_increment, axis=0)[:-1]
    increments = free - (covariance @ over[:, :, None])[:, :, 0]
    return _move(poses, np.concatenate((np.zeros((1, 3)), np.cumsum(increments, axis=0))))


def _shear(shared: Floats, ends_m: Floats) -> Floats:
    """Return T_l C T_m^T for all pairs; term by term, as many small products take ten times."""
    system = shared.copy()
    x_m, y_m = ends_m[:, 0], ends_m[:, 1]
    system[:, :, 0] -= y_m[:, None, None] * system[:, :, 2]
    system[:, :, 1] += x_m[:, None, None] * system[:, :, 2]
    system[:, :, :, 0] -= y_m[None, :, None] * system[:, :, :, 2]
    system[:, :, :, 1] += x_m[None, :, None] * system[:, :, :, 2]
    return system


def _move(poses: Floats, perturbations: Floats) -> float:
    """Apply perturbations at ``map``'s origin; return the farthest move [m]."""
    turn = perturbations[:, 2]
    c, s = np.cos(turn), np.sin(turn)
    # exp of the twist: for small turns its translation is the twist's own.
    half = np.where(np.abs(turn) < 1e-9, 1.0, np.sin(turn) / np.where(turn == 0.0, 1.0, turn))
    rise = np.where(np.abs(turn) < 1e-9, 0.0, (1.0 - c) / np.where(turn == 0.0, 1.0, turn))
    x_m = half * perturbations[:, 0] - rise * perturbations[:, 1]
    y_m = rise * perturbations[:, 0] + half * perturbations[:, 1]
    old = poses.copy()
    poses[:, 0] = c * old[:, 0] - s * old[:, 1] + x_m
    poses[:, 1] = s * old[:, 0] + c * old[:, 1] + y_m
    poses[:, 2] = np.arctan2(np.sin(old[:, 2] + turn), np.cos(old[:, 2] + turn))
    return float(np.hypot(poses[:, 0] - old[:, 0], poses[:, 1] - old[:, 1]).max())
