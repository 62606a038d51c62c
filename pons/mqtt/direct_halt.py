"""Stop the robot at the bridge itself, by a link that stands before anybody needs it.

The order of ``pons stop`` without a process's start: ``cmd/stop`` at 20 Hz until the bridge echoes
it. The planner is asked beside it as the second way; its model is never waited for.
"""

from __future__ import annotations

import asyncio
import logging
import secrets
import time
from concurrent.futures import ThreadPoolExecutor
from typing import TYPE_CHECKING

from pons.http import PlannerDown, PlannerProblem, call
from wire import Stop
from wire.doors import BRIDGE_DOOR
from wire.keys import ANY_ROBOT, STATUS, STOP, Party
from wire.session import open_session
from wire.sockets import misplaced_listener

if TYPE_CHECKING:
    from pons.settings import LaunchSettings

log = logging.getLogger("home")

SOURCE = "mqtt"
PERIOD_S = 0.05
LIMIT_S = 2.0
_POLL_S = 0.01
_HTTP_TIMEOUT_S = 2.5


class DirectHalt:
    """Keep an operator's link to the bridge, and stop by it."""

    def __init__(self, settings: LaunchSettings) -> None:
        self._settings = settings
        self._session = open_session(Party.OPERATOR, ANY_ROBOT, settings.home)
        self._mouth = self._session.publisher(STOP)
        self._ears = self._session.subscriber(STATUS)
        self._aside = ThreadPoolExecutor(1, "second-way")
        self._task: asyncio.Task[bool] | None = None

    def close(self) -> None:
        """Leave the bridge."""
        self._session.close()
        self._aside.shutdown(wait=False, cancel_futures=True)

    def stop(self) -> None:
        """Say stop now; ``is_confirmed`` tells later what came of it.

        While an earlier one is not confirmed, it stands for this one too: it is said again anyway.
        """
        if self._task is None or self._task.done():
            order = Stop(id=f"{SOURCE}-{secrets.token_hex(6)}", source=SOURCE)
            self._mouth.put(order)  # here, before anything else of this process has its turn
            self._task = asyncio.get_running_loop().create_task(self._confirm(order))

    async def is_confirmed(self) -> bool:
        """Wait up to 3 s and return whether bridge or planner confirmed the newest stop."""
        return self._task is not None and await self._task

    async def _confirm(self, order: Stop) -> bool:
        loop = asyncio.get_running_loop()
        second = loop.run_in_executor(self._aside, self._ask_planner)
        if await self._until_echoed(order):
            trouble = misplaced_listener(self._settings.home, BRIDGE_DOOR)
            if trouble is None:
                return True
            log.error("no_bridge: %s", trouble)
        confirmed = await second
        if not confirmed:
            log.error("no_bridge: neither bridge nor planner confirmed the stop")
        return confirmed

    async def _until_echoed(self, order: Stop) -> bool:
        end_s, next_s = time.monotonic() + LIMIT_S, time.monotonic() + PERIOD_S
        while (now_s := time.monotonic()) < end_s:
            if now_s >= next_s:
                self._mouth.put(order)
                next_s = now_s + PERIOD_S
            status = self._ears.newest()
            if status is not None and any(answer.id == order.id for answer in status.answers):
                return True
            await asyncio.sleep(_POLL_S)
        return False

    def _ask_planner(self) -> bool:
        try:
            body = {"source": SOURCE}
            answer = call(self._settings, "POST", "/v1/stop", body, timeout_s=_HTTP_TIMEOUT_S)
        except (PlannerDown, PlannerProblem) as trouble:
            log.warning("the stop's second way: %s", trouble)
            return False
        return bool(answer.get("confirmed"))
