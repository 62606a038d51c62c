"""Tell by the trial what names and shapes can't: rows with objectness, and rows that are no boxes.

A row a cell with objectness is one column longer than one without, so with one name too many or too
few each would pass for the other. What settles it is where the numbers of the grey trial lie.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from planner.perception.detect.decoders.base import GRIDS, finite_rows, integral
from planner.perception.detect.decoders.yolox import RAW_REACH
from planner.perception.detect.detections import HIGHEST_SCORE
from planner.perception.detect.model_info import Facts
from planner.perception.detect.preprocess import Floats
from planner.perception.failure import VisionFailure

QUIET, LOUD = 0.005, 0.05
"""Of each cell's best class score in the trial the median. Beside an objectness classes are learnt
on things alone and talk everywhere (a YOLOX: 0.15); without one they are silent where nothing is
(the cells of Pons's own: 0.0000003)."""
SAYING = 0.05
"""The least `min_score`: a row that scores less never becomes a box."""
NEARLY_ZERO = -0.001
FILLED = -1.0
"""What some exporters write into rows that hold nothing; others write zeros."""


def in_doubt(facts: Facts) -> bool:
    """Tell whether the shape is that of rows with objectness and also of rows without."""
    shape = facts.first
    alone = len(facts.outputs) == 1 and len(shape) == 3 and shape[0] == 1 and shape[2] >= 6
    return alone and shape[1] in {facts.cells(strides) for strides in GRIDS} - {0}


def has_objectness(facts: Facts) -> bool | None:
    """Return whether a grid's rows hold an objectness, by the figures alone; None if unclear.

    Boxes that are not in pixels are a YOLOX's raw ones. The heads of those who write ``task`` into
    the metadata have no objectness. Numbers that are all zero say nothing against that.
    """
    if "task" in facts.metadata and not 0.0 < facts.largest <= RAW_REACH:
        return False
    return facts.largest <= RAW_REACH or _by_scores(facts.trial)


def _by_scores(trial: Floats | None) -> bool | None:
    if trial is None:
        return None
    scores = trial[0][finite_rows(trial[0]), 4:]
    if not len(scores):
        return None
    if np.median(scores[:, 1:].max(axis=1)) >= LOUD:
        return True
    # The first column too: in a YOLOv6 it is one everywhere, and no class.
    return False if 0.0 < np.median(scores.max(axis=1)) <= QUIET else None


def check_scores(facts: Facts, name: str, *, in_rows: bool) -> None:
    """Refuse a grid or queries whose scores can't be some in the trial.

    Args:
        facts: of the model.
        name: of the decoder it is to be read with.
        in_rows: a row, not a column, holds one box and then its scores.

    Raises:
        VisionFailure: ``model_layout_unknown``.
    """
    if facts.trial is None:
        return
    scores = facts.trial[0, :, 4:] if in_rows else facts.trial[0, 4:]
    scores = scores[np.isfinite(scores)]
    low, high = float(scores.min(initial=0.0)), float(scores.max(initial=0.0))
    if not (low >= NEARLY_ZERO and high <= HIGHEST_SCORE):
        text = f"as {name} its scores in a trial are from {low:.3g} to {high:.3g}, not 0 to 1"
        raise VisionFailure("model_layout_unknown", text)


def check_suppressed(facts: Facts) -> None:
    """Refuse what has the six columns of boxes where the trial's rows can't be boxes.

    Raises:
        VisionFailure: ``model_not_detector`` or ``model_names_wrong``.
    """
    if facts.trial is not None:
        _check_boxes(facts.trial.reshape(-1, 6), facts)


LABELLED = ("labels", "boxes", "scores")


def check_labelled(facts: Facts) -> None:
    """Refuse outputs named labels, boxes and scores that can't be such in the trial.

    Raises:
        VisionFailure: ``model_layout_unknown``, ``model_not_detector`` or ``model_names_wrong``.
    """
    if not facts.results:
        return
    found = [facts.results[name] for name in LABELLED]
    for name, output in zip(LABELLED, found, strict=True):
        if output.dtype.kind not in "iuf":
            text = f"{name} holds {output.dtype}; expected numbers"
            raise VisionFailure("model_layout_unknown", text)
    labels, boxes, scores = (np.asarray(output, np.float32) for output in found)
    columns = (boxes.reshape(-1, 4), scores.reshape(-1, 1), labels.reshape(-1, 1))
    _check_boxes(np.concatenate(columns, axis=1), facts)


def _check_boxes(rows: Floats, facts: Facts) -> None:
    """Refuse rows of left, top, right, bottom, score, class that can't be finished boxes."""
    rows = rows[finite_rows(rows)]
    scores = rows[:, 4]
    _require_all(rows, (scores >= FILLED) & (scores <= HIGHEST_SCORE), "its score is none")
    rows = rows[scores > 0.0]
    _require_all(rows, integral(rows[:, 5]), "its class is no number of a class")
    told = rows[rows[:, 4] >= SAYING]
    ordered = np.asarray((told[:, :2] <= told[:, 2:4]).all(axis=1))
    _require_all(told, ordered, "its box ends before it begins")
    most = int(rows[:, 5].max(initial=0.0))
    if facts.names and most >= len(facts.names):
        text = f"class {most} came out, counted from 0; {len(facts.names)} names"
        raise VisionFailure("model_names_wrong", text)


def _require_all(rows: Floats, good: NDArray[np.bool_], why: str) -> None:
    if not good.all():
        first = ", ".join(f"{number:.3g}" for number in rows[~good][0])
        raise VisionFailure("model_not_detector", f"a trial picture gave the row {first}: {why}")
