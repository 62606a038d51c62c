"""The event socket takes a stop in any frame at any rate; everything else of it is bounded."""

from __future__ import annotations

import json
import time
from contextlib import ExitStack
from typing import Any

import pytest
from websockets.exceptions import ConnectionClosed, InvalidStatus
from websockets.sync.client import ClientConnection, connect

from planner.api.websocket import AT_ONCE, MOST_OF_AN_ADDRESS, MOST_SOCKETS, SNAPSHOT_S, Seats
from tests.planner.api.serving import Served


def opened(server: Served) -> ClientConnection:
    return connect(f"ws://127.0.0.1:{server.port}/v1/events", max_queue=None)


def until(socket: ClientConnection, *kinds: str) -> dict[str, Any]:
    while (frame := json.loads(socket.recv(5.0)))["kind"] not in kinds:
        pass
    assert isinstance(frame, dict)
    return frame


@pytest.mark.parametrize("frame", ['{"stop": true}', b'{"stop": true}'], ids=["text", "bytes"])
def test_a_stop_is_a_stop_in_either_kind_of_frame(server: Served, frame: str | bytes) -> None:
    with opened(server) as socket:
        socket.send(frame)
        assert until(socket, "stopped", "problem")["kind"] == "stopped"
    assert server.services.goals.stops == ["page"]


@pytest.mark.parametrize(
    "frame",
    [b"\xff\xfe\x00", b"", b"[]", b'{"stop": 1}', b"x" * 2_000, "", "[" * 900, '{"stop', "null",
     '"stop"'],
)  # fmt: skip
def test_what_can_not_be_read_is_told_so_and_the_socket_stays(
    shared_server: Served, frame: str | bytes, caplog: pytest.LogCaptureFixture
) -> None:
    with opened(shared_server) as socket:
        socket.send(frame)
        assert until(socket, "problem")["code"] == "unknown_message"
        socket.send('{"stop": true}')
        until(socket, "stopped")
    assert "Traceback" not in caplog.text


def test_snapshots_that_are_asked_for_at_once_are_one_a_second(shared_server: Served) -> None:
    with opened(shared_server) as socket:
        until(socket, "snapshot")
        began_s = time.monotonic()
        socket.send('{"snapshot": true}')
        until(socket, "snapshot")
        for _ in range(30):
            socket.send('{"snapshot": true}')
        until(socket, "snapshot")
        assert time.monotonic() - began_s >= 0.9 * SNAPSHOT_S
        kinds = []
        while time.monotonic() - began_s < 3.0 * SNAPSHOT_S:
            kinds.append(json.loads(socket.recv(5.0))["kind"])
        assert kinds.count("snapshot") == 0, "thirty were one"


def test_who_sends_too_much_is_told_and_closed(shared_server: Served) -> None:
    with opened(shared_server) as socket:
        for _ in range(AT_ONCE + 20):
            socket.send("{}")
        while until(socket, "problem")["code"] != "too_many_messages":
            pass
        with pytest.raises(ConnectionClosed) as closed:
            until(socket)
    assert closed.value.rcvd is not None
    assert closed.value.rcvd.code == 1008


def test_a_stop_has_no_rate(server: Served) -> None:
    with opened(server) as socket:
        for _ in range(2 * AT_ONCE):
            socket.send('{"stop": true}')
        for _ in range(2 * AT_ONCE):
            until(socket, "stopped")
    assert len(server.services.goals.stops) == 2 * AT_ONCE


def seated(server: Served) -> ClientConnection:
    """Open a socket as soon as the planner has noticed that another one left."""
    end_s = time.monotonic() + 5.0
    while True:
        try:
            return opened(server)
        except InvalidStatus:
            if time.monotonic() > end_s:
                raise
            time.sleep(0.01)


def test_sockets_of_an_address_are_bounded_and_a_stop_needs_none(server: Served) -> None:
    with ExitStack() as stack:
        sockets = [stack.enter_context(opened(server)) for _ in range(MOST_OF_AN_ADDRESS)]
        with pytest.raises(InvalidStatus) as refused, opened(server):
            pytest.fail("one more was let in")
        answer = refused.value.response
        assert (answer.status_code, json.loads(answer.body or b"")["code"]) == (
            503,
            "too_many_sockets",
        )
        assert server.stop()
        sockets[0].close()
        with seated(server) as another:
            until(another, "snapshot")


def test_seats_are_bounded_in_all_and_forget_who_left() -> None:
    seats = Seats()
    taken = [name for name in map(str, range(2 * MOST_SOCKETS)) if seats.take(name)]
    assert len(taken) == MOST_SOCKETS
    for name in taken:
        seats.give_back(name)
    assert seats.take("another")
    assert dict(seats._taken) == {"another": 1}
