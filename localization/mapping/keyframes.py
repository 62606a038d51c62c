"""Keep what a robot saw at chosen poses: the only memory that a map is made from.

A keyframe's points stay as they were seen, in ``base``; only its pose in ``map`` is ever changed,
so that a loop that closes late moves everything seen from there along with it.
"""

from __future__ import annotations

import io
import zipfile
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np

from localization.scan_matching import thin, to_map

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.typing import NDArray

    Floats = NDArray[np.float64]

POINTS = 360
"""Kept of a scan: a point each degree shows every wall of a home."""
FORMAT = 1
KEYFRAMES_FILE = "keyframes.npz"
_MOST_KEYFRAMES, _MOST_POINTS = 20_000, 4_000
"""Of a file: beyond them it is not one of ours."""
_HEADER_BYTES, _MOST_EDGES_BYTES = 1024, 64 << 20
"""Room for what numpy writes before an array; edges have no count of their own."""


@dataclass(frozen=True, slots=True)
class Keyframe:
    """Hold one scan with its pose."""

    pose: Floats
    """x [m], y [m], yaw [rad] of ``base`` in ``map``."""
    points_m: Floats
    """Returns in ``base``, shape (n, 2)."""
    stamp_s: float

    def move_to(self, pose: Floats) -> Keyframe:
        """Return the same returns seen from another pose."""
        return replace(self, pose=np.array(pose, np.float64))

    def points_in_map(self) -> Floats:
        """Return the returns in ``map``, shape (n, 2)."""
        x_m, y_m = to_map(self.pose[None], self.points_m)
        return np.column_stack((x_m[0], y_m[0]))


def keyframe_of(pose: Floats, points_m: Floats, stamp_s: float) -> Keyframe:
    """Return a keyframe of a whole scan, thinned."""
    return Keyframe(np.array(pose, np.float64), thin(points_m, POINTS), stamp_s)


def pose_between(a_in_map: Floats, b_in_map: Floats) -> Floats:
    """Return b in a; poses of shape (..., 3)."""
    c, s = np.cos(a_in_map[..., 2]), np.sin(a_in_map[..., 2])
    x_m, y_m = b_in_map[..., 0] - a_in_map[..., 0], b_in_map[..., 1] - a_in_map[..., 1]
    yaw = wrap_angles(b_in_map[..., 2] - a_in_map[..., 2])
    return np.stack((c * x_m + s * y_m, c * y_m - s * x_m, yaw), axis=-1)


def pose_after(a_in_map: Floats, b_in_a: Floats) -> Floats:
    """Return b in ``map``; poses of shape (..., 3)."""
    c, s = np.cos(a_in_map[..., 2]), np.sin(a_in_map[..., 2])
    x_m = a_in_map[..., 0] + c * b_in_a[..., 0] - s * b_in_a[..., 1]
    y_m = a_in_map[..., 1] + s * b_in_a[..., 0] + c * b_in_a[..., 1]
    return np.stack((x_m, y_m, wrap_angles(a_in_map[..., 2] + b_in_a[..., 2])), axis=-1)


def wrap_angles(angles_rad: Floats) -> Floats:
    """Return angles in [-pi, pi]."""
    return np.asarray(np.arctan2(np.sin(angles_rad), np.cos(angles_rad)))


class KeyframeFileError(ValueError):
    """Report bytes that are no keyframes of ours."""


def write_keyframes(keyframes: Sequence[Keyframe], edges: Floats) -> bytes:
    """Return a file (npz) of keyframes with the edges of their graph.

    Args:
        keyframes: in the order of their making.
        edges: as :meth:`localization.mapping.pose_graph.PoseGraph.table` gives them.
    """
    out = io.BytesIO()
    points = [keyframe.points_m for keyframe in keyframes]
    np.savez_compressed(
        out,
        format=np.int64(FORMAT),
        poses=np.array([keyframe.pose for keyframe in keyframes]).reshape(-1, 3),
        stamps_s=np.array([keyframe.stamp_s for keyframe in keyframes]),
        counts=np.array([len(one) for one in points], np.int64),
        points_mm=np.round(np.vstack([np.empty((0, 2)), *points]) * 1e3).astype(np.int32),
        edges=edges,
    )
    return out.getvalue()


def _check_sizes(archive: zipfile.ZipFile, points: int) -> None:
    """Refuse arrays that would unpack to more than they may hold, before they are read.

    Args:
        archive: of the arrays.
        points: how many all keyframes have together; 0: not known yet, so only the rest is judged.

    Raises:
        ValueError: an array is too large.
    """
    most = {"edges": _MOST_EDGES_BYTES, "points_mm": 8 * points or 8 << 40}
    for member in archive.infolist():
        name = member.filename.removesuffix(".npy")
        if not member.file_size <= most.get(name, 24 * _MOST_KEYFRAMES) + _HEADER_BYTES:
            raise ValueError(f"{name} holds {member.file_size} bytes")


def read_keyframes(data: bytes) -> tuple[tuple[Keyframe, ...], Floats]:
    """Return the keyframes and edges of a file.

    Raises:
        KeyframeFileError: the bytes are no such file, or not whole.
    """
    try:
        with np.load(io.BytesIO(data), allow_pickle=False) as held:
            _check_sizes(held.zip, 0)
            kind, poses = int(held["format"]), np.asarray(held["poses"], np.float64)
            stamps_s, counts = held["stamps_s"].astype(np.float64), held["counts"].astype(np.int64)
            _check_sizes(held.zip, int(np.clip(counts, 0, _MOST_POINTS).sum()))
            points_m, edges = held["points_mm"] / 1e3, np.asarray(held["edges"], np.float64)
    except (OSError, ValueError, KeyError, EOFError, zipfile.BadZipFile) as error:
        # Without numpy's words: for what it can't read it advises to unpickle it.
        raise KeyframeFileError("not a file of keyframes") from error
    fits = (
        kind == FORMAT
        and poses.shape == (len(counts), 3)
        and len(counts) <= _MOST_KEYFRAMES
        and stamps_s.shape == counts.shape
        and bool(((counts >= 0) & (counts <= _MOST_POINTS)).all())
        and points_m.shape == (int(counts.sum()), 2)
        and edges.ndim == 2
        and bool(np.isfinite(poses).all() and np.isfinite(stamps_s).all())
    )
    if not fits:
        text = f"format {kind}, poses {poses.shape}, points {points_m.shape}; expected {FORMAT}"
        raise KeyframeFileError(text)
    shares = np.split(points_m, np.cumsum(counts)[:-1]) if len(counts) else []
    found = zip(poses, shares, stamps_s.tolist(), strict=True)
    return tuple(Keyframe(pose, points, stamp_s) for pose, points, stamp_s in found), edges
