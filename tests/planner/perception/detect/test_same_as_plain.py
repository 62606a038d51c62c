"""What is quick finds what is plain: each step again, pixel by pixel and row by row as it is told.

Nothing here is shared with what it judges but the model's run, OpenCV's resizing and the table of
colours.
"""

from __future__ import annotations

from itertools import product
from math import ceil, exp
from pathlib import Path
from typing import Any, cast

import cv2
import numpy as np
import pytest
from numpy.typing import NDArray

from planner.perception.color_classifier import IDS, _table
from planner.perception.detect import ModelOptions, OnnxDetector
from planner.perception.detect.decoders import ALL
from planner.perception.detect.decoders.base import Facts
from planner.perception.detect.detections import filter_rows
from planner.perception.detect.pictures import Picture

Box = tuple[float, float, float, float]
Row = tuple[float, int, Box]
"""Score, class, box."""
LEAST = 0.4
SIDE = 64
STRIDES = (8, 16, 32)


def corners(x: float, y: float, wide: float, high: float) -> Box:
    return x - wide / 2, y - high / 2, x + wide / 2, y + high / 2


def raw_yolox(out: NDArray[np.float32], width: int, height: int) -> list[Row]:
    """Read a raw grid cell by cell."""
    cells = [
        (column, line, stride)
        for stride in STRIDES
        for line, column in product(range(height // stride), range(width // stride))
    ]
    rows: list[Row] = []
    for (column, line, stride), row in zip(cells, out.astype(np.float64), strict=True):
        if not row[4] >= LEAST:  # a class's score is one at most
            continue
        number = int(row[5:].argmax())
        score = float(row[4] * row[5 + number])
        if np.isfinite(row).all() and score >= LEAST:
            x, y = (row[0] + column) * stride, (row[1] + line) * stride
            rows.append((score, number, corners(x, y, exp(row[2]) * stride, exp(row[3]) * stride)))
    return rows


def rows_of_cells(out: NDArray[np.float32], objectness: int) -> list[Row]:
    """Read rows of a box by its middle, objectness where there is one, and class scores."""
    rows: list[Row] = []
    for row in out.astype(np.float64):
        number = int(row[4 + objectness :].argmax())
        score = float(row[4 + objectness + number] * (row[4] if objectness else 1.0))
        if np.isfinite(row).all() and score >= LEAST:
            rows.append((score, number, corners(*row[:4])))
    return rows


def overlap(one: Box, other: Box) -> float:
    wide = min(one[2], other[2]) - max(one[0], other[0])
    high = min(one[3], other[3]) - max(one[1], other[1])
    both = max(0.0, wide) * max(0.0, high)
    areas = [(it[2] - it[0]) * (it[3] - it[1]) for it in (one, other)]
    return both / (sum(areas) - both)


def plainly(detector: OnnxDetector, picture: Picture) -> list[Row]:
    """Return what a YOLOX sees: fit in, run, read, cut, suppress."""
    about = detector.about
    scale = min(about.width / picture.shape[1], about.height / picture.shape[0])
    size = round(picture.shape[1] * scale), round(picture.shape[0] * scale)
    canvas = np.full((about.height, about.width, 3), 114, np.float32)
    canvas[: size[1], : size[0]] = cv2.resize(picture, size)
    blob = canvas.transpose(2, 0, 1)[None].copy()
    outputs = detector.model.session.run({detector.model.input.name: blob})
    limits = (picture.shape[1], picture.shape[0]) * 2
    scales = (size[0] / picture.shape[1], size[1] / picture.shape[0]) * 2
    kept: list[Row] = []
    for score, number, box in sorted(
        raw_yolox(cast("Any", outputs[0][0]), about.width, about.height), reverse=True
    ):
        left, top, right, bottom = (
            min(max(side / by, 0.0), limit)
            for side, by, limit in zip(box, scales, limits, strict=True)
        )
        cut = (left, top, right, bottom)
        rivals = (it for it in kept if it[1] == number)
        if min(right - left, bottom - top) >= 1.0 and all(
            overlap(cut, it[2]) <= 0.5 for it in rivals
        ):
            kept.append((score, number, cut))
    return kept


def color(picture: Picture, box: Box) -> str | None:
    """Return the colour of a box's middle as it is told: brighten, then let each pixel vote."""
    bright = float(np.percentile(picture[::16, ::16].max(axis=2), 90))
    gain = np.float32(min(4.0, max(1.0, 235.0 / max(1.0, bright))))

    def part(low: float, high: float, limit: int) -> slice:
        first = min(max(0, int(low + 0.25 * (high - low))), limit - 1)
        last = min(max(first + 1, ceil(low + 0.75 * (high - low))), limit)
        return slice(first, last, ceil((last - first) / 32))

    height, width = picture.shape[:2]
    pixels = picture[part(box[1], box[3], height), part(box[0], box[2], width)].reshape(-1, 3)
    lit = np.minimum(pixels * gain, np.float32(255.0)).astype(int) // 8
    votes = [0] * len(IDS)
    for blue, green, red in lit.tolist():
        votes[int(_table()[blue * 1024 + green * 32 + red])] += 1
    most, count = max(votes), len(pixels)
    first = IDS[votes.index(most)]
    if count < 4 or (first != "white" and most >= 0.4 * count):
        return first if count >= 4 else None
    paints = {it: n for it, n in zip(IDS, votes, strict=True) if it not in ("white", "gray")}
    paint = max(paints, key=lambda it: paints[it])
    if paints[paint] >= max(0.15 * count, 0.4 * (count - votes[IDS.index("white")])):
        return paint
    return first if most >= 0.4 * count else None


def test_photographs_show_what_they_show_by_the_plain_way(shared_data: Path) -> None:
    models = shared_data / "models"
    detector = OnnxDetector(ModelOptions(models / "yolox_nano.onnx", models / "coco_classes.txt"))
    things = 0
    for path in sorted((shared_data / "images").glob("*.jpg"))[1:5]:
        picture = cast("Picture", cv2.imread(str(path)))
        small = cast("Picture", cv2.resize(picture, (320, 240), interpolation=cv2.INTER_AREA))
        for seen in (picture, small):
            found, plain = detector.find(seen), plainly(detector, seen)
            assert [it.label for it in found] == [detector.about.classes[row[1]] for row in plain]
            for it, (score, _, box) in zip(found, plain, strict=True):
                assert it.score == pytest.approx(score, abs=1e-5)
                assert it.box == pytest.approx(box, abs=1e-2)
                assert it.color == color(seen, it.box)
            things += len(found)
    assert things > 10


@pytest.mark.parametrize("bad", [0.5, np.nan, np.inf, -np.inf])
@pytest.mark.parametrize("name", ["yolov8", "yolov5", "yolox"])
def test_any_output_is_read_as_row_by_row(name: str, bad: float) -> None:
    """A few numbers are spoilt, wherever they stand."""
    rng = np.random.default_rng(7)
    count = sum((SIDE // stride) ** 2 for stride in STRIDES) * (3 if name == "yolov5" else 1)
    objectness = 0 if name == "yolov8" else 1
    rows = rng.uniform(0.0, 1.0, (count, 4 + objectness + 3)).astype(np.float32) ** 2
    rows[rng.integers(0, count, 9), rng.integers(0, rows.shape[1], 9)] = bad
    out = rows.T[None] if name == "yolov8" else rows[None]
    facts = Facts({"out": out.shape}, {}, ("a", "b", "c"), "labels", SIDE, SIDE)
    with np.errstate(invalid="ignore"):
        found = filter_rows(ALL[name](facts).decode([out], LEAST), [LEAST] * 3)
        plain = raw_yolox(rows, SIDE, SIDE) if name == "yolox" else rows_of_cells(rows, objectness)
    assert len(plain) > 10
    assert [row[5] for row in found] == [row[1] for row in plain]
    assert np.allclose([row[4] for row in found], [row[0] for row in plain], atol=1e-6)
    assert np.allclose([row[:4] for row in found], [row[2] for row in plain], rtol=1e-5, atol=1e-4)
