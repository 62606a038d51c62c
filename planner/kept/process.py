"""Keep one process running and hand it requests. Knows when it lives and dies; not what is asked.

Whatever becomes of the process, who asks gets an answer or a typed failure in bounded time. Only
the process's own word is a refusal: one that dies, however often and early, is started again.
"""

from __future__ import annotations

import asyncio
import contextlib
import logging
from asyncio.subprocess import Process
from collections.abc import Callable, Sequence
from typing import Any, TypeVar

from planner.kept.failure import Codes, Failure
from planner.kept.frames import Frame, pack
from planner.kept.life import STREAM_ERRORS, command_of, end, read, reap, send, spawn

log = logging.getLogger(__name__)

T = TypeVar("T")
FIRST_PAUSE_S = 0.05
"""Before a process that died is started again; doubled each time until one answers."""


class KeptProcess:
    """Run a module of ours as a process, again and again."""

    def __init__(
        self,
        module: str,
        arguments: Sequence[str],
        codes: Codes,
        *,
        one_at_a_time: bool,
        first_word_s: float,
        longest_pause_s: float,
    ) -> None:
        """Say what to run; nothing is started.

        Args:
            module: it calls :func:`planner.kept.run`, and is run with ``arguments``.
            arguments: what it is told.
            codes: what its failures are called.
            one_at_a_time: who asks waits for his turn, and his time runs meanwhile.
            first_word_s: one that has not said that it is ready by then is started again.
            longest_pause_s: the doubling of pauses before new starts ends here.
        """
        self._command, self._codes = (module, *arguments), codes
        self._process: Process | None = None
        self._keeper: asyncio.Task[None] | None = None
        self._burial: asyncio.Task[None] | None = None
        self._ready = asyncio.Event()
        self._refused: Failure | None = None
        self._waiting: dict[int, asyncio.Future[Frame]] = {}
        self._busy = "busy or " if one_at_a_time else ""
        self._turn = asyncio.Lock() if one_at_a_time else contextlib.nullcontext()
        self._number = 0
        self._pause_s, self._longest_pause_s = FIRST_PAUSE_S, longest_pause_s
        self._first_word_s = first_word_s

    @property
    def pid(self) -> int | None:
        """Return the process's id while one runs."""
        return None if self._process is None else self._process.pid

    async def start(self, timeout_s: float) -> None:
        """Start it and wait until it can answer. Ends by itself, with :meth:`close`.

        Raises:
            Failure: it was refused, and nothing is left running; or it is not up yet (``down``),
                and goes on being started.
        """
        if self._keeper is None:
            self._keeper = asyncio.create_task(self._keep(), name=self._command[0])
        try:
            async with asyncio.timeout(timeout_s):
                await self._wait_ready()
        except TimeoutError:
            raise self._down(f"not ready after {timeout_s:g} s") from None
        except BaseException:
            await self.close()
            raise

    async def ask(
        self,
        head: dict[str, Any],
        bodies: Sequence[bytes],
        timeout_s: float,
        understand: Callable[[Frame], T],
    ) -> T:
        """Return the answer to one request, as ``understand`` reads it.

        Raises:
            Failure: what it failed with, what it was refused for, ``down``, ``died`` or
                ``timed_out``.
            ValueError: a number in ``head`` is not finite.
        """
        self._must_run()
        self._number += 1
        number = self._number
        frame = pack({**head, "number": number}, *bodies)
        answer: asyncio.Future[Frame] = asyncio.get_running_loop().create_future()
        try:
            async with asyncio.timeout(timeout_s), self._turn:
                await self._wait_ready()
                self._waiting[number] = answer
                await self._send(frame)
                told = await answer
        except TimeoutError:
            if number not in self._waiting:
                raise self._down(f"it is {self._busy}being restarted") from None
            self._kill()  # it cannot be asked to stop thinking
            raise self._codes.failed(self._codes.timed_out, f"after {timeout_s:g} s") from None
        finally:
            self._waiting.pop(number, None)
        return self._understood(told, understand)

    async def close(self) -> None:
        """End the process and wait until it is gone. Safe to call twice."""
        keeper, self._keeper = self._keeper, None
        if keeper is not None:
            keeper.cancel()
            with contextlib.suppress(asyncio.CancelledError):
                await keeper
        if self._burial is not None:
            await self._burial

    def _greet(self, said: Any) -> None:
        """Take what it says when it is ready; a Failure that this raises refuses it for good."""

    def _down(self, detail: str) -> Failure:
        return self._codes.failed(self._codes.down, detail)

    def _died(self) -> Failure:
        return self._codes.failed(self._codes.died)

    def _must_not_be_refused(self) -> None:
        if self._refused is not None:
            # Its traceback would grow with each time it is raised.
            raise self._refused.with_traceback(None)

    def _must_run(self) -> None:
        self._must_not_be_refused()
        if self._keeper is None:
            raise self._down("it was not started")

    async def _wait_ready(self) -> None:
        await self._ready.wait()
        self._must_not_be_refused()

    async def _send(self, frame: bytes) -> None:
        if self._process is None:
            raise self._died()
        try:
            await send(self._process, frame)
        except OSError:
            raise self._died() from None

    def _understood(self, told: Frame, understand: Callable[[Frame], T]) -> T:
        head, _ = told
        if "failed" in head:
            raise self._codes.failed(head["failed"], head.get("detail", ""))
        try:
            return understand(told)
        except (ValueError, KeyError, TypeError) as error:
            log.error("%s gave an answer that is none: %r", self._command[0], error)
            self._kill()  # it is out of step, or another version of us
            raise self._died() from None

    def _kill(self) -> None:
        self._ready.clear()  # from now on: who asks next waits for the process that follows
        if self._process is not None:
            end(self._process)

    async def _keep(self) -> None:
        """Keep one process running until cancelled, or until it is refused."""
        while self._refused is None:
            try:
                self._process = await spawn(command_of(*self._command))
                await self._listen(self._process)
            except Failure as failure:
                log.error("%s refused what it was given: %s", self._command[0], failure)
                self._refused = failure
                self._ready.set()
            except STREAM_ERRORS as error:
                log.warning(
                    "%s is started again in %g s; its stream ended: %r",
                    *(self._command[0], self._pause_s, error),
                )
            finally:
                await self._bury()
            if self._refused is None:
                await asyncio.sleep(self._pause_s)
                self._pause_s = min(2 * self._pause_s, self._longest_pause_s)

    async def _listen(self, process: Process) -> None:
        """Hand answers to who waits for them, until the stream ends."""
        async with asyncio.timeout(self._first_word_s):
            greeting, _ = await read(process)
        if "refused" in greeting:
            raise self._codes.failed(greeting["refused"], greeting["detail"])
        self._greet(greeting["ready"])
        self._ready.set()
        while True:
            told = await read(process)
            self._pause_s = FIRST_PAUSE_S
            waiting = self._waiting.get(int(told[0]["number"]))
            if waiting is not None and not waiting.done():  # else who asked has gone away
                waiting.set_result(told)

    async def _bury(self) -> None:
        process, self._process = self._process, None
        if self._refused is None:
            self._ready.clear()
        for answer in self._waiting.values():
            if not answer.done():
                answer.set_result(({"failed": self._codes.died}, b""))
        if process is not None:
            # Shielded: whoever cancels us, a process is always waited for.
            self._burial = asyncio.create_task(reap(process))
            await asyncio.shield(self._burial)
