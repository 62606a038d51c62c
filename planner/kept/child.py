"""Be a kept process: frames in, frames out, work while nobody asks.

Standard output is kept for frames alone. ``begin`` has bound it to its parent and stepped back.
"""

from __future__ import annotations

import os
import signal
import sys
from collections.abc import Callable, Iterable
from select import select
from typing import Any, NoReturn

from planner.kept.failure import Failure
from planner.kept.frames import HEADER, Frame, lengths, pack, unpack

REFUSED = 1
DONE = object()


class Parent:
    """Hold both pipes to the process that started this one."""

    def __init__(self, requests: int, answers: int) -> None:
        """Take the descriptors to read from and to write to."""
        self._requests, self._answers = requests, answers

    def read(self) -> Frame | None:
        """Return the next frame, or None at the end of the input."""
        header = self._exactly(HEADER.size)
        if header is None:
            return None
        head, body = lengths(header)
        text, data = self._exactly(head), self._exactly(body)
        return None if text is None or data is None else (unpack(text), data)

    def write(self, head: dict[str, Any], *bodies: bytes) -> None:
        """Send one frame."""
        view = memoryview(pack(head, *bodies))
        while view:
            view = view[os.write(self._answers, view) :]

    def refuse(self, code: str, detail: str) -> int:
        """Say why this process can't do its work at all; return what to exit with."""
        self.write({"refused": code, "detail": detail})
        return REFUSED

    def serve(self, answer: Callable[[Frame], Frame], idle: Iterable[object] = ()) -> int:
        """Answer until the input ends; return what to exit with.

        Args:
            answer: returns the answer to a request, or raises the Failure that is the answer.
            idle: is gone through, a piece at a time, while nobody asks.
        """
        work = iter(idle)
        while True:
            while not self._asked() and next(work, DONE) is not DONE:
                pass
            request = self.read()
            if request is None:
                return 0
            try:
                head, data = answer(request)
            except Failure as failure:
                head, data = {"failed": failure.code, "detail": failure.detail}, b""
            self.write({"number": request[0]["number"], **head}, data)

    def _asked(self) -> bool:
        return bool(select([self._requests], [], [], 0.0)[0])

    def _exactly(self, count: int) -> bytes | None:
        # No buffered reader: what it had read ahead, select would not see.
        parts, missing = [], count
        while missing > 0:
            part = os.read(self._requests, missing)
            if not part:
                return None
            parts.append(part)
            missing -= len(part)
        return b"".join(parts)


def run(main: Callable[..., int]) -> NoReturn:
    """Be the process for which the parent ran this module, and exit with what ``main`` returns.

    Args:
        main: called with the parent and the arguments that came.
    """
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # Ctrl-C reaches the group; the parent decides
    answers = os.dup(1)
    os.dup2(2, 1)  # what a library prints must not look like a frame
    sys.exit(main(Parent(0, answers), *sys.argv[1:]))
