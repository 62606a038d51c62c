"""Serve a list of goals over HTTP, as much of a planner as the commands about goals meet."""

from __future__ import annotations

import json
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from typing import Any


def goal(goal_id: str, state: str, text: str = "go there", **more: Any) -> dict[str, Any]:
    return {"id": goal_id, "state": state, "text": text, "created": "2026", "outcome": None, **more}


@dataclass
class Planner:
    """Serve a list of goals over HTTP and keep what was asked of them."""

    goals: list[dict[str, Any]] = field(default_factory=list)
    done: str = "succeeded"
    heard: list[tuple[str, Any]] = field(default_factory=list)
    held_metal: bool = False
    """It refuses orders without an operator's proof, as before a held robot of metal."""
    asks_until_planned: int | None = None
    """How often the goals are asked for while a model loads, which then ends their thought."""

    def answer(self, method: str, path: str, body: Any) -> tuple[int, Any]:
        if method == "GET" and path == "/v1/goals":
            return 200, {"goals": self.goals}
        if method == "GET" and path == "/v1/robot":
            held = {"reason": "stop", "id": "stop-1"} if self.held_metal else None
            return 200, {"status": {"held": held}, "brain": {"loads": self.asks_until_planned}}
        found = next((g for g in self.goals if path.split("/")[3] == g["id"]), None)
        if found is None:
            return 404, {"code": "unknown_goal", "detail": path}
        if method == "GET" and self.asks_until_planned is not None:
            self.asks_until_planned -= 1
            found["state"] = "planning" if self.asks_until_planned else self.done
        if method == "POST":
            self.heard.append((path, body))
            if self.held_metal and "operator" not in body:
                return 403, {"code": "operator_proof_needed", "detail": path}
            found["state"] = self.done
        return 200, found


@contextmanager
def served_goals(planner: Planner) -> Iterator[int]:
    """Serve on a free port of the loopback, and yield it."""

    class Handler(BaseHTTPRequestHandler):
        def do_GET(self) -> None:
            self._say(planner.answer("GET", self.path, None))

        def do_POST(self) -> None:
            body = json.loads(self.rfile.read(int(self.headers["Content-Length"])))
            self._say(planner.answer("POST", self.path, body))

        def _say(self, answer: tuple[int, Any]) -> None:
            raw = json.dumps(answer[1]).encode()
            self.send_response(answer[0])
            self.send_header("Content-Length", str(len(raw)))
            self.end_headers()
            self.wfile.write(raw)

        def log_message(self, format: str, *args: object) -> None:  # noqa: A002  # the base names it
            pass

    server = ThreadingHTTPServer(("127.0.0.1", 0), Handler)
    thread = threading.Thread(target=server.serve_forever, kwargs={"poll_interval": 0.01})
    thread.start()
    try:
        yield server.server_address[1]
    finally:
        server.shutdown()
        server.server_close()
        thread.join()
