"""Open a model file: refuse it clearly, or return a session that was tried and a fitting decoder.

One trial picture, all grey, is run before anything is chosen: it warms the session up, and the
shapes that come out count where those in the file are left open.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from planner.perception.detect.class_names import BESIDE, names_in, names_of
from planner.perception.detect.decoders import Choice, choose
from planner.perception.detect.decoders.base import Facts, Shape
from planner.perception.detect.input_size import NUMBERS, Input, find_input, without_batch
from planner.perception.detect.onnx_file import OnnxFile, examine
from planner.perception.detect.session import (
    FRACTIONS,
    RUN_ERRORS,
    Array,
    ModelSession,
    is_starved,
    kind_of,
    last_words,
    senseless,
)
from planner.perception.failure import VisionFailure

GREY = 0.5


@dataclass(frozen=True, slots=True)
class ModelOptions:
    """Hold the owner's settings of a model."""

    path: Path
    labels: Path | None = None
    decoder: str | None = None
    provider: str | None = None
    threads: int = 1
    input_px: int | None = None


@dataclass(frozen=True, slots=True)
class Model:
    """Hold a model that is ready to look."""

    name: str
    file: OnnxFile
    session: ModelSession
    input: Input
    choice: Choice
    words: tuple[tuple[str, ...], ...]
    """All that people may call each class, where more than one name was given."""
    beside: dict[str, Array]
    """What it is fed beside the picture."""


def open_model(wanted: ModelOptions) -> Model:
    """Return the model of a file.

    Raises:
        VisionFailure: a code of :data:`planner.perception.failure.REFUSALS`.
    """
    file = examine(wanted.path)
    session = ModelSession(wanted.path, file, wanted.threads, wanted.provider)
    taken = find_input(session.inputs, session.metadata, wanted.input_px)
    beside: dict[str, Array] = {}
    if taken.sizes is not None:
        # A square: one maker wants width and height, another height and width, and none says so.
        side = np.full(2, told_side_px(taken), NUMBERS[taken.sizes.kind])
        beside[taken.sizes.name] = side if len(taken.sizes.shape) == 1 else side[None]
    outputs = _run_trial(session, taken, beside)
    facts, words = _facts(wanted, session, taken, outputs)
    choice = choose(facts, wanted.decoder)
    try:
        choice.decoder.decode(outputs, GREY)
    except RUN_ERRORS as error:
        text = f"as {choice.decoder.NAME}: {last_words(error)}"
        raise VisionFailure("model_layout_unknown", text) from None
    return Model(wanted.path.name, file, session, taken, choice, words, beside)


def told_side_px(taken: Input) -> int:
    """Return the side of the square picture that a model is told of."""
    return max(taken.width, taken.height)


def _run_trial(session: ModelSession, taken: Input, beside: dict[str, Array]) -> Sequence[Array]:
    """Return the outputs for a grey picture; refuse those that can't be boxes of any layout."""
    try:
        outputs = session.run({taken.name: _grey(taken), **beside})
    except RUN_ERRORS as error:
        if is_starved(error):
            raise VisionFailure("model_too_hungry", "on a trial picture") from None
        text = f"it failed on a trial picture: {last_words(error)}"
        raise VisionFailure("model_broken", text) from None
    if not any(kind_of(found) == FRACTIONS for found in outputs):
        shown = "; ".join(slot.describe() for slot in session.outputs)
        raise VisionFailure(
            "model_not_detector", f"no output holds fractions, as scores are: {shown}"
        )
    if senseless(outputs):
        raise VisionFailure("model_broken", "on a trial picture no number came out that is finite")
    return outputs


def _grey(taken: Input) -> Array:
    """Return a grey picture as the model takes one."""
    if taken.bytes_in is None:
        return without_batch(np.full((1, 3, taken.height, taken.width), GREY, np.float32), taken)
    return np.full((1, taken.height, taken.width, 3), round(255 * GREY), np.uint8)


def _facts(
    wanted: ModelOptions, session: ModelSession, taken: Input, outputs: Sequence[Array]
) -> tuple[Facts, tuple[tuple[str, ...], ...]]:
    """Return the facts of a model, and what people may call its classes."""
    labels = wanted.labels or _labels_beside(wanted.path)
    named = names_in(session.metadata) if labels is None else names_of(labels)
    results = dict(zip((slot.name for slot in session.outputs), outputs, strict=True))
    facts = Facts(
        outputs={name: _shape(found) for name, found in results.items()},
        metadata=session.metadata,
        names=named.ids,
        names_from="metadata" if labels is None else "labels",
        width=taken.width,
        height=taken.height,
        largest=_largest(outputs[0]),
        trial=_numbers(outputs[0]),
        promised=session.outputs[0].shape,
        results=results,
        told_side_px=told_side_px(taken) if taken.sizes is not None else None,
    )
    return facts, named.words


def _labels_beside(model: Path) -> Path | None:
    """Return the labels file that lies beside a model under its name, if one does."""
    beside = model.with_suffix(BESIDE)
    return beside if beside.is_file() else None


def _largest(found: object) -> float:
    """Return the largest number by size; NaN where one is none or there are none."""
    if isinstance(found, np.ndarray) and found.dtype.kind == "f" and found.size:
        return float(np.abs(found).max())
    return float("nan")


def _numbers(found: object) -> NDArray[np.float32] | None:
    """Return an output of numbers as single precision; None where it is another."""
    if isinstance(found, np.ndarray) and found.dtype.kind == "f" and found.size:
        return np.asarray(found, np.float32)
    return None


def _shape(found: object) -> Shape:
    """Return an output's shape; that of a lone number where it is no tensor."""
    return found.shape if isinstance(found, np.ndarray) else ()
