"""Run the perception process: ``planner.perception.process_main SETTINGS``.

Started by :class:`planner.perception.VisionWorker` alone. Without a model it still shrinks
pictures for whoever asks a model elsewhere.
"""

from __future__ import annotations

import json
from dataclasses import asdict
from functools import partial
from pathlib import Path
from typing import Any

from planner.perception.detect import (
    ModelOptions,
    OnnxDetector,
    bound_memory,
    depth_at,
    lay_out,
    scale_down,
    shrink,
    unpack_color,
    unpack_depth,
)
from planner.perception.failure import VisionFailure
from planner.perception.snapshot import look_frame
from processes.worker_main import ParentPipes, run_worker
from processes.worker_protocol import Frame


def main(parent: ParentPipes, settings: str) -> int:
    """Open the model, say ready, and answer until the input ends."""
    try:
        detector = _detector(json.loads(settings))
    except VisionFailure as failure:
        return parent.refuse(failure.code, failure.detail)
    parent.write({"ready": None if detector is None else asdict(detector.about)})
    return parent.serve(partial(_answer, detector))


def _detector(settings: dict[str, Any]) -> OnnxDetector | None:
    if settings["path"] is None:
        return None
    bound_memory(settings["provider"])
    min_score: float | None = settings.pop("min_score")
    own: str | None = settings.pop("own")
    paths = {
        name: None if settings[name] is None else Path(settings[name])
        for name in ("path", "labels")
    }
    wanted = ModelOptions(**{**settings, **paths})
    if own is None:
        return OnnxDetector(wanted, min_score)
    ours = ModelOptions(Path(own), provider=wanted.provider, threads=wanted.threads)
    return OnnxDetector(ours, beside=OnnxDetector(wanted, min_score))


def _answer(detector: OnnxDetector | None, asked: Frame) -> Frame:
    head, body = asked
    if "sheet" in head:
        return {}, _sheet(head, body)
    if "long_side" in head:
        return {}, _shrunk(body, int(head["long_side"]))
    if "at" in head:
        return {"depth_m": _depth_at(head, body)}, b""
    if detector is None:
        raise VisionFailure("no_detector")
    cut, (width, height) = int(head["color"]), head["size"]
    depth = body[cut:] if head["deep"] else None
    said, focal_px = (int(width), int(height)), float(head["focal"])
    return look_frame(detector.look(body[:cut], depth, said, focal_px, wide=bool(head["wide"])))


def _depth_at(head: dict[str, Any], body: bytes) -> float | None:
    width, height = head["size"]
    depth = unpack_depth(body, (int(width), int(height)))
    return None if isinstance(depth, str) else depth_at(depth, *map(float, head["at"]))


def _shrunk(body: bytes, long_side: int) -> bytes:
    picture = unpack_color(body)
    if isinstance(picture, str):
        raise VisionFailure(picture)
    return shrink(picture, long_side)


def _sheet(head: dict[str, Any], body: bytes) -> bytes:
    """Lay out the pictures that stand one behind the other in the body."""
    tiles, at = [], 0
    for label, length in zip(head["sheet"], head["lengths"], strict=True):
        picture = unpack_color(body[at : at + int(length)])
        if isinstance(picture, str):
            raise VisionFailure(picture)
        tiles.append((scale_down(picture, int(head["long_side"])), str(label)))  # not all at once
        at += int(length)
    return lay_out(tiles, int(head["long_side"]))


if __name__ == "__main__":
    run_worker(main)
