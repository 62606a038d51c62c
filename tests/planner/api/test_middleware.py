"""The guard: headers on every answer, what nothing takes, and wrong tokens that wait."""

from __future__ import annotations

import asyncio
import logging
import threading
import time

import pytest
from starlette.testclient import TestClient
from starlette.types import Message, Receive, Scope, Send

from planner.api import Access
from planner.api.middleware import FREE, LONGEST_S, MOST_ADDRESSES, Guard, Guesses
from tests.planner.api.serving import Served, request, served

TOKEN = "a token of many characters"
OPEN = Access("127.0.0.1", operator_token=TOKEN)


class Clock:
    """Tell the time that a test sets."""

    now_s = 0.0

    def __call__(self) -> float:
        return self.now_s


def test_each_wrong_token_of_an_address_waits_longer_and_none_for_ever() -> None:
    guesses = Guesses(Clock())
    waits = [guesses.note("192.0.2.1") for _ in range(2_000)]
    assert waits[:FREE] == [0.0] * FREE
    assert waits == sorted(waits)
    assert 0.0 < waits[FREE] < waits[FREE + 1]
    assert waits[-1] == LONGEST_S
    assert guesses.note("192.0.2.2") == 0.0, "another address has made no mistake"


def test_mistakes_are_forgiven_with_time() -> None:
    clock = Clock()
    guesses = Guesses(clock)
    for _ in range(8):
        guesses.note("192.0.2.1")
    clock.now_s = 1_000.0
    assert guesses.note("192.0.2.1") == 0.0


def test_guesses_from_everywhere_take_bounded_memory() -> None:
    guesses = Guesses(Clock())
    for number in range(3 * MOST_ADDRESSES):
        guesses.note(f"10.{number >> 8}.{number & 255}.1")
    assert len(guesses) == MOST_ADDRESSES


def test_the_addresses_of_one_network_are_one() -> None:
    guesses = Guesses(Clock())
    for number in range(1, 100):
        guesses.note(f"2001:db8::{number:x}")
    assert len(guesses) == 1


def test_a_thousand_guesses_are_a_few_lines(caplog: pytest.LogCaptureFixture) -> None:
    clock = Clock()
    guesses = Guesses(clock)
    with caplog.at_level(logging.WARNING):
        for number in range(1_000):
            clock.now_s = number * 0.02
            guesses.note("192.0.2.1")
    said = [record.getMessage() for record in caplog.records]
    assert len(said) == 2
    assert said[0] == "wrong_token: 1 refused, the last from '192.0.2.1'"
    assert "wrong_token: 500 refused" in said[1]


def ask(server: Served, token: str) -> tuple[int, float]:
    began_s = time.monotonic()
    line = f"Authorization: Bearer {token}"
    status, _ = server.ask(request("GET", "/v1/robot", b"", line))
    return status, time.monotonic() - began_s


def test_a_right_token_is_served_while_its_address_guesses() -> None:
    with served(access=OPEN) as server:
        guessing = [
            threading.Thread(target=ask, args=(server, f"wrong {number}")) for number in range(40)
        ]
        for guess in guessing:
            guess.start()
        assert [ask(server, TOKEN)[0] for _ in range(5)] == [200] * 5
        status, waited_s = ask(server, "wrong again")
        for guess in guessing:
            guess.join()
    assert status == 401
    assert waited_s >= LONGEST_S / 2


@pytest.mark.parametrize(
    ("line", "code"),
    [
        ("Origin: http://[", "foreign_origin"),
        ("Via: 1.1 proxy", "proxy_without_token"),
    ],
)
def test_what_is_refused_is_told_in_both_languages(
    shared_server: Served, line: str, code: str
) -> None:
    status, said = shared_server.ask(request("GET", "/v1/robot", b"", line))
    assert (status, said["code"]) == (403, code)
    assert said["message"]["en"]
    assert said["message"]["zh"]


def test_a_malformed_host_leaves_no_traceback(
    shared_server: Served, caplog: pytest.LogCaptureFixture
) -> None:
    for method, path in (("GET", "/"), ("POST", "/v1/stop"), ("GET", "/v1/events")):
        raw = request(method, path).replace(b"Host: 127.0.0.1", b"Host: [")
        assert shared_server.ask(raw)[1]["code"] == "foreign_host"
    key = "Sec-WebSocket-Key: AAAAAAAAAAAAAAAAAAAAAA=="
    lines = ("Upgrade: websocket", "Sec-WebSocket-Version: 13", key)
    upgrade = request("GET", "/v1/events", b"", *lines)
    upgrade = upgrade.replace(b"Host: 127.0.0.1", b"Host: [")
    with shared_server.connect() as asking:
        asking.sendall(upgrade.replace(b"Connection: close", b"Connection: Upgrade"))
        assert asking.recv(65_536).startswith(b"HTTP/1.1 403")
    assert "Traceback" not in caplog.text


@pytest.mark.parametrize("asked", [("GET", "/v1/robot"), ("GET", "/none"), ("POST", "/v1/goals"),
                                   ("GET", "/v1/camera.jpg"), ("TRACE", "/v1/robot")])  # fmt: skip
@pytest.mark.parametrize("host", ["127.0.0.1:8420", "evil.example"])
def test_every_answer_carries_the_security_headers_and_is_not_stored(
    client: TestClient, asked: tuple[str, str], host: str
) -> None:
    answer = client.request(*asked, headers={"host": host})
    for name in ("content-security-policy", "x-content-type-options", "referrer-policy",
                 "x-frame-options", "cross-origin-resource-policy"):  # fmt: skip
        assert name in answer.headers, (name, answer.status_code)
    assert answer.headers["cache-control"] == "no-store"
    policy = answer.headers["permissions-policy"]
    assert "microphone=(self)" in policy
    assert "camera=()" in policy


def test_methods_that_nothing_takes_are_told_what_is_taken(client: TestClient) -> None:
    for method in ("TRACE", "FROB"):
        answer = client.request(method, "/v1/goals")
        assert (answer.status_code, answer.json()["code"]) == (405, "method_not_allowed")
        assert answer.headers["allow"] == "GET, POST"


async def refused_after(*messages: Message) -> tuple[int, int]:
    """Return the status that a foreign host's request got, and how many messages were taken."""
    taken = iter(messages)
    count = 0
    sent: list[Message] = []

    async def receive() -> Message:
        nonlocal count
        message = next(taken, None)
        if message is None:
            await asyncio.Event().wait()
        assert message is not None
        count += 1
        return message

    async def send(message: Message) -> None:
        sent.append(message)

    async def never(scope: Scope, receive: Receive, send: Send) -> None:
        raise AssertionError("a refused request came through")

    scope: Scope = {
        "type": "http", "method": "POST", "path": "/v1/goals", "client": ("127.0.0.1", 1),
        "headers": [(b"host", b"evil.example")],
    }  # fmt: skip
    await Guard(never, Access("127.0.0.1"))(scope, receive, send)
    return sent[0]["status"], count


def part(size: int, *, more: bool) -> Message:
    return {"type": "http.request", "body": b"x" * size, "more_body": more}


def test_a_refusal_comes_after_the_body_so_that_no_proxy_loses_it() -> None:
    assert asyncio.run(refused_after(part(10, more=True), part(5, more=False))) == (403, 2)


def test_a_refusal_waits_for_no_endless_and_no_silent_body() -> None:
    many = [part(60_000, more=True)] * 9
    status, taken = asyncio.run(refused_after(*many))
    assert (status, taken) == (403, 2)
    assert asyncio.run(refused_after(part(10, more=True))) == (403, 1)
