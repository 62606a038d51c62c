"""Ask one endpoint in the way that it understands, and find that way by use.

A body that is refused is made simpler and sent again; a stream that breaks is asked for plainly.
Neither has any effect outside of the call: nothing moves before a whole reply was judged.
"""

from __future__ import annotations

import logging
import time
from dataclasses import replace

from planner.brain.endpoint.completion import ModelReply, is_too_long, read_reply, why_down
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
from planner.settings import ModelSettings

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
        again: bool = False,
    ) -> ModelReply:
        """Return a reply to these messages.

        A way of asking that is taken and brings nothing is left for the next; what then brings
        something is remembered. ``told`` takes what is written so far (None: no stream), until
        ``end_s`` on the monotonic clock; ``form`` names the reply, ``picture`` is a data URL.
        ``again``: the reply before it was no use, so the way of asking stays.

        Raises BrainDown, or NotSent where no picture is taken, or not this one.
        """
        dialect, refused, barren = self._dialects.current, list[Body](), list[ModelReply]()
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
                if simpler is not None and len(refused) < MAX_REFUSED:
                    dialect = simpler
                elif barren:
                    return barren[0]
                else:
                    raise self._given_up(no, with_picture=picture is not None) from None
            else:
                self._breaks = 0 if stream else self._breaks
                if picture is not None:
                    dialect = replace(dialect, pictures=True)
                reply = self._read(content, form)
                below = None if again or not reply.is_barren else next(dialect.lower(), None)
                if below is None:
                    self._keep(dialect, reply, barren)
                    return _add_cost(reply, barren)
                log.info("%s brought nothing by %s", self._settings.name, dialect.mode.value)
                barren.append(reply)
                dialect = below

    def _given_up(self, no: BadRequest, *, with_picture: bool) -> BrainDown | NotSent:
        """Return the failure of a body that no simpler one could take the place of."""
        if with_picture and self._dialects.kept:
            self._sightless = True  # it took words before: what is new is the picture
            return NotSent(str(no), why="no_pictures")
        why = "context_too_small" if is_too_long(str(no)) else "bad_request"
        return BrainDown(str(no), why=why, server=str(no).partition(": ")[2])

    def _keep(self, dialect: Dialect, reply: ModelReply, barren: list[ModelReply]) -> None:
        """Remember a way of asking that brought something."""
        if not reply.is_barren:
            self._dialects.keep(dialect, barren=bool(barren))

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
            why = why_down(broken.server) if broken.server else "bad_reply"
            told = f"the stream broke: {broken}"
            raise BrainDown(told, why=why, server=broken.server) from None
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

    def _read(self, content: object, form: ReplyForm) -> ModelReply:
        struck = self._client.secret.redact
        try:
            reply = read_reply(content, form.name)
        except BrainDown as down:
            told = struck(str(down))
            raise BrainDown(told, why=down.why, server=struck(down.server)) from None
        return replace(reply, text=struck(reply.text))


def _add_cost(reply: ModelReply, before: list[ModelReply]) -> ModelReply:
    """Return a reply with what those before it have cost, too."""
    return replace(reply, tokens=sum((each.tokens for each in before), reply.tokens))
