"""Who may ask what: hosts, origins, tokens, roles, content types."""

from __future__ import annotations

import pytest

from planner.api.access import Access, AccessError, is_loopback
from planner.people import Role

LOCAL = Access("127.0.0.1")
OPEN = Access(
    "0.0.0.0",  # the very case: reachable from outside
    hosts=frozenset({"robot.lan"}),
    operator_token="op-secret",
    viewer_token="view-secret",
)
JSON = {"content-type": "application/json"}


def headers(host: str = "127.0.0.1:8420", **more: str) -> dict[str, str]:
    return {"host": host, **{name.replace("_", "-"): value for name, value in more.items()}}


@pytest.mark.parametrize("host", ["127.0.0.1:8420", "localhost:8420", "localhost", "[::1]:8420"])
def test_loopback_needs_no_token(host: str) -> None:
    assert LOCAL.judge("GET", "/v1/robot", headers(host)) is Role.OPERATOR


@pytest.mark.parametrize(
    "host", ["evil.example", "127.0.0.1.evil.example", "", "localhost.evil", "10.0.0.1:8420"]
)
@pytest.mark.parametrize("websocket", [False, True])
def test_a_foreign_host_is_refused_everywhere(host: str, websocket: bool) -> None:
    with pytest.raises(AccessError) as refused:
        LOCAL.judge("GET", "/v1/events", headers(host), websocket=websocket)
    assert refused.value.code == "foreign_host"


@pytest.mark.parametrize(
    "origin",
    [
        "http://evil.example",
        "null",
        "http://127.0.0.1:3000",
        "http://localhost:8420",
        "file://",
        "http://127.0.0.1:8420.evil.example",
    ],
)
@pytest.mark.parametrize("websocket", [False, True])
def test_a_foreign_origin_is_refused_everywhere(origin: str, websocket: bool) -> None:
    with pytest.raises(AccessError) as refused:
        LOCAL.judge("GET", "/v1/events", headers(origin=origin), websocket=websocket)
    assert refused.value.code == "foreign_origin"


def test_the_page_itself_may_ask() -> None:
    asked = headers(origin="http://127.0.0.1:8420")
    assert LOCAL.judge("GET", "/v1/events", asked, websocket=True) is Role.OPERATOR


def test_over_tls_a_page_that_came_without_it_may_not_ask() -> None:
    secure = Access("127.0.0.1", speaks_tls=True)
    asked = headers(origin="https://127.0.0.1:8420")
    assert secure.judge("GET", "/v1/events", asked, websocket=True) is Role.OPERATOR
    with pytest.raises(AccessError) as refused:
        secure.judge("GET", "/v1/events", headers(origin="http://127.0.0.1:8420"), websocket=True)
    assert refused.value.code == "foreign_origin"
    assert "https://127.0.0.1:8420" in refused.value.detail


def test_behind_a_proxy_that_adds_the_tls_its_page_may_ask() -> None:
    token = "Bearer op-secret"
    asked = headers("robot.lan", origin="https://robot.lan", authorization=token, **JSON)
    assert OPEN.judge("POST", "/v1/goals", asked) is Role.OPERATOR


def test_the_authoritys_certificate_is_seen_before_any_token_is_typed() -> None:
    assert OPEN.judge("GET", "/ca.crt", headers("robot.lan")) is Role.VIEWER
    with pytest.raises(AccessError):
        OPEN.judge("POST", "/ca.crt", headers("robot.lan", **JSON))


def test_json_with_a_charset_is_json() -> None:
    asked = headers(content_type="application/json; charset=utf-8")
    assert LOCAL.judge("POST", "/v1/goals", asked) is Role.OPERATOR


NO_TOKEN = ("", "Bearer", "Bearer ", "Basic op-secret", "op-secret")


@pytest.mark.parametrize(
    "authorization", ["", "Bearer", "Bearer ", "Bearer wrong", "Basic op-secret", "op-secret"]
)
def test_elsewhere_a_token_is_needed(authorization: str) -> None:
    with pytest.raises(AccessError) as refused:
        OPEN.judge("GET", "/v1/robot", headers("robot.lan", authorization=authorization))
    assert (refused.value.status, refused.value.code) == (401, "token_needed")
    assert ("no token came" in refused.value.detail) == (authorization in NO_TOKEN)


def test_a_viewer_looks_and_stops_but_does_not_drive() -> None:
    viewer = headers("robot.lan", authorization="Bearer view-secret", **JSON)
    assert OPEN.judge("GET", "/v1/robot", viewer) is Role.VIEWER
    assert OPEN.judge("POST", "/v1/stop", viewer) is Role.VIEWER
    with pytest.raises(AccessError) as refused:
        OPEN.judge("POST", "/v1/goals", viewer)
    assert refused.value.code == "operator_needed"
    assert refused.value.detail == (
        "the viewer's token came; POST /v1/goals needs the operator's; "
        "a viewer may GET, and POST /v1/disarm, /v1/estop, /v1/stop"
    )


def test_an_empty_token_opens_nothing() -> None:
    nobody = Access("0.0.0.0", hosts=frozenset({"robot.lan"}))
    with pytest.raises(AccessError):
        nobody.judge("GET", "/v1/robot", headers("robot.lan", authorization="Bearer "))


@pytest.mark.parametrize(
    ("host", "expected"),
    [("127.0.0.1", True), ("127.9.9.9", True), ("::1", True), ("localhost", True),
     ("0.0.0.0", False), ("192.168.1.2", False), ("robot.lan", False), ("::", False)],
)  # fmt: skip
def test_loopback_is_told_from_the_rest(host: str, expected: bool) -> None:
    assert is_loopback(host) is expected


@pytest.mark.parametrize("host", ["[", "[::1", "[abc]", "a[b", "ℂ℀", "\x00", "@", ":"])
@pytest.mark.parametrize("path", ["/", "/v1/stop", "/v1/events"])
def test_a_malformed_host_is_a_foreign_one(host: str, path: str) -> None:
    with pytest.raises(AccessError) as refused:
        LOCAL.judge("GET", path, headers(host), websocket=path == "/v1/events")
    assert (refused.value.status, refused.value.code) == (403, "foreign_host")


@pytest.mark.parametrize("origin", ["http://[", "http://[::1", "http://", "://", "[", "http:[", ""])
def test_a_malformed_origin_is_a_foreign_one(origin: str) -> None:
    with pytest.raises(AccessError) as refused:
        LOCAL.judge("POST", "/v1/stop", headers(origin=origin))
    assert (refused.value.status, refused.value.code) == (403, "foreign_origin")


PROXIED = ["X-Forwarded-For", "x-forwarded-proto", "X-Forwarded-Host", "Forwarded", "Via"]


@pytest.mark.parametrize("name", PROXIED)
@pytest.mark.parametrize(
    ("path", "websocket"),
    [("/", False), ("/v1/goals", False), ("/v1/robot", False), ("/v1/events", True)],
)
def test_without_a_token_nobody_asks_through_a_proxy(name: str, path: str, websocket: bool) -> None:
    asked = {**headers(**JSON), name.lower(): "203.0.113.9"}
    with pytest.raises(AccessError) as refused:
        LOCAL.judge("GET", path, asked, websocket=websocket)
    assert (refused.value.status, refused.value.code) == (403, "proxy_without_token")
    assert "PONS_OPERATOR_TOKEN" in refused.value.detail


@pytest.mark.parametrize("path", ["/v1/stop", "/v1/estop", "/v1/disarm"])
def test_a_stop_comes_through_any_proxy(path: str) -> None:
    asked = {**headers(), "x-forwarded-for": "203.0.113.9"}
    assert LOCAL.judge("POST", path, asked) is Role.OPERATOR


def test_with_a_token_a_proxy_may_stand_in_front() -> None:
    behind = Access("127.0.0.1", operator_token="op-secret")
    asked = headers(authorization="Bearer op-secret", x_forwarded_for="203.0.113.9", **JSON)
    assert behind.judge("POST", "/v1/goals", asked) is Role.OPERATOR


@pytest.mark.parametrize(("authorization", "guessed"), [("", False), ("Bearer wrong", True)])
def test_a_wrong_token_is_told_from_none(authorization: str, guessed: bool) -> None:
    with pytest.raises(AccessError) as refused:
        OPEN.judge("GET", "/v1/robot", headers("robot.lan", authorization=authorization))
    assert refused.value.guessed is guessed
