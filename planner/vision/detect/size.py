"""Find the picture's input in a model, and its size. Refuses what can't be given."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from planner.vision.detect.names import literal
from planner.vision.detect.session import Slot
from planner.vision.failure import VisionFailure

FLOAT = "tensor(float)"
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


def find_input(
    slots: Sequence[Slot], metadata: Mapping[str, str], input_px: int | None = None
) -> Input:
    """Return a model's input.

    Args:
        slots: its inputs.
        metadata: may say ``imgsz`` where the shape leaves the size open.
        input_px: what the owner sets for such a model.

    Raises:
        VisionFailure: ``model_not_detector``, ``model_input_odd`` or ``model_size_open``.
    """
    pictures = [slot for slot in slots if len(slot.shape) == 4]
    shown = "; ".join(slot.shown() for slot in slots) or "none"
    if not pictures:
        raise VisionFailure("model_not_detector", f"no input takes a picture: {shown}")
    picture, others = pictures[0], [slot for slot in slots if slot is not pictures[0]]
    strangers = [slot for slot in others if slot.name != SIZES or "int64" not in slot.kind]
    if strangers:
        raise VisionFailure("model_input_odd", f"it also wants {strangers[0].shown()}")
    batch, channels = picture.shape[:2]
    if picture.kind != FLOAT or channels != 3 or (isinstance(batch, int) and batch != 1):
        expected = "expected 1 x 3 x height x width, tensor(float)"
        raise VisionFailure("model_input_odd", f"{picture.shown()}; {expected}")
    height, width = _sides(picture, metadata, input_px)
    return Input(picture.name, width, height, SIZES if others else None)


def _sides(picture: Slot, metadata: Mapping[str, str], input_px: int | None) -> tuple[int, int]:
    """Return height and width [px]."""
    height, width = picture.shape[2:]
    if not (isinstance(height, int) and isinstance(width, int)):
        height, width = _open_sides(picture, metadata, input_px)
    low, high = SIDES_PX
    if not (low <= height <= high and low <= width <= high):
        text = f"{picture.shown()}: {width} x {height} px; expected {low} to {high}"
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
    text = f"{picture.shown()}: export it with a fixed size, or set input_px in [vision], as 640"
    raise VisionFailure("model_size_open", text)
