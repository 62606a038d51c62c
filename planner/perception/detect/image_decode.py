"""Unpack pictures that may be broken or hostile: an array, or a code that says why not.

OpenCV is the codec. It sees only bytes whose header was checked.
"""

from __future__ import annotations

from typing import Any, cast

import cv2
import numpy as np
from numpy.typing import NDArray

from wire.image_header import PictureHeader, read_header

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
