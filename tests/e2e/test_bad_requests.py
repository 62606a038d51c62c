"""What makes no sense gets a clear answer with a stable code; nothing moves and nothing is lost."""

from __future__ import annotations

import asyncio
import json
import socket
import time
from collections.abc import Iterator

import pytest
from websockets.asyncio.client import connect
from websockets.exceptions import InvalidStatus

from tests.e2e.polling import until
from tests.e2e.robot import Robot
from tests.e2e.system import Reply

pytestmark = [pytest.mark.e2e, pytest.mark.nightly(keep=8)]

JSON = {"Content-Type": "application/json"}


@pytest.fixture
def still(robot: Robot) -> Iterator[Robot]:
    """Hold that the robot never moved and can still be asked, however the request ended."""
    began_s, before = time.monotonic(), [goal["id"] for goal in robot.system.goals()]
    yield robot
    robot.judge.assert_never_moves(0.05)
    robot.judge.assert_stood(began_s)
    until(lambda: robot.system.http("GET", "/readyz").status == 200, 10.0, "readiness")
    kept = [goal["id"] for goal in robot.system.goals()]
    assert set(before) <= set(kept)


def assert_problem(reply: Reply, status: int, code: str) -> None:
    assert (reply.status, reply.code) == (status, code), reply
    assert reply.headers["content-type" if "content-type" in reply.headers else "Content-Type"] == (
        "application/problem+json"
    )
    assert reply.body["detail"]


ASKED, NO = "needs_clarification", "refused"
ORDERS = {
    "empty": ("", NO, "empty_goal"),
    "spaces": (" \t\n ", NO, "empty_goal"),
    "3.6 kB": ("go to the kitchen " * 200, NO, "text_too_long"),
    "binary": ("\x00\x01\x02\x7f\ufffd\x1b[2J", NO, "bad_text"),
    "unknown place": ("go to the moon", ASKED, "unknown_place"),
    "unknown place zh": ("去月球", ASKED, "unknown_place"),
    "nonsense": ("colourless green ideas sleep furiously", ASKED, "not_understood"),
    "nonsense zh": ("天地玄黄宇宙洪荒", NO, "not_understood"),
}


@pytest.mark.parametrize(("text", "state", "code"), ORDERS.values(), ids=ORDERS)
def test_a_goal_that_cannot_be_ends_typed_in_both_languages(
    still: Robot, text: str, state: str, code: str
) -> None:
    goal = still.system.give(text)
    ended = still.system.until_goal(goal["id"], "refused", "needs_clarification", limit_s=5.0)
    outcome = ended["outcome"]
    assert (ended["state"], ended["reason"], outcome["code"]) == (state, code, code)
    assert outcome["message"]["en"]
    assert outcome["message"]["zh"]


def test_an_unknown_place_names_what_exists(still: Robot) -> None:
    done = still.system.pons("say", "go to the moon")
    assert done.returncode in (3, 5)
    assert "kitchen" in done.stdout
    done = still.system.pons("say", "去月球")
    assert "厨房" in done.stdout


def test_an_empty_order_in_the_shell_is_answered(still: Robot) -> None:
    done = still.system.pons("say", "")
    assert done.returncode in (3, 5), (done.stdout, done.stderr)


def test_bytes_that_are_no_text_are_refused(still: Robot) -> None:
    raw = b'{"text": "go to the kitchen \xff\xfe"}'
    reply = still.system.http("POST", "/v1/goals", raw, JSON)
    assert reply.status in (400, 422), reply
    assert reply.code in ("malformed_json", "invalid_request")


@pytest.mark.parametrize(
    ("raw", "status", "code"),
    [
        (b"", 422, "invalid_request"),
        (b"{", 400, "malformed_json"),
        (b'{"text": NaN}', 422, "invalid_request"),
        (b'{"text": 7}', 422, "invalid_request"),
        (b"[]", 422, "invalid_request"),
        (b'{"text": "go to the kitchen", "sped": 2}', 422, "invalid_request"),
        (b'{"text": "' + b"x" * 100_000 + b'"}', 422, "goal_too_long"),
        (b'{"text": "' + b"x" * 300_000 + b'"}', 413, "body_too_large"),
    ],
    ids=["nothing", "half", "nan", "number", "list", "unknown key", "100 kB", "300 kB"],
)
def test_malformed_bodies_are_refused(still: Robot, raw: bytes, status: int, code: str) -> None:
    before = len(still.system.goals())
    assert_problem(still.system.http("POST", "/v1/goals", raw, JSON), status, code)
    assert len(still.system.goals()) == before


@pytest.mark.parametrize("verb", ["cancel", "pause", "resume", "confirm", "answer", "move"])
def test_unknown_goals_are_refused(still: Robot, verb: str) -> None:
    body = {"text": "yes"} if verb == "answer" else {}
    assert_problem(still.system.http("GET", "/v1/goals/nobody"), 404, "unknown_goal")
    reply = still.system.http("POST", f"/v1/goals/nobody/{verb}", body)
    assert_problem(reply, 404, "unknown_goal")
    assert reply.body["message"]["zh"]


def test_unknown_routes_and_wrong_methods_are_refused(still: Robot) -> None:
    ask = still.system.http
    assert_problem(ask("GET", "/v1/nothing"), 404, "unknown_route")
    assert_problem(ask("DELETE", "/v1/goals", {}), 405, "method_not_allowed")
    assert_problem(ask("GET", "/v1/stop"), 405, "method_not_allowed")
    assert_problem(ask("POST", "/v1/robot", {}), 405, "method_not_allowed")


def test_wrong_content_types_are_refused(still: Robot) -> None:
    for kind in ("text/plain", "application/x-www-form-urlencoded", "multipart/form-data"):
        reply = still.system.http(
            "POST", "/v1/goals", b'{"text": "go to the kitchen"}', {"Content-Type": kind}
        )
        assert_problem(reply, 415, "unsupported_media_type")


@pytest.mark.parametrize("path", ["/v1/goals", "/v1/stop", "/v1/arm", "/healthz", "/v1/nothing"])
def test_foreign_hosts_and_origins_are_refused(still: Robot, path: str) -> None:
    ask = still.system.http
    method = "GET" if path in ("/healthz", "/v1/nothing") else "POST"
    body = b'{"text": "go to the kitchen"}' if method == "POST" else None
    epoch = still.judge.status.epoch
    assert_problem(ask(method, path, body, {**JSON, "Host": "evil.example"}), 403, "foreign_host")
    for origin in ("http://evil.example", "null", f"http://localhost.evil:{still.system.port}"):
        reply = ask(method, path, body, {**JSON, "Origin": origin})
        assert_problem(reply, 403, "foreign_origin")
    assert still.judge.status.epoch == epoch


def test_foreign_hosts_and_origins_get_no_socket(still: Robot) -> None:
    url = f"ws://127.0.0.1:{still.system.port}/v1/events"

    async def knock(headers: dict[str, str]) -> int:
        try:
            async with connect(url, additional_headers=headers):
                return 101
        except InvalidStatus as refused:
            return int(refused.response.status_code)

    assert asyncio.run(knock({"Origin": "http://evil.example"})) == 403
    assert raw_handshake(still.system.port, "evil.example") == 403
    assert raw_handshake(still.system.port, f"127.0.0.1:{still.system.port}") == 101


def raw_handshake(port: int, host: str) -> int:
    """Open a WebSocket by hand, with a Host of our choosing; return the status."""
    lines = [
        "GET /v1/events HTTP/1.1",
        f"Host: {host}",
        "Upgrade: websocket",
        "Connection: Upgrade",
        "Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==",
        "Sec-WebSocket-Version: 13",
    ]
    with socket.create_connection(("127.0.0.1", port), timeout=5.0) as link:
        link.sendall(("\r\n".join(lines) + "\r\n\r\n").encode())
        return int(link.recv(64).split()[1])


def test_a_repeated_request_is_one_goal(still: Robot) -> None:
    headers = {**JSON, "Idempotency-Key": "e2e-once"}
    raw = json.dumps({"text": "where are you?"}).encode()
    first = still.system.http("POST", "/v1/goals", raw, headers)
    again = still.system.http("POST", "/v1/goals", raw, headers)
    assert first.body["id"] == again.body["id"]
    other = json.dumps({"text": "go to the kitchen"}).encode()
    reply = still.system.http("POST", "/v1/goals", other, headers)
    assert_problem(reply, 409, "idempotency_conflict")


def test_nothing_to_act_on_is_said(still: Robot) -> None:
    for verb in ("pause", "resume", "cancel"):
        done = still.system.pons(verb)
        assert done.returncode == 1, (done.stdout, done.stderr)
        assert "no_goal" in done.stderr
        done = still.system.pons(verb, "nobody")
        assert done.returncode != 0
        assert "unknown_goal" in done.stderr
