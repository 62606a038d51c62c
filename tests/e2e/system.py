"""Run the whole robot as a person does: ``pons up`` in a home of its own, the CLI, plain HTTP.

Owns requests and waits; ``tests.e2e.pons_up`` owns the processes. Judges nothing about driving.
"""

from __future__ import annotations

import contextlib
import http.client
import json
import signal
import subprocess
import tempfile
import time
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import psutil

from processes.parent_death import module_in
from processes.standby import find_server
from tests.e2e.polling import until
from tests.e2e.pons_up import PonsUp

ROOT = Path(__file__).resolve().parents[2]
TWO_ROOM = ROOT / "sites" / "two_room"
HOME_SITE = ROOT / "sites" / "home"
CHILDREN = ("sim", "localization", "bridge", "planner", "sim.camera")
START_LIMIT_S = 80.0
"""Alone on two cores a robot is up in 3 s, three that start at once in 11 s; beside a gate's other
work that was more than 40 s, and a story told again costs more than waiting."""
GONE_LIMIT_S = 10.0
ENDED = ("succeeded", "failed", "refused", "cancelled")

Json = dict[str, Any]


def new_home() -> tempfile.TemporaryDirectory[str]:
    """Make a folder whose name leaves room for sockets: their paths end at 107 bytes."""
    return tempfile.TemporaryDirectory(prefix="pons-e2e-")


@dataclass(frozen=True, slots=True)
class Reply:
    """Hold one HTTP answer."""

    status: int
    headers: dict[str, str]
    body: Any

    @property
    def code(self) -> str:
        """Return the stable code of a problem."""
        return str(self.body.get("code", "")) if isinstance(self.body, dict) else ""


class System(PonsUp):
    """Be one person's running robot."""

    def __init__(self, home: Path, site: Path = TWO_ROOM, **settings: str) -> None:
        super().__init__(home, site, home / "up.log", **settings)

    # Life ---------------------------------------------------------------------------------------

    def start(self) -> None:
        """Start ``pons up`` and wait for the line with its URL."""
        self.launch()
        self.until_ready()

    @contextlib.contextmanager
    def running(self) -> Iterator[System]:
        """Be up, and end as a person ends it; whatever happens, nothing is left."""
        try:
            self.start()
            yield self
            self.end()
        finally:
            self.destroy()

    def until_ready(self) -> None:
        """Wait for the line with the URL."""
        until(self.has_greeted, START_LIMIT_S, "the URL line of pons up", self.read_log)

    def child(self, name: str) -> psutil.Process:
        """Return one of the children of ``pons up``; waits until it is there."""
        return until(lambda: self._child(name), START_LIMIT_S, f"{name} running", self.read_log)

    def _child(self, name: str) -> psutil.Process | None:
        assert self.up is not None
        for process in psutil.Process(self.up.pid).children():
            with contextlib.suppress(psutil.NoSuchProcess, IndexError):
                if module_in(process.cmdline()) == name:
                    return psutil.Process(find_server(process.pid))
        return None

    def kill(self, name: str) -> float:
        """SIGKILL a child; return the moment."""
        self.child(name).send_signal(signal.SIGKILL)
        return time.monotonic()

    def freeze(self, name: str) -> float:
        """SIGSTOP a child; return the moment."""
        self.child(name).send_signal(signal.SIGSTOP)
        return time.monotonic()

    def thaw(self, name: str) -> float:
        """SIGCONT a child; return the moment."""
        self.child(name).send_signal(signal.SIGCONT)
        return time.monotonic()

    def end(self, number: signal.Signals = signal.SIGINT) -> None:
        """End ``pons up`` and hold that nothing of it is left."""
        if self.up is None:
            return
        self.up.send_signal(number)
        self.assert_gone()

    def assert_gone(self) -> None:
        """Hold that ``pons up`` ends, and every process of this home, within ten seconds."""
        assert self.up is not None
        self.up.wait(timeout=GONE_LIMIT_S)
        self.up = None
        try:
            until(lambda: not self.processes(), GONE_LIMIT_S, "all processes gone", self._alive)
        finally:
            self.destroy()

    def _alive(self) -> list[str]:
        return [" ".join(process.cmdline())[:200] for process in self.processes()]

    def logs(self, lines: int = 25) -> str:
        """Return the ends of all logs, for a failed test."""
        return "\n".join(
            "\n".join([f"-- {name}", *tail]) for name, tail in self.tails(lines).items()
        )

    # Requests -----------------------------------------------------------------------------------

    def pons(
        self, *words: str, timeout_s: float = 100.0, chinese: bool = False
    ) -> subprocess.CompletedProcess[str]:
        """Run a ``pons`` command as a person in a shell, whose language is English or Chinese."""
        return subprocess.run(
            self.command(*words),
            cwd=self.folder,
            env=self.environment | {"LC_ALL": "zh_CN.UTF-8" if chinese else "C.UTF-8"},
            capture_output=True,
            text=True,
            check=False,
            timeout=timeout_s,
        )

    def http(
        self,
        method: str,
        path: str,
        body: Json | bytes | None = None,
        headers: dict[str, str] | None = None,
        timeout_s: float = 10.0,
    ) -> Reply:
        """Send one request, as plainly as curl would."""
        sent = dict(headers or {})
        if isinstance(body, dict):
            sent.setdefault("Content-Type", "application/json")
            body = json.dumps(body).encode()
        connection = http.client.HTTPConnection("127.0.0.1", self.port, timeout=timeout_s)
        try:
            connection.request(method, path, body=body, headers=sent)
            answer = connection.getresponse()
            raw = answer.read()
            content_type = answer.getheader("Content-Type", "")
            content = json.loads(raw) if "json" in content_type else raw
            return Reply(answer.status, dict(answer.getheaders()), content)
        finally:
            connection.close()

    def give(self, text: str, **more: Any) -> Json:
        """Give a goal over HTTP and return it."""
        reply = self.http("POST", "/v1/goals", {"text": text, **more})
        assert reply.status == 202, reply
        goal: Json = reply.body
        return goal

    def goal(self, goal_id: str) -> Json:
        """Return a goal's record."""
        reply = self.http("GET", f"/v1/goals/{goal_id}")
        assert reply.status == 200, reply
        goal: Json = reply.body
        return goal

    def goals(self) -> list[Json]:
        """Return the newest goals."""
        goals: list[Json] = self.http("GET", "/v1/goals").body["goals"]
        return goals

    def act(self, goal_id: str, verb: str) -> Json:
        """Act on a goal."""
        reply = self.http("POST", f"/v1/goals/{goal_id}/{verb}", {})
        assert reply.status == 200, reply
        goal: Json = reply.body
        return goal

    def operate(self, verb: str) -> Reply:
        """Make an operator's request."""
        return self.http("POST", f"/v1/{verb}", {})

    def until_goal(self, goal_id: str, *states: str, limit_s: float = 40.0) -> Json:
        """Wait until a goal is in one of the states; a planner that is away may come back."""

        def seen() -> Json | None:
            with contextlib.suppress(OSError, http.client.HTTPException):
                reply = self.http("GET", f"/v1/goals/{goal_id}", timeout_s=2.0)
                if reply.status == 200 and reply.body["state"] in states:
                    goal: Json = reply.body
                    return goal
            return None

        def now() -> object:
            with contextlib.suppress(OSError, http.client.HTTPException):
                return self.http("GET", f"/v1/goals/{goal_id}", timeout_s=2.0).body
            return "no planner"

        return until(seen, limit_s, f"goal {goal_id} {'/'.join(states)}", now)

    def until_served(self) -> None:
        """Wait until the planner answers."""

        def served() -> bool:
            with contextlib.suppress(OSError, http.client.HTTPException):
                return self.http("GET", "/healthz", timeout_s=2.0).status == 200
            return False

        until(served, START_LIMIT_S, "/healthz 200", self.read_log)
