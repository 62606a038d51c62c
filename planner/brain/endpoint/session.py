"""Own the line to one endpoint: consent, client, dialect, and the turns of those who ask."""

from __future__ import annotations

import asyncio
import time
from collections.abc import Awaitable, Callable
from pathlib import Path
from typing import TYPE_CHECKING, TypeVar

from planner.brain.endpoint.capabilities_file import Dialects
from planner.brain.endpoint.completion import Asker
from planner.brain.endpoint.http_client import Client
from planner.brain.endpoint.url_policy import Address
from planner.brain.errors import BrainDown
from planner.brain.usage_meter import Meter, thinking_about
from planner.settings import ModelSettings
from wire import Misconfigured

if TYPE_CHECKING:
    import httpx

T = TypeVar("T")


class Line:
    """Be shared by all that ask one model: whoever plans, and whoever looks."""

    def __init__(
        self,
        settings: ModelSettings,
        home: Path,
        transport: httpx.AsyncBaseTransport | None,
        meter: Meter | None,
    ) -> None:
        """Judge the address; nothing is asked yet.

        Raises:
            Misconfigured: ``model_url``, ``model_offhost``.
        """
        self.address = Address.parse(settings.url)
        if not self.address.local and not settings.allow_offhost:
            raise Misconfigured(
                "model_offhost",
                f"what people say would be sent to {self.address.host}; if that is meant, set "
                "allow_offhost = true in [model], or PONS_MODEL_ALLOW_OFFHOST=1",
            )
        self.settings = settings
        self.client = Client(self.address, settings, transport, meter)
        self.dialects = Dialects(home, settings, self.address.url)
        self.asker = Asker(settings, self.client, self.dialects)
        self._turns = asyncio.Semaphore(settings.parallel)

    async def turn(self, goal: str, talk: Callable[[float], Awaitable[T]], wanted: str) -> T:
        """Return what comes of talking, inside one deadline that spans waiting for a turn.

        Args:
            goal: whose budget pays.
            talk: is told when its time is up, on the monotonic clock.
            wanted: what is told that there is none of.

        Raises:
            BrainDown: ``timeout``; and whatever talking raises.
        """
        end_s = time.monotonic() + self.settings.timeout_s
        try:
            with thinking_about(goal):
                async with asyncio.timeout(self.settings.timeout_s), self._turns:
                    return await talk(end_s)
        except TimeoutError:
            told = f"no {wanted} within {self.settings.timeout_s:g} s"
            raise BrainDown(told, why="timeout") from None
