"""Run commands side by side: ``at_once.py COMMAND… ++ COMMAND…``; each one's output stays whole.

The first is shown as it comes, each other one when those before it have ended. Fails if any fails.
Ctrl-C reaches all of them, for they are of one terminal; each cleans up by itself. Knows no test.
``AT_ONCE_LOCK`` names a file to lock for who must wait until the others have ended.
"""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import tempfile
from collections.abc import Sequence
from contextlib import ExitStack
from itertools import groupby
from types import FrameType
from typing import BinaryIO

BETWEEN = "++"
CHUNK_BYTES = 65_536
PAUSE_S = 0.2
INTERRUPTED = 130


def main(words: Sequence[str]) -> int:
    """Run all commands and return the worst exit status."""
    commands = [list(part) for is_end, part in groupby(words, BETWEEN.__eq__) if not is_end]
    interrupts: list[int] = []

    def note(signum: int, _frame: FrameType | None) -> None:
        interrupts.append(signum)

    signal.signal(signal.SIGINT, note)
    with ExitStack() as stack:
        outputs: list[BinaryIO | None] = [None]
        outputs += [stack.enter_context(tempfile.TemporaryFile()) for _ in commands[1:]]
        lock = stack.enter_context(tempfile.NamedTemporaryFile(prefix="at-once-"))
        told = os.environ | {"AT_ONCE_LOCK": lock.name}
        running = [
            subprocess.Popen(
                command, stdin=subprocess.DEVNULL, stdout=output, stderr=output, env=told
            )
            for command, output in zip(commands, outputs, strict=True)
        ]
        signal.signal(signal.SIGTERM, lambda *_: end(running))
        for process, output in zip(running, outputs, strict=True):
            if output is not None:
                show(process, output.fileno())
            process.wait()
    worst = max((abs(process.returncode) for process in running), default=0)
    return INTERRUPTED if interrupts else worst


def end(running: Sequence[subprocess.Popen[bytes]]) -> None:
    """Pass a request to end on to all."""
    for process in running:
        process.terminate()


def show(process: subprocess.Popen[bytes], output: int) -> None:
    """Print what a process has written and what it writes until it ends."""
    at = 0
    while True:
        ended = process.poll() is not None
        while piece := os.pread(output, CHUNK_BYTES, at):
            at += len(piece)
            sys.stdout.buffer.write(piece)
            sys.stdout.flush()
        if ended:
            return
        try:
            process.wait(PAUSE_S)
        except subprocess.TimeoutExpired:
            continue


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
