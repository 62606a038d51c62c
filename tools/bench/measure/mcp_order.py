"""Measure what MCP adds to the time from an order to its plan, against the API's own.

One robot; an order by the tool over Streamable HTTP and one by the API alternate, each looked after
at the same pace until it is planned, in the name of the same agent.
"""

from __future__ import annotations

import asyncio
import os
import socket
import subprocess
import sys
import time
from contextlib import contextmanager
from typing import TYPE_CHECKING, Any

import httpx

from pons.http import call
from pons.robot_processes import free_port
from tools.bench.context import until
from tools.bench.report import ReportRow, row_of
from tools.bench.robot import BenchRobot

if TYPE_CHECKING:
    from collections.abc import Iterator

    from tools.bench.context import BenchLab

NAME = "mcp_order"
TITLE = "an order over MCP -> its plan, against over the API"
LONG_ONLY = False
ORDER = "where are you?"
SLICE = 10
ACCEPTED = "application/json, text/event-stream"
FIRST_LOOK_S = 0.004
"""As the tool looks first after a goal, later by half more each time."""
PAUSE_S = 0.6
"""Between two pairs: an agent's rate is bounded."""


def measure(lab: BenchLab) -> list[ReportRow]:
    """Take pairs, the first of each in turn; tell each way, and the difference pair by pair."""
    slices = list(lab.slices("pairs", lab.count(5, 20), lambda _: _take(lab)))
    pairs = [pair for one in slices for pair in one]
    more = [1e3 * (by_mcp - by_http) for by_mcp, by_http in pairs]
    return [
        row_of("order -> plan over MCP", "ms", "", [1e3 * pair[0] for pair in pairs]),
        row_of("order -> plan over HTTP", "ms", "", [1e3 * pair[1] for pair in pairs]),
        row_of("MCP over HTTP, of a pair", "ms", "p50 <= 30", more),
    ]


def _take(lab: BenchLab) -> list[list[float]]:
    with lab.folder() as home, BenchRobot(home, "two_room") as robot:
        robot.await_planner()
        made = call(robot.settings, "POST", "/v1/people", {"name": "Bench", "role": "agent"})
        with _run_server(robot) as port:
            return asyncio.run(_pairs(robot.settings.url, port, str(made["token"])))


@contextmanager
def _run_server(robot: BenchRobot) -> Iterator[int]:
    """Run ``pons mcp --http`` for this robot; lend its port."""
    settings, port = robot.settings, free_port()
    environment = {
        **os.environ, "PONS_HOME": str(settings.home), "PONS_PORT": str(settings.port),
        "PONS_ROBOT": str(settings.robot), "PONS_SITE": str(settings.site),
    }  # fmt: skip
    words = [sys.executable, "-m", "pons", "mcp", "--http", "--port", str(port)]
    with subprocess.Popen(words, env=environment, stderr=subprocess.DEVNULL) as process:
        try:
            until(lambda: _is_open(port), 60.0, "the MCP server", 0.1)
            yield port
        finally:
            process.terminate()


async def _pairs(url: str, port: int, token: str) -> list[list[float]]:
    headers = {"authorization": f"Bearer {token}", "accept": ACCEPTED}
    pairs: list[list[float]] = []
    async with httpx.AsyncClient(headers=headers, trust_env=False, timeout=30.0) as http:
        for number in range(-1, SLICE):  # the first pair opens connections, and does not count
            pair = [0.0, 0.0]
            for way in (0, 1) if number % 2 == 0 else (1, 0):
                began_s = time.monotonic()
                await (_by_mcp(http, port) if way == 0 else _by_http(http, url))
                pair[way] = time.monotonic() - began_s
            pairs += [pair] * (number >= 0)
            await asyncio.sleep(PAUSE_S)
    return pairs


def _is_open(port: int) -> bool:
    with socket.socket() as probe:
        return probe.connect_ex(("127.0.0.1", port)) == 0


async def _by_mcp(http: httpx.AsyncClient, port: int) -> None:
    asked = {"name": "order", "arguments": {"text": ORDER}}
    body = {"jsonrpc": "2.0", "id": 1, "method": "tools/call", "params": asked}
    answer = (await http.post(f"http://127.0.0.1:{port}/mcp", json=body)).json()
    if answer.get("result", {}).get("isError", True) is not False:
        raise OSError(str(answer))


async def _by_http(http: httpx.AsyncClient, url: str) -> None:
    goal: dict[str, Any] = (await http.post(f"{url}/v1/goals", json={"text": ORDER})).json()
    pause_s = FIRST_LOOK_S
    while goal["state"] == "planning":
        goal = (await http.get(f"{url}/v1/goals/{goal['id']}")).json()
        await asyncio.sleep(pause_s)
        pause_s *= 1.5
