"""Choose the decoder: by the owner, else metadata, else the outputs' names, else their shapes.

Refuses rather than guesses: boxes read in a wrong layout would be ghosts on the map.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from planner.perception.detect.class_names import literal
from planner.perception.detect.decoders.base import UNTOLD, Decoder, NamedDecoder
from planner.perception.detect.decoders.end_to_end import EndToEnd
from planner.perception.detect.decoders.layout_trial import (
    check_labelled,
    check_scores,
    check_suppressed,
    has_objectness,
    in_doubt,
)
from planner.perception.detect.decoders.logits import DetrLogits, OwlV2, OwlVit
from planner.perception.detect.decoders.mmyolo import MmYolo
from planner.perception.detect.decoders.rfdetr import RfDetr
from planner.perception.detect.decoders.rtdetr import RtDetr
from planner.perception.detect.decoders.rtdetr_rows import RtDetrRows
from planner.perception.detect.decoders.yolov5 import YoloV5
from planner.perception.detect.decoders.yolov8 import YoloV8, is_turned
from planner.perception.detect.decoders.yolox import YoloX
from planner.perception.detect.decoders.yolox_decoded import DecodedYoloX
from planner.perception.detect.model_info import Facts
from planner.perception.failure import VisionFailure

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
