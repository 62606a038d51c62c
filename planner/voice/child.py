"""Be the voice process: ``python -m planner.voice.child``. Started by `VoiceWorker` alone.

The first frame on standard input carries the site's names, each later one a recording; each is
answered on standard output. Ends when the input ends, and so with its parent. Runs at nice 10: the
bridge's loop and the planner's heartbeat share its cores. Decoding holds the interpreter for its
whole length (measured: 0.1 s for each second of speech), which is why it is a process.
"""

from __future__ import annotations

import os
import signal
import sys
from dataclasses import asdict
from typing import TYPE_CHECKING, Any, BinaryIO

from planner.voice.frames import HEADER, lengths, pack, unpack

if TYPE_CHECKING:
    from planner.voice.sphinx import Sphinx

NICE = 10
REFUSED = 1


def main() -> int:
    """Load the recogniser, say ready, and answer until the input ends."""
    os.nice(NICE)
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # Ctrl-C reaches the group; the parent decides
    answers = os.fdopen(os.dup(1), "wb")
    os.dup2(2, 1)  # what a library prints must not look like a frame
    requests = sys.stdin.buffer
    first = _read(requests)
    if first is None:
        return 0
    try:
        from planner.voice.sphinx import Sphinx

        sphinx = Sphinx([str(name) for name in first[0]["names"]])
    except (ImportError, OSError, RuntimeError, ValueError) as error:
        _write(answers, pack({"refused": f"{type(error).__name__}: {error}"}))
        return REFUSED
    _write(answers, pack({"ready": list(sphinx.language.left_out)}))
    _serve(sphinx, requests, answers)
    return 0


def _serve(sphinx: Sphinx, requests: BinaryIO, answers: BinaryIO) -> None:
    while (request := _read(requests)) is not None:
        head, pcm = request
        try:
            heard = asdict(sphinx.hear(pcm, int(head["rate_hz"]), int(head["channels"])))
        except (RuntimeError, ValueError, KeyError) as error:
            heard = {"failed": f"{type(error).__name__}: {error}"}
        _write(answers, pack({"number": head.get("number"), **heard}))


def _read(stream: BinaryIO) -> tuple[dict[str, Any], bytes] | None:
    header = stream.read(HEADER.size)
    if len(header) < HEADER.size:
        return None
    head, body = lengths(header)
    text, pcm = stream.read(head), stream.read(body)
    return None if len(text) < head or len(pcm) < body else (unpack(text), pcm)


def _write(stream: BinaryIO, data: bytes) -> None:
    stream.write(data)
    stream.flush()


if __name__ == "__main__":
    sys.exit(main())
