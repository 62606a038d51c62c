"""Weave floors and walls: which of a texture's colours lies at a point of its plane.

Knows no home; colours are numbers on a palette, beginning at a given one.
"""

from __future__ import annotations

from math import cos, sin
from typing import TYPE_CHECKING, Final

import numpy as np
from numpy.typing import NDArray

if TYPE_CHECKING:
    from sim.camera.appearance import Texture
    from sim.camera.parts import Rgb

Floats = NDArray[np.float32]
Numbers = NDArray[np.int32]
_SHADES: Final = 7
_SEAM: Final = 0.04
"""Width of the gap between planks, as a share of theirs."""


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


def _two(texture: Texture) -> list[Rgb]:
    return [texture.first, texture.second]


def _planks(texture: Texture) -> list[Rgb]:
    """Return the shades of boards, then those of the seams beside them."""
    first, second = np.array(texture.first), np.array(texture.second)
    shares = np.linspace(0.0, 1.0, _SHADES)[:, None]
    boards = first + (second - first) * shares
    found: list[Rgb] = [tuple(row) for row in np.vstack((boards, 0.85 * boards)).tolist()]
    return found
