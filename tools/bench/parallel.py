"""Take slices in processes of their own, one a processor. For what measures no time.

The process: ``python -m tools.bench.parallel MODULE FUNCTION INDEX``, which writes a line of JSON.
"""

from __future__ import annotations

import json
import os
import signal
import sys
from contextlib import redirect_stdout
from dataclasses import dataclass
from importlib import import_module
from selectors import EVENT_READ, DefaultSelector
from subprocess import PIPE, Popen
from typing import IO, TYPE_CHECKING, Any, cast

from pons.settings import CHECKOUT

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Iterator

CORES = len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1


@dataclass(frozen=True, slots=True)
class SliceResult:
    """Hold what became of one slice: what was taken, or why nothing was."""

    index: int
    data: Any = None
    trouble: str | None = None


def take_in_parallel(
    take: Callable[[int], Any], indices: Iterable[int], at_once: int = CORES
) -> Iterator[SliceResult]:
    """Yield what each index comes to, in the order in which they are done.

    Whoever stops asking, by Ctrl-C too, ends the processes.

    Args:
        take: a function of a module, which another process can import; returns what JSON can hold.
        indices: asked for one by one, as a process becomes free.
        at_once: how many processes.
    """
    left = iter(indices)
    running: dict[Popen[str], int] = {}
    with DefaultSelector() as ears:
        try:
            while True:
                while len(running) < at_once and (index := next(left, None)) is not None:
                    process = _begin(take, index)
                    running[process] = index
                    ears.register(cast("IO[str]", process.stdout), EVENT_READ, process)
                if not running:
                    return
                for key, _ in ears.select():
                    ears.unregister(key.fileobj)
                    yield _read_result(key.data, running.pop(key.data))
        finally:
            for process in running:
                process.kill()
                process.communicate()


def _begin(take: Callable[[int], Any], index: int) -> Popen[str]:
    words = [sys.executable, "-m", __name__, take.__module__, take.__qualname__, str(index)]
    return Popen(words, cwd=CHECKOUT, stdout=PIPE, text=True)


def _read_result(process: Popen[str], index: int) -> SliceResult:
    """Read the one line, which is begun when the process is done."""
    said, _ = process.communicate()
    if process.returncode == 0:
        return SliceResult(index, **json.loads(said))
    return SliceResult(index, trouble=f"its process ended with {process.returncode}")


def main(arguments: list[str]) -> int:
    """Take one slice; tell it, or what went wrong."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # who started this hears it, and ends it
    module, function, index = arguments
    try:
        with redirect_stdout(sys.stderr):
            told = {"data": getattr(import_module(module), function)(int(index))}
    except Exception as trouble:  # noqa: BLE001  # told by the process that asked
        told = {"trouble": f"{type(trouble).__name__}: {trouble}"}
    print(json.dumps(told), flush=True)
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
