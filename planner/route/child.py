"""Be the route process: ``python -m planner.route.child PARENT_PID SITE LIMITS``.

Started by :class:`planner.route.RouteWorker` and by nobody else. Reads frames on standard input,
answers on standard output, ends when the input ends or the parent dies. Runs at nice 10, because
the bridge's loop and the planner's heartbeat share its cores. While nobody asks, it works out the
exact costs to the places that people name.
"""

from __future__ import annotations

import ctypes
import os
import signal
import sys
from pathlib import Path
from select import select

from planner.route.frames import (
    HEADER,
    body_length,
    pack,
    pack_failure,
    pack_result,
    read_limits,
    read_request,
    unpack,
)
from planner.route.request import RouteFailure
from planner.route.router import Router
from planner.world import Site, SiteError

PR_SET_PDEATHSIG = 1  # prctl(2)
NICE = 10
DONE = object()


def main(arguments: list[str]) -> int:
    """Load the site named by path, say ready, and answer until the input ends."""
    parent_pid, folder, limits = arguments
    if not _bind_to_parent(int(parent_pid)):
        return 1
    os.nice(NICE)
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # Ctrl-C reaches the group; the parent decides
    answers = _own_output()
    try:
        site = Site.load(Path(folder))
    except SiteError as error:
        _write(answers, pack({"refused": error.code, "detail": str(error)}))
        return 1
    router = Router(site, read_limits(limits))
    _write(answers, pack({"ready": site.map_id}))
    _serve(router, sys.stdin.fileno(), answers)
    return 0


def _serve(router: Router, requests: int, answers: int) -> None:
    idle_work, working = router.warm(), True
    while True:
        if working and not _waiting(requests):
            working = next(idle_work, DONE) is not DONE
            continue
        body = _read_frame(requests)
        if body is None:
            return
        number, request = read_request(unpack(body))
        try:
            answer = pack_result(number, router.route(request))
        except RouteFailure as failure:
            answer = pack_failure(number, failure)
        _write(answers, answer)


def _waiting(descriptor: int) -> bool:
    return bool(select([descriptor], [], [], 0.0)[0])


def _read_frame(descriptor: int) -> bytes | None:
    """Return the next frame's body, or None at the end of the input."""
    header = _read_exactly(descriptor, HEADER.size)
    return None if header is None else _read_exactly(descriptor, body_length(header))


def _read_exactly(descriptor: int, count: int) -> bytes | None:
    # No buffered reader: what it had read ahead, select would not see.
    parts, missing = [], count
    while missing > 0:
        part = os.read(descriptor, missing)
        if not part:
            return None
        parts.append(part)
        missing -= len(part)
    return b"".join(parts)


def _write(descriptor: int, data: bytes) -> None:
    view = memoryview(data)
    while view:
        view = view[os.write(descriptor, view) :]


def _own_output() -> int:
    """Keep standard output for frames alone; what a library prints goes to standard error."""
    answers = os.dup(1)
    os.dup2(2, 1)
    return answers


def _bind_to_parent(parent_pid: int) -> bool:
    """Die with the parent from now on; False if it is gone already."""
    if sys.platform == "linux":
        libc = ctypes.CDLL(None, use_errno=True)
        if libc.prctl(PR_SET_PDEATHSIG, signal.SIGKILL, 0, 0, 0) != 0:
            raise OSError(ctypes.get_errno(), "prctl(PR_SET_PDEATHSIG)")
    return os.getppid() == parent_pid


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
