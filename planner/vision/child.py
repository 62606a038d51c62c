"""Be the vision process: ``python -m planner.vision.child PARENT_PID SETTINGS``.

Started by :class:`planner.vision.VisionWorker` and by nobody else. Reads frames on standard input,
answers on standard output, ends when the input ends or the parent dies. Runs at nice 10, because
the bridge's loop and the planner's heartbeat share its cores. Without a model it still shrinks
pictures for whoever asks a model elsewhere.
"""

from __future__ import annotations

import ctypes
import json
import os
import signal
import sys
from dataclasses import asdict
from pathlib import Path
from typing import Any, BinaryIO

from planner.vision.detect import Detector, Wanted, depth_at, shrink, unpack_color, unpack_depth
from planner.vision.failure import VisionFailure
from planner.vision.frames import HEADER, lengths, look_head, pack, unpack

PR_SET_PDEATHSIG = 1  # prctl(2)
NICE = 10
REFUSED = 1


def main(arguments: list[str]) -> int:
    """Open the model, say ready, and answer until the input ends."""
    parent_pid, settings = arguments
    if not _bind_to_parent(int(parent_pid)):
        return REFUSED
    os.nice(NICE)
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # Ctrl-C reaches the group; the parent decides
    answers = os.fdopen(os.dup(1), "wb")
    os.dup2(2, 1)  # what a library prints must not look like a frame
    try:
        detector = _detector(json.loads(settings))
    except VisionFailure as failure:
        _write(answers, pack({"refused": failure.code, "detail": failure.detail}))
        return REFUSED
    about = None if detector is None else asdict(detector.about)
    _write(answers, pack({"ready": about}))
    _serve(detector, sys.stdin.buffer, answers)
    return 0


def _detector(settings: dict[str, Any]) -> Detector | None:
    if settings["path"] is None:
        return None
    min_score = float(settings.pop("min_score"))
    paths = {
        name: None if settings[name] is None else Path(settings[name])
        for name in ("path", "labels")
    }
    return Detector(Wanted(**{**settings, **paths}), min_score)


def _serve(detector: Detector | None, requests: BinaryIO, answers: BinaryIO) -> None:
    while (request := _read(requests)) is not None:
        head, body = request
        number = head["number"]
        if "long_side" in head:
            answer, picture = _shrunk(body, int(head["long_side"]))
            _write(answers, pack({"number": number, **answer}, picture))
        elif "at" in head:
            _write(answers, pack({"number": number, "depth_m": _depth_at(head, body)}))
        elif detector is None:
            _write(answers, pack({"number": number, "failed": "no_detector"}))
        else:
            _write(answers, pack({"number": number, **_looked(detector, head, body)}))


def _looked(detector: Detector, head: dict[str, Any], body: bytes) -> dict[str, Any]:
    cut = int(head["color"])
    width, height = head["size"]
    depth = body[cut:] if head["deep"] else None
    said, focal_px = (int(width), int(height)), float(head["focal"])
    return look_head(detector.look(body[:cut], depth, said, focal_px))


def _depth_at(head: dict[str, Any], body: bytes) -> float | None:
    width, height = head["size"]
    depth = unpack_depth(body, (int(width), int(height)))
    return None if isinstance(depth, str) else depth_at(depth, *map(float, head["at"]))


def _shrunk(body: bytes, long_side: int) -> tuple[dict[str, Any], bytes]:
    picture = unpack_color(body)
    if isinstance(picture, str):
        return {"failed": picture}, b""
    return {}, shrink(picture, long_side)


def _read(stream: BinaryIO) -> tuple[dict[str, Any], bytes] | None:
    header = stream.read(HEADER.size)
    if len(header) < HEADER.size:
        return None
    head, body = lengths(header)
    text, data = stream.read(head), stream.read(body)
    return None if len(text) < head or len(data) < body else (unpack(text), data)


def _write(stream: BinaryIO, data: bytes) -> None:
    stream.write(data)
    stream.flush()


def _bind_to_parent(parent_pid: int) -> bool:
    """Die with the parent from now on; False if it is gone already."""
    if sys.platform == "linux":
        libc = ctypes.CDLL(None, use_errno=True)
        if libc.prctl(PR_SET_PDEATHSIG, signal.SIGKILL, 0, 0, 0) != 0:
            raise OSError(ctypes.get_errno(), "prctl(PR_SET_PDEATHSIG)")
    return os.getppid() == parent_pid


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
