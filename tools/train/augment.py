"""Change a frame in ways that change nothing of what is in it: light, sharpness, place, size.

Homes and light are varied where frames are drawn; this varies what each epoch sees of them. The
same generator gives the same change.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import cv2
import numpy as np

from tools.train.budget import HEIGHT_PX, WIDTH_PX

if TYPE_CHECKING:
    from numpy.random import Generator
    from numpy.typing import NDArray

    from tools.train.store import StoredFrame

    Picture = NDArray[np.uint8]
    Things = NDArray[np.float32]

WHOLE = (WIDTH_PX, HEIGHT_PX)
ZOOM = (0.75, 1.5)
LEAST_SHARE = 0.4
"""What is left of a box after moving the picture; with less it is not judged."""
LEAST_PX = 4.0
FILL = 114
"""Grey beyond the picture's edge, as a letterbox has it."""


def decode(jpeg: bytes, size: tuple[int, int] = WHOLE) -> Picture:
    """Return a picture (height, width, 3) of that size in RGB.

    Raises:
        ValueError: it is no picture, or one of another size.
    """
    data = np.frombuffer(jpeg, np.uint8)
    picture = cv2.imdecode(data, cv2.IMREAD_COLOR) if len(data) else None
    if picture is None or picture.shape != (size[1], size[0], 3):
        raise ValueError("a stored frame is no JPEG of the size that is trained for")
    return np.ascontiguousarray(picture[:, :, ::-1]).astype(np.uint8, copy=False)


def augment(
    frame: StoredFrame, random: Generator, size: tuple[int, int] = WHOLE, *, plain: bool = False
) -> tuple[Picture, Things]:
    """Return a frame as one epoch sees it, in a size (width, height) [px].

    A plain one is mirrored at most.
    """
    picture, things = decode(frame.jpeg), frame.things
    if size != WHOLE:
        picture, things = shrunk(picture, things, size)
    if random.random() < 0.5:
        picture, things = mirror(picture, things)
    if plain:
        return picture, things
    if random.random() < 0.6:
        picture, things = zoom_and_shift(picture, things, random)
    if random.random() < 0.8:
        picture = change_light(picture, random)
    if random.random() < 0.15:
        picture = np.asarray(cv2.GaussianBlur(picture, (3, 3), 0), np.uint8)
    if random.random() < 0.2:
        picture = add_grain(picture, random)
    if random.random() < 0.25:
        picture = recompress(picture, int(random.integers(40, 90)))
    return picture, things


def mirror(picture: Picture, things: Things) -> tuple[Picture, Things]:
    """Swap left and right."""
    swapped = things.copy()
    wide = picture.shape[1]
    swapped[:, 1], swapped[:, 3] = wide - things[:, 3], wide - things[:, 1]
    return np.ascontiguousarray(picture[:, ::-1]), swapped


def zoom_and_shift(picture: Picture, things: Things, random: Generator) -> tuple[Picture, Things]:
    """Zoom and shift; most of the picture stays in view."""
    zoom = float(np.exp(random.uniform(*np.log(ZOOM))))
    # Zoomed in, the window stays within the picture; zoomed out, the picture within the window.
    size = picture.shape[1], picture.shape[0]
    right = (1 - zoom) * size[0] * random.random()
    down = (1 - zoom) * size[1] * random.random()
    matrix = np.array([[zoom, 0.0, right], [0.0, zoom, down]], np.float64)
    shifted = cv2.warpAffine(picture, matrix, size, borderValue=(FILL, FILL, FILL))
    return np.asarray(shifted, np.uint8), clip_boxes(things, zoom, (right, down), size)


def clip_boxes(
    things: Things, zoom: float, off: tuple[float, float], size: tuple[int, int]
) -> Things:
    """Move boxes along and cut them at the edge; what loses most of itself is not judged."""
    new = things.copy()
    new[:, 1:5] = things[:, 1:5] * zoom + np.array([*off, *off], np.float32)
    whole = (new[:, 3] - new[:, 1]) * (new[:, 4] - new[:, 2])
    new[:, [1, 3]] = new[:, [1, 3]].clip(0, size[0])
    new[:, [2, 4]] = new[:, [2, 4]].clip(0, size[1])
    wide, high = new[:, 3] - new[:, 1], new[:, 4] - new[:, 2]
    small = np.minimum(wide, high) < LEAST_PX
    new[small | (wide * high < LEAST_SHARE * whole), 5] = -1
    return new[(wide > 0) & (high > 0)]


def shrunk(picture: Picture, things: Things, size: tuple[int, int]) -> tuple[Picture, Things]:
    """Return a frame in another size (width, height) [px]; what gets too small is not judged."""
    new = things.copy()
    new[:, 1:5] *= np.tile(np.array(size, np.float32) / WHOLE, 2)
    new[np.minimum(new[:, 3] - new[:, 1], new[:, 4] - new[:, 2]) < LEAST_PX, 5] = -1
    less = cv2.resize(picture, size, interpolation=cv2.INTER_AREA)
    return np.asarray(less, np.uint8), new


def change_light(picture: Picture, random: Generator) -> Picture:
    """Change brightness, contrast, gamma and each colour's share a little."""
    ramp = np.arange(256, dtype=np.float64)[:, None] / 255
    ramp = ramp ** np.exp(random.uniform(-0.35, 0.35))
    ramp = (ramp - 0.5) * random.uniform(0.75, 1.25) + 0.5 + random.uniform(-0.12, 0.12)
    ramp = ramp * random.uniform(0.9, 1.1, (1, 3))
    table = (ramp * 255).round().clip(0, 255).astype(np.uint8)
    return np.asarray(cv2.LUT(picture, table[None]), np.uint8)


def add_grain(picture: Picture, random: Generator) -> Picture:
    """Add a sensor's noise."""
    noise = random.standard_normal(picture.shape, np.float32)
    noise *= np.float32(random.uniform(1.0, 7.0))
    noise += picture
    return np.clip(noise + np.float32(0.5), 0, 255).astype(np.uint8)


def recompress(picture: Picture, quality: int) -> Picture:
    """Encode as JPEG once more."""
    _, data = cv2.imencode(".jpg", picture[:, :, ::-1], [cv2.IMWRITE_JPEG_QUALITY, quality])
    return decode(data.tobytes(), (picture.shape[1], picture.shape[0]))
