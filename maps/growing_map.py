"""Keep a map that grows while a robot drives, as one small file. Standard library only.

The process that builds the map writes it whole and renames it into place; planner, route search and
page read it. Cells are cropped to what is known.
"""

from __future__ import annotations

import json
import os
import zlib
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

from maps.grid import UNKNOWN, GridMap

if TYPE_CHECKING:
    from pathlib import Path

GROWING_MAP = "growing.map"
"""Beside the map.yaml of the canvas that it grows on."""
MAX_CELLS = 64_000_000
_MAX_HEAD_BYTES = 4096
FORMAT = 1


class GrowingMapError(ValueError):
    """Report bytes that are no growing map."""


@dataclass(frozen=True, slots=True)
class GrowingMap:
    """Hold what is known of a home so far."""

    revision: int
    """Counts the keyframes that it shows and the loops that moved them."""
    keyframes: int
    loops: int
    grid: GridMap

    def to_bytes(self) -> bytes:
        """Return a line of JSON and the packed cells."""
        grid = self.grid
        head = {
            "format": FORMAT,
            "revision": self.revision,
            "keyframes": self.keyframes,
            "loops": self.loops,
            "width": grid.width,
            "height": grid.height,
            "resolution_m": grid.resolution_m,
            "origin_x_m": grid.origin_x_m,
            "origin_y_m": grid.origin_y_m,
        }
        return json.dumps(head).encode() + b"\n" + zlib.compress(grid.cells, 1)

    @classmethod
    def of_bytes(cls, data: bytes) -> GrowingMap:
        """Return what a file holds.

        Raises:
            GrowingMapError: the bytes are no such file, or not whole.
        """
        line, _, packed = data.partition(b"\n")
        try:
            head = json.loads(line[:_MAX_HEAD_BYTES])
            count = int(head["width"]) * int(head["height"])
            if head["format"] != FORMAT or not 0 < count <= MAX_CELLS:
                raise GrowingMapError(f"format {head['format']}, {count} cells")
            unpacking = zlib.decompressobj()
            cells = unpacking.decompress(packed, count + 1)
            if len(cells) != count:
                raise GrowingMapError(f"{len(cells)} cells, expected {count}")
            grid = GridMap(
                int(head["width"]),
                int(head["height"]),
                float(head["resolution_m"]),
                float(head["origin_x_m"]),
                float(head["origin_y_m"]),
                cells,
            )
            return cls(int(head["revision"]), int(head["keyframes"]), int(head["loops"]), grid)
        except (KeyError, TypeError, ValueError, zlib.error) as error:
            if isinstance(error, GrowingMapError):
                raise
            raise GrowingMapError(f"not a growing map: {error}") from error

    def paint_on(self, canvas: GridMap) -> GridMap:
        """Return a canvas with what is known here on it; beyond the canvas nothing is kept."""
        size_m, own = canvas.resolution_m, self.grid
        left = round((own.origin_x_m - canvas.origin_x_m) / size_m)
        low = round((own.origin_y_m - canvas.origin_y_m) / size_m)
        first = max(0, -left)
        last = max(first, min(own.width, canvas.width - left))
        cells = bytearray(canvas.cells)
        for row in range(max(0, -low), min(own.height, canvas.height - low)):
            at = (row + low) * canvas.width + left
            if first == last:
                break  # all of it lies to one side
            seen = own.cells[row * own.width + first : row * own.width + last]
            under = cells[at + first : at + last]
            known = (
                over if over != UNKNOWN else old for over, old in zip(seen, under, strict=True)
            )
            cells[at + first : at + last] = bytes(known)
        return replace(canvas, cells=bytes(cells))


def write_growing_map(folder: Path, grown: GrowingMap) -> None:
    """Put a growing map in the place of the last, whole.

    Raises:
        OSError: the folder can't be written.
    """
    beside = folder / f".{GROWING_MAP}.new"
    beside.write_bytes(grown.to_bytes())
    os.replace(beside, folder / GROWING_MAP)  # noqa: PTH105  # atomic, also over a reader


def read_growing_map(folder: Path) -> GrowingMap | None:
    """Return a folder's growing map; None where there is none.

    Raises:
        GrowingMapError: there is one that can't be read.
    """
    try:
        data = (folder / GROWING_MAP).read_bytes()
    except FileNotFoundError:
        return None
    except OSError as error:
        raise GrowingMapError(f"{folder / GROWING_MAP}: {error.strerror}") from error
    return GrowingMap.of_bytes(data)
