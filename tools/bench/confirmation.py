"""Say stop as a person does, and tell how long it took until the bridge had confirmed it.

Over HTTP on a new connection, by ``pons stop`` as a process of its own, or over a page's socket
that is open already.
"""

from __future__ import annotations

import json
import os
import subprocess
import sys
import time
from contextlib import contextmanager, suppress
from typing import TYPE_CHECKING

from websockets.exceptions import WebSocketException
from websockets.sync.client import connect

from pons.http import PlannerDown, PlannerProblem, call
from pons.settings import CHECKOUT
from tools.bench.context import MeasurementFailure

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator, Sequence
    from contextlib import AbstractContextManager

    from pons.settings import LaunchSettings

    Stop = Callable[[], float | None]
    """Says stop; returns seconds until it was confirmed, None where it was not."""

LIMIT_S = 2.0
"""A stop over HTTP or a socket that is not confirmed by then is lost."""
SHELL_S = 10.0
SAID = "bridge confirmed"
HTTP, CLI, PAGE = "HTTP", "CLI", "page's socket"


@contextmanager
def by_http(settings: LaunchSettings) -> Iterator[Stop]:
    """Yield a stop by ``POST /v1/stop`` on a new connection."""
    yield lambda: stopped_by_http(settings)


@contextmanager
def by_shell(settings: LaunchSettings) -> Iterator[Stop]:
    """Yield a stop by a new ``pons stop``."""
    yield lambda: stopped_by_shell(settings)


@contextmanager
def by_page(settings: LaunchSettings) -> Iterator[Stop]:
    """Open a page's socket and yield a stop over it. Raises Missed where it does not open."""
    url = f"ws://{settings.host}:{settings.port}/v1/events"
    try:
        socket = connect(url, max_queue=None, open_timeout=SHELL_S)
    except (OSError, WebSocketException) as trouble:
        raise MeasurementFailure(f"the page's socket: {trouble}") from None

    def stop() -> float | None:
        with suppress(TimeoutError):  # a page has read what came before
            while True:
                socket.recv(0.0)
        began_s = time.monotonic()
        socket.send('{"stop": true}')
        while (left_s := began_s + LIMIT_S - time.monotonic()) > 0.0:
            text = str(socket.recv(left_s))
            if '"stopped"' in text[:60]:
                confirmed = json.loads(text).get("confirmed") is True
                return time.monotonic() - began_s if confirmed else None
        return None

    def confirm() -> float | None:
        try:
            return stop()
        except (OSError, WebSocketException):  # closed, or silent for too long
            return None

    with socket:
        yield confirm


WAYS: dict[str, Callable[[LaunchSettings], AbstractContextManager[Stop]]] = {
    HTTP: by_http,
    CLI: by_shell,
    PAGE: by_page,
}


def stopped_by_http(settings: LaunchSettings, source: str = "bench") -> float | None:
    """Stop over HTTP; return seconds until the answer that it is confirmed."""
    began_s = time.monotonic()
    try:
        answer = call(settings, "POST", "/v1/stop", {"source": source}, LIMIT_S)
    except (PlannerDown, PlannerProblem):
        return None
    return time.monotonic() - began_s if answer.get("confirmed") else None


def stopped_by_shell(
    settings: LaunchSettings, user: int | None = None, groups: Sequence[int] = ()
) -> float | None:
    """Run ``pons stop``; return seconds from its start until it says that it is confirmed.

    Args:
        settings: of the robot that is to stop.
        user: number of who says it, where it is another than who runs this.
        groups: those of that user, its main one first.
    """
    began_s, said_s = time.monotonic(), None
    process = subprocess.Popen(
        [sys.executable, "-m", "pons", "stop"],
        cwd=CHECKOUT,
        env={**os.environ, "PONS_HOME": str(settings.home), "PONS_PORT": str(settings.port)},
        stdin=subprocess.DEVNULL,
        stdout=subprocess.PIPE,
        stderr=subprocess.DEVNULL,
        text=True,
        user=user,
        group=groups[0] if groups else None,
        extra_groups=groups or None,
    )
    try:
        for text in process.stdout or ():
            if SAID in text:
                said_s = time.monotonic()
        process.wait(SHELL_S)
    except subprocess.TimeoutExpired:
        process.kill()
        process.wait()
    return None if said_s is None else said_s - began_s
