"""Give birth to a child process, talk to it, and bury it. Knows pipes; not when to do which."""

from __future__ import annotations

import asyncio
import contextlib
import os
import signal
import sys
from asyncio.subprocess import PIPE, Process
from collections.abc import Sequence

from planner.kept.frames import HEADER, Frame, lengths, unpack

BEGIN = "planner.kept.begin"
STREAM_ERRORS = (OSError, EOFError, ValueError, KeyError, TypeError)
"""What reading and understanding another process's frames may raise."""
SINGLE = {"OPENBLAS_NUM_THREADS": "1", "OMP_NUM_THREADS": "1"}
"""One thread each: these libraries would start a pool, and the bridge needs the cores."""


def command_of(module: str, *arguments: str) -> tuple[str, ...]:
    """Return how to run a module of ours whose end is :func:`planner.kept.run`."""
    return (sys.executable, "-m", BEGIN, str(os.getpid()), module, *arguments)


async def spawn(command: Sequence[str]) -> Process:
    """Start a child. Raises OSError where the system gives none."""
    return await asyncio.create_subprocess_exec(
        *command, stdin=PIPE, stdout=PIPE, env=os.environ | SINGLE
    )


async def send(process: Process, frame: bytes) -> None:
    """Hand over a frame, and wait while the pipe is full. Raises OSError where it is gone."""
    if process.stdin is None:
        raise BrokenPipeError("the process has no standard input")
    process.stdin.write(frame)
    await process.stdin.drain()


async def read(process: Process) -> Frame:
    """Return the child's next frame. Raises one of :data:`STREAM_ERRORS`."""
    if process.stdout is None:
        raise BrokenPipeError("the process has no standard output")
    head, body = lengths(await process.stdout.readexactly(HEADER.size))
    return unpack(await process.stdout.readexactly(head)), await process.stdout.readexactly(body)


async def exchange(process: Process, frame: bytes) -> Frame:
    """Hand over a frame and return the next one that comes. Raises as both do."""
    await send(process, frame)
    return await read(process)


def end(process: Process) -> None:
    """Kill it, whatever state it is in."""
    # Not process.kill(): it reaps what has died, and asyncio's own watcher then finds no child.
    if process.returncode is None:
        with contextlib.suppress(ProcessLookupError):
            os.kill(process.pid, signal.SIGKILL)


async def reap(process: Process) -> None:
    """Kill it and wait until it is gone, its pipes too. Shield this from being cancelled."""
    end(process)
    if process.stdin is not None:
        process.stdin.close()
    if process.stdout is not None:
        await process.stdout.read()  # to its end, so that the pipe is closed with the process
    await process.wait()
