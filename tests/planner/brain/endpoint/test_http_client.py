"""Check how an endpoint's answers are classed, bounded and tried again."""

from __future__ import annotations

import time
from pathlib import Path

import httpx
import pytest

from planner.brain import BrainDown, PlanRejected
from planner.brain.endpoint import MAX_REPLY_BYTES
from planner.plan import Vocabulary
from tests.planner.brain.endpoint.servers import (
    GO,
    Answer,
    Endless,
    Server,
    answer,
    brain,
    raw,
    think,
    wrote,
)

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
        (lambda: raw(b"", 307, {"location": "http://127.0.0.1:1/"}), "redirect", 1),
        (lambda: raw(b"<html>500</html>", 502), "server_error", 2),
        (lambda: raw(b""), "bad_reply", 1),
        (lambda: raw(b"null"), "bad_reply", 1),
        (lambda: raw(b"[" * 100_000), "bad_reply", 1),
        (lambda: raw(b'{"choices":[NaN]}'), "bad_reply", 1),
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
    "first",
    [
        answer(ERROR, 500),
        answer(ERROR, 503, headers={"retry-after": "0.05"}),
        answer(ERROR, 429, headers={"retry-after": "0"}),
        httpx.RemoteProtocolError("the idle connection was closed"),
    ],
)
def test_a_short_trouble_costs_one_more_try(
    first: httpx.Response | Exception, home: Vocabulary, tmp_path: Path
) -> None:
    server = Server(first, wrote(GO))
    assert think(brain(server, tmp_path), home).plan.kind == "plan"
    assert len(server.requests) == 2


def test_an_endless_reply_is_cut_at_its_bound(home: Vocabulary, tmp_path: Path) -> None:
    stream = Endless(b"a" * 65_536)
    server = Server(lambda: httpx.Response(200, stream=stream))
    with pytest.raises(BrainDown) as down:
        think(brain(server, tmp_path), home)
    assert down.value.why == "too_large"
    assert stream.sent <= MAX_REPLY_BYTES + 2 * 65_536


def test_an_endless_error_is_cut_too(home: Vocabulary, tmp_path: Path) -> None:
    stream = Endless(b"a" * 65_536)
    server = Server(lambda: httpx.Response(401, stream=stream))
    with pytest.raises(BrainDown) as down:
        think(brain(server, tmp_path), home)
    assert down.value.why == "bad_key"


def test_a_drip_is_cut_by_the_deadline(home: Vocabulary, tmp_path: Path) -> None:
    server = Server(lambda: httpx.Response(200, stream=Endless(b" ", pause_s=0.01)))
    began_s = time.monotonic()
    with pytest.raises(BrainDown) as down:
        think(brain(server, tmp_path, timeout_s=0.5), home)
    assert down.value.why == "timeout"
    assert time.monotonic() - began_s >= 0.5


def test_a_redirect_is_never_followed(home: Vocabulary, tmp_path: Path) -> None:
    server = Server(raw(b"", 308, {"location": "http://127.0.0.1:1/v1"}), wrote(GO))
    with pytest.raises(BrainDown):
        think(brain(server, tmp_path), home)
    assert len(server.requests) == 1


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
    with pytest.raises(PlanRejected, match=told):
        think(brain(server, tmp_path), home)
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
