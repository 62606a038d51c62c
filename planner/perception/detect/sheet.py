"""Lay out pictures of several directions on one sheet, each below its label.

A model is shown one picture a question. Tiles are as large as the sheet's longer side allows, and
never larger than the pictures were; labels stand above them, so that nothing is covered.
"""

from __future__ import annotations

from math import ceil
from typing import TYPE_CHECKING, Any, NamedTuple

import cv2
import numpy as np

from planner.perception.detect.image_decode import JPEG_QUALITY

if TYPE_CHECKING:
    from collections.abc import Sequence

    from planner.perception.detect.image_decode import Picture

LABEL_PX = 24
"""Height of the strip above each picture."""
GAP_PX = 4
"""Between tiles: what stands in one is not in its neighbour."""
_INSET_PX = 7
_INK = (0, 0, 0)
_FONT, _WANTED_SCALE, _THICK = cv2.FONT_HERSHEY_SIMPLEX, 0.6, 1


class Grid(NamedTuple):
    """Say how pictures are laid out."""

    columns: int
    rows: int
    width: int
    """Of one picture [px]."""
    height: int


def grid_of(count: int, size: tuple[int, int], long_side: int) -> Grid:
    """Return the grid with the largest tiles whose sheet is no longer than so many pixels.

    Args:
        count: of the tiles.
        size: width and height of the largest picture.
        long_side: of the sheet.
    """
    grids = [_with_columns(columns, count, size, long_side) for columns in range(1, count + 1)]
    return max(grids, key=lambda grid: (grid.width * grid.height, -grid.columns))


def lay_out(pictures: Sequence[tuple[Picture, str]], long_side: int) -> bytes:
    """Return one JPEG with these pictures in rows, each below its label (ASCII). No metadata."""
    high = max(picture.shape[0] for picture, _ in pictures)
    wide = max(picture.shape[1] for picture, _ in pictures)
    grid = grid_of(len(pictures), (wide, high), long_side)
    across, down = grid.width + GAP_PX, grid.height + GAP_PX + LABEL_PX
    sheet = np.full((grid.rows * down - GAP_PX, grid.columns * across - GAP_PX, 3), 255, np.uint8)
    for number, (picture, label) in enumerate(pictures):
        top, left = number // grid.columns * down, number % grid.columns * across
        _write(sheet[top : top + LABEL_PX, left : left + grid.width], label)
        tile = _fit(picture, grid)
        sheet[top + LABEL_PX : top + LABEL_PX + tile.shape[0], left : left + tile.shape[1]] = tile
    _, data = cv2.imencode(".jpg", sheet, (cv2.IMWRITE_JPEG_QUALITY, JPEG_QUALITY))
    return data.tobytes()


def _with_columns(columns: int, count: int, size: tuple[int, int], long_side: int) -> Grid:
    rows = ceil(count / columns)
    wide = (long_side + GAP_PX) / columns - GAP_PX
    high = (long_side + GAP_PX) / rows - GAP_PX - LABEL_PX
    scale = min(1.0, wide / size[0], high / size[1])
    return Grid(columns, rows, max(1, int(size[0] * scale)), max(1, int(size[1] * scale)))


def _fit(picture: Picture, grid: Grid) -> Any:
    height, width = picture.shape[:2]
    scale = min(1.0, grid.width / width, grid.height / height)
    size = (max(1, int(width * scale)), max(1, int(height * scale)))
    return cv2.resize(picture, size, interpolation=cv2.INTER_AREA) if scale < 1.0 else picture


def _write(strip: Any, label: str) -> None:
    """Write a label, smaller where the tile is narrow."""
    (length, _), _ = cv2.getTextSize(label, _FONT, _WANTED_SCALE, _THICK)
    scale = min(_WANTED_SCALE, _WANTED_SCALE * (strip.shape[1] - 4) / max(1, length))
    if scale > 0.0:
        foot = (2, LABEL_PX - _INSET_PX)
        cv2.putText(strip, label, foot, _FONT, scale, _INK, _THICK, cv2.LINE_AA)
