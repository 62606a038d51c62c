"""Whoever watches sees it all in order, and may stop the robot over the same socket."""

from __future__ import annotations

import json
import time
from typing import Any

import pytest
from websockets.sync.client import ClientConnection, connect

from tests.e2e.robot import Robot

pytestmark = [pytest.mark.e2e, pytest.mark.nightly(keep=1)]


def events(socket: ClientConnection, until_kind: str, limit_s: float) -> list[dict[str, Any]]:
    """Return all events up to the first of a kind."""
    end_s, heard = time.monotonic() + limit_s, []
    while time.monotonic() < end_s:
        heard.append(json.loads(socket.recv(timeout=2.0)))
        if heard[-1]["kind"] == until_kind:
            return heard
    raise AssertionError(f"no {until_kind} in {limit_s} s, only {[e['kind'] for e in heard][-20:]}")


def test_a_watcher_sees_a_drive_and_stops_it(robot: Robot) -> None:
    with connect(f"ws://127.0.0.1:{robot.system.port}/v1/events") as socket:
        snapshot = json.loads(socket.recv(timeout=5.0))
        assert snapshot["kind"] == "snapshot"
        assert snapshot["robot"]["status"]["mode"] == "HOLD"
        assert isinstance(snapshot["goals"], list)
        _, goal = robot.drive_off()
        asked_s = time.monotonic()
        socket.send(json.dumps({"stop": True}))
        heard = [snapshot, *events(socket, "stopped", 5.0)]
        robot.assert_stops(asked_s)
        assert heard[-1]["confirmed"] is True
        seqs = [event["seq"] for event in heard]
        assert seqs == sorted(set(seqs))
        states = [
            event["change"]["goal"]["state"]
            for event in heard
            if event["kind"] == "goal" and event["change"]["goal"]["id"] == goal["id"]
        ]
        assert states[0] == "planning"
        assert "running" in states
        speeds = [e["robot"]["status"]["sent"]["v_mps"] for e in heard if e["kind"] == "robot"]
        assert max(speeds) > 0.1
        held = robot.judge.status.held
        assert held is not None
        assert held.reason == "stop"


def test_words_that_a_watcher_may_not_say_are_answered(robot: Robot) -> None:
    with connect(f"ws://127.0.0.1:{robot.system.port}/v1/events") as socket:
        for text in ("{", '{"go": "kitchen"}', "stop", "[]", '{"stop": 1}', "x" * 3_000):
            socket.send(text)
            problem = events(socket, "problem", 5.0)[-1]
            assert problem["code"] == "unknown_message"
    robot.judge.assert_never_moves(0.2)
