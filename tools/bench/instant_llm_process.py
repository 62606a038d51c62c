"""Run the endpoint that answers at once in a process of its own, and turn its one switch."""

from __future__ import annotations

import time
from contextlib import contextmanager
from typing import TYPE_CHECKING, Any

import httpx

from pons.robot_processes import free_port
from pons.supervisor import Child
from tools.bench.context import until

if TYPE_CHECKING:
    from collections.abc import Iterator
    from pathlib import Path

PATIENCE_S = 60.0


@contextmanager
def instant(folder: Path) -> Iterator[str]:
    """Run it; yield its base URL."""
    port = free_port()
    child = Child(
        "instant", ["tools.bench.instant_llm_server", "--port", str(port)], folder / "instant.log"
    )
    child.start(time.monotonic())
    url = f"http://127.0.0.1:{port}/v1"
    try:
        until(lambda: _answers(url), PATIENCE_S, "the instant endpoint", 0.05)
        yield url
    finally:
        child.stop(4.0)


def counts(url: str) -> dict[str, Any]:
    """Return calls and characters by model."""
    found: dict[str, Any] = httpx.get(url.replace("/v1", "/counts"), trust_env=False).json()
    return found


def hang(url: str) -> None:
    """Let it take requests from now on and answer none."""
    httpx.post(url.replace("/v1", "/hang"), json={"on": True}, trust_env=False).raise_for_status()


def _answers(url: str) -> bool:
    try:
        return "calls" in counts(url)
    except httpx.HTTPError:
        return False
