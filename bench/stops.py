"""Say stop as people do, and note the moment at which it was handed over."""

from __future__ import annotations

import os
import subprocess
import sys
import time
from http.client import HTTPConnection
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from bench.robot import Robot

LIMIT_S = 10.0
_CLI = (
    "import sys, time; from pons import settings, stop; known = settings.load(); "
    "print(time.monotonic(), flush=True); sys.exit(stop.run(known))"
)
"""``pons stop`` itself, noting the time when all is loaded and nothing is sent."""


def by_api(robot: Robot) -> float:
    """POST a stop on a connection that stands; return when its bytes were handed over."""
    connection = HTTPConnection(robot.settings.host, robot.settings.port, timeout=LIMIT_S)
    try:
        connection.connect()
        sent_s = time.monotonic()
        sort = {"Content-Type": "application/json"}
        connection.request("POST", "/v1/stop", b'{"source": "bench"}', sort)
        connection.getresponse().read()
        return sent_s
    finally:
        connection.close()


def by_cli(robot: Robot) -> float:
    """Run ``pons stop``; return when its process, loaded, was about to speak."""
    ours = {"PONS_HOME": str(robot.settings.home), "PONS_PORT": str(robot.settings.port)}
    done = subprocess.run(
        [sys.executable, "-c", _CLI],
        env={**os.environ, **ours},
        capture_output=True,
        text=True,
        check=True,
        timeout=LIMIT_S,
    )
    return float(done.stdout.splitlines()[0])
