"""Unpack pictures that may be broken or hostile, draw on them, and lay several out on one sheet.

OpenCV is the codec. It sees only bytes whose header was checked; what can't be unpacked comes back
as a code that says why. A model is shown one picture a question: tiles are as large as the sheet's
longer side allows, never larger than the pictures were, and labels stand above them, so that
nothing is covered.
"""

from __future__ import annotations

from collections.abc import Iterable
from math import ceil
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple, cast

import cv2
import numpy as np
from numpy.typing import NDArray

from planner.perception.snapshot import Detection
from wire.image_header import PictureHeader, read_header

if TYPE_CHECKING:
    from collections.abc import Sequence

Picture = NDArray[np.uint8]
"""height x width x 3, blue green red."""
Depth = NDArray[np.uint16]
"""height x width, millimetres along the optical axis, 0 where nothing was measured."""

MAX_SIDE_PX = 8192
MAX_PIXELS = 25_000_000
"""75 MB unpacked; a robot's camera has a tenth."""
JPEG_QUALITY = 90

cv2.setNumThreads(1)


def color_trouble(header: PictureHeader | None, said: tuple[int, int] | None) -> str | None:
    """Return why a picture is not unpacked, from its header alone.

    Args:
        header: what its first bytes say; None where they say nothing.
        said: width and height as whoever sent it said.
    """
    if header is None:
        return "picture_not_known"
    if header.width < 1 or header.height < 1:
        return "picture_empty"
    if not _fits(header):
        return "picture_too_large"
    if header.bits > 8:
        return "picture_deep"
    if header.channels < 3:
        return "picture_one_channel"
    if header.bits != 8:
        return "picture_undecodable"  # no format has colour in fewer
    if not header.whole:
        return "picture_truncated"
    if said is not None and said != (header.width, header.height):
        return "picture_size_wrong"
    return None


def depth_trouble(header: PictureHeader | None, size: tuple[int, int]) -> str | None:
    """Return why depth is not unpacked, from its header alone. Size: width, height."""
    if header is None or header.kind != "png" or (header.bits, header.channels) != (16, 1):
        return "depth_not_known"
    if (header.width, header.height) != size:
        return "depth_size_wrong"
    return None if header.whole else "depth_truncated"


def unpack_color(data: bytes, said: tuple[int, int] | None = None) -> Picture | str:
    """Return a picture, or the code of its fault."""
    trouble = color_trouble(read_header(data), said)
    if trouble is not None:
        return trouble
    found = _decode(data, cv2.IMREAD_COLOR | cv2.IMREAD_IGNORE_ORIENTATION)
    if found is None or found.dtype != np.uint8 or found.ndim != 3:
        return "picture_undecodable"
    return cast("Picture", found)


def unpack_depth(data: bytes, size: tuple[int, int]) -> Depth | str:
    """Return the depth of a picture of that width and height, or the code of its fault."""
    trouble = depth_trouble(read_header(data), size)
    if trouble is not None:
        return trouble
    found = _decode(data, cv2.IMREAD_UNCHANGED)
    if found is None or found.dtype != np.uint16 or found.shape != (size[1], size[0]):
        return "depth_undecodable"
    return cast("Depth", found) if found.any() else "depth_empty"


def shrink(picture: Picture, long_side: int) -> bytes:
    """Return a JPEG of a picture whose longer side is at most ``long_side`` [px]. No metadata."""
    small = scale_down(picture, long_side)
    _, data = cv2.imencode(".jpg", small, (cv2.IMWRITE_JPEG_QUALITY, JPEG_QUALITY))
    return data.tobytes()


def scale_down(picture: Picture, long_side: int) -> Picture:
    """Return a picture whose longer side is at most ``long_side`` [px]."""
    height, width = picture.shape[:2]
    scale = long_side / max(height, width)
    if scale >= 1.0:
        return picture
    size = (max(1, round(width * scale)), max(1, round(height * scale)))
    return cast("Picture", cv2.resize(picture, size, interpolation=cv2.INTER_AREA))


def _fits(header: PictureHeader) -> bool:
    wide, high = header.width, header.height
    return max(wide, high) <= MAX_SIDE_PX and wide * high <= MAX_PIXELS


def _decode(data: bytes, how: int) -> Any:
    """Return an array of the picture's own kind, or None."""
    try:
        return cv2.imdecode(np.frombuffer(data, np.uint8), how)
    except cv2.error:
        return None


LINE = (60, 200, 60)
BEHIND = (30, 30, 30)
FONT = cv2.FONT_HERSHEY_SIMPLEX
TEXT_SCALE = 0.45
ABOVE_PX = 4


def draw_detections(picture: Picture, detections: Iterable[Detection]) -> Picture:
    """Return a copy of a picture with each detection's box, label and score."""
    copy = picture.copy()
    for found in detections:
        left, top, right, bottom = (round(side) for side in found.box)
        cv2.rectangle(copy, (left, top), (right, bottom), LINE, 2)
        words = (found.color, found.label, f"{found.score:.2f}")
        at = (left, max(12, top - ABOVE_PX))
        text = " ".join(filter(None, words))
        for color, thickness in ((BEHIND, 3), (LINE, 1)):  # readable on any ground
            cv2.putText(copy, text, at, FONT, TEXT_SCALE, color, thickness, cv2.LINE_AA)
    return copy


def save(picture: Picture, path: Path) -> bool:
    """Write a picture in the format of the file's name; tell whether that worked."""
    try:
        return bool(cv2.imwrite(str(path), picture))
    except cv2.error:  # no such format
        return False


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
