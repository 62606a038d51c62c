"""Decode the picture of a map into grey bytes. Knows PGM itself and leaves PNG to OpenCV.

OpenCV is imported only when a PNG is read: it brings numpy and some 40 MB into the process, and
our own sites are PGM.
"""

from __future__ import annotations

import errno
import re
from dataclasses import dataclass
from itertools import islice
from pathlib import Path

from planner.site.errors import SiteError
from wire.plain_file import read_plain_file
from wire.png import SIGNATURE, chunks_fit
from wire.site_map import MOST_IMAGE_BYTES

MAX_PIXELS = 64_000_000
"""8000 x 8000: a map of 400 m x 400 m at 0.05 m."""

_PGM_HEAD = re.compile(
    rb"(P[25])(?:\s|#[^\n]*\n)+(\d{1,9})(?:\s|#[^\n]*\n)+(\d{1,9})(?:\s|#[^\n]*\n)+(\d{1,9})\s"
)


@dataclass(frozen=True, slots=True)
class GreyImage:
    """Keep grey pixels, 0 black to 255 white, first row at the top."""

    width: int
    height: int
    pixels: bytes


def read_image(path: Path) -> tuple[bytes, GreyImage]:
    """Return a map image's bytes, which name the map, and its pixels.

    Raises:
        SiteError: ``map_image_missing``, ``map_image_malformed`` or ``map_image_too_large``.
    """
    try:
        data = read_plain_file(path, MOST_IMAGE_BYTES)
    except OSError as error:
        if error.errno == errno.EFBIG:
            raise SiteError("map_image_too_large", f"{path}: {error.strerror}") from error
        others = ", ".join(sorted(p.name for p in path.parent.glob("*.p[gn][mg]"))) or "none"
        text = f"the map's image {path} cannot be read ({error.strerror}); images there: {others}"
        raise SiteError("map_image_missing", text) from error
    return data, decode(data, path)


def decode(data: bytes, where: Path) -> GreyImage:
    """Decode PGM (P2, P5, at most 8 bits) or PNG.

    Raises:
        SiteError: ``map_image_malformed`` or ``map_image_too_large``.
    """
    if data.startswith(SIGNATURE):
        return _decode_png(data, where)
    head = _PGM_HEAD.match(data)
    if head is None:
        raise SiteError("map_image_malformed", f"{where}: neither PGM (P2, P5) nor PNG")
    return _decode_pgm(head, data[head.end() :], where)


def _decode_pgm(head: re.Match[bytes], body: bytes, where: Path) -> GreyImage:
    width, height, white = (int(text) for text in head.groups()[1:])
    _check_size(width, height, where)
    if not 1 <= white <= 255:
        raise SiteError("map_image_malformed", f"{where}: white is {white}; expected 1 to 255")
    wanted = width * height
    raw = body if head[1] == b"P5" else _plain_values(body, wanted, where)
    if len(raw) < wanted or max(raw[:wanted]) > white:
        text = f"{where}: {width} x {height} pixels up to {white} announced, {len(raw)} bytes came"
        raise SiteError("map_image_malformed", text)
    scale = bytes(min(255, round(value * 255 / white)) for value in range(256))
    return GreyImage(width, height, raw[:wanted].translate(scale))


def _plain_values(body: bytes, wanted: int, where: Path) -> bytes:
    try:  # one at a time: a list of them all takes forty times the file
        return bytes(int(text[0]) for text in islice(re.finditer(rb"\S+", body), wanted))
    except ValueError as error:
        raise SiteError("map_image_malformed", f"{where}: {error}") from error


def _decode_png(data: bytes, where: Path) -> GreyImage:
    # The header says the size before anything is unpacked: a small file may hold a huge picture.
    width, height = int.from_bytes(data[16:20]), int.from_bytes(data[20:24])
    _check_size(width, height, where)
    if not chunks_fit(data):
        text = f"{where}: {len(data)} bytes came, and its chunks speak of more"
        raise SiteError("map_image_malformed", text)
    import cv2

    pixels = cv2.imread(str(where), cv2.IMREAD_GRAYSCALE)
    if pixels is None or pixels.shape != (height, width):
        raise SiteError("map_image_malformed", f"{where}: the PNG cannot be decoded")
    return GreyImage(width, height, pixels.tobytes())


def _check_size(width: int, height: int, where: Path) -> None:
    if not 0 < width * height <= MAX_PIXELS:
        text = f"{where}: {width} x {height} pixels; expected 1 to {MAX_PIXELS} in all"
        raise SiteError("map_image_too_large", text)
