"""Hear a recording while it is being spoken, over a WebSocket: for a stop, and for nothing else.

First ``{"rate_hz": 48000}``, then samples of 16 bits and one channel in binary frames of at most
4096 bytes, as they come from the microphone, then ``{"end": true}`` or a close. A stop is obeyed at
once, before the person has let the button go, and told; every other word waits for the whole
recording (``/v1/voice``). Whoever may look may stop, by voice too.
"""

from __future__ import annotations

import asyncio
import contextlib
import json
import logging
from typing import TYPE_CHECKING, Any

from fastapi import APIRouter, WebSocket, WebSocketDisconnect

from planner.api.access import SUBPROTOCOL
from planner.api.crowd import address_of
from planner.api.interfaces import Services
from planner.people import name_asker
from planner.voice import Recognition, Sound, StopListener, VoiceFailure

if TYPE_CHECKING:
    from collections.abc import AsyncIterator, Mapping

log = logging.getLogger(__name__)

MOST_SOCKETS, MOST_OF_ADDRESS = 4, 2
"""Each may keep a processor busy while somebody talks. Room is made, never refused: the oldest of
the address goes, else the oldest of all."""
MOST_CLOCK_S = 30.0
"""From the opening on: sound that trickles holds a seat no longer than sound that streams."""
MOST_SECONDS = 20.0
"""Of sound; a page ends a recording after 14 s."""
PATIENCE_S = 5.0
"""Without a frame."""
MIN_RATE_HZ, MAX_RATE_HZ = 8_000, 48_000
POLICY_VIOLATION = 1008


class NoRecording(Exception):
    """Refuse frames that are no recording; ``code`` is stable."""

    def __init__(self, code: str, detail: str) -> None:
        super().__init__(f"{code}: {detail}")
        self.code, self.detail = code, detail


class RecordingSeats:
    """Hand out what recordings are heard at, so that nobody takes them away for good."""

    def __init__(self) -> None:
        self._held: list[tuple[str, asyncio.Timeout]] = []

    @contextlib.asynccontextmanager
    async def hold(self, address: str, limit: asyncio.Timeout) -> AsyncIterator[None]:
        """Hold a seat; where it is needed for a newer recording, its limit ends at once."""
        own = [seat for seat in self._held if seat[0] == address]
        if len(own) >= MOST_OF_ADDRESS:
            self._end(own[0])
        elif len(self._held) >= MOST_SOCKETS:
            self._end(self._held[0])
        seat = address, limit
        self._held.append(seat)
        try:
            yield
        finally:
            if seat in self._held:
                self._held.remove(seat)

    def _end(self, seat: tuple[str, asyncio.Timeout]) -> None:
        self._held.remove(seat)
        seat[1].reschedule(asyncio.get_running_loop().time())


def routes(services: Services) -> APIRouter:
    """Return the socket."""
    router = APIRouter(tags=["goals"])
    seats = RecordingSeats()

    @router.websocket("/v1/voice/live")
    async def live(socket: WebSocket) -> None:
        offered = socket.scope.get("subprotocols", ())
        await socket.accept(subprotocol=SUBPROTOCOL if SUBPROTOCOL in offered else None)
        address = address_of(socket.client.host) if socket.client else ""
        with contextlib.suppress(WebSocketDisconnect, RuntimeError):  # gone: nobody to tell
            try:
                async with asyncio.timeout(MOST_CLOCK_S) as limit, seats.hold(address, limit):
                    await _attend(services, socket)
            except TimeoutError:
                told = f"a seat is held for {MOST_CLOCK_S:g} s, and the oldest goes for a new one"
                await _refuse(socket, NoRecording("voice_seat_over", told))

    return router


async def _attend(services: Services, socket: WebSocket) -> None:
    try:
        rate_hz = _rate(await _frame(socket))
    except NoRecording as refused:
        await _refuse(socket, refused)
        return
    feeds = [_Feed(each, rate_hz) for each in services.ears.listen()]
    reading = asyncio.create_task(_read(socket, feeds, rate_hz))
    hearing = [asyncio.create_task(feed.run()) for feed in feeds]
    try:
        stop = await _first_stop(reading, hearing)
        if stop is not None:
            await _obey(services, socket, stop)
        elif reading.done():
            reading.result()
        await socket.close()
    except NoRecording as refused:
        await _refuse(socket, refused)
    finally:
        for task in (reading, *hearing):
            task.cancel()
        await asyncio.gather(reading, *hearing, return_exceptions=True)


async def _first_stop(
    reading: asyncio.Task[None], hearing: list[asyncio.Task[Recognition | None]]
) -> Recognition | None:
    """Return the first stop that any listener hears; None at the end of the recording without."""
    waiting: set[asyncio.Task[Any]] = {reading, *hearing}
    while not waiting.isdisjoint(hearing):
        done, waiting = await asyncio.wait(waiting, return_when=asyncio.FIRST_COMPLETED)
        for task in done - {reading}:
            if task.result() is not None:
                stop: Recognition = task.result()
                return stop
    await asyncio.wait({reading})
    return None


async def _obey(services: Services, socket: WebSocket, stop: Recognition) -> None:
    stopped = await services.goals.stop(name_asker("voice"))
    log.info("stopped by voice, in the middle of a recording")
    told = {"transcript": stop.transcript, "recogniser": stop.by, "confirmed": stopped.is_echoed}
    await socket.send_text(json.dumps({"type": "stopped", **told}, ensure_ascii=False))


class _Feed:
    """Collect what one listener has not heard yet: a slow one hears more at a time."""

    def __init__(self, listener: StopListener, rate_hz: int) -> None:
        self._listener, self._rate_hz = listener, rate_hz
        self._pcm = bytearray()
        self._news, self._ended = asyncio.Event(), False

    def add(self, pcm: bytes) -> None:
        self._pcm += pcm
        self._news.set()

    def end(self) -> None:
        self._ended = True
        self._news.set()

    async def run(self) -> Recognition | None:
        """Return the stop that was heard, or None at the end or where it can't hear."""
        while not (self._ended and not self._pcm):
            await self._news.wait()
            self._news.clear()
            pcm, self._pcm = bytes(self._pcm), bytearray()
            if not pcm:
                continue
            try:
                stop = await self._listener.take(Sound(self._rate_hz, 1, pcm))
            except VoiceFailure as failure:
                log.warning("not heard while it was spoken: %s", failure)
                return None
            if stop is not None:
                return stop
        return None


async def _read(socket: WebSocket, feeds: list[_Feed], rate_hz: int) -> None:
    """Hand samples on until the recording ends.

    Raises:
        NoRecording: what came is none.
    """
    taken, most = 0, int(MOST_SECONDS * rate_hz) * 2
    try:
        while True:
            message = await _frame(socket)
            pcm = message.get("bytes")
            if pcm is None:
                if _content(message).get("end") is True or message["type"] != "websocket.receive":
                    return
                raise NoRecording("unknown_message", 'expected samples or {"end": true}')
            taken += len(pcm)
            if len(pcm) % 2:
                raise NoRecording("sound_malformed", f"{len(pcm)} bytes are no whole samples")
            if taken > most:
                raise NoRecording("audio_too_long", f"at most {MOST_SECONDS:g} s")
            for feed in feeds:
                feed.add(pcm)
    finally:
        for feed in feeds:
            feed.end()


async def _frame(socket: WebSocket) -> Mapping[str, Any]:
    try:
        async with asyncio.timeout(PATIENCE_S):
            return await socket.receive()
    except TimeoutError:
        raise NoRecording("voice_silent", f"nothing came for {PATIENCE_S:g} s") from None


def _rate(message: Mapping[str, Any]) -> int:
    rate_hz = _content(message).get("rate_hz")
    if type(rate_hz) is int and MIN_RATE_HZ <= rate_hz <= MAX_RATE_HZ:
        return rate_hz
    told = f'expected {{"rate_hz": …}} of {MIN_RATE_HZ} to {MAX_RATE_HZ} first'
    raise NoRecording("rate_missing", told)


def _content(message: Mapping[str, Any]) -> dict[str, Any]:
    text = message.get("text")
    if not isinstance(text, str) or len(text) > 1_000:
        return {}
    try:
        content = json.loads(text)
    except (ValueError, RecursionError):
        return {}
    return content if isinstance(content, dict) else {}


async def _refuse(socket: WebSocket, refused: NoRecording) -> None:
    told = {"type": "problem", "code": refused.code, "detail": refused.detail}
    await socket.send_text(json.dumps(told))
    await socket.close(POLICY_VIOLATION, refused.code)
