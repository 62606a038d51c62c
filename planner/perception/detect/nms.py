"""Leave one box where several of one class show one thing. OpenCV does it, class by class.

OpenCV keeps classes apart by shifting each by the largest coordinate, which holds for boxes inside
the picture alone: cut them first. Measured on 100 boxes: 0.14 ms, against 3 ms for a loop in numpy.
"""

from __future__ import annotations

import cv2
import numpy as np

from planner.perception.detect.detections import Row

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
