"""Stand in for the vision process where only its life and death are looked at: light, sees nothing.

A model whose name begins with ``dies`` is its end.
"""

from __future__ import annotations

import json
import sys

from planner.vision.frames import HEADER, lengths, look_head, pack, unpack
from planner.vision.result import LookResult


def main() -> int:
    """Say ready and answer nothing seen."""
    if "dies" in str(json.loads(sys.argv[2])["path"]):
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


if __name__ == "__main__":
    sys.exit(main())
