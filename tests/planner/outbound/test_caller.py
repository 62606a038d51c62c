"""One call to a server that the owner named: bounded, typed, and its key goes nowhere else."""

from __future__ import annotations

import asyncio
from collections.abc import Callable

import httpx
import pytest

from planner.outbound import Address, CallFailure
from planner.outbound.caller import CallAnswer, Caller

KEY = "sk-this-is-secret"
LOCAL = Address.parse("http://127.0.0.1:9/v1", "/audio/speech", "speech")
Handler = Callable[[httpx.Request], httpx.Response]


def call(handler: Handler, most_bytes: int = 1000, address: Address = LOCAL) -> CallAnswer:
    async def story() -> CallAnswer:
        caller = Caller(address, KEY, timeout_s=1.0, transport=httpx.MockTransport(handler))
        try:
            return await caller.post(most_bytes=most_bytes, json={"input": "hello"})
        finally:
            await caller.close()

    return asyncio.run(story())


def why(handler: Handler, most_bytes: int = 1000) -> tuple[str, str]:
    with pytest.raises(CallFailure) as failure:
        call(handler, most_bytes)
    return failure.value.why, str(failure.value)


def test_an_answer_comes_with_its_kind_and_the_key_goes_in_one_header() -> None:
    asked: list[httpx.Request] = []

    def handler(request: httpx.Request) -> httpx.Response:
        asked.append(request)
        return httpx.Response(
            200, headers={"content-type": "Audio/WAV; x=1"}, stream=httpx.ByteStream(b"RIFF")
        )

    answer = call(handler)
    assert (answer.kind, answer.body) == ("audio/wav", b"RIFF")
    assert str(asked[0].url) == "http://127.0.0.1:9/v1/audio/speech"
    assert asked[0].headers["authorization"] == f"Bearer {KEY}"
    assert KEY not in str(asked[0].url)


@pytest.mark.parametrize(
    ("status", "expected"),
    [(301, "redirect"), (400, "bad_request"), (401, "bad_key"), (404, "unknown_route"),
     (415, "bad_request"), (429, "rate_limited"), (500, "server_error"), (503, "server_error")],
)  # fmt: skip
def test_each_status_has_its_reason_and_an_echoed_key_is_struck(status: int, expected: str) -> None:
    def handler(_: httpx.Request) -> httpx.Response:
        return httpx.Response(
            status,
            headers={"location": "http://169.254.169.254/"},
            stream=httpx.ByteStream(f"no {KEY} {'x' * 9999}".encode()),
        )

    reason, told = why(handler)
    assert reason == expected
    assert KEY not in told
    assert len(told) < 300


def test_more_bytes_than_may_come_are_a_failure_whatever_the_header_says() -> None:
    def sends(size: int) -> Handler:
        return lambda _: httpx.Response(200, stream=httpx.ByteStream(bytes(size)))

    assert why(sends(101), most_bytes=100)[0] == "too_large"
    assert call(sends(100), most_bytes=100).body == bytes(100)


def test_a_packed_answer_is_refused_unread() -> None:
    """A small body must not unpack into a large one."""
    head = {"content-encoding": "gzip"}

    def handler(_: httpx.Request) -> httpx.Response:
        return httpx.Response(200, headers=head, stream=httpx.ByteStream(b"garbage"))

    assert why(handler)[0] == "bad_reply"


@pytest.mark.parametrize(
    ("error", "expected"),
    [
        (httpx.ConnectError("nobody"), "unreachable"),
        (httpx.ConnectTimeout("slow"), "unreachable"),
        (httpx.ReadTimeout("slow"), "timeout"),
        (httpx.RemoteProtocolError(f"illegal header {KEY}"), "unreachable"),
        (httpx.DecodingError("garbage"), "bad_reply"),
    ],
)
def test_what_the_network_does_is_typed(error: Exception, expected: str) -> None:
    def handler(_: httpx.Request) -> httpx.Response:
        raise error

    reason, told = why(handler)
    assert reason == expected
    assert KEY not in told


def test_a_name_that_leads_to_a_metadata_service_is_never_called(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    async def look(_: object, host: str, port: int, **__: object) -> list[tuple[object, ...]]:
        return [(2, 1, 6, "", ("169.254.169.254", port))]

    monkeypatch.setattr(asyncio.BaseEventLoop, "getaddrinfo", look)
    asked: list[httpx.Request] = []

    def handler(request: httpx.Request) -> httpx.Response:
        asked.append(request)
        return httpx.Response(200)

    address = Address.parse("http://voices.example/v1", "/audio/speech", "speech")
    with pytest.raises(CallFailure) as failure:
        call(handler, address=address)
    assert (failure.value.why, asked) == ("refused_address", [])
