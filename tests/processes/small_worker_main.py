"""Be a small worker that answers, or does as badly as it is told. Sees and knows nothing."""

from __future__ import annotations

import json
import os
import time
from functools import partial
from pathlib import Path
from types import MappingProxyType

from processes.worker_main import ParentPipes, run_worker
from processes.worker_protocol import FailureCodes, Frame, WorkerFailure, pack

IMPORTED_AT_NICE = os.nice(0)
MODULE = "tests.processes.small_worker_main"
SPOILS = {
    "dies": b"",
    "babbles": b"Traceback (most recent call last):\n",
    "says a list": b"\0\0\0\2\0\0\0\0[]",
    "says no number": pack({"nothing": "to see"}),
}
"""What it writes instead of an answer, or before its first word."""


class Trouble(WorkerFailure):
    """Say what went wrong."""

    reasons = MappingProxyType(
        {
            "down": ("it is down", "未运行"),
            "died": ("it died", "已退出"),
            "late": ("it took too long", "超时"),
            "unwilling": ("it does not want to", "拒绝执行"),
        }
    )


CODES = FailureCodes(Trouble, down="down", died="died", timed_out="late")


def main(parent: ParentPipes, told: str) -> int:
    """Say ready, or spoil the first starts in every way there is."""
    wanted = json.loads(told)
    if "refuses" in wanted:
        return parent.refuse(wanted["refuses"], "so there")
    if "log" in wanted and (earlier := _earlier_starts(Path(wanted["log"]))) < len(SPOILS):
        _spoil(parent, [*SPOILS][earlier])
    parent.write({"ready": wanted.get("ready")})
    return parent.serve(partial(_answer, parent))


def _earlier_starts(log: Path) -> int:
    with log.open("ab") as file:
        file.write(b".")
        return file.tell() - 1


def _spoil(parent: ParentPipes, how: str) -> None:
    os.write(parent._answers, SPOILS[how])
    if how == "dies":
        os._exit(3)
    time.sleep(60)


def _answer(parent: ParentPipes, asked: Frame) -> Frame:
    head, body = asked
    time.sleep(head.get("thinks_s", 0.0))
    if head.get("spoils") in SPOILS:
        _spoil(parent, head["spoils"])
    if "fails" in head:
        return {"failed": head["fails"], "detail": "so there"}, b""
    if "unwilling" in head:
        raise Trouble("unwilling", "so there")
    print("not a frame")
    return {} if "spoils" in head else {
        "pid": os.getpid(),
        "imported_at_nice": IMPORTED_AT_NICE,
    }, body[::-1]


if __name__ == "__main__":
    run_worker(main)
