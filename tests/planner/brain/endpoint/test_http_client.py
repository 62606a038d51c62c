"""Check how an endpoint's answers are classed and bounded, also from hostile servers on sockets."""

from __future__ import annotations

import asyncio
import gc
import json
import logging
import socket
import time
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import httpx
import psutil
import pytest

from planner.brain import BadPlan, BrainDown, ThinkRequest
from planner.brain.endpoint import MAX_REPLY_BYTES, EndpointBrain
from planner.plan import Vocabulary
from tests.planner.brain.endpoint.servers import (
    GO,
    KEY,
    Answer,
    Endless,
    Server,
    answer,
    brain,
    raw,
    settings,
    think,
    wrote,
)
from tests.planner.brain.endpoint.sockets import (
    CHUNK,
    END_S,
    Script,
    completion,
    ok,
    said,
    self_signed,
    serving,
    without_end,
)
from tests.planner.outbound.test_address import resolving

ERROR = {"error": {"message": "mock"}}


@pytest.mark.parametrize(
    ("given", "why", "calls"),
    [
        (lambda: answer(ERROR, 401), "bad_key", 1),
        (lambda: answer(ERROR, 403), "bad_key", 1),
        (lambda: answer(ERROR, 404), "unknown_model", 1),
        (lambda: answer(ERROR, 413), "bad_request", 1),
        (lambda: answer(ERROR, 500), "server_error", 2),
        (lambda: answer(ERROR, 503, headers={"retry-after": "0"}), "server_error", 2),
        (lambda: answer(ERROR, 503, headers={"retry-after": "9999"}), "server_error", 1),
        (lambda: answer(ERROR, 429, headers={"retry-after": "0.01"}), "rate_limited", 2),
        (lambda: answer(ERROR, 429, headers={"retry-after": "3600"}), "rate_limited", 1),
        (lambda: answer(ERROR, 429, headers={"retry-after": "nan"}), "rate_limited", 1),
        (lambda: answer(ERROR, 429, headers={"retry-after": "-1"}), "rate_limited", 1),
        (lambda: answer(ERROR, 429, headers={"retry-after": "Wed, 21 Oct"}), "rate_limited", 1),
        (lambda: raw(b"", 302, {"location": "http://169.254.169.254/"}), "redirect", 1),
        (lambda: httpx.Response(401, stream=Endless(b"a" * 65_536)), "bad_key", 1),
        (lambda: raw(b"<html>500</html>", 502), "server_error", 2),
        (lambda: raw(b""), "bad_reply", 1),
        (lambda: raw(b"null"), "bad_reply", 1),
        (lambda: raw(b'\xff\xfe{"choices":[]}'), "bad_reply", 1),
        (lambda: answer({"choices": []}), "bad_reply", 1),
        (lambda: answer({"choices": {"0": {}}}), "bad_reply", 1),
        (lambda: answer({"choices": [{"message": "hi"}]}), "bad_reply", 1),
        (lambda: answer(ERROR), "server_error", 1),
        (lambda: answer({"error": {"code": ["x"]}}, 400), "bad_request", 4),
        (lambda: answer({"error": {"code": {"content_filter": 1}}}, 422), "bad_request", 4),
        (lambda: answer({"error": {"message": "Model Not Exist"}}, 400), "unknown_model", 1),
        (lambda: answer({"error": "The model `m` does not exist"}, 422), "unknown_model", 1),
        (lambda: answer({"error": "model 'm' not found, try pulling it"}, 400), "unknown_model", 1),
        (lambda: answer({"error": "this model: response_format not found"}, 400), "bad_request", 4),
        (TypeError("unhashable type: 'list'"), "bad_reply", 1),
        (AttributeError("'int' object has no attribute 'get'"), "bad_reply", 1),
        (
            lambda: raw(b"data: {}\n\n", headers={"content-type": "text/event-stream"}),
            "bad_reply",
            1,
        ),
        (lambda: raw(b"\x1f\x8b", headers={"content-encoding": "gzip"}), "bad_reply", 1),
        (lambda: raw(b"a" * (MAX_REPLY_BYTES + 1)), "too_large", 1),
        (httpx.ConnectError("refused"), "unreachable", 1),
        (httpx.ConnectTimeout("slow"), "unreachable", 1),
        (httpx.ReadTimeout("slow"), "timeout", 1),
        (httpx.RemoteProtocolError("gone"), "server_error", 2),
        (httpx.ReadError("reset"), "server_error", 2),
    ],
)
def test_every_failure_has_its_reason(
    given: Answer, why: str, calls: int, home: Vocabulary, tmp_path: Path
) -> None:
    server = Server(given)
    with pytest.raises(BrainDown) as down:
        think(brain(server, tmp_path, timeout_s=5.0), home)
    assert (down.value.why, len(server.requests)) == (why, calls)


@pytest.mark.parametrize(
    ("message", "told"),
    [
        ({"content": None}, "empty"),
        ({"content": 7}, "empty"),
        ({"content": "", "reasoning": GO, "reasoning_content": GO}, "empty"),
        ({"content": None, "tool_calls": [{"function": {"name": "fly", "arguments": GO}}]}, "tool"),
        ({"content": None, "tool_calls": [{"function": {"name": "plan"}}]}, "arguments"),
        ({"content": None, "tool_calls": "all"}, "empty"),
        ({"content": [{"type": "image"}, {"type": "text", "text": "no"}]}, "no JSON"),
    ],
)
def test_a_message_without_a_plan_is_repaired_once(
    message: dict[str, object], told: str, home: Vocabulary, tmp_path: Path
) -> None:
    server = Server(lambda: answer({"choices": [{"message": message}]}))
    with pytest.raises(BadPlan, match=told):
        think(brain(server, tmp_path, mode="prompt"), home)  # below which there is no other way
    assert len(server.requests) == 2
    assert told in server.bodies[1]["messages"][-1]["content"]


@pytest.mark.parametrize(
    "message",
    [
        {"content": [{"type": "text", "text": GO}]},
        {"content": None, "tool_calls": [{"function": {"name": "plan", "arguments": GO}}]},
        {"content": GO, "reasoning_content": "hm", "tool_calls": None, "refusal": None},
    ],
)
def test_a_plan_is_found_where_servers_put_it(
    message: dict[str, object], home: Vocabulary, tmp_path: Path
) -> None:
    server = Server(answer({"choices": [{"message": message}], "usage": {"total_tokens": "many"}}))
    thought = think(brain(server, tmp_path), home)
    assert (thought.plan.kind, thought.calls, thought.tokens) == ("plan", 1, 0)


GROWN_BYTES = 48_000_000
"""A reply's cap many times over; a server that gets its will sends more in a second."""
SHORTEST_S = 0.5
"""The shortest deadline that the settings allow."""
HEAD = b"HTTP/1.1 200 OK\r\nContent-Type: application/json\r\n"
CHUNKED = HEAD + b"Transfer-Encoding: chunked\r\n\r\n"
EVENTS = b"HTTP/1.1 200 OK\r\nContent-Type: text/event-stream\r\n\r\n"
DELTA = b'data: {"choices":[{"delta":{"content":" "}}]}\n\n'
ONE_CHUNK = b"10000\r\n" + CHUNK + b"\r\n"
DEEP = "[" * 100_000 + "]" * 100_000


def ended(
    port: int, home: Vocabulary, folder: Path, scheme: str = "http", timeout_s: float = 1.5
) -> str:
    """Think once and return how it ended; hold time and memory."""
    us, began_s = psutil.Process(), time.monotonic()
    before = us.memory_info().rss
    url = f"{scheme}://127.0.0.1:{port}/v1"
    made = EndpointBrain(settings(url=url, timeout_s=timeout_s), folder)
    how, words = _thought(made, home)
    assert len(words) < 3_000
    assert time.monotonic() - began_s < 15.0, "the deadline did not hold"
    assert us.memory_info().rss - before < GROWN_BYTES
    return how


def _thought(made: EndpointBrain, home: Vocabulary) -> tuple[str, str]:
    try:
        return think(made, home).plan.kind, ""
    except BrainDown as down:
        return down.why, str(down)
    except BadPlan as rejected:
        return "rejected", str(rejected)


@pytest.mark.parametrize(
    ("script", "end"),
    [
        (said(completion(GO)), "plan"),
        (without_end(HEAD + b"Content-Length: 1000000000\r\n\r\n", CHUNK), "too_large"),
        (without_end(CHUNKED, ONE_CHUNK), "too_large"),
        (without_end(HEAD + b"\r\n", CHUNK), "too_large"),
        (without_end(b"HTTP/1.1 500 No\r\n\r\n", CHUNK), "server_error"),
        (without_end(b"HTTP/1.1 200 OK\r\n", b"X: " + CHUNK + b"\r\n"), "server_error"),
        (said(b"", pause_s=0.05), "server_error"),
        (said(b"SSH-2.0-OpenSSH_9.2\r\n"), "server_error"),
        (said(bytes(range(256))), "server_error"),
        (said(completion(GO)[:-40]), "server_error"),
        (said(HEAD + b"Content-Length: -1\r\n\r\n{}"), "server_error"),
        (said(CHUNKED + b"FFFFFFFFFFFFFFFFF\r\n"), "server_error"),
        (said(b"HTTP/1.1 302 Found\r\nLocation: http://127.0.0.1:1/\r\n\r\n"), "redirect"),
        (said(b"HTTP/1.1 307 T\r\nLocation: file:///etc/passwd\r\n\r\n"), "redirect"),
        (said(b"HTTP/1.1 308 P\r\nLocation: http://169.254.169.254/\r\n\r\n"), "redirect"),
        (said(ok(b'{"choices":' + DEEP.encode() + b"}")), "bad_reply"),
        (said(ok(b'{"choices":[{"message":{"content":NaN}}]}')), "bad_reply"),
        (said(ok(b'{"choices":1e999}')), "bad_reply"),
        (said(ok(b"x", b"Content-Encoding: gzip")), "bad_reply"),
        (without_end(EVENTS, b": " + CHUNK + b"\n"), "too_large"),
        (without_end(EVENTS, b"data: " + CHUNK), "too_large"),
        (said(EVENTS + b"data: [DONE]\n\n"), "rejected"),
        (said(EVENTS), "bad_reply"),
        (said(EVENTS + b"data: " + DEEP.encode() + b"\n\n"), "bad_reply"),
        (said(EVENTS + b'data: {"choices":[{"delta":{"content":"{"}}]}\n\n'), "bad_reply"),
        (said(EVENTS + bytes(range(256)) * 9), "bad_reply"),
        (said(completion(DEEP)), "rejected"),
        (said(completion('{"kind":' + DEEP + "}")), "rejected"),
        (said(completion('{"kind":"plan","steps":[{"kind":"wait","seconds":NaN}]}')), "rejected"),
        (said(completion('{"kind":"plan","steps":[{"kind":"wait","seconds":1e999}]}')), "rejected"),
        (said(completion('{"kind":"plan","steps":"go_to"}')), "rejected"),
        (said(completion('{"kind":["plan"],"steps":[]}')), "rejected"),
        (said(completion('{"kind":"plan","steps":[{"kind":"go_to","place":["kitchen"]}]}')),
         "rejected"),
        (said(completion('{"kind":"plan","steps":[{"kind":"go_to_map","x":1}]}')), "rejected"),
    ],
)  # fmt: skip
def test_every_server_ends_typed(
    script: Script, end: str, home: Vocabulary, tmp_path: Path
) -> None:
    with serving(script) as wire:
        assert ended(wire.port, home, tmp_path) == end
        assert wire.asked, "nobody asked"


def test_servers_that_hold_on_are_cut_at_the_deadline(home: Vocabulary, tmp_path: Path) -> None:
    """Each is met at the same time as the others, as each takes the deadline's whole length."""
    scripts = [
        without_end(HEAD + b"Content-Length: 1000000\r\n\r\n", b" ", 0.02),
        without_end(CHUNKED, b"1\r\n \r\n", 0.02),
        without_end(b"HTTP/1.1 200 OK\r\n", b"X: 1\r\n", 0.02),
        without_end(b"", b"H", 0.02),
        without_end(b"", b"HTTP/1.1 100 Continue\r\n\r\n", 0.02),
        without_end(EVENTS, DELTA, 0.02),
        without_end(EVENTS, b": I think\n\n", 0.02),
    ]

    def met(number: int) -> tuple[str, bool]:
        with serving(scripts[number]) as wire:
            folder = tmp_path / str(number)
            return ended(wire.port, home, folder, timeout_s=SHORTEST_S), bool(wire.asked)

    with ThreadPoolExecutor(len(scripts)) as pool:
        ends = list(pool.map(met, range(len(scripts))))
    assert ends == [("timeout", True)] * len(scripts)


@pytest.mark.parametrize(
    "echo",
    [b"Authorization: Bearer %s\r\n\r\n", b"HTTP/1.1 200 OK\r\nAuthorization Bearer %s\r\n\r\n"],
)
@pytest.mark.parametrize("key", [KEY, "sk-odd\\'key\"" * 12])
def test_a_key_echoed_as_a_broken_head_is_struck(
    echo: bytes, key: str, home: Vocabulary, tmp_path: Path, caplog: pytest.LogCaptureFixture
) -> None:
    caplog.set_level(logging.DEBUG)
    with serving(said(echo % key.encode())) as wire:
        url = f"http://127.0.0.1:{wire.port}/v1"
        made = EndpointBrain(settings(url=url, key=key, timeout_s=1.5), tmp_path)
        why, words = _thought(made, home)
    assert (why, "RemoteProtocolError" in words) == ("server_error", True)
    assert "***" in words
    assert key[:6] not in words + caplog.text


def test_a_connection_is_used_again_and_one_that_was_closed_is_opened_anew(
    home: Vocabulary, tmp_path: Path
) -> None:
    """What a server closed while it idled costs nothing; what it keeps open is kept."""

    def twice(connection: socket.socket) -> None:
        connection.sendall(completion(GO))
        connection.settimeout(END_S)
        if connection.recv(65_536):
            connection.sendall(completion(GO))

    async def story() -> None:
        made = EndpointBrain(settings(url=f"http://127.0.0.1:{wire.port}/v1"), tmp_path)
        for _ in range(4):
            thought = await made.think(ThinkRequest(text="go to the kitchen", vocabulary=home))
            assert (thought.plan.kind, thought.calls) == ("plan", 1)
            await asyncio.sleep(0.05)  # the server closes after its second answer
        await made.close()

    with serving(twice) as wire:
        asyncio.run(story())
        assert len(wire.asked) == 2


@pytest.mark.parametrize(
    "more",
    [
        {"waypoints": [{"x": 1.0, "y": 2.0, "speed": 0.5}]},
        {"steps": [{"kind": "go_to", "place": "kitchen"}]},
        {"plan": {"kind": "plan", "steps": [{"kind": "go_to", "place": "kitchen"}]}},
    ],
)
def test_a_refusal_with_a_way_beside_it_drives_nowhere(
    more: dict[str, object], home: Vocabulary, tmp_path: Path
) -> None:
    text = json.dumps({"kind": "refuse", "code": "unsafe", "en": "No.", "zh": "不。", **more})
    with serving(said(completion(text))) as wire:
        assert ended(wire.port, home, tmp_path) in ("refuse", "rejected")


def test_a_port_where_nobody_is_is_said_at_once(home: Vocabulary, tmp_path: Path) -> None:
    with socket.create_server(("127.0.0.1", 0)) as taken:
        port = int(taken.getsockname()[1])
    assert ended(port, home, tmp_path) == "unreachable"


def test_a_server_that_never_accepts_is_cut(home: Vocabulary, tmp_path: Path) -> None:
    with socket.create_server(("127.0.0.1", 0), backlog=1) as silent:
        port = int(silent.getsockname()[1])
        assert ended(port, home, tmp_path, timeout_s=SHORTEST_S) == "timeout"


def test_a_certificate_that_nobody_vouches_for_is_refused(home: Vocabulary, tmp_path: Path) -> None:
    context = self_signed(tmp_path)
    if context is None:
        pytest.skip("openssl is not installed: no certificate can be made")
    with serving(said(completion(GO)), context) as wire:
        assert ended(wire.port, home, tmp_path, "https") == "unreachable"
        assert wire.asked == [], "the key must not leave before the server is known"


def test_the_name_stands_in_the_handshake_of_a_pinned_call(
    home: Vocabulary, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The certificate is held against the name, though the call goes to an address."""
    context = self_signed(tmp_path)
    if context is None:
        pytest.skip("openssl is not installed: no certificate can be made")
    named: list[object] = []
    context.sni_callback = lambda _socket, name, _context: named.append(name)
    with serving(said(completion(GO)), context) as wire:

        async def look(*_: object, **__: object) -> list[tuple[object, ...]]:
            return [(socket.AF_INET, socket.SOCK_STREAM, 6, "", ("127.0.0.1", wire.port))]

        monkeypatch.setattr(asyncio.BaseEventLoop, "getaddrinfo", look)
        url = f"https://models.example:{wire.port}/v1"
        made = EndpointBrain(settings(url=url, allow_offhost=True, timeout_s=5.0), tmp_path)
        assert _thought(made, home)[0] == "unreachable"
        assert (named, wire.asked) == (["models.example"], [])


# asyncio itself forgets the transport whose handshake failed so early; the collector closes it.
@pytest.mark.filterwarnings("ignore::pytest.PytestUnraisableExceptionWarning")
def test_tls_where_none_is_spoken_and_the_other_way_round(home: Vocabulary, tmp_path: Path) -> None:
    """End typed; a handshake given up leaves its socket to the collector, which closes it."""
    with serving(said(completion(GO))) as plain:
        how = ended(plain.port, home, tmp_path, "https", SHORTEST_S)
        assert how in ("unreachable", "timeout")
    context = self_signed(tmp_path)
    if context is not None:
        with serving(said(completion(GO)), context) as secret:
            assert ended(secret.port, home, tmp_path) in ("server_error", "unreachable")
            assert secret.asked == []
    gc.collect()  # here, where the warning is expected, and not in the middle of another test


def test_a_call_goes_to_the_address_that_was_judged(
    home: Vocabulary, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """A name that means another address at the connection leads nowhere else."""
    asked = resolving(monkeypatch, ["203.0.113.7"], ["169.254.169.254"])
    server = Server(lambda: wrote(GO))
    made = brain(server, tmp_path, url="https://models.example/v1", allow_offhost=True)
    think(made, home)
    (request,) = server.requests
    assert str(request.url) == "https://203.0.113.7/v1/chat/completions"
    assert request.headers["host"] == "models.example"
    assert request.extensions["sni_hostname"] == "models.example"
    assert request.headers["authorization"] == f"Bearer {KEY}"
    assert asked == ["models.example"]


@pytest.mark.parametrize("found", [["10.0.0.1", "169.254.169.254"], ["fe80::1"], []])
def test_a_name_that_leads_to_the_link_by_any_of_its_addresses_is_not_asked(
    found: list[str], home: Vocabulary, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    resolving(monkeypatch, found)
    server = Server(lambda: wrote(GO))
    made = brain(server, tmp_path, url="http://models.example:8080/v1", allow_offhost=True)
    with pytest.raises(BrainDown) as down:
        think(made, home)
    assert down.value.why == ("refused_address" if found else "unreachable")
    assert server.requests == []


def test_an_address_that_takes_no_connection_is_passed_over(
    home: Vocabulary, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    resolving(monkeypatch, ["2001:db8::1", "203.0.113.7"])
    server = Server(httpx.ConnectError("no way"), lambda: wrote(GO))
    made = brain(server, tmp_path, url="http://models.example:8080/v1", allow_offhost=True)
    assert think(made, home).plan.kind == "plan"
    hosts = [(request.url.host, request.headers["host"]) for request in server.requests]
    assert hosts == [("2001:db8::1", "models.example:8080"), ("203.0.113.7", "models.example:8080")]
