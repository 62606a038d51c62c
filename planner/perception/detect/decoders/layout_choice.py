"""Choose the decoder: by the owner, else metadata, else the outputs' names, else their shapes.

Refuses rather than guesses: boxes read in a wrong layout would be ghosts on the map. What names and
shapes can't tell, the trial does: a row a cell with objectness is one column longer than one
without, so with one name too many or too few each would pass for the other, and where the numbers
of the grey trial lie settles it.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from planner.perception.detect.class_names import literal
from planner.perception.detect.decoders.base import (
    GRIDS,
    UNTOLD,
    Decoder,
    Facts,
    NamedDecoder,
    finite_rows,
    integral,
)
from planner.perception.detect.decoders.detr import (
    DetrLogits,
    OwlV2,
    OwlVit,
    RfDetr,
    RtDetr,
    RtDetrRows,
)
from planner.perception.detect.decoders.yolo import (
    RAW_REACH,
    DecodedYoloX,
    EndToEnd,
    MmYolo,
    YoloV5,
    YoloV8,
    YoloX,
    is_turned,
)
from planner.perception.detect.detections import HIGHEST_SCORE
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


Kind = type[Decoder]
ALL: dict[str, Kind] = {
    kind.NAME: kind
    for kind in (
        *(YoloV5, YoloV8, EndToEnd, YoloX, DecodedYoloX, RtDetr, RtDetrRows, RfDetr),
        *(MmYolo, DetrLogits, OwlVit, OwlV2),
    )
}
BY_CLASSES: tuple[Kind, ...] = (YoloV8, YoloV5, YoloX, DecodedYoloX)
"""Told apart by how many classes their shape makes beside how many names there are."""
BY_NAMES: tuple[type[NamedDecoder], ...] = (MmYolo, RtDetr, RfDetr, OwlV2, OwlVit, DetrLogits)
"""In this order: of outputs that several know, the one that asks for most is first."""
BY_SHAPE: tuple[Kind, ...] = (YoloV5, YoloX, DecodedYoloX, YoloV8, EndToEnd)
DETECT = "detect"


@dataclass(frozen=True, slots=True)
class Choice:
    """Hold the decoder, why it is this one, and the classes it will report."""

    decoder: Decoder
    why: str
    classes: tuple[str, ...]


def choose(facts: Facts, wanted: str | None = None) -> Choice:
    """Return the decoder for a model.

    Raises:
        VisionFailure: ``model_decoder_wrong``, ``model_not_detector``, ``model_layout_unknown``,
            ``model_names_missing`` or ``model_names_wrong``.
    """
    kind, why = _set(facts, wanted) or _by_metadata(facts) or _by_names(facts) or _by_shape(facts)
    classes = _classes(kind, facts)
    if kind is EndToEnd:
        check_suppressed(facts)
    elif kind in (RtDetr, MmYolo):
        check_labelled(facts)
    elif kind not in BY_NAMES:
        check_scores(facts, kind.NAME, in_rows=kind is not YoloV8 or is_turned(facts))
    return Choice(kind(facts), why, classes)


def _set(facts: Facts, wanted: str | None) -> tuple[Kind, str] | None:
    """Take the decoder that the owner, or else the metadata, names outright."""
    for name, who in ((wanted, "settings"), (facts.metadata.get("decoder"), "metadata")):
        if name is None:
            continue
        kind = ALL.get(name)
        if kind is None:
            text = f"{who}: decoder {name[:40]!r}; known: {', '.join(ALL)}"
            raise VisionFailure("model_decoder_wrong", text)
        if kind.classes_of(facts) is None:
            text = f"{who}: decoder {name!r}; outputs: {facts.describe()}"
            raise VisionFailure("model_decoder_wrong", text)
        return kind, f"{who}: decoder = {name}"
    return None


def _by_metadata(facts: Facts) -> tuple[Kind, str] | None:
    task = facts.metadata.get("task", DETECT)
    if task != DETECT:
        raise VisionFailure("model_not_detector", f"its metadata says: task = {task[:40]}")
    if _suppresses(facts) and EndToEnd.classes_of(facts) is not None:
        return EndToEnd, "metadata: it suppresses by itself"
    if _is_rtdetr(facts) and RtDetrRows.classes_of(facts) is not None:
        return RtDetrRows, "metadata: described as RT-DETR"
    if not facts.names:
        return None
    fitting = [kind for kind in _choose_kinds(BY_CLASSES, facts) if _fits(kind, facts)]
    if len(fitting) != 1:
        return None
    return fitting[0], f"{facts.names_from}: {len(facts.names)} names; output {facts.describe()}"


def _choose_kinds(kinds: Sequence[Kind], facts: Facts) -> list[Kind]:
    """Return the kinds of that shape; of a grid's two readings the one that the trial tells."""
    fitting = [kind for kind in kinds if kind.classes_of(facts) is not None]
    if not in_doubt(facts):
        return fitting
    objectness = has_objectness(facts)
    if objectness is None:
        either = " or ".join(f"{kind.NAME} ({kind.classes_of(facts)} classes)" for kind in fitting)
        text = f"{facts.describe()} may be {either}, names alone don't tell: set [vision] decoder"
        raise VisionFailure("model_layout_unknown", text)
    return [kind for kind in fitting if objectness is (kind is not YoloV8)]


def _fits(kind: Kind, facts: Facts) -> bool:
    return kind.classes_of(facts) == len(facts.names)


def _suppresses(facts: Facts) -> bool:
    options = literal(facts.metadata.get("args", ""))
    asked = isinstance(options, dict) and options.get("nms") is True
    return asked or facts.metadata.get("end2end", "").lower() == "true"


def _is_rtdetr(facts: Facts) -> bool:
    # Two classes make rows of six, as a YOLO has that suppresses by itself: the shape can't tell.
    return "rtdetr" in facts.metadata.get("description", "").lower().replace("-", "")


def _by_names(facts: Facts) -> tuple[Kind, str] | None:
    named = [kind for kind in BY_NAMES if all(name in facts.outputs for name in kind.OUTPUTS)]
    for kind in named:
        if kind.classes_of(facts) is not None:
            return kind, f"outputs are named {', '.join(facts.outputs)}"
    if named:
        told = "; or ".join(f"for {kind.NAME} {kind.EXPECTED}" for kind in named)
        text = f"outputs: {facts.describe()}; expected {told}"
        raise VisionFailure("model_layout_unknown", text)
    return None


def _by_shape(facts: Facts) -> tuple[Kind, str]:
    for kind in _choose_kinds(BY_SHAPE, facts):
        # One row for each picture is a classifier's: what suppresses has as many as it finds.
        if kind is not EndToEnd or facts.promised[:-1] != (1,):
            return kind, f"shape: {facts.describe()}"
    if all(len(shape) < 3 for shape in facts.outputs.values()):
        raise VisionFailure("model_not_detector", f"outputs: {facts.describe()}")
    if facts.width % 32 or facts.height % 32:
        text = f"no grid fits {facts.width} x {facts.height} px; outputs: {facts.describe()}"
        raise VisionFailure("model_input_odd", text)
    text = f"outputs: {facts.describe()}; {len(facts.names)} class names; known: {', '.join(ALL)}"
    raise VisionFailure("model_layout_unknown", text)


def _classes(kind: Kind, facts: Facts) -> tuple[str, ...]:
    """Return the names, as many as the model has classes."""
    count, names = kind.classes_of(facts), facts.names
    if not any(names):
        many = f"it has {count}; " if count else ""
        text = f"{many}give a file with one name a line as [vision] labels"
        raise VisionFailure("model_names_missing", text)
    if count is None or count == UNTOLD:
        return names
    if not count - kind.SPARE <= len(names) <= count:
        rivals = [other.NAME for other in BY_CLASSES if other is not kind and _fits(other, facts)]
        unless = f"; if it is a {rivals[0]}, set that as [vision] decoder" if rivals else ""
        text = f"as {kind.NAME} it has {count} classes, {len(names)} names{unless}"
        if not names[0] and len(names) == count + 1:
            text = f"as {kind.NAME} it has {count} classes, and none of its names has the number 0"
            text = f"{text}; expected 0 to {count - 1}, not 1 to {count}: give [vision] labels"
        raise VisionFailure("model_names_wrong", text)
    return names + ("",) * (count - len(names))
