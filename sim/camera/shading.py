"""Colour each ray's hit: parts in their own colour, floors and walls by the point hit.

Light is one lamp far away, what the ceiling gives back, and the rest evenly; no shadows. Sources:
Lambert's cosine law; hemisphere lighting is 0.5 + 0.5 n_z.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from sim.camera.rooms import FLOOR, SURFACES, WALL
from sim.camera.texture import TexturePlan, Woven
from sim.site.plan import room_rects

if TYPE_CHECKING:
    from collections.abc import Sequence

    from sim.camera.framebuffer import Canvas
    from sim.camera.scene import Instance
    from sim.camera.surfaces import Appearance, Texture
    from sim.site import Home

Floats = NDArray[np.float32]
Numbers = NDArray[np.int32]
SKIRTING_M = 0.08


class Painter:
    """Turn a canvas into colours, ids and angles for one home and look."""

    def __init__(
        self, home: Home, look: Appearance, things: Sequence[Instance], numbers: list[int]
    ) -> None:
        """Prepare the tables that are looked up by a part's number.

        Args:
            home: whose rooms have floors and walls.
            look: their textures and the light.
            things: in the order of their parts' numbers.
            numbers: the id of every part.
        """
        self._look = look
        self._plan = TexturePlan(list(room_rects(home).values()))
        paints = [part.paint for thing in things for part in thing.parts]
        palette = [look.skirting, look.skirting, look.ceiling, *paints]
        self._floors = [_onto(palette, texture) for texture in look.floors]
        self._walls = [_onto(palette, texture) for texture in look.walls]
        # One plane a channel: a gather of planes is four times faster than one of triples.
        tinted = np.array(palette) * np.array(look.tint)
        self._palette = np.ascontiguousarray(tinted.T, dtype=np.float32)
        self._number = np.array([0] * SURFACES + numbers, dtype=np.int32)

    def paint(
        self, canvas: Canvas, eye: NDArray[np.float64]
    ) -> tuple[NDArray[np.uint8], Numbers, Floats]:
        """Return colours (rows, columns, 3), ids and cosines to the surface (rows, columns)."""
        paint = canvas.hit.copy()
        self._cover(FLOOR, canvas, eye, paint)
        self._cover(WALL, canvas, eye, paint)
        light = self._light(canvas.normal)
        color = np.empty((*paint.shape, 3), dtype=np.uint8)
        for channel in range(3):
            lit = np.take(self._palette[channel], paint, mode="clip")
            lit *= light
            color[..., channel] = np.minimum(lit, 255.0, out=lit)
        x, y, z = canvas.normal * canvas.aimed
        ids: Numbers = np.take(self._number, canvas.hit, mode="clip")
        facing: Floats = np.abs(x + y + z)
        return color, ids, facing

    def _light(self, normal: Floats) -> Floats:
        look, (x, y, z) = self._look, normal
        lamp: Floats = x * look.light[0] + y * look.light[1] + z * look.light[2]
        np.maximum(lamp, 0.0, out=lamp)
        lamp *= look.key
        lamp += (look.ambient + 0.5 * look.sky) + (0.5 * look.sky) * z
        return lamp

    def _cover(self, kind: int, canvas: Canvas, eye: NDArray[np.float64], paint: Numbers) -> None:
        """Replace one surface's number by those of its textures' colours."""
        at = np.flatnonzero(canvas.hit.reshape(-1) == kind)
        range_m = canvas.range_m.reshape(-1)[at]
        x, y, z = (
            canvas.aimed[axis].reshape(-1)[at] * range_m + np.float32(eye[axis])
            for axis in range(3)
        )
        if kind == FLOOR:
            woven = self._woven(self._floors, x, y, x, y)
        else:
            nx, ny = (canvas.normal[axis].reshape(-1)[at] for axis in (0, 1))
            along = np.where(nx == 0.0, x, y)
            # A wall's face belongs to the room before it.
            step = np.float32(0.2)
            woven = self._woven(self._walls, x + step * nx, y + step * ny, along, z)
            woven[z < SKIRTING_M] = WALL
        paint.reshape(-1)[at] = woven

    def _woven(self, covers: list[Woven], x: Floats, y: Floats, u: Floats, v: Floats) -> Numbers:
        """Return colour numbers at u, v of the textures that the rooms around x, y have."""
        which = self._plan.rooms(x, y)
        present = np.flatnonzero(np.bincount(which))
        if len(present) == 1:  # nearly always
            whole: Numbers = covers[int(present[0]) % len(covers)].at(u, v)
            return whole
        found = np.empty(len(x), dtype=np.int32)
        for room in present:
            part = np.flatnonzero(which == room)
            found[part] = covers[int(room) % len(covers)].at(u[part], v[part])
        return found


def _onto(palette: list[tuple[float, float, float]], texture: Texture) -> Woven:
    """Put a texture's colours onto the palette."""
    woven = Woven(texture, len(palette))
    palette.extend(woven.colors)
    return woven
