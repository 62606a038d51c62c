"""Name the prevailing colour of pixels. Knows pixels and ids; the words for them are elsewhere.

Each pixel votes for one id, by hue, saturation and value; the id with the most votes wins if enough
of the pixels agree. A table over all colours at five bits a channel makes a vote one look-up.
"""

from __future__ import annotations

from functools import cache

import cv2
import numpy as np
from numpy.typing import NDArray

Pixels = NDArray[np.uint8]
"""n x 3, blue green red."""

IDS = (
    *("black", "gray", "white", "red", "orange", "yellow"),
    *("green", "blue", "purple", "pink", "brown"),
)
BLACK, GRAY, WHITE, RED, ORANGE, YELLOW, GREEN, BLUE, PURPLE, PINK, BROWN = range(len(IDS))
MIN_SHARE = 0.4
"""Of the pixels that must agree: half a thing may lie in the shade or be of another colour."""
MIN_PIXELS = 4
BITS = 5

# Hue as OpenCV counts it: half degrees, 0 to 179. Upper ends, in order.
HUES = ((7, RED), (19, ORANGE), (34, YELLOW), (85, GREEN), (129, BLUE), (149, PURPLE), (167, PINK))
"""What is above the last is red again."""
DARK_VALUE = 45
PALE_SATURATION = 45
WHITE_VALUE = 190
BROWN_VALUE = 165
"""An orange darker than this is brown."""
BROWN_RED_SATURATION = 150
"""A dark red duller than this is brown as well."""
PINK_SATURATION = 140
PINK_VALUE = 180
"""A red as pale and as light as this is pink."""


def prevailing(pixels: Pixels) -> str | None:
    """Return the id of the colour that most pixels have; None where they do not agree."""
    if len(pixels) < MIN_PIXELS:
        return None
    parts = (pixels >> (8 - BITS)).astype(np.intp)
    places = (parts[:, 0] << (2 * BITS)) | (parts[:, 1] << BITS) | parts[:, 2]
    votes = np.bincount(_table()[places], minlength=len(IDS))
    winner = int(votes.argmax())
    return IDS[winner] if votes[winner] >= MIN_SHARE * len(pixels) else None


@cache
def _table() -> NDArray[np.uint8]:
    """Return the colour's number for each blue, green and red at five bits."""
    steps = np.arange(1 << BITS, dtype=np.uint8) * 8 + 4  # the middle of each step
    colors = np.stack(np.meshgrid(steps, steps, steps, indexing="ij"), axis=-1)
    hsv = cv2.cvtColor(colors.reshape(1, -1, 3), cv2.COLOR_BGR2HSV)[0].astype(np.intp)
    hue, saturation, value = hsv[:, 0], hsv[:, 1], hsv[:, 2]
    number = np.full(len(hsv), RED)
    for end, color in reversed(HUES):
        number[hue <= end] = color
    number[(number == ORANGE) & (value < BROWN_VALUE)] = BROWN
    dull = (saturation < BROWN_RED_SATURATION) & (value < BROWN_VALUE)
    number[(number == RED) & (hue <= 7) & dull] = BROWN
    pale = (saturation < PINK_SATURATION) & (value >= PINK_VALUE)
    number[(number == RED) & pale] = PINK
    colorless = saturation < PALE_SATURATION
    number[colorless] = np.where(value[colorless] >= WHITE_VALUE, WHITE, GRAY)
    number[value < DARK_VALUE] = BLACK
    return number.astype(np.uint8)
