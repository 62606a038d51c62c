"""Unpack a picture that came over a network: JPEG or PNG, its own header asked first.

OpenCV is the codec. It sees only bytes whose size and kind were checked, for some hundred bytes can
ask it for gigabytes (wire/image_header.py).
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, cast

import cv2
import numpy as np

from sensors.camera.shot import CameraTrouble
from wire.image_header import read_header

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from wire.image_header import PictureHeader

UNREADABLE, TOO_LARGE = "camera_picture_unreadable", "camera_too_large"
MAX_SIDE_PX = 8192
"""The wire's own bound."""
MAX_PIXELS = 25_000_000
"""75 MB unpacked, as much as the planner would unpack."""
RGB = "compressed rgb"
"""In ``format``: red was packed where a JPEG has blue (compressed_image_transport)."""


def unpack(data: bytes, form: str, name: str) -> NDArray[np.uint8]:
    """Return a picture, blue green red; grey ones have three equal channels.

    Args:
        data: its bytes.
        form: how its sender says that it is packed; the bytes themselves count.
        name: what is said of it where it fails.

    Raises:
        CameraTrouble: ``camera_picture_unreadable`` or ``camera_too_large``.
    """
    header = read_header(data)
    if header is None:
        begin = data[:4].hex()
        found = f"{name}: neither JPEG nor PNG: begins with {begin}, its format is {form!r}"
        raise CameraTrouble(UNREADABLE, found)
    if not _fits(header):
        found = f"{name}: {header.width} x {header.height}, expected at most {MAX_PIXELS} pixels"
        raise CameraTrouble(TOO_LARGE, found)
    if header.bits > 8:
        raise CameraTrouble(UNREADABLE, f"{name}: {header.bits} bits a channel, as depth has")
    if not header.whole:
        raise CameraTrouble(UNREADABLE, f"{name}: a {header.kind} of which the end is missing")
    picture = _decode(data)
    if picture is None or picture.shape != (header.height, header.width, 3):
        raise CameraTrouble(UNREADABLE, f"{name}: a {header.kind} that can't be unpacked")
    if RGB in form.lower():
        picture = cv2.cvtColor(picture, cv2.COLOR_RGB2BGR)
    return cast("NDArray[np.uint8]", picture)


def _fits(header: PictureHeader) -> bool:
    wide, high = header.width, header.height
    return 1 <= wide <= MAX_SIDE_PX and 1 <= high <= MAX_SIDE_PX and wide * high <= MAX_PIXELS


def _decode(data: bytes) -> Any:
    """Return an array, or None."""
    how = cv2.IMREAD_COLOR | cv2.IMREAD_IGNORE_ORIENTATION
    try:
        return cv2.imdecode(np.frombuffer(data, np.uint8), how)
    except cv2.error:
        return None
