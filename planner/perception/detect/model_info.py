"""Own the facts of a model that ran one trial picture: names, shapes, metadata. Data only."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

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
