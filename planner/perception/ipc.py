"""Put detections and the detector's description into the vision process's frames. Pure."""

from __future__ import annotations

from dataclasses import asdict
from typing import Any

from planner.perception.result import DetectorInfo, LookResult
from planner.perception.snapshot import Detection
from processes.worker_protocol import Frame


def look_frame(result: LookResult) -> Frame:
    """Return a result as a frame."""
    return asdict(result), b""


def read_look(frame: Frame) -> LookResult:
    """Return the result that :func:`look_frame` wrote. Raises KeyError, TypeError or ValueError."""
    head, _ = frame
    skipped, depth_lost = head["skipped"], head["depth_lost"]
    return LookResult(
        detections=tuple(map(_detection, head["detections"])),
        width=int(head["width"]),
        height=int(head["height"]),
        took_s=float(head["took_s"]),
        skipped=None if skipped is None else str(skipped),
        depth_lost=None if depth_lost is None else str(depth_lost),
        wide=bool(head["wide"]),
    )


def _detection(item: dict[str, Any]) -> Detection:
    left, top, right, bottom = (float(side) for side in item["box"])
    return Detection(**{**item, "box": (left, top, right, bottom)})


def read_about(head: dict[str, Any] | None) -> DetectorInfo | None:
    """Return the running detector; None without a model. Raises KeyError or TypeError."""
    if head is None:
        return None
    told = {
        "classes": tuple(head["classes"]),
        "words": tuple(map(tuple, head["words"])),
        "beside": read_about(head["beside"]),
    }
    return DetectorInfo(**{**head, **told})
