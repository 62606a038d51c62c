"""Say stop as people do, and note the moment at which it was handed over.

Each way is made ready before the robot drives, as a page or a client that is already open is; what
it yields says stop, returns when it did, and waits for the answer.
"""

from __future__ import annotations

import json
import os
import subprocess
import sys
import time
from collections.abc import Callable, Iterator
from contextlib import AbstractContextManager, contextmanager
from http.client import HTTPConnection
from typing import TYPE_CHECKING

from websockets.sync.client import connect

from tools.bench.robot import BenchRobot

if TYPE_CHECKING:
    from pathlib import Path

Note = tuple[float, float, str]
"""When a command had left [s, monotonic], the speed that it means [m/s], the mode."""
Stop = Callable[[], float]
"""Stops; returns the moment on the monotonic clock."""
LIMIT_S = 10.0
SENTENCE = "uh robot, there is a child on the floor, could you please stop"
_CLI = (
    "import sys, time; from pons import settings, stop; known = settings.load(); "
    "print('ready', flush=True); input(); print(time.monotonic(), flush=True); "
    "sys.exit(stop.run(known))"
)
"""``pons stop`` itself, waiting for a word when all is loaded and nothing is sent."""


def noting(home: Path) -> BenchRobot:
    """Return a robot whose bridge notes its commands."""
    return BenchRobot(home, "two_room", tapped=True)


def notes_of(robot: BenchRobot) -> list[Note]:
    """End the bridge of such a robot and return what it noted."""
    return [(at_s, v_mps, mode) for at_s, v_mps, mode in robot.end_bridge()["commands"]]


@contextmanager
def by_api(robot: BenchRobot) -> Iterator[Stop]:
    """Yield a stop by ``POST /v1/stop``."""
    yield lambda: _post(robot, "/v1/stop", {"source": "bench"})


@contextmanager
def by_sentence(robot: BenchRobot) -> Iterator[Stop]:
    """Yield a stop by words that the stop lane must find in a sentence, given as a goal."""
    yield lambda: _post(robot, "/v1/goals", {"text": SENTENCE})


def _post(robot: BenchRobot, path: str, body: dict[str, str]) -> float:
    """POST on a connection of its own, made on the spot: the planner closes idle ones."""
    connection = HTTPConnection(robot.settings.host, robot.settings.port, timeout=LIMIT_S)
    try:
        connection.connect()
        sent_s = time.monotonic()
        sort = {"Content-Type": "application/json"}
        connection.request("POST", path, json.dumps(body).encode(), sort)
        connection.getresponse().read()
        return sent_s
    finally:
        connection.close()


@contextmanager
def by_cli(robot: BenchRobot) -> Iterator[Stop]:
    """Run ``pons stop``; the moment is when its process, loaded, is about to speak."""
    ours = {"PONS_HOME": str(robot.settings.home), "PONS_PORT": str(robot.settings.port)}
    process = subprocess.Popen(
        [sys.executable, "-c", _CLI],
        env={**os.environ, **ours},
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
        text=True,
    )

    def stop() -> float:
        said, _ = process.communicate("now\n", LIMIT_S)
        return float(said.splitlines()[0])  # what stood before was read

    try:
        if process.stdout is None or process.stdout.readline() != "ready\n":
            raise OSError("pons stop did not load")
        yield stop
    finally:
        process.kill()
        process.communicate()


@contextmanager
def by_socket(robot: BenchRobot) -> Iterator[Stop]:
    """Say it over an open event socket, as the page does first."""
    url = f"ws://{robot.settings.host}:{robot.settings.port}/v1/events"
    with connect(url, max_queue=None) as socket:  # all that comes meanwhile is kept, none read

        def stop() -> float:
            sent_s = time.monotonic()
            socket.send('{"stop": true}')
            while time.monotonic() < sent_s + LIMIT_S:
                if '"stopped"' in str(socket.recv(LIMIT_S)):
                    break
            return sent_s

        yield stop


WAYS: dict[str, Callable[[BenchRobot], AbstractContextManager[Stop]]] = {
    "API": by_api,
    "sentence": by_sentence,
    "CLI": by_cli,
    "WebSocket": by_socket,
}
