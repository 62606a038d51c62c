"""Supervise a worker process from a loop that must never wait.

The worker's supervision is asyncio's, in a thread of its own, which must be started before the
owner takes real-time priority: what it starts inherits its rank.
"""

from __future__ import annotations

import asyncio
import logging
import threading
from math import inf
from typing import TYPE_CHECKING, Any

from processes.worker import SupervisedWorker
from processes.worker_protocol import FailureCodes, WorkerFailure

if TYPE_CHECKING:
    from collections.abc import Coroutine

log = logging.getLogger(__name__)

READY_S = 60.0
"""To start Python and numpy on a busy board and load a map."""
LONGEST_PAUSE_S = 5.0


class WorkerThread:
    """Run one worker's supervision, and what asks it, in a thread."""

    def __init__(
        self, name: str, module: str, arguments: tuple[str, ...], codes: FailureCodes,
        rests_after_s: float = inf,
    ) -> None:  # fmt: skip
        """Describe both; :meth:`start` starts them.

        Args:
            name: of the thread.
            module: the worker's.
            arguments: of its command line.
            codes: of its failures.
            rests_after_s: of no request, until the process is ended; the next one starts it.
        """
        self.worker = SupervisedWorker(
            *(module, arguments, codes),
            one_at_a_time=True,
            first_word_s=READY_S,
            longest_pause_s=LONGEST_PAUSE_S,
            rests_after_s=rests_after_s,
        )
        self._loop = asyncio.new_event_loop()
        self._thread = threading.Thread(target=self._serve, name=name, daemon=True)
        self._tasks: set[asyncio.Task[None]] = set()

    def start(self) -> None:
        """Start the thread and, in it, the process."""
        self._thread.start()
        self.schedule(self._start())

    def schedule(self, work: Coroutine[Any, Any, None]) -> None:
        """Have the thread do something; nobody waits for it."""
        self._loop.call_soon_threadsafe(self._begin, work)

    def close(self) -> None:
        """End what is scheduled, the process and the thread."""
        asyncio.run_coroutine_threadsafe(self._end(), self._loop).result()
        self._loop.call_soon_threadsafe(self._loop.stop)
        self._thread.join()
        self._loop.close()

    def _serve(self) -> None:
        asyncio.set_event_loop(self._loop)
        self._loop.run_forever()

    def _begin(self, work: Coroutine[Any, Any, None]) -> None:
        task = self._loop.create_task(work)
        self._tasks.add(task)
        task.add_done_callback(self._tasks.discard)

    async def _start(self) -> None:
        try:
            await self.worker.start(READY_S)
        except WorkerFailure as failure:
            log.error("%s", failure)

    async def _end(self) -> None:
        for task in self._tasks:
            task.cancel()
        await self.worker.close()
