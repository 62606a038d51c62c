"""Own every reason why a model is refused, a picture is skipped or eyes are down. Data only.

A code is stable; its sentence stands in the catalogue. A skipped picture is no exception: it comes
back as a code inside the answer, and is counted.
"""

from __future__ import annotations

from types import MappingProxyType

from planner.language.catalogue import pair_up
from processes.worker_protocol import WorkerFailure

REFUSALS = pair_up(
    "vision_failure",
    (
        "model_missing",
        "model_unreadable",
        "model_not_onnx",
        "model_truncated",
        "model_too_new",
        "model_broken",
        "model_too_hungry",
        "model_not_detector",
        "model_input_odd",
        "model_size_open",
        "model_layout_unknown",
        "model_decoder_wrong",
        "model_names_missing",
        "model_names_malformed",
        "model_names_wrong",
        "provider_unavailable",
    ),
)
"""Why a model is refused, at the start: a person must act."""

SKIPS = pair_up(
    "vision_failure",
    (
        "picture_not_known",
        "picture_empty",
        "picture_too_large",
        "picture_one_channel",
        "picture_deep",
        "picture_truncated",
        "picture_undecodable",
        "picture_dark",
        "picture_size_wrong",
        "depth_not_known",
        "depth_truncated",
        "depth_undecodable",
        "depth_size_wrong",
        "depth_empty",
        "depth_of_another",
        "detector_failed",
    ),
)
"""Why a picture was not thought upon: it is counted, and the next one is looked at. For
``depth_empty`` it was, without its depth."""

FAILURES = pair_up(
    "vision_failure",
    (
        "no_detector",
        "detector_down",
        "detector_timed_out",
    ),
)
"""Why eyes do not answer."""

REASONS = MappingProxyType({**REFUSALS, **SKIPS, **FAILURES})
"""Every code with its sentence in English and Chinese."""


class VisionFailure(WorkerFailure):
    """Say why there is no look: a model that is refused, a process that is down."""

    reasons = REASONS
