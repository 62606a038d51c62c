"""Draw fixtures that no detector is asked for: shelves, a bench, a bath, a rack, a dock."""

from __future__ import annotations

from typing import TYPE_CHECKING

from sim.camera.furniture import cabinet
from sim.camera.primitives import GeomPart, ball, block, rod, tube

if TYPE_CHECKING:
    from collections.abc import Callable

    from sim.camera.materials import Coat
    from sim.site.classes import Size

_CHINA = (236.0, 238.0, 240.0)
_WATER = (196.0, 204.0, 208.0)


def shelf(size: Size, coat: Coat) -> list[GeomPart]:
    """Draw open shelves between two sides and a back."""
    x, y, top = size[0] / 2, size[1] / 2, size[2]
    count = max(2, round(top / 0.36))
    boards = [top * index / count for index in range(count + 1)]
    return [
        block((-x, -x + 0.02), (-y, y), (0.0, top), coat.shade_color),
        *(block((-x, x), side, (0.0, top), coat.main) for side in ((-y, -y + 0.03), (y - 0.03, y))),
        *(
            block((-x, x), (-y, y), (max(0.0, board - 0.03), max(0.03, board)), coat.main)
            for board in boards
        ),
    ]


def bench(size: Size, coat: Coat) -> list[GeomPart]:
    """Draw a chest with a cushion."""
    x, y, top = size[0] / 2, size[1] / 2, size[2]
    return [
        block((-x, x), (-y, y), (0.0, top - 0.08), coat.main),
        block((-x, x), (-y, y), (top - 0.08, top), coat.light),
    ]


def basin(size: Size, _coat: Coat) -> list[GeomPart]:
    """Draw a white block with a hollow: a wash basin, or a bath when it is long."""
    x, y, top = size[0] / 2, size[1] / 2, size[2]
    rim = 0.06
    return [
        block((-x, x), (-y, y), (0.0, top), _CHINA),
        block((-x + rim, x - rim), (-y + rim, y - rim), (top, top + 0.002), _WATER),
        rod((-x + 0.02, 0.0, top), (-x + 0.02, 0.0, top + 0.12), 0.012, (150.0, 152.0, 156.0)),
    ]


def toilet(size: Size, _coat: Coat) -> list[GeomPart]:
    """Draw a cistern, a foot and a round bowl with its lid."""
    x, y, top = size[0] / 2, size[1] / 2, size[2]
    bowl = min(y, 0.6 * x)
    return [
        block((-x, -x + 0.18), (-y, y), (0.0, top + 0.35), _CHINA),
        block((-x + 0.18, x - bowl), (-0.5 * y, 0.5 * y), (0.0, top - 0.05), _CHINA),
        tube((x - bowl, 0.0), (0.2 * top, top - 0.05), bowl, _CHINA),
        tube((x - bowl, 0.0), (top - 0.05, top), bowl, _WATER),
    ]


def rack(size: Size, coat: Coat) -> list[GeomPart]:
    """Draw a pole on a foot with four hooks."""
    radius, top = min(size[0], size[1]) / 2, size[2]
    hooks = ((1, 0), (0, 1), (-1, 0), (0, -1))
    return [
        tube((0.0, 0.0), (0.0, 0.04), 0.9 * radius, coat.frame),
        tube((0.0, 0.0), (0.04, top), 0.025, coat.frame),
        *(
            rod((0.0, 0.0, top - 0.2), (dx * 0.7 * radius, dy * 0.7 * radius, top - 0.1), 0.012,
                coat.metal)
            for dx, dy in hooks
        ),
    ]  # fmt: skip


def dock(size: Size, coat: Coat) -> list[GeomPart]:
    """Draw a dark plate with two contacts and a green lamp."""
    x, y, top = size[0] / 2, size[1] / 2, size[2]
    brass = (190.0, 160.0, 80.0)
    return [
        block((-x, x - 0.01), (-y, y), (0.0, top), coat.black),
        *(block((x - 0.01, x), side, (0.08, 0.14), brass) for side in ((-0.1, -0.04), (0.04, 0.1))),
        ball((x - 0.012, 0.0, 0.85 * top), 0.012, (60.0, 230.0, 90.0)),
    ]


FORMS: dict[str, Callable[[Size, Coat], list[GeomPart]]] = {
    "shelf": shelf, "bookshelf": shelf, "bookcase": shelf, "bench": bench, "bathtub": basin,
    "washbasin": basin, "sink": basin, "toilet": toilet, "rack": rack, "station": dock,
}  # fmt: skip
"""By a word of the id."""


def form_of(item_id: str) -> Callable[[Size, Coat], list[GeomPart]]:
    """Return how to draw a piece of furniture that no class names."""
    named = [FORMS[word] for word in item_id.split("_") if word in FORMS]
    return named[-1] if named else cabinet
