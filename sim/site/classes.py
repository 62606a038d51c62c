"""Define the classes of a home's things, their sizes and the heights of their tops.

The one list of classes and colours for home.yaml, the drawn picture and whoever is taught by it.
Knows no home and no picture.
"""

from __future__ import annotations

from typing import Final, Literal, get_args

ThingClass = Literal[
    "person", "chair", "sofa", "table", "bed", "tv", "fridge", "plant", "door", "box",
    "cup", "ball", "bottle", "book",
]  # fmt: skip
FurnitureClass = Literal["chair", "sofa", "table", "bed", "tv", "fridge", "plant", "box", "none"]
ObjectClass = Literal[
    "chair", "table", "tv", "plant", "door", "box", "cup", "ball", "bottle", "book"
]
Color = Literal[
    "red", "orange", "yellow", "green", "blue", "purple", "pink", "brown", "black", "gray", "white"
]
Size = tuple[float, float, float]
"""Depth along the front, breadth across it, height [m]."""

CLASSES: Final[tuple[str, ...]] = get_args(ThingClass)
COLORS: Final[tuple[str, ...]] = get_args(Color)
NO_CLASS: Final = "none"

_SAME: Final[dict[str, FurnitureClass]] = {
    "chair": "chair", "armchair": "chair", "stool": "chair", "sofa": "sofa", "couch": "sofa",
    "table": "table", "desk": "table", "bed": "bed", "tv": "tv", "television": "tv",
    "fridge": "fridge", "refrigerator": "fridge", "plant": "plant", "box": "box", "crate": "box",
}  # fmt: skip
"""Words of an id that name a class."""

SIZES_M: Final[dict[str, Size]] = {
    "chair": (0.45, 0.45, 0.9), "table": (0.6, 0.9, 0.72), "tv": (0.2, 0.9, 0.58),
    "plant": (0.3, 0.3, 0.6), "door": (0.02, 0.9, 2.0), "box": (0.35, 0.45, 0.35),
    "cup": (0.09, 0.09, 0.11), "ball": (0.2, 0.2, 0.2), "bottle": (0.08, 0.08, 0.28),
    "book": (0.24, 0.17, 0.04),
}  # fmt: skip
ROUND: Final = frozenset({"cup", "ball", "bottle", "plant"})

PERSON_RADIUS_M, PERSON_HEIGHT_M = 0.25, 1.7
CRATE_M = 0.5
SPARE_OBSTACLES: Final = ("person_0", "person_1", "crate_0", "crate_1")
"""Every simulated home has these besides its own; they are nowhere until somebody places them."""

_SEAT: Final = {"sofa": 0.53, "chair": 0.5, "bed": 0.9}
"""Where a thing put on such furniture comes to lie, as a share of the furniture's height."""


def class_of(item_id: str) -> FurnitureClass:
    """Return the class that an id's words name; of several the last, as in ``table_chair``."""
    named = [_SAME[word] for word in item_id.split("_") if word in _SAME]
    return named[-1] if named else NO_CLASS


def surface_m(class_id: str, height_m: float) -> float:
    """Return how high a thing lies that is put on furniture of this class and height [m]."""
    return _SEAT.get(class_id, 1.0) * height_m
