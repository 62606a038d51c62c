"""Keep a worker process running and exchange frames with it.

Whatever becomes of the process, a caller gets an answer or a typed failure in bounded time. Only
the process's own word is a refusal: one that dies, however often and early, is started again. The
recogniser is started by its client and given up at the first odd answer, so it takes the pipes from
here (:func:`spawn`, :func:`exchange`, :func:`reap`) and no :class:`SupervisedWorker`.
"""

from __future__ import annotations

import asyncio
import contextlib
import logging
import os
import signal
from asyncio.subprocess import PIPE, Process
from collections.abc import Callable, Iterator, Sequence
from math import inf
from typing import Any, TypeVar

from processes.backoff import Backoff
from processes.parent_death import worker_command
from processes.worker_protocol import (
    HEADER,
    FailureCodes,
    Frame,
    WorkerFailure,
    pack,
    read_lengths,
    unpack,
)

log = logging.getLogger(__name__)

T = TypeVar("T")
FIRST_PAUSE_S = 0.05
"""Before a process that died is started again; doubled each time until one answers."""
STREAM_ERRORS = (OSError, EOFError, ValueError, KeyError, TypeError)
"""What reading and understanding another process's frames may raise."""
WAKES_S = 20.0
"""More than else may an answer take of a process that rested: on a busy board it starts slowly."""
ONE_THREAD = {"OPENBLAS_NUM_THREADS": "1", "OMP_NUM_THREADS": "1"}
"""These libraries would start a pool of threads, and the bridge needs the cores."""


class Rest:
    """End what nobody has used for a while."""

    def __init__(self, after_s: float, end: Callable[[], None]) -> None:
        """Take how long to wait [s], from each :meth:`put_off` on, and what to call then."""
        self._after_s, self._end = after_s, end
        self._timer: asyncio.TimerHandle | None = None

    def put_off(self) -> None:
        """Begin to wait anew. Where an event loop runs."""
        self.cancel()
        if self._after_s < inf:
            self._timer = asyncio.get_running_loop().call_later(self._after_s, self._end)

    def cancel(self) -> None:
        """Wait no more."""
        if self._timer is not None:
            self._timer.cancel()


class SupervisedWorker:
    """Run a module of ours as a worker process, again whenever it ends."""

    def __init__(
        self,
        module: str,
        arguments: Sequence[str],
        codes: FailureCodes,
        *,
        one_at_a_time: bool,
        first_word_s: float,
        longest_pause_s: float,
        rests_after_s: float = inf,
    ) -> None:
        """Take the worker's command line; nothing is started.

        Args:
            module: its end calls :func:`processes.worker_main.run_worker`.
            arguments: its command line.
            codes: of its failures.
            one_at_a_time: a request waits for its turn, and its time runs meanwhile.
            first_word_s: a process that has not said ready by then is started again.
            longest_pause_s: where the doubling of pauses before new starts ends.
            rests_after_s: of no request, until the process is ended; the next one starts it.
        """
        self._command, self._codes = (module, *arguments), codes
        self._process: Process | None = None
        self._supervision: asyncio.Task[None] | None = None
        self._reaping: asyncio.Task[None] | None = None
        self._ready = asyncio.Event()
        self._refused: WorkerFailure | None = None
        self._waiting: dict[int, asyncio.Future[Frame]] = {}
        self._busy = "busy or " if one_at_a_time else ""
        self._turn = asyncio.Lock() if one_at_a_time else contextlib.nullcontext()
        self._number = 0
        self._backoff = Backoff(FIRST_PAUSE_S, longest_pause_s)
        self._first_word_s = first_word_s
        self._wanted = asyncio.Event()
        self._rest, self._users = Rest(rests_after_s, self._end_unused), 0
        self._is_ended = False
        """Its end, which comes, is no death: nobody needed it."""
        self._has_rested = False
        """Since it was ready last."""

    @property
    def pid(self) -> int | None:
        """Return the process's id while one runs."""
        return None if self._process is None else self._process.pid

    async def start(self, timeout_s: float) -> None:
        """Start the worker and wait until it can answer. Ends by itself, with :meth:`close`.

        Raises:
            WorkerFailure: the worker refused, and nothing is left running; or it is not up yet
                (``down``), and goes on being started.
        """
        if self._supervision is None:
            self._supervision = asyncio.create_task(self._supervise(), name=self._command[0])
        try:
            with self._in_use():
                async with asyncio.timeout(timeout_s):
                    await self._wait_ready()
        except TimeoutError:
            raise self._down_failure(f"not ready after {timeout_s:g} s") from None
        except BaseException:
            await self.close()
            raise

    async def ask(
        self,
        head: dict[str, Any],
        bodies: Sequence[bytes],
        timeout_s: float,
        read_answer: Callable[[Frame], T],
    ) -> T:
        """Return the answer to one request, as ``read_answer`` returns it.

        Raises:
            WorkerFailure: the worker's own, its refusal, ``down``, ``died`` or
                ``timed_out``.
            ValueError: a number in ``head`` is not finite.
        """
        self._raise_unless_running()
        self._number += 1
        number = self._number
        frame = pack({**head, "number": number}, *bodies)
        answer: asyncio.Future[Frame] = asyncio.get_running_loop().create_future()
        timeout_s += WAKES_S if self._has_rested else 0.0
        try:
            with self._in_use():
                async with asyncio.timeout(timeout_s), self._turn:
                    await self._wait_ready()
                    self._waiting[number] = answer
                    await self._send(frame)
                    told = await answer
        except TimeoutError:
            if number not in self._waiting:
                raise self._down_failure(f"it is {self._busy}being restarted") from None
            self._kill()  # it cannot be asked to stop thinking
            raise self._codes.to_failure(self._codes.timed_out, f"after {timeout_s:g} s") from None
        finally:
            self._waiting.pop(number, None)
        return self._read_answer(told, read_answer)

    async def close(self) -> None:
        """End the worker and wait until it is gone. Safe to call twice."""
        self._rest.cancel()
        supervision, self._supervision = self._supervision, None
        if supervision is not None:
            supervision.cancel()
            with contextlib.suppress(asyncio.CancelledError):
                await supervision
        if self._reaping is not None:
            await self._reaping

    def _check_greeting(self, said: Any) -> None:
        """Check the worker's ready word; a WorkerFailure raised here is a refusal for good."""

    def _down_failure(self, detail: str) -> WorkerFailure:
        return self._codes.to_failure(self._codes.down, detail)

    def _death_failure(self) -> WorkerFailure:
        return self._codes.to_failure(self._codes.died)

    def _raise_if_refused(self) -> None:
        if self._refused is not None:
            # Its traceback would grow with each time it is raised.
            raise self._refused.with_traceback(None)

    def _raise_unless_running(self) -> None:
        self._raise_if_refused()
        if self._supervision is None:
            raise self._down_failure("it was not started")

    async def _wait_ready(self) -> None:
        await self._ready.wait()
        self._raise_if_refused()

    async def _send(self, frame: bytes) -> None:
        if self._process is None:
            raise self._death_failure()
        try:
            await send_frame(self._process, frame)
        except OSError:
            raise self._death_failure() from None

    def _read_answer(self, told: Frame, read_answer: Callable[[Frame], T]) -> T:
        head, _ = told
        if "failed" in head:
            raise self._codes.to_failure(head["failed"], head.get("detail", ""))
        try:
            return read_answer(told)
        except (ValueError, KeyError, TypeError) as error:
            log.error("%s gave an answer that is none: %r", self._command[0], error)
            self._kill()  # it is out of step, or of another version
            raise self._death_failure() from None

    @contextlib.contextmanager
    def _in_use(self) -> Iterator[None]:
        self._users += 1
        self._rest.cancel()
        self._wanted.set()
        try:
            yield
        finally:
            self._users -= 1
            if not self._users:
                self._rest.put_off()

    def _end_unused(self) -> None:
        self._wanted.clear()
        self._has_rested = True
        self._is_ended = self._process is not None
        self._kill()

    def _kill(self) -> None:
        self._ready.clear()  # from now on the next request waits for the process that follows
        if self._process is not None:
            kill(self._process)

    async def _supervise(self) -> None:
        """Keep one process running until cancelled, or until it refuses its arguments."""
        while self._refused is None:
            await self._wanted.wait()
            try:
                self._process = await spawn(worker_command(*self._command))
                await self._listen(self._process)
            except WorkerFailure as failure:
                log.error("%s refused what it was given: %s", self._command[0], failure)
                self._refused = failure
                self._ready.set()
            except STREAM_ERRORS as error:
                if not self._is_ended:
                    log.warning(
                        "%s is started again in %g s; its stream ended: %r",
                        *(self._command[0], self._backoff.next_s, error),
                    )
            finally:
                await self._end_process()
            was_ended, self._is_ended = self._is_ended, False
            if self._refused is None and not was_ended:
                await asyncio.sleep(self._backoff.pause_after())

    async def _listen(self, process: Process) -> None:
        """Hand answers to their callers, until the stream ends."""
        async with asyncio.timeout(self._first_word_s):
            greeting, _ = await read_frame(process)
        if "refused" in greeting:
            raise self._codes.to_failure(greeting["refused"], greeting["detail"])
        self._check_greeting(greeting["ready"])
        self._has_rested = False
        self._ready.set()
        while True:
            told = await read_frame(process)
            self._backoff.reset()
            waiting = self._waiting.get(int(told[0]["number"]))
            if waiting is not None and not waiting.done():  # else its caller has gone away
                waiting.set_result(told)

    async def _end_process(self) -> None:
        process, self._process = self._process, None
        if self._refused is None:
            self._ready.clear()
        for answer in self._waiting.values():
            if not answer.done():
                answer.set_result(({"failed": self._codes.died}, b""))
        if process is not None:
            # Shielded: a cancelled caller leaves no process that nobody waits for.
            self._reaping = asyncio.create_task(reap(process))
            await asyncio.shield(self._reaping)


async def spawn(command: Sequence[str]) -> Process:
    """Start a worker process. Raises OSError where the system gives none."""
    return await asyncio.create_subprocess_exec(
        *command, stdin=PIPE, stdout=PIPE, env=os.environ | ONE_THREAD
    )


async def send_frame(process: Process, frame: bytes) -> None:
    """Hand over a frame, and wait while the pipe is full. Raises OSError where it is gone."""
    if process.stdin is None:
        raise BrokenPipeError("the process has no standard input")
    process.stdin.write(frame)
    await process.stdin.drain()


async def read_frame(process: Process) -> Frame:
    """Return the worker's next frame. Raises one of :data:`STREAM_ERRORS`."""
    if process.stdout is None:
        raise BrokenPipeError("the process has no standard output")
    head, body = read_lengths(await process.stdout.readexactly(HEADER.size))
    return unpack(await process.stdout.readexactly(head)), await process.stdout.readexactly(body)


async def exchange(process: Process, frame: bytes) -> Frame:
    """Hand over a frame and return the next one that comes. Raises one of STREAM_ERRORS."""
    await send_frame(process, frame)
    return await read_frame(process)


def kill(process: Process) -> None:
    """Kill a worker in any state."""
    # Not process.kill(): it reaps a dead process, and asyncio's own watcher then finds no child.
    if process.returncode is None:
        with contextlib.suppress(ProcessLookupError):
            os.kill(process.pid, signal.SIGKILL)


async def reap(process: Process) -> None:
    """Kill a worker and wait until it and its pipes are gone. Shield this from cancellation."""
    kill(process)
    if process.stdin is not None:
        process.stdin.close()
    if process.stdout is not None:
        await process.stdout.read()  # to its end, so that the pipe is closed with the process
    await process.wait()
