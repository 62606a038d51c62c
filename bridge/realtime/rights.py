"""Ask the system for real-time rights, one by one. Refusals are values: a robot may drive without,
slowly and visibly (row NOT_RT), but nobody may believe that it has what was refused.

Order matters and is the shell's: the transport's rank while it starts, memory after warm-up, CPU
and the loop's rank last and for the calling thread alone.
"""

from __future__ import annotations

import ctypes
import os
import resource
import sys
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Iterator

MCL_CURRENT, MCL_FUTURE, MCL_ONFAULT = 1, 2, 4
"""linux/mman.h. ONFAULT locks pages as they are touched: 39 MB resident instead of 113 to 154."""

_CAP_IPC_LOCK = 14  # linux/capability.h
_STATUS = Path("/proc/self/status")

BELOW_THE_LOOP = 10
"""The transport's threads run so much lower than the loop: it goes before what it waits for."""


@dataclass(frozen=True, slots=True)
class Right:
    """Hold one right asked of the system, and whether it was granted."""

    name: str
    granted: bool
    detail: str


def all_granted(rights: tuple[Right, ...]) -> bool:
    """Return whether every right was granted."""
    return all(right.granted for right in rights)


def lock_memory() -> Right:
    """Keep every page of this process in memory, now and later.

    Only where the limit is infinite, or does not bind us (capabilities(7): CAP_IPC_LOCK): under a
    finite one, FUTURE makes a later allocation fail, which is worse than a page fault.
    """
    if sys.platform != "linux":
        return Right("mlockall", granted=False, detail=f"not on {sys.platform}")
    limit, _ = resource.getrlimit(resource.RLIMIT_MEMLOCK)
    if limit != resource.RLIM_INFINITY and not _above_the_limit():
        return Right("mlockall", granted=False, detail=f"RLIMIT_MEMLOCK is {limit} bytes")
    libc = ctypes.CDLL(None, use_errno=True)
    if libc.mlockall(MCL_CURRENT | MCL_FUTURE | MCL_ONFAULT) != 0:
        return Right("mlockall", granted=False, detail=os.strerror(ctypes.get_errno()))
    return Right("mlockall", granted=True, detail="current, future, on fault")


def _above_the_limit() -> bool:
    """Return whether this process holds CAP_IPC_LOCK, for which no limit counts."""
    try:
        lines = _STATUS.read_text("ascii").splitlines()
        held = next(int(line.split()[1], 16) for line in lines if line.startswith("CapEff:"))
    except (OSError, StopIteration, ValueError, IndexError):
        return False
    return bool(held >> _CAP_IPC_LOCK & 1)


def pin(cpu: int | None) -> Right:
    """Bind the calling thread to one CPU; None takes the highest that this process may use."""
    if sys.platform != "linux":
        return Right("affinity", granted=False, detail=f"not on {sys.platform}")
    allowed = os.sched_getaffinity(0)
    chosen = max(allowed) if cpu is None else cpu
    if chosen not in allowed:
        return Right("affinity", granted=False, detail=f"cpu {chosen} not in {sorted(allowed)}")
    try:
        os.sched_setaffinity(0, {chosen})
    except OSError as error:
        return Right("affinity", granted=False, detail=f"cpu {chosen}: {error.strerror}")
    return Right("affinity", granted=True, detail=f"cpu {chosen}")


def take_fifo(priority: int) -> Right:
    """Run the calling thread under SCHED_FIFO; threads that it starts do not inherit it."""
    return _fifo("fifo", priority, inherited=False)


@contextmanager
def transport_fifo(priority: int) -> Iterator[Right]:
    """Run threads that are started within under SCHED_FIFO, below a loop of this ``priority``.

    A loop that wakes in time reads what the transport's threads have brought by then: where those
    wait for a busy machine, encoders that came in time look late. The caller keeps its own rank.
    """
    own = _rank()
    right = _fifo("transport fifo", max(1, priority - BELOW_THE_LOOP), inherited=True)
    try:
        yield right
    finally:
        if right.granted and own is not None:
            os.sched_setscheduler(0, *own)


def _rank() -> tuple[int, os.sched_param] | None:
    if sys.platform != "linux":
        return None
    return os.sched_getscheduler(0), os.sched_getparam(0)


def _fifo(name: str, priority: int, *, inherited: bool) -> Right:
    if sys.platform != "linux":
        return Right(name, granted=False, detail=f"not on {sys.platform}")
    policy = os.SCHED_FIFO if inherited else os.SCHED_FIFO | os.SCHED_RESET_ON_FORK
    try:
        os.sched_setscheduler(0, policy, os.sched_param(priority))
    except OSError as error:
        return Right(name, granted=False, detail=f"priority {priority}: {error.strerror}")
    return Right(name, granted=True, detail=f"priority {priority}")
