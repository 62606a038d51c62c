"""Say what is in a drawn picture and where: tight boxes around what can be seen of each thing.

A thing is asked for when enough of it is in sight to tell what it is; one of which less is seen is
kept as not judged, so that nobody is taught or held to miss it.
"""

from __future__ import annotations

import re
from dataclasses import dataclass
from math import cos, sin
from typing import TYPE_CHECKING

import numpy as np

from sim.camera import focal_px
from tools.train.budget import CLASSES
from wire import Pose2, compose

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Mapping, Sequence

    from numpy.typing import NDArray

    from sim.camera.primitives import GeomPart
    from sim.camera.scene import Instance
    from wire import CameraConfig

LEAST_SIDE_PX = 4.0
"""Shorter side of the box."""
LEAST_PIXELS = 16
LEAST_SHARE = 0.25
"""Of the box that the whole thing would have in this picture, were nothing before it."""
BEHIND_M = 0.1
"""Nearer than this, or behind the camera, a corner has no place in the picture."""
NUMBER = re.compile(r'(type|size|pos|fromto)="([^"]*)"')

Box = tuple[float, float, float, float]
"""Left, top, right, bottom [px]."""


@dataclass(frozen=True, slots=True)
class Hull:
    """Bound a thing by an upright box in its own frame, standing somewhere in ``map``."""

    low: tuple[float, float, float]
    high: tuple[float, float, float]
    pose: Pose2
    z_m: float

    def corners(self) -> NDArray[np.float64]:
        """Return its eight corners (8, 3) in ``map`` [m]."""
        picks = np.array([[(i >> axis) & 1 for axis in range(3)] for i in range(8)], bool)
        local = np.where(picks, np.array(self.high), np.array(self.low))
        c, s = cos(self.pose.yaw_rad), sin(self.pose.yaw_rad)
        x = self.pose.x_m + c * local[:, 0] - s * local[:, 1]
        y = self.pose.y_m + s * local[:, 0] + c * local[:, 1]
        return np.stack([x, y, self.z_m + local[:, 2]], 1)


def hulls(things: Iterable[Instance]) -> dict[str, Hull]:
    """Return the hull of what each thing's class names; things that are nowhere have none."""
    found: dict[str, Hull] = {}
    for thing in things:
        bounds = [_bounds(part) for part in thing.parts if part.labelled]
        if bounds and not thing.absent:
            low = np.min([b[0] for b in bounds], 0)
            high = np.max([b[1] for b in bounds], 0)
            found[thing.id] = Hull(tuple(low), tuple(high), thing.pose, thing.z_m)
    return found


def _bounds(part: GeomPart) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Return a part's lowest and highest corner in its thing's frame [m]."""
    said = dict(NUMBER.findall(part.form))
    size = np.array(said["size"].split(), np.float64)
    if "fromto" in said:
        ends = np.array(said["fromto"].split(), np.float64).reshape(2, 3)
        return ends.min(0) - size[0], ends.max(0) + size[0]
    middle = np.array(said.get("pos", "0 0 0").split(), np.float64)
    # Three numbers are half sides or half axes, one is a radius, two a radius and half a height.
    half = size if len(size) == 3 else np.array([size[0], size[0], size[-1]])
    return middle - half, middle + half


def whole_box(hull: Hull, camera: CameraConfig, base_in_map: Pose2) -> Box | None:
    """Return the box that a whole thing would have, cut at the picture's edge; None unknown."""
    on_floor = compose(base_in_map, Pose2(camera.x_m, camera.y_m, camera.yaw_rad))
    cy, sy = cos(on_floor.yaw_rad), sin(on_floor.yaw_rad)
    cp, sp = cos(camera.pitch_rad), sin(camera.pitch_rad)
    off = hull.corners() - np.array([on_floor.x_m, on_floor.y_m, camera.z_m])
    level = off[:, 0] * cy + off[:, 1] * sy
    left = -off[:, 0] * sy + off[:, 1] * cy
    ahead, up = level * cp - off[:, 2] * sp, level * sp + off[:, 2] * cp
    if ahead.min() < BEHIND_M:
        return None
    focal = focal_px(camera)
    x = camera.width_px / 2 - focal * left / ahead
    y = camera.height_px / 2 - focal * up / ahead
    wide, high = camera.width_px, camera.height_px
    x0, x1 = np.clip([x.min(), x.max()], 0, wide)
    y0, y1 = np.clip([y.min(), y.max()], 0, high)
    return float(x0), float(y0), float(x1), float(y1)


def boxes(
    ids: NDArray[np.int32],
    labels: Mapping[int, tuple[str, str]],
    whole: Callable[[str], Box | None],
) -> NDArray[np.float32]:
    """Return what is in a picture (M, 6): class, left, top, right, bottom [px], 1 or -1.

    Args:
        ids: (height, width), what each pixel shows.
        labels: instance and class of each id.
        whole: tells the box that a whole instance would have, where that is known.
    """
    rows: list[tuple[float, ...]] = []
    for number in np.unique(ids).tolist():
        instance, class_id = labels.get(number, ("", "none"))
        if class_id not in CLASSES:
            continue
        down, across = np.nonzero(ids == number)
        box = (across.min(), down.min(), across.max() + 1, down.max() + 1)
        asked = len(down) >= LEAST_PIXELS and _is_enough(box, whole(instance))
        rows.append((CLASSES.index(class_id), *map(float, box), 1.0 if asked else -1.0))
    return np.array(rows, np.float32).reshape(-1, 6)


def _is_enough(box: Sequence[float], whole: Box | None) -> bool:
    wide, high = box[2] - box[0], box[3] - box[1]
    if min(wide, high) < LEAST_SIDE_PX:
        return False
    if whole is None:  # it reaches beside or behind the camera: near, and large in the picture
        return True
    area = max(0.0, whole[2] - whole[0]) * max(0.0, whole[3] - whole[1])
    return bool(wide * high >= LEAST_SHARE * area)
