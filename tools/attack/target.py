"""Run the robot that is attacked, and ask it as any client on this machine would.

Attackers come from addresses of their own (all of 127/8 is this machine), so that what is bounded
by address bounds them and not the one who stops.
"""

from __future__ import annotations

import http.client
import json
import os
import resource
import socket
import time
from contextlib import contextmanager
from dataclasses import dataclass
from itertools import count
from typing import TYPE_CHECKING, Any

from tools.bench.processes import rss_mb
from tools.bench.robot import BenchRobot

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping

    from tools.attack.lab import AttackLab

OPERATOR, VIEWER = "an operator's token of the attack", "a viewer's token of the attack"
USERS_FILES = 1_024
"""The soft limit of open files that a process has by default, and under systemd."""
_ADDRESSES = count()


@dataclass(frozen=True, slots=True)
class TargetAnswer:
    """Hold an answer of the planner."""

    status: int
    body: bytes

    @property
    def content(self) -> Any:
        """Return its JSON; None where it is none."""
        try:
            return json.loads(self.body)
        except ValueError:
            return None


@contextmanager
def robot(lab: AttackLab, *, tokens: bool = False) -> Iterator[BenchRobot]:
    """Run a simulated robot, ready and armed, its processes limited as users' are.

    Raises:
        Missed: it was not ready in time.
    """
    given = {"PONS_OPERATOR_TOKEN": OPERATOR, "PONS_VIEWER_TOKEN": VIEWER} if tokens else {}
    with lab.folder() as home, _environment(given), BenchRobot(home, "two_room") as running:
        running.make_ready(120.0)
        yield running


@contextmanager
def users_files() -> Iterator[None]:
    """Let children begin with the usual limit of open files; this process itself takes more."""
    soft, hard = resource.getrlimit(resource.RLIMIT_NOFILE)
    resource.setrlimit(resource.RLIMIT_NOFILE, (min(USERS_FILES, hard), hard))
    try:
        yield
    finally:
        resource.setrlimit(resource.RLIMIT_NOFILE, (max(soft, min(16 * USERS_FILES, hard)), hard))


@contextmanager
def _environment(given: Mapping[str, str]) -> Iterator[None]:
    before = {name: os.environ.get(name) for name in given}
    os.environ.update(given)
    try:
        yield
    finally:
        for name, value in before.items():
            if value is None:
                os.environ.pop(name, None)
            else:
                os.environ[name] = value


def planner_mb(running: BenchRobot) -> float:
    """Return the planner's resident memory [MB]."""
    return rss_mb(running.pid("planner"))


def ask(
    running: BenchRobot,
    method: str,
    path: str,
    *,
    token: str | None = None,
    body: bytes | None = None,
    kind: str = "application/json",
    source: str = "127.0.0.1",
    timeout_s: float = 5.0,
) -> TargetAnswer | None:
    """Return the planner's answer; None where none came."""
    headers = {"Content-Type": kind} if body is not None else {}
    if token is not None:
        headers["Authorization"] = f"Bearer {token}"
    connection = http.client.HTTPConnection(
        running.settings.host, running.settings.port, timeout=timeout_s, source_address=(source, 0)
    )
    try:
        connection.request(method, path, body, headers)
        answer = connection.getresponse()
        return TargetAnswer(answer.status, answer.read(4_000_000))
    except (OSError, http.client.HTTPException):
        return None
    finally:
        connection.close()


def stop_confirmed(running: BenchRobot, token: str | None = None) -> float | None:
    """Stop as a new client; return the time until the bridge's word came [s], or None."""
    began_s = time.monotonic()
    answer = ask(running, "POST", "/v1/stop", token=token, body=b'{"source": "attack"}')
    if answer is None or answer.status != 200 or answer.content.get("confirmed") is not True:
        return None
    return time.monotonic() - began_s


def connect(running: BenchRobot, source: str, timeout_s: float = 2.0) -> socket.socket | None:
    """Return a connection from an address of this machine; None where it is refused."""
    address = (running.settings.host, running.settings.port)
    try:
        made = socket.create_connection(address, timeout_s, (source, 0))
    except OSError:
        return None
    made.setblocking(False)
    return made


def another_address() -> str:
    """Return an address of this machine that nobody used yet, where the system has so many."""
    number = next(_ADDRESSES)
    address = f"127.{1 + number // 62_500 % 200}.{number // 250 % 250}.{1 + number % 250}"
    with socket.socket() as probe:
        try:
            probe.bind((address, 0))
        except OSError:
            return "127.0.0.1"
    return address
