"""Texture floors and walls: return the colour at a point of their plane.

Knows no home; colours are numbers on a palette, beginning at a given one.
"""

from __future__ import annotations

from math import cos, sin
from typing import TYPE_CHECKING, Final

import numpy as np
from numpy.typing import NDArray

if TYPE_CHECKING:
    from sim.camera.primitives import Rgb
    from sim.camera.surfaces import Texture
    from sim.site import Rect

Floats = NDArray[np.float32]
Numbers = NDArray[np.int32]
_SHADES: Final = 7
_SEAM: Final = 0.04
"""Width of the gap between planks, as a share of theirs."""
_CELL_M: Final = 0.05


class Woven:
    """Hold one texture and where its colours begin."""

    def __init__(self, texture: Texture, first: int) -> None:
        self._texture, self._first = texture, first
        c, s = cos(texture.turn_rad), sin(texture.turn_rad)
        self._c, self._s = np.float32(c / texture.scale_m), np.float32(s / texture.scale_m)
        self.colors = _planks(texture) if texture.weave == "planks" else _two(texture)

    def at(self, u: Floats, v: Floats) -> Numbers:
        """Return colours' numbers at coordinates [m] of the plane."""
        if self._texture.weave == "plain":
            return np.full(len(u), self._first, dtype=np.int32)
        a, b = self._c * u + self._s * v, self._c * v - self._s * u
        row = np.floor(a)
        column = row.astype(np.int32)
        if self._texture.weave == "stripes":
            return self._first + (column & 1)
        if self._texture.weave == "checker":
            return self._first + ((column + np.floor(b).astype(np.int32)) & 1)
        # Planks: rows of boards six times as long as wide, each shifted by a third.
        board = np.floor(b * np.float32(1 / 6) + row * np.float32(1 / 3)).astype(np.int32)
        shade = (column * 73 + board * 151) % _SHADES
        return self._first + shade + _SHADES * (a - row < _SEAM)


class TexturePlan:
    """Know the room of many points at once: a grid of numbers, since a test for each costs more."""

    def __init__(self, rooms: list[Rect]) -> None:
        self._x0, self._y0 = min(room.x0 for room in rooms), min(room.y0 for room in rooms)
        x1, y1 = max(room.x1 for room in rooms), max(room.y1 for room in rooms)
        # A cell more all around: what lies outside gets the room of the edge, the first's number.
        shape = (_cell(y1 - self._y0) + 3, _cell(x1 - self._x0) + 3)
        self._grid = np.zeros(shape, dtype=np.int32)
        for number, room in enumerate(rooms):
            rows = slice(_cell(room.y0 - self._y0) + 1, _cell(room.y1 - self._y0) + 1)
            columns = slice(_cell(room.x0 - self._x0) + 1, _cell(room.x1 - self._x0) + 1)
            self._grid[rows, columns] = number

    def rooms(self, x: Floats, y: Floats) -> Numbers:
        """Return each point's room, by its number; 0 outside."""
        scale = np.float32(1.0 / _CELL_M)
        rows, columns = self._grid.shape
        row = ((y - np.float32(self._y0)) * scale + np.float32(1.0)).astype(np.int32)
        column = ((x - np.float32(self._x0)) * scale + np.float32(1.0)).astype(np.int32)
        np.clip(row, 0, rows - 1, out=row)
        np.clip(column, 0, columns - 1, out=column)
        row *= columns
        row += column
        found: Numbers = np.take(self._grid.reshape(-1), row)
        return found


def _cell(length_m: float) -> int:
    return round(length_m / _CELL_M)


def _two(texture: Texture) -> list[Rgb]:
    return [texture.first, texture.second]


def _planks(texture: Texture) -> list[Rgb]:
    """Return the shades of boards, then those of the seams beside them."""
    first, second = np.array(texture.first), np.array(texture.second)
    shares = np.linspace(0.0, 1.0, _SHADES)[:, None]
    boards = first + (second - first) * shares
    found: list[Rgb] = [tuple(row) for row in np.vstack((boards, 0.85 * boards)).tolist()]
    return found
