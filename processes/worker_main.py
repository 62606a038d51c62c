"""The worker's own end of its pipes: requests in, answers out, other work while none waits.

Standard output is kept for frames alone. :mod:`processes.parent_death` has bound the process to its
parent and set its nice.
"""

from __future__ import annotations

import os
import signal
import sys
from collections.abc import Callable, Iterable
from select import select
from typing import Any, NoReturn

from processes.worker_protocol import HEADER, Frame, WorkerFailure, pack, read_lengths, unpack

EXIT_REFUSED = 1
DONE = object()


class ParentPipes:
    """Both pipes to the process that started this one."""

    def __init__(self, requests: int, answers: int) -> None:
        """Take the descriptors to read from and to write to."""
        self._requests, self._answers = requests, answers

    def read(self) -> Frame | None:
        """Return the next frame, or None at the end of the input."""
        header = self._read_exactly(HEADER.size)
        if header is None:
            return None
        head, body = read_lengths(header)
        text, data = self._read_exactly(head), self._read_exactly(body)
        return None if text is None or data is None else (unpack(text), data)

    def write(self, head: dict[str, Any], *bodies: bytes) -> None:
        """Send one frame."""
        view = memoryview(pack(head, *bodies))
        while view:
            view = view[os.write(self._answers, view) :]

    def refuse(self, code: str, detail: str) -> int:
        """Say why this process can't do its work at all; return its exit status."""
        self.write({"refused": code, "detail": detail})
        return EXIT_REFUSED

    def serve(self, answer: Callable[[Frame], Frame], idle: Iterable[object] = ()) -> int:
        """Answer until the input ends; return the exit status.

        Args:
            answer: returns the answer to a request, or raises the WorkerFailure that is the answer.
            idle: work to do piece by piece while no request waits.
        """
        work = iter(idle)
        while True:
            while not self._has_request() and next(work, DONE) is not DONE:
                pass
            request = self.read()
            if request is None:
                return 0
            try:
                head, data = answer(request)
            except WorkerFailure as failure:
                head, data = {"failed": failure.code, "detail": failure.detail}, b""
            self.write({"number": request[0]["number"], **head}, data)

    def _has_request(self) -> bool:
        return bool(select([self._requests], [], [], 0.0)[0])

    def _read_exactly(self, count: int) -> bytes | None:
        # No buffered reader: select would not see what it has read ahead.
        parts, missing = [], count
        while missing > 0:
            part = os.read(self._requests, missing)
            if not part:
                return None
            parts.append(part)
            missing -= len(part)
        return b"".join(parts)


def run_worker(main: Callable[..., int]) -> NoReturn:
    """Run a worker's ``main`` on the pipes to its parent, and exit with its status.

    Args:
        main: called with the pipes and the command line's arguments.
    """
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # Ctrl-C reaches the group; the parent decides
    answers = os.dup(1)
    os.dup2(2, 1)  # what a library prints must not look like a frame
    sys.exit(main(ParentPipes(0, answers), *sys.argv[1:]))
