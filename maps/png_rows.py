"""Compare what a PNG's header says with the pixels that its data hold. Keeps none of them.

A decoder takes as many rows as the header says and passes over the rest: with a header that lies,
part of a map would be read as the whole. Source: PNG specification, "Filtering", "Interlacing".
"""

from __future__ import annotations

import zlib
from typing import TYPE_CHECKING

from maps.errors import BilingualError
from wire.png import SIGNATURE

if TYPE_CHECKING:
    from collections.abc import Iterator

_SAMPLES = {0: 1, 2: 3, 3: 1, 4: 2, 6: 4}
"""Of a pixel, by colour type."""
_PASSES = (
    (0, 0, 8, 8), (4, 0, 8, 8), (0, 4, 4, 8), (2, 0, 4, 4),
    (0, 2, 2, 4), (1, 0, 2, 2), (0, 1, 1, 2),
)  # fmt: skip
"""Of an interlaced picture (Adam7): first column and row, steps between columns and rows."""
_PIECE = 1 << 20


def count_rows_bytes(data: bytes) -> tuple[int, int]:
    """Return how many bytes of rows a PNG holds, at most one too many, and how many it should.

    Args:
        data: a PNG whose chunks are whole (:func:`wire.png.chunks_fit`).

    Raises:
        ValueError: the colour type is none, or the data can't be unpacked.
    """
    wanted = _count_due(data)
    unpacker, held = zlib.decompressobj(), 0
    try:
        for piece in _pixel_data(data):
            rest = piece
            while rest and held <= wanted:
                held += len(unpacker.decompress(rest, _PIECE))
                rest = unpacker.unconsumed_tail
    except zlib.error as error:
        text = f"its pixels cannot be unpacked ({error})"
        raise BilingualError(text, "像素数据无法解压") from error
    return min(held, wanted + 1), wanted


def _count_due(data: bytes) -> int:
    width, height = int.from_bytes(data[16:20]), int.from_bytes(data[20:24])
    depth, color, interlaced = data[24], data[25], data[28] == 1
    if color not in _SAMPLES:
        text = f"its colour type is {color}; expected 0, 2, 3, 4 or 6"
        raise BilingualError(text, f"颜色类型为 {color}；应为 0、2、3、4 或 6")
    bits = depth * _SAMPLES[color]
    sizes = [(width, height)]
    if interlaced:
        sizes = [
            (-(-(width - x) // across), -(-(height - y) // down)) for x, y, across, down in _PASSES
        ]
    # Each row has a byte before it that names its filter.
    return sum((1 + -(-w * bits // 8)) * h for w, h in sizes if w > 0 and h > 0)


def _pixel_data(data: bytes) -> Iterator[bytes]:
    at = len(SIGNATURE)
    while at + 8 <= len(data):
        length = int.from_bytes(data[at : at + 4])
        if data[at + 4 : at + 8] == b"IDAT":
            yield data[at + 8 : at + 8 + length]
        at += length + 12
