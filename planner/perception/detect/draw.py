"""Draw detections on a picture, for a person's eye."""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path

import cv2

from planner.perception.detect.image_decode import Picture
from planner.perception.snapshot import Detection

LINE = (60, 200, 60)
BEHIND = (30, 30, 30)
FONT = cv2.FONT_HERSHEY_SIMPLEX
TEXT_SCALE = 0.45
ABOVE_PX = 4


def draw_detections(picture: Picture, detections: Iterable[Detection]) -> Picture:
    """Return a copy of a picture with each detection's box, label and score."""
    copy = picture.copy()
    for found in detections:
        left, top, right, bottom = (round(side) for side in found.box)
        cv2.rectangle(copy, (left, top), (right, bottom), LINE, 2)
        words = (found.color, found.label, f"{found.score:.2f}")
        at = (left, max(12, top - ABOVE_PX))
        text = " ".join(filter(None, words))
        for color, thickness in ((BEHIND, 3), (LINE, 1)):  # readable on any ground
            cv2.putText(copy, text, at, FONT, TEXT_SCALE, color, thickness, cv2.LINE_AA)
    return copy


def save(picture: Picture, path: Path) -> bool:
    """Write a picture in the format of the file's name; tell whether that worked."""
    try:
        return bool(cv2.imwrite(str(path), picture))
    except cv2.error:  # no such format
        return False
