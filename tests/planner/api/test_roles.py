"""The table of who may do what, written a second time, tried on every route with every method."""

from __future__ import annotations

import json
from collections.abc import Iterator

import pytest

from planner.api.access import Access, AccessError
from planner.people import Person, Role
from tests.conftest import ROOT

METHODS = ("GET", "HEAD", "OPTIONS", "POST", "PUT", "PATCH", "DELETE")
LOOKING = frozenset({"GET", "HEAD", "OPTIONS"})
OPERATORS = frozenset({"/v1/goals/x/replies"})
"""What a viewer may not even look at."""
STOPPING = frozenset({"/v1/stop", "/v1/estop", "/v1/disarm"})
OWNERS = ("/v1/people", "/v1/people/x")
"""What only the token that the planner was started with may change."""
_LOOKS = """/healthz /readyz /v1/robot /v1/map /v1/places /v1/camera.jpg /v1/objects
/v1/localization /v1/goals /v1/goals/x /v1/history /v1/history/x /v1/memory /v1/usage /v1/orders
/v1/people /v1/capabilities /v1/skills"""
AGENTS = {
    "POST": ["/v1/goals", "/v1/goals/x/answer", "/v1/goals/x/cancel", "/v1/rehearsals"],
    "GET": _LOOKS.split(),
}
"""All that an agent may ask for, beside a stop; a route that nobody lists here is refused."""
DISPATCHERS = {
    "POST": [
        *AGENTS["POST"], "/v1/goals/x/confirm", "/v1/goals/x/pause", "/v1/goals/x/resume",
        "/v1/goals/x/move", "/v1/voice", "/v1/voice/hush",
    ],
    "GET": [*AGENTS["GET"], "/v1/fence", "/v1/marks", "/v1/obstacles", "/v1/voice"],
}  # fmt: skip
LISTED = {"Claude": AGENTS, "Desk": DISPATCHERS}
OWNERS_OWN = ("/v1/settings", "/v1/settings/model/test", "/v1/settings/restart",
              "/v1/wizard", "/v1/wizard/look", "/v1/wizard/preset", "/v1/wizard/robot",
              "/v1/wizard/take", "/v1/wizard/map", "/v1/wizard/map/save")  # fmt: skip
"""What others may not even look at."""
TOKENS = {
    "operator": "o" * 20, "viewer": "v" * 20, "wrong token": "w" * 20, "nobody": "",
    "Ana": "a" * 20, "guest": "g" * 20, "Claude": "c" * 20, "Desk": "d" * 20,
}  # fmt: skip
PEOPLE = {
    TOKENS["Ana"]: Person("ana", "Ana", Role.OPERATOR, "2026-01-01T00:00:00+00:00"),
    TOKENS["guest"]: Person("guest", "Guest", Role.VIEWER, "2026-01-01T00:00:00+00:00"),
    TOKENS["Claude"]: Person("claude", "Claude", Role.AGENT, "2026-01-01T00:00:00+00:00"),
    TOKENS["Desk"]: Person("desk", "Desk", Role.DISPATCHER, "2026-01-01T00:00:00+00:00"),
}
ACCESS = Access(
    "127.0.0.1",
    operator_token=TOKENS["operator"],
    viewer_token=TOKENS["viewer"],
    find_person=PEOPLE.get,
)


def all_requests() -> Iterator[tuple[str, str]]:
    """Yield every method with every path, a name in place of what the path leaves open."""
    contract = json.loads((ROOT / "openapi.json").read_text("utf-8"))
    for template in sorted(contract["paths"]):
        path = "/".join("x" if part.startswith("{") else part for part in template.split("/"))
        yield from ((method, path) for method in METHODS)


def expected_status(asker: str, method: str, path: str) -> int | None:
    """Return the status by which an asker is refused; None where it may ask."""
    if asker in ("nobody", "wrong token"):
        return 401
    if asker in LISTED:
        stops = method == "POST" and path in STOPPING
        listed = LISTED[asker].get("GET" if method in LOOKING else method, [])
        return None if stops or path in listed else 403
    if path in OWNERS and asker != "operator" and method not in LOOKING:
        return 403
    if path in OWNERS_OWN and asker != "operator":
        return 403
    looks = method in LOOKING and path not in OPERATORS
    if asker in ("viewer", "guest") and not looks and path not in STOPPING:
        return 403
    return None


@pytest.mark.parametrize("asker", TOKENS)
def test_every_route_refuses_each_asker_as_the_table_says(asker: str) -> None:
    requests = list(all_requests())
    assert ("POST", "/v1/goals/x/confirm") in requests
    for method, path in requests:
        kind = "audio/wav" if path == "/v1/voice" else "application/json"
        headers = {"host": "127.0.0.1", "content-type": kind}
        if TOKENS[asker]:
            headers["authorization"] = f"Bearer {TOKENS[asker]}"
        try:
            ACCESS.judge(method, path, headers)
            refused = None
        except AccessError as refusal:
            refused = refusal.status
        assert expected_status(asker, method, path) == refused, (method, path)


@pytest.mark.parametrize("asker", LISTED)
@pytest.mark.parametrize(
    "path",
    ["/v1/new", "/v1/goals/x/new", "/v1/goals/", "/v1/goals//cancel", "/v1/arm/", "/v2/stop"],
)
def test_a_route_that_no_table_has_is_refused_to_whoever_has_a_table(asker: str, path: str) -> None:
    bearer = {"authorization": f"Bearer {TOKENS[asker]}", "content-type": "application/json"}
    for method in ("GET", "POST", "PUT", "PATCH", "DELETE"):
        with pytest.raises(AccessError, match="person_needed"):
            ACCESS.judge(method, path, {"host": "127.0.0.1", **bearer})


@pytest.mark.parametrize("path", ["/v1/hand", "/v1/voice/live", "/v1/new"])
def test_an_agent_opens_no_socket_but_that_of_events(path: str) -> None:
    headers = {"host": "127.0.0.1", "authorization": f"Bearer {TOKENS['Claude']}"}
    assert ACCESS.judge("GET", "/v1/events", headers, websocket=True) is Role.AGENT
    with pytest.raises(AccessError, match="person_needed"):
        ACCESS.judge("GET", path, headers, websocket=True)
