"""Break one thing and mend it: a context manager for every kind of fault."""

from __future__ import annotations

import os
import resource
import secrets
import sqlite3
import time
from contextlib import ExitStack, contextmanager, suppress
from typing import TYPE_CHECKING

import psutil

from tools.bench.chaos.draw import Breakage, FaultKind
from tools.bench.chaos.house import House, read_only
from wire import SimControl, SimFault, load_robot
from wire.keys import SIM_CONTROL, Party
from wire.session import open_session

if TYPE_CHECKING:
    from collections.abc import Iterator
    from contextlib import AbstractContextManager
    from pathlib import Path

NEEDS_MOUNTS = frozenset({FaultKind.DISK_FULL, FaultKind.READ_ONLY})
CHUNK_BYTES = 32 << 20


def break_house(house: House, fault: Breakage) -> AbstractContextManager[str]:
    """Return what breaks it on entering, yields a word of what was found, and mends it on leaving.

    A process that does not live at that moment can't be broken: the word says so.
    """
    match fault.kind:
        case FaultKind.KILL:
            return _kill(house, fault.target)
        case FaultKind.FREEZE:
            return _frozen(processes_of(house, fault.target))
        case FaultKind.MEMORY:
            return _starve(house, fault.target)
        case FaultKind.LIDAR:
            return _blind(house, SimFault(fault.target))
        case FaultKind.DISK_FULL:
            return full_disk(house.home)
        case FaultKind.READ_ONLY:
            return _unwritable(house.home)
        case FaultKind.SLOW_DISK:
            return _slow(house)
        case FaultKind.STALL:
            return _frozen(house.tree())
        case FaultKind.SOCKET:
            return _unlink(house.home, fault.target)


def processes_of(house: House, name: str) -> list[psutil.Process]:
    """Return the process of a name in a list, which is empty where it does not live."""
    process = house.find(name)
    return [process] if process is not None else []


@contextmanager
def _kill(house: House, name: str) -> Iterator[str]:
    processes = processes_of(house, name)
    for process in processes:
        with suppress(psutil.NoSuchProcess):
            process.kill()
    yield _word(processes)


@contextmanager
def _frozen(processes: list[psutil.Process]) -> Iterator[str]:
    try:
        for process in processes:
            with suppress(psutil.NoSuchProcess):
                process.suspend()
        yield _word(processes)
    finally:
        for process in processes:
            with suppress(psutil.NoSuchProcess):  # psutil knows a pid that was given anew
                process.resume()


@contextmanager
def _starve(house: House, name: str) -> Iterator[str]:
    """Let a process have no more memory than it has: what it asks for next is refused."""
    processes, before = processes_of(house, name), (resource.RLIM_INFINITY, resource.RLIM_INFINITY)
    try:
        for process in processes:
            with suppress(psutil.NoSuchProcess):
                before = process.rlimit(resource.RLIMIT_AS)
                process.rlimit(resource.RLIMIT_AS, (process.memory_info().vms, before[1]))
        yield _word(processes)
    finally:
        for process in processes:
            with suppress(psutil.NoSuchProcess):
                process.rlimit(resource.RLIMIT_AS, before)


@contextmanager
def _blind(house: House, fault: SimFault) -> Iterator[str]:
    robot_id = load_robot(house.settings.robot).id
    with open_session(Party.JUDGE, robot_id, house.home) as session:
        mouth = session.publisher(SIM_CONTROL)

        def wish(faults: tuple[SimFault, ...]) -> None:
            control = SimControl(id=f"chaos-{secrets.token_hex(6)}", faults=faults)
            for _ in range(20):  # the session may not have reached the simulator yet
                mouth.put(control)
                time.sleep(0.02)

        try:
            wish((fault,))
            yield ""
        finally:
            wish(())


@contextmanager
def full_disk(home: Path) -> Iterator[str]:
    """Fill the disk of a home to its last byte; empty it again."""
    filler = home / "filler"
    try:
        with suppress(OSError), filler.open("wb") as file:
            at, chunk = 0, CHUNK_BYTES
            while chunk >= 1:
                try:
                    os.posix_fallocate(file.fileno(), at, chunk)
                    at += chunk
                except OSError:
                    chunk //= 4
        yield ""
    finally:
        filler.unlink(missing_ok=True)


@contextmanager
def _unwritable(home: Path) -> Iterator[str]:
    with read_only(home):
        yield ""


@contextmanager
def _slow(house: House) -> Iterator[str]:
    """Let nothing be written: the recorder is stopped, and the journal's lock is held."""
    with ExitStack() as stack:
        stack.enter_context(_frozen(processes_of(house, "recorder")))
        word = ""
        try:
            journal = sqlite3.connect(house.home / "missions.db", timeout=0.2, isolation_level=None)
            stack.callback(journal.close)
            journal.execute("BEGIN IMMEDIATE")
            stack.callback(journal.execute, "ROLLBACK")
        except sqlite3.Error as error:
            word = f"the journal's lock was not to be had: {error}"
        yield word


@contextmanager
def _unlink(home: Path, listener: str) -> Iterator[str]:
    paths = sockets(home, listener)
    for path in paths:
        path.unlink(missing_ok=True)
    yield "" if paths else "no socket there"


def sockets(home: Path, listener: str) -> list[Path]:
    """Return where a listener's socket lies now: in ``run``, or in a folder of its own there."""
    return sorted((home / "run").glob(f"**/{listener}.sock"))


def _word(processes: list[psutil.Process]) -> str:
    return "" if processes else "it did not live"
