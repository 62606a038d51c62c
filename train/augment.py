"""Change a frame in ways that change nothing of what is in it: light, sharpness, place, size.

Homes and light are varied where frames are drawn; this varies what each epoch sees of them. The
same generator gives the same change.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import cv2
import numpy as np

from train.budget import HEIGHT_PX, WIDTH_PX

if TYPE_CHECKING:
    from numpy.random import Generator
    from numpy.typing import NDArray

    from train.store import Framed

    Picture = NDArray[np.uint8]
    Things = NDArray[np.float32]

ZOOM = (0.75, 1.5)
LEAST_SHARE = 0.4
"""What is left of a box after moving the picture; with less it is not judged."""
LEAST_PX = 4.0
FILL = 114
"""Grey beyond the picture's edge, as a letterbox has it."""


def decoded(jpeg: bytes) -> Picture:
    """Return a picture (240, 320, 3) in RGB.

    Raises:
        ValueError: it is no picture, or one of another size.
    """
    data = np.frombuffer(jpeg, np.uint8)
    picture = cv2.imdecode(data, cv2.IMREAD_COLOR) if len(data) else None
    if picture is None or picture.shape != (HEIGHT_PX, WIDTH_PX, 3):
        raise ValueError("a stored frame is no JPEG of the size that is trained for")
    return np.ascontiguousarray(picture[:, :, ::-1]).astype(np.uint8, copy=False)


def augmented(frame: Framed, random: Generator) -> tuple[Picture, Things]:
    """Return a frame as one epoch sees it."""
    picture, things = decoded(frame.jpeg), frame.things
    if random.random() < 0.5:
        picture, things = mirrored(picture, things)
    if random.random() < 0.6:
        picture, things = moved(picture, things, random)
    if random.random() < 0.8:
        picture = lit(picture, random)
    if random.random() < 0.15:
        picture = np.asarray(cv2.GaussianBlur(picture, (3, 3), 0), np.uint8)
    if random.random() < 0.2:
        picture = grained(picture, random)
    if random.random() < 0.25:
        picture = squeezed(picture, int(random.integers(40, 90)))
    return picture, things


def mirrored(picture: Picture, things: Things) -> tuple[Picture, Things]:
    """Swap left and right."""
    swapped = things.copy()
    swapped[:, 1], swapped[:, 3] = WIDTH_PX - things[:, 3], WIDTH_PX - things[:, 1]
    return np.ascontiguousarray(picture[:, ::-1]), swapped


def moved(picture: Picture, things: Things, random: Generator) -> tuple[Picture, Things]:
    """Zoom and shift; most of the picture stays in view."""
    zoom = float(np.exp(random.uniform(*np.log(ZOOM))))
    # Zoomed in, the window stays within the picture; zoomed out, the picture within the window.
    right = (1 - zoom) * WIDTH_PX * random.random()
    down = (1 - zoom) * HEIGHT_PX * random.random()
    matrix = np.array([[zoom, 0.0, right], [0.0, zoom, down]], np.float64)
    shifted = cv2.warpAffine(picture, matrix, (WIDTH_PX, HEIGHT_PX), borderValue=(FILL, FILL, FILL))
    return np.asarray(shifted, np.uint8), clipped(things, zoom, right, down)


def clipped(things: Things, zoom: float, right: float, down: float) -> Things:
    """Move boxes along and cut them at the edge; what loses most of itself is not judged."""
    new = things.copy()
    new[:, 1:5] = things[:, 1:5] * zoom + np.array([right, down, right, down], np.float32)
    whole = (new[:, 3] - new[:, 1]) * (new[:, 4] - new[:, 2])
    new[:, [1, 3]] = new[:, [1, 3]].clip(0, WIDTH_PX)
    new[:, [2, 4]] = new[:, [2, 4]].clip(0, HEIGHT_PX)
    wide, high = new[:, 3] - new[:, 1], new[:, 4] - new[:, 2]
    small = np.minimum(wide, high) < LEAST_PX
    new[small | (wide * high < LEAST_SHARE * whole), 5] = -1
    return new[(wide > 0) & (high > 0)]


def lit(picture: Picture, random: Generator) -> Picture:
    """Change brightness, contrast, gamma and each colour's share a little."""
    ramp = np.arange(256, dtype=np.float64)[:, None] / 255
    ramp = ramp ** np.exp(random.uniform(-0.35, 0.35))
    ramp = (ramp - 0.5) * random.uniform(0.75, 1.25) + 0.5 + random.uniform(-0.12, 0.12)
    ramp = ramp * random.uniform(0.9, 1.1, (1, 3))
    table = (ramp * 255).round().clip(0, 255).astype(np.uint8)
    return np.asarray(cv2.LUT(picture, table[None]), np.uint8)


def grained(picture: Picture, random: Generator) -> Picture:
    """Add a sensor's noise."""
    noise = random.standard_normal(picture.shape, np.float32)
    noise *= np.float32(random.uniform(1.0, 7.0))
    noise += picture
    return np.clip(noise + np.float32(0.5), 0, 255).astype(np.uint8)


def squeezed(picture: Picture, quality: int) -> Picture:
    """Encode as JPEG once more."""
    _, data = cv2.imencode(".jpg", picture[:, :, ::-1], [cv2.IMWRITE_JPEG_QUALITY, quality])
    return decoded(data.tobytes())
