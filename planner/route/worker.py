"""Run the route search in another process and keep one alive. Knows processes and pipes; no maps.

A long search would hold the interpreter and with it the heartbeat, so it never runs in the
planner. Whatever becomes of the process, a caller gets a route or a typed failure in bounded time.
"""

from __future__ import annotations

import asyncio
import contextlib
import logging
import os
import signal
import sys
from asyncio.subprocess import PIPE, Process
from pathlib import Path
from typing import Any

from planner.route.frames import (
    HEADER,
    body_length,
    limits_text,
    pack_request,
    read_answer,
    unpack,
)
from planner.route.request import RouteFailure, RouteLimits, RouteRequest, RouteResult

log = logging.getLogger(__name__)

READY_S = 30.0
"""To start Python, numpy and OpenCV on a busy board and load a site."""
ROUTE_S = 5.0
FIRST_PAUSE_S, LONGEST_PAUSE_S = 0.05, 5.0
"""Before a process that died is started again; doubled each time until one answers."""


class RouteWorker:
    """Find routes on one site, in another process."""

    def __init__(self, folder: Path, map_id: str, limits: RouteLimits) -> None:
        """Take the site by path, so that no map is ever copied between processes."""
        self._command = (folder, map_id, limits)
        self._process: Process | None = None
        self._keeper: asyncio.Task[None] | None = None
        self._burial: asyncio.Task[None] | None = None
        self._ready = asyncio.Event()
        self._refused: RouteFailure | None = None
        self._waiting: dict[int, asyncio.Future[RouteResult]] = {}
        self._number = 0
        self._pause_s = FIRST_PAUSE_S

    @property
    def pid(self) -> int | None:
        """Return the process's id while one runs."""
        return None if self._process is None else self._process.pid

    @property
    def ready(self) -> bool:
        """Tell whether a process waits for requests."""
        return self._ready.is_set()

    async def start(self, timeout_s: float = READY_S) -> None:
        """Start the process and wait until it can answer. Ends by itself, with :meth:`close`.

        Raises:
            RouteFailure: ``route_worker_unavailable``; nothing is left running.
        """
        if self._keeper is None:
            self._keeper = asyncio.create_task(self._keep(), name="route worker")
        try:
            async with asyncio.timeout(timeout_s):
                await self._wait_ready()
        except TimeoutError:
            await self.close()
            text = f"not ready after {timeout_s} s"
            raise RouteFailure("route_worker_unavailable", text) from None
        except BaseException:
            await self.close()
            raise

    async def route(self, request: RouteRequest, timeout_s: float = ROUTE_S) -> RouteResult:
        """Find the way.

        Raises:
            RouteFailure: there is none, or the process failed or was too slow; the code says which.
        """
        if self._keeper is None:
            raise RouteFailure("route_worker_unavailable", "it was not started")
        self._number += 1
        number, asked = self._number, False
        frame = pack_request(number, request)
        answer: asyncio.Future[RouteResult] = asyncio.get_running_loop().create_future()
        try:
            async with asyncio.timeout(timeout_s):
                await self._wait_ready()
                self._waiting[number] = answer
                asked = True
                self._send(frame)
                return await answer
        except TimeoutError:
            if not asked:
                raise RouteFailure("route_worker_unavailable", "it is being restarted") from None
            self._kill()  # it cannot be asked to stop searching
            raise RouteFailure("route_timed_out", f"after {timeout_s} s") from None
        finally:
            self._waiting.pop(number, None)

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

    def _send(self, frame: bytes) -> None:
        if self._process is None or self._process.stdin is None:
            raise RouteFailure("route_worker_died")
        self._process.stdin.write(frame)

    def _kill(self) -> None:
        self._ready.clear()  # from now on: who asks next waits for the process that follows
        if self._process is not None:
            _end(self._process)

    async def _keep(self) -> None:
        """Keep one process running until cancelled, or until the site itself is refused."""
        while self._refused is None:
            try:
                self._process = await self._spawn()
                await self._listen(self._process)
            except (OSError, EOFError, ValueError, KeyError, TypeError) as error:
                log.warning("the route process is started again; its stream ended with: %s", error)
            finally:
                await self._bury()
            if self._refused is None:
                await asyncio.sleep(self._pause_s)
                self._pause_s = min(2 * self._pause_s, LONGEST_PAUSE_S)

    async def _spawn(self) -> Process:
        folder, _, limits = self._command
        # One thread each: these libraries would start a pool, and the bridge needs the cores.
        single = {"OPENBLAS_NUM_THREADS": "1", "OMP_NUM_THREADS": "1"}
        return await asyncio.create_subprocess_exec(
            *(sys.executable, "-m", "planner.route.child"),
            *(str(os.getpid()), str(folder.absolute()), limits_text(limits)),
            stdin=PIPE,
            stdout=PIPE,
            env=os.environ | single,
        )

    async def _listen(self, process: Process) -> None:
        """Hand answers to who waits for them, until the stream ends."""
        if process.stdout is None:
            raise ValueError("the process has no standard output")
        self._greet(await _read(process.stdout))
        while self._refused is None:
            message = await _read(process.stdout)
            self._pause_s = FIRST_PAUSE_S
            answer = self._waiting.get(int(message["number"]))
            if answer is None or answer.done():
                continue  # who asked has gone away
            try:
                answer.set_result(read_answer(message))
            except RouteFailure as failure:
                answer.set_exception(failure)

    def _greet(self, message: dict[str, Any]) -> None:
        _, map_id, _ = self._command
        if message.get("ready") != map_id:
            text = message.get("detail") or f"it loaded map {message.get('ready')}, not {map_id}"
            self._refused = RouteFailure("route_worker_unavailable", text)
        self._ready.set()

    async def _bury(self) -> None:
        process, self._process = self._process, None
        if self._refused is None:
            self._ready.clear()
        for answer in self._waiting.values():
            if not answer.done():
                answer.set_exception(RouteFailure("route_worker_died"))
        if process is not None:
            # Shielded: whoever cancels us, a process is always waited for.
            self._burial = asyncio.create_task(_reap(process))
            await asyncio.shield(self._burial)


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


async def _read(stream: asyncio.StreamReader) -> dict[str, Any]:
    header = await stream.readexactly(HEADER.size)
    return unpack(await stream.readexactly(body_length(header)))
