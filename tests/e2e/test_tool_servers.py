"""A model asks a calendar on a true server; what changes something there waits for a yes."""

from __future__ import annotations

import json
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from pathlib import Path
from typing import Any

import pytest

from planner.settings import FILE
from tests.e2e.polling import until
from tests.e2e.robot import Robot
from tests.e2e.system import ENDED, new_home
from tests.planner.tool_servers.servers import calendar_server

pytestmark = [pytest.mark.e2e, pytest.mark.nightly]

SETTINGS = """
[model]
url = "{model}"
name = "scripted"
key = "sk-e2e-0123456789"

[tools.calendar]
url = "{tools}"
may_write = ["add_event"]
"""


@contextmanager
def scripted_model() -> Iterator[tuple[str, list[dict[str, Any]], list[str]]]:
    """Serve chat completions; yield its URL, the plans it replies with, and what it was sent."""
    plans: list[dict[str, Any]] = []
    sent: list[str] = []

    class Door(BaseHTTPRequestHandler):
        def do_POST(self) -> None:
            body = json.loads(self.rfile.read(int(self.headers["content-length"])))
            sent.append(json.dumps(body["messages"], ensure_ascii=False))
            text = json.dumps(plans.pop(0) if plans else {"kind": "answer", "text": "Done."})
            message = {"role": "assistant", "content": text}
            whole = {"id": "c", "object": "chat.completion", "created": 1, "model": "scripted",
                     "choices": [{"index": 0, "message": message, "finish_reason": "stop"}],
                     "usage": {"prompt_tokens": 9, "completion_tokens": 9}}  # fmt: skip
            told = json.dumps(whole).encode()
            self.send_response(200)
            self.send_header("content-type", "application/json")
            self.send_header("content-length", str(len(told)))
            self.end_headers()
            self.wfile.write(told)

        def log_message(self, *_: Any) -> None:
            """Say nothing."""

    server = ThreadingHTTPServer(("127.0.0.1", 0), Door)
    thread = threading.Thread(target=server.serve_forever, daemon=True)
    thread.start()
    try:
        yield f"http://127.0.0.1:{server.server_port}/v1", plans, sent
    finally:
        server.shutdown()
        server.server_close()
        thread.join()


def test_a_calendar_is_asked_after_a_drive_and_a_write_waits_for_a_yes() -> None:
    with calendar_server() as tools, scripted_model() as (model, plans, sent), new_home() as folder:
        (Path(folder) / FILE).write_text(SETTINGS.format(model=model, tools=tools), "utf-8")
        robot = Robot(Path(folder))
        robot.start()
        try:
            robot.rest()
            _ask(robot, plans, sent)
            _write(robot, plans)
        finally:
            robot.close()


def _ask(robot: Robot, plans: list[dict[str, Any]], sent: list[str]) -> None:
    until(lambda: _servers(robot)[0]["tools"], 20.0, "the list of the calendar's tools")
    place = robot.elsewhere()
    call = {"kind": "use_tool", "tool": "calendar.events", "arguments": ["today", ""]}
    steps = [
        {"kind": "go_to", "place": place.id, "because": f"go to the {place.name.en}"},
        call,
        {"kind": "decide", "question": "what is on?"},
    ]
    plans[:] = [
        {"kind": "plan", "steps": steps},
        {"kind": "answer", "text": "The dentist, at ten."},
    ]
    goal = robot.system.give(f"go to the {place.name.en} and tell me what my calendar says")
    ended = robot.system.until_goal(goal["id"], *ENDED, limit_s=60.0)
    assert ended["state"] == "succeeded", (ended["reason"], ended["outcome"], ended["plan"])
    assert any("calendar.events" in one for one in sent)
    assert any("from_tool_never_an_order" in one and "dentist at 10:00" in one for one in sent)
    assert "dentist at 10:00" in ended["outcome"]["message"]["en"]
    robot.assert_there(place)


def _write(robot: Robot, plans: list[dict[str, Any]]) -> None:
    call = {"kind": "use_tool", "tool": "calendar.add_event", "arguments": ["dentist", '["Ana"]']}
    plans[:] = [{"kind": "plan", "steps": [call]}]
    goal = robot.system.give("put the dentist into my calendar, with Ana")
    asked = robot.system.until_goal(goal["id"], *ENDED, "needs_clarification", limit_s=20.0)
    assert asked["state"] == "needs_clarification", asked
    assert _servers(robot)[0]["calls_today"] == 1  # the one that reads
    robot.system.http("POST", f"/v1/goals/{goal['id']}/answer", {"text": "yes"})
    ended = robot.system.until_goal(goal["id"], *ENDED, limit_s=20.0)
    assert ended["state"] == "succeeded", (ended["reason"], ended["outcome"], ended["plan"])
    assert _servers(robot)[0]["calls_today"] == 2


def _servers(robot: Robot) -> list[dict[str, Any]]:
    found: list[dict[str, Any]] = robot.system.http("GET", "/v1/tools").body["servers"]
    return found
