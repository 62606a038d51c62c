"""Own the line to one endpoint: consent, client, turns and deadlines of its callers, a slow load.

A server on this machine that has not been heard for a while may have to load its model first, and
ends the load where the client leaves. Its silence is therefore told from a thought that takes long:
the deadline begins with its first word, and one connection stays open until then.
"""

from __future__ import annotations

import asyncio
import ipaddress
import logging
import time
from collections.abc import Awaitable, Callable
from pathlib import Path
from typing import TYPE_CHECKING, Any, TypeVar

from planner.brain.endpoint.dialect import Body, Dialects, body_of
from planner.brain.endpoint.http_client import Client
from planner.brain.endpoint.response import BadRequest, StreamBroken
from planner.brain.endpoint.session import Asker
from planner.brain.errors import BrainDown, StillLoading
from planner.brain.schema import Message
from planner.brain.usage_meter import Meter, thinking_about
from planner.settings import ModelSettings
from planner.settings.model_address import need_local_or_allowed

if TYPE_CHECKING:
    import httpx

log = logging.getLogger(__name__)

COLD_S = 60.0
"""Without a word from the server, after which its model may have been unloaded (Ollama: 300 s)."""
SLOW_S = 4.0
"""Without a word, after which a person is told that the model may be loading."""
WARM_UP = "warm-up"
"""To whose account the call at the planner's start goes."""
T = TypeVar("T")


class Line:
    """Share one model's connection between the planning and the looking brain."""

    def __init__(
        self,
        settings: ModelSettings,
        home: Path,
        transport: httpx.AsyncBaseTransport | None,
        meter: Meter | None,
    ) -> None:
        """Judge the address; nothing is asked yet.

        Raises:
            ConfigError: ``model_url``, ``model_offhost``.
        """
        self.address = need_local_or_allowed(settings)
        self.settings = settings
        self.client = Client(self.address, settings, transport, meter)
        self.dialects = Dialects(home, settings, self.address.url)
        self.asker = Asker(settings, self.client, self.dialects)
        self._turns = asyncio.Semaphore(settings.parallel)
        near = self.address.local or (
            self.address.literal and ipaddress.ip_address(self.address.host).is_private
        )
        self.client.patient = near and settings.load_timeout_s > 0.0
        known = settings.known_preset is not None and self.address.local
        self.warms_up = self.client.patient and (
            known if settings.warm_up is None else settings.warm_up
        )
        """Whether the model is to be loaded when the planner starts."""
        self._held: asyncio.Task[Any] | None = None
        """The conversation whose connection a server that loads must not lose."""
        self._waited_in_vain = False

    async def turn(
        self,
        goal: str,
        talk: Callable[[float], Awaitable[T]],
        wanted: str,
        slow: Callable[[], None] = lambda: None,
    ) -> T:
        """Return a conversation's result, inside one deadline that spans waiting for a turn.

        Where the model may have to be loaded first, the deadline begins with the server's first
        word, and what was asked for stays asked: see :class:`StillLoading`.

        Args:
            goal: whose budget pays.
            talk: is told when its time is up, on the monotonic clock.
            wanted: what is told that there is none of.
            slow: is called where the server has not said a word for some seconds.

        Raises:
            StillLoading: the server has not answered, and may be loading.
            BrainDown: ``timeout``; and whatever talking raises.
        """
        if not self._may_load():
            return await self._talk_in_time(goal, talk, wanted)
        task = asyncio.create_task(self._load(goal, talk, wanted, slow))
        try:
            done, _ = await asyncio.wait({task}, timeout=self.settings.timeout_s)
        except asyncio.CancelledError:
            task.cancel()
            await asyncio.wait({task})
            raise
        if done:
            return task.result()
        task.add_done_callback(lambda ended: ended.cancelled() or ended.exception())
        if self._held is None or self._held.done():
            self._held = task
        told = f"no {wanted} within {self.settings.timeout_s:g} s, and not a word for long before"
        raise StillLoading(told, lambda: self._later(task), lambda: self._drop(task))

    async def _talk_in_time(
        self, goal: str, talk: Callable[[float], Awaitable[T]], wanted: str
    ) -> T:
        end_s = time.monotonic() + self.settings.timeout_s
        try:
            with thinking_about(goal):
                async with asyncio.timeout(self.settings.timeout_s), self._turns:
                    return await talk(end_s)
        except TimeoutError:
            told = f"no {wanted} within {self.settings.timeout_s:g} s"
            raise BrainDown(told, why="timeout") from None

    def _may_load(self) -> bool:
        """Tell whether the model may have to be loaded: it is near, and was not heard lately.

        Where a load was waited for in vain, the server is not given so much time again until it
        has said a word.
        """
        silent_s = time.monotonic() - self.client.heard_s
        return self.client.patient and silent_s > COLD_S and not self._waited_in_vain

    async def _load(
        self,
        goal: str,
        talk: Callable[[float], Awaitable[T]],
        wanted: str,
        slow: Callable[[], None],
    ) -> T:
        """Talk to a server that may be loading: its time begins with its first word."""
        loop, limit = asyncio.get_running_loop(), asyncio.timeout(self.settings.load_timeout_s)
        teller = loop.call_later(SLOW_S, slow)

        def hear() -> None:
            teller.cancel()
            self._waited_in_vain = False
            if not limit.expired():
                limit.reschedule(loop.time() + self.settings.timeout_s)

        try:
            with thinking_about(goal):
                async with limit:
                    self.client.listeners.add(hear)
                    async with self._turns:
                        return await talk(time.monotonic() + self.settings.timeout_s)
        except TimeoutError:
            heard = hear not in self.client.listeners
            self._waited_in_vain = not heard
            told = f"no {wanted} within {self.settings.timeout_s:g} s of the first word"
            if not heard:
                told = f"not a word within {self.settings.load_timeout_s:g} s"
            raise BrainDown(told, why="timeout" if heard else "loading") from None
        finally:
            teller.cancel()
            self.client.listeners.discard(hear)

    async def _later(self, task: asyncio.Task[T]) -> T:
        try:
            return await asyncio.shield(task)
        except asyncio.CancelledError:
            self._drop(task)
            raise

    def _drop(self, task: asyncio.Task[Any]) -> None:
        """Give up a conversation, unless it is the one whose connection loads the model."""
        if task is not self._held:
            task.cancel()

    async def warm_up(self, messages: list[Message], schema: Body) -> None:
        """Have the model loaded, and the part of the prompt that never changes read, in one call.

        What comes of it is nobody's failure: the first order finds out.
        """

        async def talk(_end_s: float) -> None:
            dialect = self.dialects.current
            body = body_of(self.settings, dialect, messages, schema)
            await self.client.post(body | {dialect.tokens_field: 1}, 0.0)

        try:
            await self._load(WARM_UP, talk, "word", lambda: None)
        except (BrainDown, BadRequest, StreamBroken) as failure:
            log.info("%s was not warmed up: %s", self.settings.name, failure)

    async def close(self) -> None:
        """Give the connections back."""
        if self._held is not None:
            self._held.cancel()
            await asyncio.wait({self._held})
        await self.client.close()
