"""Find the picture's input in a model, and its size. Refuses what can't be given."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Literal

import numpy as np

from planner.perception.detect.class_names import literal
from planner.perception.detect.session import Array, Slot
from planner.perception.failure import VisionFailure

FLOAT, BYTES = "tensor(float)", "tensor(uint8)"
EXPECTED = (
    f"expected 1 x 3 x height x width or 3 x height x width, {FLOAT}, "
    f"or 1 x height x width x 3, {BYTES}"
)
EXPECTED_BESIDE = "beside the picture only its size may be wanted, as orig_target_sizes 1 x 2"
CHANNELS = "channels"
"""In a model's metadata: ``bgr`` where its bytes are blue green red."""
SIDES_PX = (32, 2048)
SIZES = re.compile(r"(?:orig(?:inal)?|target|image)_.*sizes?|sizes?")
"""Names of the input that asks how large the picture was: ``orig_target_sizes`` (RT-DETR, D-FINE,
DEIM), ``orig_target_size`` (LightlyTrain), ``target_sizes`` and the like."""
NUMBERS = {
    "tensor(int64)": np.int64,
    "tensor(int32)": np.int32,
    "tensor(float)": np.float32,
    "tensor(float16)": np.float16,
}


@dataclass(frozen=True, slots=True)
class Input:
    """Hold where the picture goes in."""

    name: str
    width: int
    height: int
    sizes: Slot | None
    """The input that asks for the picture's size, where there is one (RT-DETR, D-FINE)."""
    bytes_in: Literal["rgb", "bgr"] | None = None
    """The order of its channels where it takes a picture's bytes and scales them by itself, row by
    row; None where it takes planes of floats as its family wants them."""
    batched: bool = True
    """The picture stands in a batch of one; else its planes are all that goes in."""


def find_input(
    slots: Sequence[Slot], metadata: Mapping[str, str], input_px: int | None = None
) -> Input:
    """Return a model's input.

    Args:
        slots: its inputs.
        metadata: may say ``imgsz`` where the shape leaves the size open, and ``channels``.
        input_px: what the owner sets for such a model.

    Raises:
        VisionFailure: ``model_not_detector``, ``model_input_odd`` or ``model_size_open``.
    """
    pictures = [slot for slot in slots if len(slot.shape) == 4]
    pictures = pictures or [slot for slot in slots if len(slot.shape) == 3 and slot.shape[0] == 3]
    shown = "; ".join(slot.describe() for slot in slots) or "none"
    if not pictures:
        raise VisionFailure("model_not_detector", f"no input takes a picture: {shown}")
    picture, others = pictures[0], [slot for slot in slots if slot is not pictures[0]]
    sizes = next(filter(_asks_size, others), None)
    strangers = [slot for slot in others if slot is not sizes]
    if strangers:
        text = f"it also wants {strangers[0].describe()}; {EXPECTED_BESIDE}"
        raise VisionFailure("model_input_odd", text)
    *batch, first, second, third = picture.shape
    planes = picture.kind == FLOAT and first == 3
    if not (planes or (picture.kind == BYTES and third == 3)) or not all(map(_may_be_one, batch)):
        raise VisionFailure("model_input_odd", f"{picture.describe()}; {EXPECTED}")
    sides = (second, third) if planes else (first, second)
    height, width = _sides(picture, sides, metadata, input_px)
    bytes_in = None if planes else _order(metadata)
    return Input(picture.name, width, height, sizes, bytes_in, batched=bool(batch))


def without_batch(picture: Array, taken: Input) -> Array:
    """Return a picture as the model takes it, from a batch of one; both share their memory."""
    return picture if taken.batched else picture[0]


def _asks_size(slot: Slot) -> bool:
    """Tell whether an input takes one width and height."""
    *pictures, two = slot.shape or (0,)
    one = not pictures or (len(pictures) == 1 and _may_be_one(pictures[0]))
    return one and two == 2 and slot.kind in NUMBERS and bool(SIZES.fullmatch(slot.name))


def _may_be_one(count: int | str | None) -> bool:
    """Tell whether a number of pictures is one or left open."""
    return not isinstance(count, int) or count == 1


def _order(metadata: Mapping[str, str]) -> Literal["rgb", "bgr"]:
    return "bgr" if metadata.get(CHANNELS, "").lower() == "bgr" else "rgb"


def _sides(
    picture: Slot,
    told: tuple[int | str | None, int | str | None],
    metadata: Mapping[str, str],
    input_px: int | None,
) -> tuple[int, int]:
    """Return height and width [px]; ``told``: as the shape has them."""
    height, width = told
    if not (isinstance(height, int) and isinstance(width, int)):
        height, width = _open_sides(picture, metadata, input_px)
    low, high = SIDES_PX
    if not (low <= height <= high and low <= width <= high):
        text = f"{picture.describe()}: {width} x {height} px; expected {low} to {high}"
        raise VisionFailure("model_input_odd", text)
    return height, width


def _open_sides(
    picture: Slot, metadata: Mapping[str, str], input_px: int | None
) -> tuple[int, int]:
    """Return height and width from the metadata, else from the owner; never from a guess."""
    said = literal(metadata.get("imgsz", ""))
    if isinstance(said, int):
        return said, said
    if isinstance(said, list | tuple) and len(said) == 2:
        height, width = said
        if isinstance(height, int) and isinstance(width, int):
            return height, width
    if input_px is not None:
        return input_px, input_px
    text = f"{picture.describe()}: export it with a fixed size, or set input_px in [vision], as 640"
    raise VisionFailure("model_size_open", text)
