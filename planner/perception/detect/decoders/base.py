"""Define a decoder's interface, the facts it decides by, and the parts that several share."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import ClassVar, Protocol

import numpy as np
from numpy.typing import NDArray

from planner.perception.detect.detections import Row
from planner.perception.detect.preprocess import Floats, Recipe

Shape = tuple[int, ...]


@dataclass(frozen=True, slots=True)
class Facts:
    """Hold the facts that decide how a model's output is read."""

    outputs: Mapping[str, Shape]
    """By name, in the model's order; the shapes that came out of the trial."""
    metadata: Mapping[str, str]
    names: tuple[str, ...]
    """Ids of the classes, by number; empty where nobody says."""
    names_from: str
    """Who says: ``metadata`` or ``labels``."""
    width: int
    height: int
    """Of the input [px]."""
    largest: float = 0.0
    """Of the first output's numbers in the trial, by size."""
    trial: NDArray[np.float32] | None = None
    """The first output of the trial; None where nobody kept it, or where it holds no numbers."""
    results: Mapping[str, NDArray[np.generic]] = field(default_factory=dict)
    """All outputs of the trial, by name; none where nobody kept them."""
    told_side_px: int | None = None
    """Side of the square that it was told as the picture's size; None where it does not ask."""
    promised: tuple[int | str | None, ...] = ()
    """The first output's shape as the file has it; a size that is left open is no number."""

    @property
    def first(self) -> Shape:
        """Return the shape of the first output."""
        return next(iter(self.outputs.values()))

    def cells(self, strides: tuple[int, ...]) -> int:
        """Return how many cells grids of these strides have on the input; 0 where none fits."""
        if any(self.width % stride or self.height % stride for stride in strides):
            return 0
        return sum((self.width // stride) * (self.height // stride) for stride in strides)

    def describe(self) -> str:
        """Write the outputs for a person."""
        shapes = (f"{name} {'x'.join(map(str, shape))}" for name, shape in self.outputs.items())
        return ", ".join(shapes) if self.outputs else "none"


GRIDS = ((8, 16, 32), (8, 16, 32, 64))
"""The strides of the YOLO families' heads."""
UNTOLD = 0
"""Classes that the shape of an output does not count."""


class Decoder(Protocol):
    """Read one layout of outputs."""

    NAME: ClassVar[str]
    RECIPE: ClassVar[Recipe]
    """How its family wants the picture."""
    SUPPRESS: ClassVar[bool]
    """Several boxes come for one thing."""
    SPARE: ClassVar[int]
    """Classes at the end that may go without a name."""

    def __init__(self, facts: Facts) -> None:
        """Get ready for outputs of these shapes."""

    @classmethod
    def classes_of(cls, facts: Facts) -> int | None:
        """Return how many classes the outputs tell of; None where they are of another layout."""

    def decode(self, outputs: Sequence[NDArray[np.generic]], min_score: float) -> list[Row]:
        """Return boxes in input pixels. `filter_rows` drops what is not finite."""


class NamedDecoder(Decoder, Protocol):
    """Read a layout that the outputs' own names tell."""

    OUTPUTS: ClassVar[tuple[str, ...]]
    """Those names: whatever else there is is left aside."""
    EXPECTED: ClassVar[str]
    """Shapes of these outputs, for the words of a refusal."""


def floats(output: NDArray[np.generic]) -> Floats:
    """Return an output without its batch, as single precision; a copy only where it is not."""
    return np.asarray(output[0], np.float32)


def finite_rows(rows: Floats) -> NDArray[np.bool_]:
    """Tell which rows hold numbers alone."""
    return np.asarray(np.isfinite(rows).all(axis=1))


def integral(classes: Floats) -> NDArray[np.bool_]:
    """Tell which numbers can be a class's."""
    return np.asarray((classes >= 0.0) & (classes == np.rint(classes)))


def by_objectness(rows: Floats, min_score: float) -> tuple[Floats, Floats, NDArray[np.intp]]:
    """Read rows of box, objectness and one score a class.

    Returns:
        The boxes' four numbers as they are, objectness x best class score, and that class.
    """
    scores, best = best_class(rows)
    kept = (scores >= min_score) & finite_rows(rows)
    return rows[kept, :4], scores[kept], best[kept]


def best_class(rows: Floats) -> tuple[Floats, NDArray[np.intp]]:
    """Return objectness x best class score, and that class, of rows as above."""
    classes = rows[:, 5:]
    return rows[:, 4] * classes.max(axis=1), classes.argmax(axis=1)
