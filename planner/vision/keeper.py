"""Keep one process running and hand it one request at a time. Knows pipes; not what is asked.

Whatever becomes of the process, who asks gets an answer or a typed failure in bounded time. One
request is in flight: who comes next waits, and his time runs meanwhile. Only the process's own
word is a refusal: one that dies, however often and early, is started again.
"""

from __future__ import annotations

import asyncio
import contextlib
import logging
import os
import signal
import sys
from asyncio.subprocess import PIPE, Process
from collections.abc import Callable, Sequence
from typing import Any

from planner.vision.failure import REASONS, VisionFailure
from planner.vision.frames import HEADER, lengths, pack, unpack

log = logging.getLogger(__name__)

FIRST_PAUSE_S, LONGEST_PAUSE_S = 0.1, 10.0
"""Before a process that died is started again; doubled each time until one answers."""
STREAM_ERRORS = (OSError, EOFError, ValueError, KeyError, TypeError)
DOWN = "detector_down"

Answer = tuple[dict[str, Any], bytes]


class KeptProcess:
    """Run a module of ours as a process, again and again."""

    def __init__(
        self, module: str, arguments: Sequence[str], greet: Callable[[dict[str, Any]], None]
    ) -> None:
        """Say what to run; nothing is started.

        Args:
            module: run with this process's id and ``arguments``.
            arguments: what it is told.
            greet: called with its first frame; raises VisionFailure to refuse it for good.
        """
        self._module, self._arguments, self._greet = module, tuple(arguments), greet
        self._process: Process | None = None
        self._keeper: asyncio.Task[None] | None = None
        self._burial: asyncio.Task[None] | None = None
        self._ready = asyncio.Event()
        self._refused: VisionFailure | None = None
        self._waiting: dict[int, asyncio.Future[Answer]] = {}
        self._turn = asyncio.Lock()
        self._number = 0
        self._pause_s = FIRST_PAUSE_S

    @property
    def pid(self) -> int | None:
        """Return the process's id while one runs."""
        return None if self._process is None else self._process.pid

    @property
    def ready(self) -> bool:
        """Tell whether a process waits for requests."""
        return self._ready.is_set() and self._refused is None

    async def start(self, timeout_s: float) -> None:
        """Start it and wait until it can answer. Ends by itself, with :meth:`close`.

        Raises:
            VisionFailure: it was refused, and nothing is left running; or it is not up yet
                (``detector_down``), and goes on being started.
        """
        if self._keeper is None:
            self._keeper = asyncio.create_task(self._keep(), name="vision worker")
        try:
            async with asyncio.timeout(timeout_s):
                await self._wait_ready()
        except TimeoutError:
            raise VisionFailure(DOWN, f"not ready after {timeout_s:g} s") from None
        except BaseException:
            await self.close()
            raise

    async def ask(self, head: dict[str, Any], bodies: Sequence[bytes], timeout_s: float) -> Answer:
        """Return the answer to one request.

        Raises:
            VisionFailure: what it failed with, what it was refused for, ``detector_down`` or
                ``detector_timed_out``.
        """
        if self._refused is not None:
            raise self._refused
        if self._keeper is None:
            raise VisionFailure(DOWN, "it was not started")
        self._number += 1
        number, asked = self._number, False
        answer: asyncio.Future[Answer] = asyncio.get_running_loop().create_future()
        try:
            async with asyncio.timeout(timeout_s), self._turn:
                await self._wait_ready()
                self._waiting[number] = answer
                asked = True
                await self._send(pack({**head, "number": number}, *bodies))
                told, data = await answer
        except TimeoutError:
            if not asked:
                raise VisionFailure(DOWN, "it is busy or being restarted") from None
            self._kill()  # it cannot be asked to stop thinking
            raise VisionFailure("detector_timed_out", f"after {timeout_s:g} s") from None
        finally:
            self._waiting.pop(number, None)
        if "failed" in told:
            raise VisionFailure(known(told["failed"]))
        return told, data

    async def close(self) -> None:
        """End the process and wait until it is gone. Safe to call twice."""
        keeper, self._keeper = self._keeper, None
        if keeper is not None:
            keeper.cancel()
            with contextlib.suppress(asyncio.CancelledError):
                await keeper
        if self._burial is not None:
            await self._burial

    async def _wait_ready(self) -> None:
        await self._ready.wait()
        if self._refused is not None:
            raise self._refused

    async def _send(self, frame: bytes) -> None:
        try:
            if self._process is None or self._process.stdin is None:
                raise OSError
            self._process.stdin.write(frame)
            await self._process.stdin.drain()
        except OSError:
            raise VisionFailure(DOWN, "it died") from None

    def _kill(self) -> None:
        self._ready.clear()  # from now on: who asks next waits for the process that follows
        if self._process is not None:
            _end(self._process)

    async def _keep(self) -> None:
        """Keep one process running until cancelled, or until it is refused."""
        while self._refused is None:
            try:
                self._process = await self._spawn()
                await self._listen(self._process)
            except VisionFailure as failure:
                self._refuse(failure)
            except STREAM_ERRORS as error:
                log.warning(
                    "the vision process is started again in %g s; its stream ended: %s",
                    *(self._pause_s, error),
                )
            finally:
                await self._bury()
            if self._refused is None:
                await asyncio.sleep(self._pause_s)
                self._pause_s = min(2 * self._pause_s, LONGEST_PAUSE_S)

    async def _spawn(self) -> Process:
        # One thread each: these libraries would start a pool, and the bridge needs the cores.
        single = {"OPENBLAS_NUM_THREADS": "1", "OMP_NUM_THREADS": "1"}
        return await asyncio.create_subprocess_exec(
            *(sys.executable, "-m", self._module, str(os.getpid()), *self._arguments),
            stdin=PIPE,
            stdout=PIPE,
            env=os.environ | single,
        )

    async def _listen(self, process: Process) -> None:
        """Hand answers to who waits for them, until the stream ends."""
        if process.stdout is None:
            raise ValueError("the process has no standard output")
        self._greet((await _read(process.stdout))[0])
        self._ready.set()
        while True:
            head, data = await _read(process.stdout)
            self._pause_s = FIRST_PAUSE_S
            waiting = self._waiting.get(int(head["number"]))
            if waiting is not None and not waiting.done():  # else who asked has gone away
                waiting.set_result((head, data))

    def _refuse(self, failure: VisionFailure) -> None:
        log.error("the vision process refused what it was given: %s", failure)
        self._refused = failure
        self._ready.set()

    async def _bury(self) -> None:
        process, self._process = self._process, None
        if self._refused is None:
            self._ready.clear()
        for answer in self._waiting.values():
            if not answer.done():
                answer.set_result(({"failed": DOWN}, b""))
        if process is not None:
            # Shielded: whoever cancels us, a process is always waited for.
            self._burial = asyncio.create_task(_reap(process))
            await asyncio.shield(self._burial)


def known(code: object) -> str:
    """Return a code that came from the process, if it is one of ours."""
    return code if isinstance(code, str) and code in REASONS else DOWN


async def _reap(process: Process) -> None:
    _end(process)
    if process.stdin is not None:
        process.stdin.close()
    if process.stdout is not None:
        await process.stdout.read()  # to its end, so that the pipe is closed with the process
    await process.wait()


def _end(process: Process) -> None:
    # Not process.kill(): it reaps what has died, and asyncio's own watcher then finds no child.
    if process.returncode is None:
        with contextlib.suppress(ProcessLookupError):
            os.kill(process.pid, signal.SIGKILL)


async def _read(stream: asyncio.StreamReader) -> Answer:
    head, body = lengths(await stream.readexactly(HEADER.size))
    return unpack(await stream.readexactly(head)), await stream.readexactly(body)
