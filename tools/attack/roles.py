"""Ask for every route as nobody, with a wrong token, as a viewer and as an operator.

What each may is written here a second time, by hand: nobody may do anything, a viewer may look and
stop, an operator may do all. Routes come from openapi.json, so that a new one is tried at once.
"""

from __future__ import annotations

import base64
import json
from typing import TYPE_CHECKING

from websockets.exceptions import InvalidHandshake, WebSocketException
from websockets.sync.client import connect

from pons.settings import CHECKOUT
from tools.attack import target
from tools.attack.outcome import AttackOutcome

if TYPE_CHECKING:
    from collections.abc import Iterator

    from tools.attack.lab import AttackLab
    from tools.bench.robot import BenchRobot

NAME = "roles"
TITLE = "every route as every asker"
METHODS = ("GET", "HEAD", "OPTIONS", "POST", "PUT", "PATCH", "DELETE")
LOOKING = frozenset({"GET", "HEAD", "OPTIONS"})
OPERATORS = frozenset({"/v1/goals/x/replies"})
"""What a viewer may not even look at (planner/api/access.py)."""
STOPPING = frozenset({"/v1/stop", "/v1/estop", "/v1/disarm"})
ASKERS = {
    "nobody": None,
    "wrong token": "no token of this planner",
    "viewer": target.VIEWER,
    "operator": target.OPERATOR,
}
REFUSED = frozenset({401, 403})


def attack(lab: AttackLab) -> list[AttackOutcome]:
    """Ask with every method for every path, and open the event socket."""
    with target.robot(lab, tokens=True) as running:
        before_mb = target.planner_mb(running)
        found = [_ask_as(running, asker) for asker in ASKERS]
        stopped = target.stop_confirmed(running, target.VIEWER) is not None
        after_mb = target.planner_mb(running)
    note = "a viewer's stop afterwards"
    last = AttackOutcome("stop", 1, int(not stopped), "confirmed", before_mb, after_mb, 30.0, note)
    return [*found, last]


def _ask_as(running: BenchRobot, asker: str) -> AttackOutcome:
    wrong: list[str] = []
    tried = 0
    for method, path in all_requests():
        answer = target.ask(running, method, path, token=ASKERS[asker], body=b"{}",
                            kind=kind_of(path), source=target.another_address())  # fmt: skip
        tried += 1
        status = answer.status if answer is not None else 0
        if not fits(expected_status(asker, method, path), status):
            wrong.append(f"{method} {path} {status}")
    opened = _socket_opens(running, ASKERS[asker])
    if opened is not (asker in ("viewer", "operator")):
        wrong.append(f"/v1/events {'opened' if opened else 'refused'}")
    goal = {"nobody": "401", "wrong token": "401", "viewer": "looks, stops; else 403"}
    note = "; ".join(wrong[:6])
    return AttackOutcome(
        asker, tried + 1, len(wrong), goal.get(asker, "no 401, 403, 5xx"), note=note
    )


def all_requests() -> Iterator[tuple[str, str]]:
    """Yield every method with every path, a name in place of what the path leaves open."""
    contract = json.loads((CHECKOUT / "openapi.json").read_text("utf-8"))
    for template in sorted(contract["paths"]):
        path = "/".join("x" if part.startswith("{") else part for part in template.split("/"))
        yield from ((method, path) for method in METHODS)


def expected_status(asker: str, method: str, path: str) -> int | None:
    """Return the status by which an asker is refused; None where it may ask."""
    if asker in ("nobody", "wrong token"):
        return 401
    looks = method in LOOKING and path not in OPERATORS
    if asker == "viewer" and not looks and path not in STOPPING:
        return 403
    return None


def fits(wanted: int | None, status: int) -> bool:
    """Return whether a status is the one refusal, or none where none is wanted; 5xx never is."""
    if wanted is not None:
        return status == wanted
    return (0 < status < 500 and status not in REFUSED) or status == 503


def kind_of(path: str) -> str:
    """Return the content type that a path takes."""
    return "audio/wav" if path == "/v1/voice" else "application/json"


def _socket_opens(running: BenchRobot, token: str | None) -> bool:
    """Return whether the event socket takes a token, given as a browser does."""
    url = f"ws://{running.settings.host}:{running.settings.port}/v1/events"
    offers = ["pons.v1"]
    if token is not None:
        text = base64.urlsafe_b64encode(token.encode()).decode().rstrip("=")
        offers.append(f"bearer.{text}")
    try:
        with connect(url, subprotocols=offers, open_timeout=10.0) as socket:  # type: ignore[arg-type]
            return bool(socket.recv(5.0))
    except (InvalidHandshake, WebSocketException, OSError):
        return False
