"""Do work in a fork of this process and hand its result back; its changes are lost with it.

For work that spoils its tools and takes a core: each piece begins with the same memory, two run at
once, and one that crashes fails alone. The forking process must have one thread.
"""

from __future__ import annotations

import os
import pickle
import signal
import traceback
from collections.abc import Callable
from types import TracebackType
from typing import Generic, NoReturn, TypeVar

from processes.parent_death import bind_to_parent

T = TypeVar("T")


class ForkedJob(Generic[T]):
    """One piece of work in a fork; leaving the ``with`` ends it."""

    def __init__(self, work: Callable[[], T]) -> None:
        """Begin it.

        Raises:
            OSError: the system gives no process.
        """
        self._answers, answers = os.pipe()
        parent = os.getpid()
        try:
            self._pid = os.fork()
            if self._pid == 0:
                _run_fork(work, answers, parent)
        except OSError:
            os.close(self._answers)
            raise
        finally:
            os.close(answers)

    def __enter__(self) -> ForkedJob[T]:
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        value: BaseException | None,
        at: TracebackType | None,
    ) -> None:
        os.close(self._answers)
        if self._pid:
            os.kill(self._pid, signal.SIGKILL)
            os.waitpid(self._pid, 0)

    def result(self) -> T:
        """Wait for the end and return the job's result; once.

        Raises:
            ChildProcessError: the work raised or crashed; its traceback is on standard error.
        """
        with os.fdopen(os.dup(self._answers), "rb") as pipe:
            data = pipe.read()
        pid, self._pid = self._pid, 0
        _, status = os.waitpid(pid, 0)
        if status != 0:
            code = os.waitstatus_to_exitcode(status)
            raise ChildProcessError(f"a fork ended with {code}")
        result: T = pickle.loads(data)  # from our own fork, by a pipe that nobody else has
        return result


def _run_fork(work: Callable[[], object], answers: int, parent: int) -> NoReturn:
    """Be the fork: nothing of the parent's stack is ever run on."""
    status = 1
    try:
        if bind_to_parent(parent):
            with os.fdopen(answers, "wb") as pipe:
                pipe.write(pickle.dumps(work()))
            status = 0
    finally:
        if status:
            traceback.print_exc()
        os._exit(status)
