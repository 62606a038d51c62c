"""What a connection may hold before its request is complete is bounded; a stop gets through."""

from __future__ import annotations

import socket
import time
from collections.abc import Iterator
from dataclasses import replace

import pytest
from websockets.exceptions import ConnectionClosed
from websockets.sync.client import connect

from planner.api.connections import protocol
from planner.api.crowd import Bounds
from tests.planner.api.serving import Served, answer_of, eventually, read_all, request, served

pytestmark = pytest.mark.nightly(keep=12)


QUICK = Bounds(request_s=0.4, stalled_s=0.4, linger_s=0.3)
SMALL = replace(QUICK, request_s=5.0, an_address=8, all=12, burst=30)
PATIENT = replace(QUICK, request_s=30.0, body_bytes=4_000_000)
GOAL = b"POST /v1/goals HTTP/1.1\r\nHost: 127.0.0.1\r\nContent-Type: application/json\r\n"
HEAD = b"POST /v1/stop HTTP/1.1\r\nHost: 127.0.0.1\r\nConnection: close\r\n"


@pytest.fixture(scope="module")
def quick() -> Iterator[Served]:
    with served(bounds=QUICK) as server:
        yield server


@pytest.fixture(scope="module")
def patient() -> Iterator[Served]:
    with served(bounds=PATIENT) as server:
        yield server


@pytest.mark.parametrize(
    ("begun", "status"),
    [
        (b"", 0),
        (b"G", 408),
        (b"GET / HTTP/1.1\r\nHost: 127", 408),
        (request("GET", "/healthz").replace(b"Connection: close\r\n", b"") + b"GET", 408),
    ],
    ids=["silent", "a letter", "half a head", "half a second request"],
)
def test_a_connection_without_a_complete_request_ends(
    quick: Served, begun: bytes, status: int
) -> None:
    with quick.connect() as asking:
        asking.sendall(begun)
        said = read_all(asking)  # returns when the server has closed
    assert (b" 408 " in said) is (status == 408), said
    assert eventually(lambda: len(quick.http.crowd) == 0)


def trickle(asking: socket.socket, piece: bytes, limit_s: float) -> bool:
    """Send a piece ten times a second; return whether the server ended it in time."""
    end_s = time.monotonic() + limit_s
    asking.settimeout(0.1)
    while time.monotonic() < end_s:
        try:
            asking.sendall(piece)
            if not asking.recv(65_536):
                return True
        except TimeoutError:
            continue
        except ConnectionError:
            return True
    return False


@pytest.mark.parametrize(
    "head",
    [
        b"GET / HTTP/1.1\r\nHost: 127.0.0.1\r\nX: ",
        GOAL + b"Content-Length: 9000\r\n\r\n",
        GOAL + b"Transfer-Encoding: chunked\r\n\r\n1f40\r\n",
    ],
    ids=["header", "body", "chunk"],
)
def test_what_trickles_ends(quick: Served, head: bytes) -> None:
    with quick.connect() as asking:
        asking.sendall(head)
        assert trickle(asking, b"a", 8.0)


def test_a_body_that_comes_fast_enough_may_take_longer(quick: Served) -> None:
    """Three times the time of a head, in pieces: a slow network is no attack."""
    body = b'{"text": "go' + b" " * 120_000 + b'"}'
    head = request("POST", "/v1/goals", body, "Content-Type: application/json")[: -len(body)]
    with quick.connect() as asking:
        asking.sendall(head)
        for start in range(0, len(body), 10_000):
            asking.sendall(body[start : start + 10_000])
            time.sleep(0.1)
        assert answer_of(asking)[0] == 422  # too long for a goal, and all of it was read


def test_a_stop_whose_body_does_not_come_stops(patient: Served) -> None:
    with patient.connect() as asking:
        asking.sendall(HEAD + b"Content-Length: 5\r\n\r\n{")
        assert answer_of(asking)[0] == 200
    assert patient.services.goals.stops


def test_who_leaves_an_answer_unread_is_let_go() -> None:
    services = served(bounds=replace(QUICK, request_s=30.0, pipelined=1_000))
    with services as server, server.connect() as asking:
        asking.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, 4_096)
        ask = b"GET /v1/map HTTP/1.1\r\nHost: 127.0.0.1\r\n\r\n"
        asking.sendall(ask * 400)
        assert eventually(lambda: len(server.http.crowd) == 1)
        assert eventually(lambda: len(server.http.crowd) == 0)


def test_when_room_is_short_the_oldest_without_a_request_goes_and_a_stop_is_served() -> None:
    with served(bounds=SMALL) as server, server.silent(SMALL.an_address + 1) as silent:
        assert server.stop()
        assert eventually(lambda: len(server.http.crowd) <= SMALL.an_address)
        silent[0].settimeout(5.0)
        assert read_all(silent[0]) == b""
        silent[-1].sendall(request("GET", "/healthz"))
        assert answer_of(silent[-1])[0] == 200


def test_a_crowd_that_comes_at_once_leaves_room_for_a_stop() -> None:
    with served(bounds=SMALL) as server, server.silent(200):
        assert server.stop()
        assert eventually(lambda: len(server.http.crowd) <= SMALL.an_address)


@pytest.mark.parametrize(
    "more",
    [
        b"X: " + b"a" * 200_000,
        b"a: b\r\n" * 200,
        b"\r\n" * 40_000,
        b"Transfer-Encoding: chunked\r\n\r\n0\r\n" + b"a: b\r\n" * 200,
        b"Transfer-Encoding: chunked\r\n\r\n0\r\nX: " + b"a" * 200_000,
        b"Transfer-Encoding: chunked\r\n\r\n1;" + b"a" * 200_000,
        b"Cookie: " + b"a" * 20_000 + b"\r\nX: " + b"a" * 20_000,
    ],
    ids=["long header", "many headers", "blanks", "many trailers", "long trailer",
         "chunk extension", "two long headers"],
)  # fmt: skip
def test_headers_are_bounded_wherever_they_stand(patient: Served, more: bytes) -> None:
    begun = b"" if more.startswith(b"\r") else GOAL
    status, said = patient.ask(begun + more)
    assert (status, said["code"]) == (431, "headers_too_large")
    assert set(said["message"]) == {"en", "zh"}


def test_headers_of_a_usual_size_pass(patient: Served) -> None:
    cookies = [f"Cookie: {'a' * 4_000}"] * 6
    assert patient.ask(request("GET", "/healthz", b"", *cookies))[0] == 200


@pytest.mark.parametrize("raw", [b"nonsense\r\n\r\n", b"GET / HTTP/1.1\r\nA b: c\r\n\r\n"])
def test_what_is_no_http_is_told_so(patient: Served, raw: bytes) -> None:
    status, said = patient.ask(raw)
    assert (status, said["code"]) == (400, "malformed_request")


def test_a_stop_whose_chunks_never_end_stops(patient: Served) -> None:
    before = len(patient.services.goals.stops)
    patient.ask(HEAD + b"Transfer-Encoding: chunked\r\n\r\n1;" + b"a" * 100_000)
    assert eventually(lambda: len(patient.services.goals.stops) > before)


def test_a_body_that_goes_on_after_its_answer_ends(patient: Served) -> None:
    with patient.connect() as asking:
        asking.sendall(GOAL.replace(b"goals", b"x") + b"Content-Length: 990000000000\r\n\r\n")

        def goes_on() -> None:
            end_s = time.monotonic() + 5.0
            while time.monotonic() < end_s:
                asking.sendall(b"a" * 100_000)

        with pytest.raises(ConnectionError):
            goes_on()


def test_who_sends_all_before_reading_reads_the_answer(patient: Served) -> None:
    body = b"a" * 3_000_000
    head = GOAL + f"Connection: close\r\nContent-Length: {len(body)}\r\n\r\n".encode()
    status, said = patient.ask(head + body)
    assert (status, said["code"]) == (413, "body_too_large")


def test_after_an_answer_comes_no_second_one(quick: Served) -> None:
    with quick.connect() as asking:
        asking.sendall(GOAL.replace(b"goals", b"x") + b"Content-Length: 9000\r\n\r\n{")
        assert read_all(asking).count(b"HTTP/1.1") == 1


def test_requests_that_pile_up_unanswered_are_bounded(patient: Served) -> None:
    one = b"GET /healthz HTTP/1.1\r\nHost: 127.0.0.1\r\n\r\n"
    with patient.connect() as asking:
        asking.sendall(one * 2_000)
        assert read_all(asking).count(b"HTTP/1.1 200") < 50


def test_many_small_frames_do_not_hold_up_a_stop() -> None:
    """A socket's frames are read a slice at a time: none of it is lost, and others come between."""
    with (
        served(bounds=PATIENT) as server,
        connect(f"ws://127.0.0.1:{server.port}/v1/events", max_queue=None) as events,
    ):
        raw = events.socket
        raw.sendall((b"\x89\x80" + b"\x00" * 4) * 5_000)  # pings
        events.send('{"stop": true}')
        while '"stopped"' not in str(events.recv(5.0)):
            pass
        assert server.services.goals.stops == ["page"]


def test_endless_fragments_end_a_socket() -> None:
    with (
        served(bounds=PATIENT) as server,
        connect(f"ws://127.0.0.1:{server.port}/v1/events", max_queue=None) as events,
    ):
        events.socket.sendall(b"\x01\x80" + b"\x00" * 4 + (b"\x00\x80" + b"\x00" * 4) * 500)

        def listen() -> None:
            while True:
                events.recv(5.0)

        with pytest.raises(ConnectionClosed):
            listen()


def test_open_sockets_are_no_room_to_make() -> None:
    with (
        served(bounds=SMALL) as server,
        connect(f"ws://127.0.0.1:{server.port}/v1/events", max_queue=None) as events,
        server.silent(100),
    ):
        assert eventually(lambda: len(server.http.crowd) == SMALL.an_address)
        events.send('{"stop": true}')
        while '"stopped"' not in str(events.recv(5.0)):
            pass


def test_a_server_has_a_crowd_of_its_own() -> None:
    assert protocol(QUICK).crowd is not protocol(QUICK).crowd
