"""Find the picture's input in a model, and its size. Refuses what can't be given."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Literal

from planner.perception.detect.class_names import literal
from planner.perception.detect.session import Slot
from planner.perception.failure import VisionFailure

FLOAT, BYTES = "tensor(float)", "tensor(uint8)"
EXPECTED = f"expected 1 x 3 x height x width, {FLOAT}, or 1 x height x width x 3, {BYTES}"
CHANNELS = "channels"
"""In a model's metadata: ``bgr`` where its bytes are blue green red."""
SIDES_PX = (32, 2048)
SIZES = "orig_target_sizes"


@dataclass(frozen=True, slots=True)
class Input:
    """Hold where the picture goes in."""

    name: str
    width: int
    height: int
    sizes: str | None
    """The input that asks for the picture's size, where there is one (RT-DETR, D-FINE)."""
    bytes_in: Literal["rgb", "bgr"] | None = None
    """The order of its channels where it takes a picture's bytes and scales them by itself, row by
    row; None where it takes planes of floats as its family wants them."""


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
    shown = "; ".join(slot.describe() for slot in slots) or "none"
    if not pictures:
        raise VisionFailure("model_not_detector", f"no input takes a picture: {shown}")
    picture, others = pictures[0], [slot for slot in slots if slot is not pictures[0]]
    strangers = [slot for slot in others if slot.name != SIZES or "int64" not in slot.kind]
    if strangers:
        raise VisionFailure("model_input_odd", f"it also wants {strangers[0].describe()}")
    axis = {FLOAT: 1, BYTES: 3}.get(picture.kind)
    batch = picture.shape[0]
    if axis is None or picture.shape[axis] != 3 or (isinstance(batch, int) and batch != 1):
        raise VisionFailure("model_input_odd", f"{picture.describe()}; {EXPECTED}")
    height, width = _sides(picture, 2 if axis == 1 else 1, metadata, input_px)
    sizes = SIZES if others else None
    return Input(picture.name, width, height, sizes, None if axis == 1 else _order(metadata))


def _order(metadata: Mapping[str, str]) -> Literal["rgb", "bgr"]:
    return "bgr" if metadata.get(CHANNELS, "").lower() == "bgr" else "rgb"


def _sides(
    picture: Slot, first: int, metadata: Mapping[str, str], input_px: int | None
) -> tuple[int, int]:
    """Return height and width [px], which stand in the shape from ``first`` on."""
    height, width = picture.shape[first : first + 2]
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
