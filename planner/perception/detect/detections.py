"""Own detections as rows of numbers: believe possible ones only, bring them to the picture.

Few rows are left once a decoder has read its output, and right after a run numpy's calls are cold:
5 to 10 us each. As Python's own numbers a row or two take a quarter of the time. Where several
boxes of one class show one thing, OpenCV leaves one: 0.14 ms for 100 boxes, against 3 ms for a loop
in numpy. It keeps classes apart by shifting each by the largest coordinate, which holds for boxes
inside the picture alone: cut them first.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from math import isfinite

import cv2
import numpy as np
from numpy.typing import NDArray

from planner.perception.detect.preprocess import Floats, Placement

Row = tuple[float, float, float, float, float, int]
"""Left, top, right, bottom [px], score, number of the class."""
MIN_SIDE_PX = 1.0
"""A thinner box shows nothing that a depth or a colour could be read from."""
MAX_ROWS = 1_000
"""Rows that Python's own loops look at; a graph may put out any number of them."""
HIGHEST_SCORE = 1.001
"""One, and what half precision makes of it."""
EDGES: Floats = np.array(
    [[1, 0, 1, 0], [0, 1, 0, 1], [-0.5, 0, 0.5, 0], [0, -0.5, 0, 0.5]], np.float32
)
"""Centre and size times this are left, top, right and bottom."""


def from_centres(cxcywh: Floats) -> Floats:
    """Return left, top, right, bottom of boxes given by centre and size, all finite."""
    return np.asarray(cxcywh[:, :4] @ EDGES)


def rows_of(boxes: Floats, scores: Floats, classes: NDArray[np.integer]) -> list[Row]:
    """Return boxes (n x 4), scores and classes (n) as rows; of very many the strongest alone."""
    if len(scores) > MAX_ROWS:
        best = np.argpartition(scores, -MAX_ROWS)[-MAX_ROWS:]
        boxes, scores, classes = boxes[best], scores[best], classes[best]
    told = zip(boxes.tolist(), scores.tolist(), classes.tolist(), strict=True)
    return [(*box, score, number) for box, score, number in told]


def filter_rows(rows: Iterable[Row], least: Sequence[float]) -> list[Row]:
    """Return rows whose every number is possible; NaN and infinity fail by themselves.

    Args:
        rows: as they were decoded.
        least: how high each class must score, in the model's order.
    """
    return [
        (*row[:4], min(row[4], 1.0), row[5])
        for row in rows
        if 0 <= row[5] < len(least)
        and least[row[5]] <= row[4] <= HIGHEST_SCORE
        and isfinite(row[0] + row[1] + row[2] + row[3])
    ]


def in_picture(rows: Iterable[Row], placed: Placement, width: int, height: int) -> list[Row]:
    """Return the input's boxes as the picture's, cut at its borders, without slivers."""
    found: list[Row] = []
    for left, top, right, bottom, score, number in rows:
        x0 = max(0.0, (left - placed.left) / placed.scale_x)
        y0 = max(0.0, (top - placed.top) / placed.scale_y)
        x1 = min(float(width), (right - placed.left) / placed.scale_x)
        y1 = min(float(height), (bottom - placed.top) / placed.scale_y)
        if x1 - x0 >= MIN_SIDE_PX and y1 - y0 >= MIN_SIDE_PX:
            found.append((x0, y0, x1, y1, score, number))
    return found


MAX_OVERLAP = 0.5
"""Intersection over union above which the weaker box goes."""
MAX_CANDIDATES = 300
MAX_FOUND = 100


def suppress(rows: list[Row], max_overlap: float = MAX_OVERLAP) -> list[Row]:
    """Return the strongest boxes, strongest first. Boxes must lie inside the picture."""
    if len(rows) < 2:
        return rows
    if len(rows) > MAX_CANDIDATES:
        rows = strongest(rows, MAX_CANDIDATES)
    rectangles = [(left, top, right - left, bottom - top) for left, top, right, bottom, *_ in rows]
    scores, classes = [row[4] for row in rows], [row[5] for row in rows]
    kept = cv2.dnn.NMSBoxesBatched(rectangles, scores, classes, 0.0, max_overlap)
    return [rows[at] for at in np.asarray(kept, np.intp).reshape(-1)[:MAX_FOUND].tolist()]


def strongest(rows: list[Row], count: int = MAX_FOUND) -> list[Row]:
    """Return at most so many, the highest scores first."""
    return sorted(rows, key=lambda row: -row[4])[:count]
