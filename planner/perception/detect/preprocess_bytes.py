"""Fit a picture into the input of a model that takes bytes, and choose how a model's is prepared.

Such a model scales by itself: what it takes is the picture, pixel by pixel as it was unpacked.
Where that is as large as the input, one copy does (0.01 ms at 320 x 240; floats take 0.15 ms).
"""

from __future__ import annotations

from typing import Literal, cast

import cv2
import numpy as np

from planner.perception.detect.image_decode import Picture
from planner.perception.detect.input_size import Input
from planner.perception.detect.preprocess import (
    BORDER,
    FloatPreparer,
    Placement,
    Preparer,
    Recipe,
    place,
)


class BytePreparer:
    """Prepare pictures for a model that takes 1 x height x width x 3 of bytes."""

    def __init__(self, fit: str, channels: Literal["rgb", "bgr"], width: int, height: int) -> None:
        """Make the buffer."""
        self._fit, self._channels, self._size = fit, channels, (width, height)
        self.buffer: Picture = np.full((1, height, width, 3), BORDER, np.uint8)
        """The model's input; it stays where it is."""
        self._shape = self.buffer[0].shape
        self._placed, self._target = place(self._size, self._size, fit), self.buffer[0]

    def prepare(self, picture: Picture) -> tuple[Picture, Placement]:
        """Return the input, 1 x height x width x 3, and where the picture lies in it.

        The input is this object's own buffer: the next picture is written over it.
        """
        if picture.shape != self._shape:
            self._make_room(picture.shape)
        placed = self._placed
        if picture.shape != self._target.shape:
            size = placed.width, placed.height
            picture = cast("Picture", cv2.resize(picture, size, interpolation=cv2.INTER_LINEAR))
        if self._channels == "rgb":
            cv2.cvtColor(picture, cv2.COLOR_BGR2RGB, dst=self._target)
        else:
            np.copyto(self._target, picture)
        return self.buffer, placed

    def _make_room(self, shape: tuple[int, ...]) -> None:
        """Clear the buffer for pictures of another shape."""
        self.buffer[:] = BORDER
        self._shape = shape
        placed = self._placed = place((shape[1], shape[0]), self._size, self._fit)
        self._target = self.buffer[0, placed.rows, placed.columns]


def preparer(recipe: Recipe, taken: Input) -> Preparer:
    """Return the preparer of pictures for a model's input; of a recipe bytes need the fit alone."""
    if taken.bytes_in is None:
        return FloatPreparer(recipe, taken.width, taken.height)
    return BytePreparer(recipe.fit, taken.bytes_in, taken.width, taken.height)
