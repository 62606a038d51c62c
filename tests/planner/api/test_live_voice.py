"""A recording heard while it is spoken: a stop is obeyed at once, and nothing else ever is."""

from __future__ import annotations

import asyncio
import contextlib
import json
from typing import Any

import pytest
from websockets.exceptions import ConnectionClosed
from websockets.sync.client import ClientConnection, connect

from planner.api import live_voice
from planner.voice import Recognition, Sound, VoiceFailure
from tests.planner.api.serving import Served

RATE = '{"rate_hz": 16000}'
PIECE = bytes(3_200)
STOP = Recognition("stop", 0.9, understood=True)


class Played:
    """Hear a stop in the piece with this number, a failure, or nothing for ever."""

    def __init__(self, stop_at: int | None, *, fails: bool = False, hangs: bool = False) -> None:
        self.stop_at, self.fails, self.hangs = stop_at, fails, hangs
        self.heard = 0
        self.rates: set[int] = set()

    async def take(self, sound: Sound) -> Recognition | None:
        if self.fails:
            raise VoiceFailure("recogniser_unavailable", "no wheel")
        if self.hangs:
            await asyncio.Event().wait()
        self.heard += len(sound.pcm) // len(PIECE)
        self.rates.add(sound.rate_hz)
        return STOP if self.stop_at is not None and self.heard >= self.stop_at else None


def opened(server: Served) -> ClientConnection:
    return connect(f"ws://127.0.0.1:{server.port}/v1/voice/live")


def told(socket: ClientConnection) -> dict[str, Any]:
    found = json.loads(socket.recv(5.0))
    assert isinstance(found, dict)
    return found


def ended(socket: ClientConnection) -> int:
    """Return the code that the socket is closed with; fail where it says anything before."""
    with pytest.raises(ConnectionClosed) as closed:
        socket.recv(5.0)
    assert closed.value.rcvd is not None
    return closed.value.rcvd.code


def test_a_stop_is_obeyed_before_the_recording_ends(server: Served) -> None:
    server.services.ears.listeners = [Played(3)]
    with opened(server) as socket:
        socket.send(RATE)
        for _ in range(3):
            socket.send(PIECE)
        assert told(socket) == {
            "type": "stopped", "transcript": "stop", "recogniser": "grammar", "confirmed": True,
        }  # fmt: skip
        assert ended(socket) == 1000
    assert server.services.goals.stops == ["voice"]


def test_what_is_no_stop_does_nothing_at_all(shared_server: Served) -> None:
    listener = Played(None)
    shared_server.services.ears.listeners = [listener]
    with opened(shared_server) as socket:
        socket.send('{"rate_hz": 48000}')
        for _ in range(5):
            socket.send(PIECE)
        socket.send('{"end": true}')
        assert ended(socket) == 1000
    assert (listener.heard, listener.rates) == (5, {48_000})
    assert shared_server.services.goals.stops == []
    assert shared_server.services.goals.calls == []


@pytest.mark.parametrize("other", [Played(None, fails=True), Played(None, hangs=True)])
def test_a_listener_that_fails_or_hangs_keeps_no_stop_of_another_back(
    server: Served, other: Played
) -> None:
    server.services.ears.listeners = [other, Played(2)]
    with opened(server) as socket:
        socket.send(RATE)
        socket.send(PIECE)
        socket.send(PIECE)
        assert told(socket)["type"] == "stopped"


def test_a_stop_that_is_heard_after_the_last_piece_still_stops(server: Served) -> None:
    server.services.ears.listeners = [Played(4)]
    with opened(server) as socket:
        socket.send(RATE)
        with contextlib.suppress(ConnectionClosed):
            for _ in range(4):
                socket.send(PIECE)
            socket.send('{"end": true}')
        assert told(socket)["type"] == "stopped"


@pytest.mark.parametrize(
    ("frames", "code"),
    [
        ((PIECE,), "rate_missing"),
        (("{}",), "rate_missing"),
        (('{"rate_hz": 1e9}',), "rate_missing"),
        (('{"rate_hz": true}',), "rate_missing"),
        (('{"rate_hz": NaN}',), "rate_missing"),
        (("[" * 900,), "rate_missing"),
        (("x" * 2_000,), "rate_missing"),
        ((RATE, b"odd"), "sound_malformed"),
        ((RATE, "go to the kitchen"), "unknown_message"),
        (('{"rate_hz": 8000}', *[bytes(4_000)] * 81), "audio_too_long"),
    ],
)
def test_what_is_no_recording_is_refused_by_its_code(
    shared_server: Served, frames: tuple[str | bytes, ...], code: str
) -> None:
    shared_server.services.ears.listeners = [Played(None)]
    with opened(shared_server) as socket:
        with contextlib.suppress(ConnectionClosed):
            for frame in frames:
                socket.send(frame)
        assert told(socket)["code"] == code
        assert ended(socket) == live_voice.POLICY_VIOLATION
    assert shared_server.services.goals.stops == []


def test_who_says_nothing_is_not_waited_for(
    shared_server: Served, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(live_voice, "PATIENCE_S", 0.05)
    with opened(shared_server) as socket:
        assert told(socket)["code"] == "voice_silent"


def test_the_oldest_of_an_address_goes_for_a_new_one(server: Served) -> None:
    server.services.ears.listeners = [Played(None)]
    with contextlib.ExitStack() as stack:
        held = [stack.enter_context(opened(server)) for _ in range(live_voice.MOST_OF_ADDRESS)]
        newest = stack.enter_context(opened(server))
        assert told(held[0])["code"] == "voice_seat_over"
        for socket in (*held[1:], newest):
            socket.send(RATE)
            socket.send('{"end": true}')
            assert ended(socket) == 1000


def test_sound_that_trickles_holds_no_seat_for_ever(
    shared_server: Served, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(live_voice, "MOST_CLOCK_S", 0.05)
    shared_server.services.ears.listeners = [Played(None)]
    with opened(shared_server) as socket:
        socket.send(RATE)
        assert told(socket)["code"] == "voice_seat_over"


async def test_a_seat_too_many_takes_the_oldest_of_all() -> None:
    seats, over, both = live_voice.RecordingSeats(), [], asyncio.Event()

    async def hold(number: int) -> None:
        try:
            async with asyncio.timeout(60.0) as limit, seats.hold(f"a{number}", limit):
                await asyncio.Event().wait()
        except TimeoutError:
            over.append(number)
            if len(over) == 2:
                both.set()

    holding = [asyncio.create_task(hold(n)) for n in range(live_voice.MOST_SOCKETS + 2)]
    await both.wait()
    for task in holding:
        task.cancel()
    await asyncio.gather(*holding, return_exceptions=True)
    assert over == [0, 1]
