"""Stand in for the vision process where only its life and death are looked at: light, sees nothing.

A model whose name begins with ``dies`` is its end, until its file holds as many bytes as the name
says (``dies4``): each death adds one.
"""

from __future__ import annotations

import json
import sys
from pathlib import Path

from planner.vision.frames import HEADER, lengths, look_head, pack, unpack
from planner.vision.result import LookResult


def main() -> int:
    """Say ready and answer nothing seen."""
    if _dies(Path(json.loads(sys.argv[2])["path"])):
        return 1
    answers, requests = sys.stdout.buffer, sys.stdin.buffer
    answers.write(pack({"ready": None}))
    answers.flush()
    while len(header := requests.read(HEADER.size)) == HEADER.size:
        head, body = lengths(header)
        number = unpack(requests.read(head))["number"]
        requests.read(body)
        answers.write(pack({"number": number, **look_head(LookResult((), 1, 1, 0.0))}))
        answers.flush()
    return 0


def _dies(model: Path) -> bool:
    if not model.stem.startswith("dies"):
        return False
    with model.open("ab") as file:
        file.write(b".")
        return file.tell() <= int(model.stem.removeprefix("dies"))


if __name__ == "__main__":
    sys.exit(main())
