"""Own the owner's settings about seeing: which detector, how often, with how much of the machine.

Data only. Nothing set is a choice too: the model that comes with Pons, where it is there.
"""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Annotated, Any, Literal, Self, get_args

from pydantic import BaseModel, ConfigDict, Field, model_validator

DecoderName = Literal[
    "yolov5", "yolov8", "end_to_end", "yolox", "yolox_decoded", "rtdetr", "rtdetr_rows", "rfdetr",
    "mmyolo", "detr_logits", "owlvit", "owlv2"
]  # fmt: skip
OPEN = "open"
DECODERS: tuple[str, ...] = get_args(DecoderName)
"""Layouts of outputs that are read; docs/vision.md says who makes which."""
ProviderName = Literal["tensorrt", "cuda", "openvino", "coreml", "cpu"]


class VisionSettings(BaseModel):
    """Hold the owner's settings of the detector and its rate."""

    model_config = ConfigDict(
        frozen=True, extra="forbid", allow_inf_nan=False, hide_input_in_errors=True
    )

    model: Path | None = None
    """A detector's ONNX file, relative to the home folder; None: the one that comes with Pons."""
    detector: Literal["open"] | None = None
    """``open``: the model is an open-vocabulary export and looks beside the detector that comes
    with Pons, for the kinds that one does not know, while a step needs it. None: it alone looks."""
    labels: Path | None = None
    """A file with the model's class names, one a line, where the model does not name them."""
    decoder: DecoderName | None = None
    """How its output is read; None: found out, and said in the log."""
    provider: ProviderName | None = None
    """Where it runs; None: the fastest that the installed onnxruntime offers."""
    threads: Annotated[int, Field(ge=1, le=16)] = 1
    """Of the processor, while it thinks. The bridge needs a core of its own."""
    rate_hz: Annotated[float, Field(ge=1.0, le=30.0)] = 5.0
    """Pictures thought upon in a second, at most. A step that stands and looks waits 6 s for a few
    of them: slower eyes would fail it, and let a thing that is followed walk off."""
    min_score: Annotated[float, Field(ge=0.05, le=0.95)] | None = None
    """What scores less is not reported; None: what the model's file says of each class, or 0.4."""
    search_pictures: Annotated[int | None, Field(ge=0, le=200)] = None
    """Pictures that one ``find`` or ``count`` may show a vision model, for what the detector does
    not know; 0: it is not asked to search; None: as many as the rooms have directions, 24 at least
    and 96 at most."""
    input_px: Annotated[int, Field(ge=32, le=2048, multiple_of=32)] | None = None
    """Width and height of the input of a model that leaves them open."""

    @model_validator(mode="after")
    def _has_a_model(self) -> Self:
        if self.detector == OPEN and self.model is None:
            raise ValueError("detector = 'open' needs model: the ONNX file of that detector")
        return self


FILES = ("model", "labels")


def with_environment(table: object, home: Path, environment: Mapping[str, str]) -> Any:
    """Let PONS_VISION_MODEL and the like win, one for each key; files become absolute.

    A file named in settings.toml is looked for in the home folder, one named by the environment
    where the command was given.
    """
    if not isinstance(table, dict):
        return table  # what is no table is told by whoever checks it
    chosen = dict(table)
    for name in FILES:
        if isinstance(chosen.get(name), str):
            chosen[name] = home / chosen[name]
    for name in VisionSettings.model_fields:
        said = environment.get(f"PONS_VISION_{name.upper()}", "")
        if said:
            chosen[name] = Path(said).absolute() if name in FILES else said
    return chosen
