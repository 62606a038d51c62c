"""Leave one box where several of one class show one thing. OpenCV does it, class by class.

OpenCV keeps classes apart by shifting each by the largest coordinate, which holds for boxes inside
the picture alone: cut them first. Measured on 100 boxes: 0.14 ms, against 3 ms for a loop in numpy.
"""

from __future__ import annotations

import cv2
import numpy as np

from planner.vision.detect.found import Found

MAX_OVERLAP = 0.5
"""Intersection over union above which the weaker box goes."""
MAX_CANDIDATES = 300
MAX_FOUND = 100


def suppress(found: Found, max_overlap: float = MAX_OVERLAP) -> Found:
    """Return the strongest boxes, strongest first. Boxes must lie inside the picture."""
    if len(found) < 2:
        return found
    if len(found) > MAX_CANDIDATES:
        found = strongest(found, MAX_CANDIDATES)
    rectangles = found.boxes.astype(np.float64)
    rectangles[:, 2:] -= rectangles[:, :2]
    kept = cv2.dnn.NMSBoxesBatched(
        rectangles.tolist(), found.scores.tolist(), found.classes.tolist(), 0.0, max_overlap
    )
    return found.only(np.asarray(kept, np.intp).reshape(-1)[:MAX_FOUND])


def strongest(found: Found, count: int) -> Found:
    """Return at most so many, the highest scores first."""
    if len(found) <= count and (found.scores[:-1] >= found.scores[1:]).all():
        return found
    order = np.argsort(-found.scores, kind="stable")[:count]
    return found.only(order)
