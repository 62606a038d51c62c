"""Draw a home from a camera: rooms first, then every thing that may be seen, nearest wins.

Knows no noise, no clock and no message but where things stand.
"""

from __future__ import annotations

from math import cos, sin
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from sim.camera.frame import Frame
from sim.camera.framebuffer import Canvas, blank
from sim.camera.meshes import MeshBody
from sim.camera.rooms import SURFACES, Rooms
from sim.camera.scene import height_m, instances
from sim.camera.shading import Painter
from sim.camera.surfaces import Appearance
from sim.camera.view import CameraView, rays

if TYPE_CHECKING:
    from collections.abc import Iterable

    from sim.camera.scene import Instance
    from sim.site import Home
    from wire import CameraConfig, Pose2, SimThing

Placed = tuple[float, float, float, float]
"""x, y, z [m] and yaw [rad] in ``map``."""


class Renderer:
    """Draw one home with one camera."""

    def __init__(self, home: Home, camera: CameraConfig, look: Appearance | None = None) -> None:
        """Build the drawn world."""
        self._home, self._camera = home, camera
        look = look or Appearance()
        self._things = instances(home, look)
        self._rooms = Rooms(home)
        self._bodies = [MeshBody(thing.parts) for thing in self._things]
        self._corners = np.array([body.corners for body in self._bodies])
        counts = [len(thing.parts) for thing in self._things]
        self._first = (SURFACES + np.cumsum([0, *counts])).tolist()
        """The number of each thing's first part."""
        self.labels: dict[int, tuple[str, str]] = {}
        """Instance and class of every id in a frame; class ``none`` where none is named."""
        self._painter = Painter(home, look, self._things, self._number_instances())
        self._rays = rays(camera)
        # The same rays by planes, as the canvas keeps them.
        self._planes = np.moveaxis(self._rays, 2, 0).astype(np.float32, order="C")

    def _number_instances(self) -> list[int]:
        """Number every instance; its parts without the label of its class get another number."""
        known: dict[tuple[str, str], int] = {}
        numbers = []
        for thing in self._things:
            for part in thing.parts:
                label = (thing.id, thing.class_id if part.labelled else "none")
                number = known.setdefault(label, len(known) + 1)
                self.labels[number] = label
                numbers.append(number)
        return numbers

    def render(self, base_in_map: Pose2, things: Iterable[SimThing] = ()) -> Frame:
        """Draw the camera's picture.

        Args:
            base_in_map: where the robot stands.
            things: what stands elsewhere than the home declares; pose None is nowhere. Names that
                this home does not know are passed over.
        """
        view = CameraView(self._camera, base_in_map)
        canvas = blank(self._planes, view)
        self._rooms.cast(view, canvas)
        self._cast_things(view, canvas, {thing.name: thing.pose for thing in things})
        return self._frame(canvas, view)

    def _cast_things(
        self, view: CameraView, canvas: Canvas, moved: dict[str, Pose2 | None]
    ) -> None:
        placed = [self._place(thing, moved) for thing in self._things]
        present = [index for index, at in enumerate(placed) if at is not None]
        if not present:
            return
        at = np.array([placed[index] for index in present])
        windows = view.windows(_place_boxes(self._corners[present], at))
        seen = [(w[2], k) for k, w in enumerate(windows) if w is not None]
        for ahead_m, k in sorted(seen):  # nearest first: what they hide is not asked for
            window = windows[k]
            if window is not None:
                self._cast(view, canvas, present[k], at[k], (window[0], window[1]), ahead_m)

    def _place(self, thing: Instance, moved: dict[str, Pose2 | None]) -> Placed | None:
        pose = None if thing.absent else thing.pose
        if thing.movable and thing.id in moved:
            pose = moved[thing.id]
        if pose is None:
            return None
        return pose.x_m, pose.y_m, height_m(self._home, thing, pose), pose.yaw_rad

    def _cast(
        self,
        view: CameraView,
        canvas: Canvas,
        index: int,
        at: NDArray[np.float64],
        window: tuple[slice, slice],
        ahead_m: float,
    ) -> None:
        if not ahead_m < canvas.range_m[window].max():
            return  # walls, or things nearer, hide it
        turn = _about_z(at[3])
        rays = self._rays[window]
        shape = rays.shape[:2]
        aimed = rays.reshape(-1, 3) @ (view.turn.T @ turn)
        hit, range_m, normal = self._bodies[index].cast((view.eye - at[:3]) @ turn, aimed)
        met = range_m.reshape(shape)
        new = (met >= 0.0) & (met < canvas.range_m[window])
        np.copyto(canvas.range_m[window], met, where=new, casting="same_kind")
        np.copyto(canvas.hit[window], hit.reshape(shape) + self._first[index], where=new)
        for axis, plane in enumerate((normal @ turn.T).T):
            np.copyto(
                canvas.normal[(axis, *window)], plane.reshape(shape), where=new,
                casting="same_kind",
            )  # fmt: skip

    def _frame(self, canvas: Canvas, view: CameraView) -> Frame:
        camera = self._camera
        depth_m = canvas.range_m * self._planes[0]
        seen = (depth_m >= camera.depth_min_m) & (depth_m <= camera.depth_max_m)
        color, ids, facing = self._painter.paint(canvas, view.eye)
        return Frame(color, np.where(seen, depth_m, np.float32(0.0)), ids, facing)


def _about_z(yaw_rad: float) -> NDArray[np.float64]:
    c, s = cos(yaw_rad), sin(yaw_rad)
    return np.array([[c, -s, 0.0], [s, c, 0.0], [0.0, 0.0, 1.0]])


def _place_boxes(corners: NDArray[np.float64], at: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return boxes, shape (n, 8, 3), stood at n places."""
    c, s = np.cos(at[:, 3])[:, None], np.sin(at[:, 3])[:, None]
    x, y, z = np.moveaxis(corners, 2, 0)
    moved = np.stack((c * x - s * y, s * x + c * y, z), axis=2)
    found: NDArray[np.float64] = moved + at[:, None, :3]
    return found
