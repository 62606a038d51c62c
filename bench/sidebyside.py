"""Take slices in processes of their own, one a processor. For what measures no time."""

from __future__ import annotations

import os
import signal
from dataclasses import dataclass
from multiprocessing import get_context
from multiprocessing.connection import wait
from typing import TYPE_CHECKING, Any, cast

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Iterator
    from multiprocessing.connection import Connection
    from multiprocessing.context import SpawnProcess

CORES = len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1
_SPAWN = get_context("spawn")  # a fork would share threads' locks


@dataclass(frozen=True, slots=True)
class Done:
    """Hold what became of one slice: what was taken, or why nothing was."""

    index: int
    data: Any = None
    trouble: str | None = None


def taken(
    take: Callable[[int], Any], indices: Iterable[int], at_once: int | None = None
) -> Iterator[Done]:
    """Yield what each index comes to, in the order in which they are done.

    Whoever stops asking, by Ctrl-C too, ends the processes.

    Args:
        take: a function of a module, which another process can import.
        indices: asked for one by one, as a process becomes free.
        at_once: how many processes; as many as this one may use by default.
    """
    left = iter(indices)
    running: dict[Connection, tuple[int, SpawnProcess]] = {}
    try:
        while True:
            while len(running) < (at_once or CORES):
                index = next(left, None)
                if index is None:
                    break
                mine, its = _SPAWN.Pipe(duplex=False)
                process = _SPAWN.Process(target=_take, args=(its, take, index), daemon=True)
                process.start()
                its.close()
                running[mine] = index, process
            if not running:
                return
            for ready in wait(list(running)):
                mine = cast("Connection", ready)
                index, process = running.pop(mine)
                yield _heard(mine, index, process)
    finally:
        for mine, (_, process) in running.items():
            process.kill()
            process.join()
            mine.close()


def _take(its: Connection, take: Callable[[int], Any], index: int) -> None:
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # who started this hears it, and ends it
    try:
        its.send(Done(index, take(index)))
    except Exception as trouble:  # noqa: BLE001  # told by the process that asked
        its.send(Done(index, trouble=f"{type(trouble).__name__}: {trouble}"))


def _heard(mine: Connection, index: int, process: SpawnProcess) -> Done:
    try:
        said = cast("Done", mine.recv())
    except EOFError:
        process.join()
        return Done(index, trouble=f"its process ended with {process.exitcode}")
    finally:
        mine.close()
    process.join()
    return said
