"""Hold connections open in every slow and endless way while somebody else stops the robot.

Bounded in count, in bytes and in time. The planner runs with the usual limit of 1 024 open files.
"""

from __future__ import annotations

import threading
import time
from contextlib import ExitStack, contextmanager
from dataclasses import dataclass
from typing import TYPE_CHECKING

from tools.attack import target
from tools.attack.outcome import AttackOutcome
from tools.bench.figures import percentile

if TYPE_CHECKING:
    import socket
    from collections.abc import Callable, Iterator, Sequence

    from tools.attack.lab import AttackLab
    from tools.bench.robot import BenchRobot

NAME = "slow_clients"
TITLE = "slow and endless clients, and stop beside them"
STOPS = 100
QUICK_S, LONG_S = 25.0, 120.0
"""After which an attack ends, however many stops were tried."""
GROWTH_MB = 60.0
"""The caps of all connections together; without any it was 530 MB."""
PULSE_S = 0.2
CROWDED_S = 10.0
"""How long to wait until all of a way's connections are open, before the first stop."""
REST_S = 1.0
_HOST = b"Host: 127.0.0.1\r\n"
_POST = b"POST /v1/goals HTTP/1.1\r\n" + _HOST + b"Content-Type: application/json\r\n"
_UPGRADE = (
    b"GET /v1/events HTTP/1.1\r\n" + _HOST + b"Connection: Upgrade\r\nUpgrade: websocket\r\n"
    b"Sec-WebSocket-Version: 13\r\nSec-WebSocket-Key: AAAAAAAAAAAAAAAAAAAAAA==\r\n\r\n"
)
_SNAPSHOT = b"\x81\x92\x00\x00\x00\x00" + b'{"snapshot": true}'
"""A text frame, masked with zeros (RFC 6455, 5.2)."""


@dataclass(frozen=True, slots=True)
class SlowWay:
    """Describe one way of being slow or endless."""

    name: str
    connections: int
    first: bytes
    """Sent when a connection opens."""
    again: bytes = b""
    """Sent over and over as long as it is taken."""
    most_bytes: int = 1_000
    """What one connection sends in all."""
    pulse_s: float = PULSE_S


WAYS = (
    SlowWay("silent connections", 1_050, b""),
    SlowWay("half a request line", 1_050, b"GET"),
    SlowWay("trickled headers", 300, b"GET /v1/robot HTTP/1.1\r\n" + _HOST + b"X-A: ", b"a"),
    SlowWay("trickled bodies", 300, _POST + b"Content-Length: 100000\r\n\r\n", b" "),
    SlowWay("endless headers", 3, b"GET / HTTP/1.1\r\n" + _HOST, b"X-A: b\r\n" * 8_000,
        30_000_000, 0.0),
    SlowWay("one endless header", 2, b"GET / HTTP/1.1\r\n" + _HOST + b"X-A: ", b"a" * 64_000,
        30_000_000, 0.0),
    SlowWay("endless chunked bodies", 4, _POST + b"Transfer-Encoding: chunked\r\n\r\n",
        b"1\r\na\r\n" * 8_000, 30_000_000, 0.0),
    SlowWay("endless chunk extension", 2, _POST + b"Transfer-Encoding: chunked\r\n\r\n1;",
        b"a" * 64_000, 30_000_000, 0.0),
    SlowWay("pipelined requests", 4, b"", (b"GET /v1/goals HTTP/1.1\r\n" + _HOST + b"\r\n") * 50,
        1_000_000, 0.0),
    SlowWay("WebSockets that never read", 200, _UPGRADE, _SNAPSHOT, 50_000),
)  # fmt: skip


def attack(lab: AttackLab) -> list[AttackOutcome]:
    """Try each way on one robot, one after the other."""
    with _robot_with_few_files(lab) as running:
        return [_try(lab, running, way) for way in WAYS]


@contextmanager
def _robot_with_few_files(lab: AttackLab) -> Iterator[BenchRobot]:
    """Run a robot whose processes have the usual limit of open files; this one takes more."""
    with ExitStack() as stack:
        with target.users_files():
            running = stack.enter_context(target.robot(lab))
        yield running


def _try(lab: AttackLab, running: BenchRobot, way: SlowWay) -> AttackOutcome:
    before_mb = peak_mb = target.planner_mb(running)
    times: list[float] = []
    lost = 0
    end_s = time.monotonic() + (LONG_S if lab.long else QUICK_S)
    with _slow(running, way) as opened:
        while len(times) + lost < STOPS and time.monotonic() < end_s:
            took_s = target.stop_confirmed(running)
            if took_s is None:
                lost += 1
            else:
                times.append(took_s)
            peak_mb = max(peak_mb, target.planner_mb(running))
        many = opened()
    time.sleep(REST_S)
    missed = STOPS - len(times)  # one that found no time to be tried is none that was confirmed
    note = f"{many} connections opened; stop {_times(times)}"
    lab.say(f"{way.name}: {len(times)} of {STOPS} stops confirmed")
    return AttackOutcome(
        way.name,
        STOPS,
        missed,
        f"each of {STOPS} stops confirmed",
        before_mb,
        peak_mb,
        GROWTH_MB,
        note,
    )


def _times(times: Sequence[float]) -> str:
    """Write how long stops took; that none was confirmed where there is none."""
    if not times:
        return "never confirmed"
    return f"p50 {1e3 * percentile(times, 0.5):.0f}, p99 {1e3 * percentile(times, 0.99):.0f} ms"


@contextmanager
def _slow(running: BenchRobot, way: SlowWay) -> Iterator[Callable[[], int]]:
    """Be slow beside the body of the ``with``; yields how many connections have been opened."""
    ended = threading.Event()
    opened: list[int] = []
    crowd = threading.Thread(target=_crowd, args=(running, way, ended, opened), daemon=True)
    crowd.start()
    try:
        full_s = time.monotonic() + CROWDED_S
        while len(opened) < way.connections and time.monotonic() < full_s:
            time.sleep(PULSE_S)
        time.sleep(REST_S)
        yield lambda: len(opened)
    finally:
        ended.set()
        crowd.join()


def _crowd(running: BenchRobot, way: SlowWay, ended: threading.Event, opened: list[int]) -> None:
    """Open connections, say what a way says, and let go at the end."""
    sockets: dict[socket.socket, int] = {}
    source = target.another_address()
    try:
        while not ended.is_set():
            if len(opened) < way.connections:
                made = target.connect(running, source)
                opened.append(1)
                if made is not None:
                    sockets[made] = _send(made, way.first)
                if len(opened) % 50:
                    continue
            for each, sent in sockets.items():
                if way.again and sent < way.most_bytes:
                    sockets[each] = sent + _send(each, way.again)
            ended.wait(way.pulse_s or 0.005)
    finally:
        for each in sockets:
            each.close()


def _send(made: socket.socket, data: bytes) -> int:
    """Send what is taken at once; return how much it was."""
    try:
        return made.send(data) if data else 0
    except OSError:  # it does not take any now, or is closed
        return 0
