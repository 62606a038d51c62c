"""Own the line to one endpoint: consent, client, dialect, and the turns of its callers.

A body that is refused is made simpler and sent again; a stream that breaks is asked for plainly.
Neither has any effect outside of the call: nothing moves before a whole reply was judged.
"""

from __future__ import annotations

import asyncio
import logging
import time
from collections.abc import Awaitable, Callable
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, TypeVar

from planner.brain.endpoint.completion import ModelReply, read_reply
from planner.brain.endpoint.dialect import (
    Body,
    Dialect,
    Dialects,
    body_of,
    not_taken,
    quiet_of,
    why_refused,
)
from planner.brain.endpoint.http_client import Client
from planner.brain.endpoint.response import BadRequest, StreamBroken, Told
from planner.brain.errors import BrainDown
from planner.brain.image_questions import NotSent
from planner.brain.response_format import PLAN_FORM, ReplyForm
from planner.brain.schema import Message
from planner.brain.usage_meter import Meter, thinking_about
from planner.outbound import Address
from planner.settings import ModelSettings
from wire import ConfigError

if TYPE_CHECKING:
    import httpx

log = logging.getLogger(__name__)

MAX_REFUSED = 8
"""Refused bodies until a server counts as one that takes none."""
MAX_BREAKS = 2
"""Streams that broke in a row until this process streams no more."""


class Asker:
    """Own how one endpoint is asked."""

    def __init__(self, settings: ModelSettings, client: Client, dialects: Dialects) -> None:
        self._settings, self._client, self._dialects = settings, client, dialects
        self._quiet = frozenset(quiet_of(settings))
        self._breaks = 0
        self._sightless = False
        """It refused a picture and did not say plainly why; until the next start."""

    @property
    def pictures(self) -> bool | None:
        """Return whether the server takes pictures, as far as was found out."""
        return False if self._sightless else self._dialects.current.pictures

    async def ask(
        self,
        messages: list[Message],
        schema: Body,
        end_s: float,
        told: Told | None,
        *,
        form: ReplyForm = PLAN_FORM,
        picture: str | None = None,
    ) -> ModelReply:
        """Return a reply to these messages.

        Args:
            messages: the prompt.
            schema: of the reply.
            end_s: when the goal's time is up, on the monotonic clock.
            told: takes what is written so far; None: no stream is asked for.
            form: what the reply is called.
            picture: the data URL of a picture that goes with the words.

        Raises:
            BrainDown: there is none.
            NotSent: the server takes no pictures, or not this one.
        """
        dialect, refused = self._dialects.current, list[Body]()
        stream = told is not None and self._settings.stream and self._breaks < MAX_BREAKS

        def body(of: Dialect) -> Body:
            return body_of(
                self._settings, of, messages, schema, stream=stream, form=form, picture=picture
            )

        while True:
            asked = body(dialect)
            try:
                content = await self._client.post(asked, end_s - time.monotonic(), told)
            except StreamBroken as broken:
                stream = self._plainly(stream, broken)
            except BadRequest as no:
                if (answered := self._read_refusal(no)) is not None:
                    return answered
                if picture is not None:
                    self._about_the_picture(no)
                refused.append(asked)
                likely = dialect.simpler(str(no).lower(), self._quiet)
                simpler = next((each for each in likely if body(each) not in refused), None)
                if simpler is None or len(refused) >= MAX_REFUSED:
                    if picture is not None and self._dialects.kept:
                        self._sightless = True  # it took words before: what is new is the picture
                        raise NotSent(str(no), why="no_pictures") from None
                    raise BrainDown(str(no), why="bad_request") from None
                dialect = simpler
            else:
                self._breaks = 0 if stream else self._breaks
                if picture is not None:
                    dialect = replace(dialect, pictures=True)
                return self._read(content, dialect, form)

    def _about_the_picture(self, no: BadRequest) -> None:
        """Raise where a refusal's words are about the picture.

        What is said plainly of all pictures is remembered; what only sounds like it, until the next
        start.
        """
        said = str(no).lower()
        why = why_refused(said)
        if why is None:
            return
        if why == "no_pictures" and not_taken(said) and self._settings.pictures is None:
            self._dialects.keep(replace(self._dialects.current, pictures=False))
        self._sightless = self._sightless or why == "no_pictures"
        raise NotSent(str(no), why=why) from None

    def _plainly(self, stream: bool, broken: StreamBroken) -> bool:
        """Return that no stream is asked for now; a stream that nobody asked for is no reply."""
        if not stream:
            raise BrainDown(f"the stream broke: {broken}", why="bad_reply") from None
        log.info("%s broke its stream (%s): asked plainly", self._settings.name, broken)
        self._breaks += 1
        return False

    def _read_refusal(self, refused: BadRequest) -> ModelReply | None:
        """Return the reply that a refusal holds, where the model or its filter did answer."""
        said = str(refused)
        if refused.declined:
            return ModelReply("", refusal=said)
        if refused.generated is not None:
            return ModelReply(self._client.secret.redact(refused.generated), trouble=said)
        return None

    def _read(self, content: object, dialect: Dialect, form: ReplyForm) -> ModelReply:
        struck = self._client.secret.redact
        try:
            reply = read_reply(content, form.name)
        except BrainDown as down:
            raise BrainDown(struck(str(down)), why=down.why) from None
        self._dialects.keep(dialect)
        return replace(reply, text=struck(reply.text))


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
        self.address = Address.parse(settings.url)
        if not self.address.local and not settings.allow_offhost:
            raise ConfigError(
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
        """Return a conversation's result, inside one deadline that spans waiting for a turn.

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
