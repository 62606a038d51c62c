"""Run the robot that is attacked, and ask it as any client on this machine would.

Attackers come from addresses of their own (all of 127/8 is this machine), so that what is bounded
by address bounds them and not the one who stops.
"""

from __future__ import annotations

import http.client
import json
import socket
import time
from contextlib import contextmanager
from dataclasses import dataclass
from itertools import count
from typing import TYPE_CHECKING, Any

from tools.bench.processes import rss_mb
from tools.bench.robot import BenchRobot

if TYPE_CHECKING:
    from collections.abc import Iterator

    from tools.attack.lab import AttackLab

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
def robot(lab: AttackLab) -> Iterator[BenchRobot]:
    """Run a simulated robot, ready and armed.

    Raises:
        Missed: it was not ready in time.
    """
    with lab.folder() as home, BenchRobot(home, "two_room") as running:
        running.make_ready(120.0)
        yield running


def planner_mb(running: BenchRobot) -> float:
    """Return the planner's resident memory [MB]."""
    return rss_mb(running.pid("planner"))


def ask(
    running: BenchRobot,
    method: str,
    path: str,
    *,
    body: bytes | None = None,
    kind: str = "application/json",
    source: str = "127.0.0.1",
    timeout_s: float = 5.0,
) -> TargetAnswer | None:
    """Return the planner's answer; None where none came."""
    headers = {"Content-Type": kind} if body is not None else {}
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


def stop_confirmed(running: BenchRobot) -> float | None:
    """Stop as a new client; return the time until the bridge's word came [s], or None."""
    began_s = time.monotonic()
    answer = ask(running, "POST", "/v1/stop", body=b'{"source": "attack"}')
    if answer is None or answer.status != 200 or answer.content.get("confirmed") is not True:
        return None
    return time.monotonic() - began_s


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
