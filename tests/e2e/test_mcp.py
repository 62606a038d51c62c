"""An assistant drives the simulated home by the SDK's own client, on stdio and over HTTP."""

from __future__ import annotations

import asyncio
import json
import subprocess
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

import httpx2
import pytest
from mcp import Client, StdioServerParameters
from mcp.client.streamable_http import streamable_http_client

from pons.robot_processes import free_port
from tests.e2e.robot import Robot
from tests.e2e.system import ROOT

pytestmark = [pytest.mark.e2e, pytest.mark.timeout(200)]
LIMIT_S = 60.0


@contextmanager
def over_http(robot: Robot) -> Iterator[str]:
    """Run ``pons mcp --http`` for this robot; lend its address."""
    port = free_port()
    words = [sys.executable, "-m", "pons", "mcp", "--http", "--port", str(port)]
    serving = subprocess.Popen(
        words, cwd=ROOT, env=robot.system.environment, stderr=subprocess.PIPE
    )
    try:
        assert serving.stderr is not None
        serving.stderr.readline()  # the line with its address
        yield f"http://127.0.0.1:{port}/mcp"
    finally:
        serving.terminate()
        serving.communicate(timeout=20.0)


async def call(client: Client, tool: str, **given: Any) -> dict[str, Any]:
    result = await client.call_tool(tool, given)
    assert not result.is_error, result.content
    return dict(result.structured_content or {})


async def drive(client: Client, place: str) -> str:
    """Order a drive as assistants do: look first, order, and wait for what comes of it."""
    assert place in {each["id"] for each in (await call(client, "places"))["places"]}
    foreseen = await call(client, "what_would_you_do", text=f"go to the {place}")
    assert foreseen["is_whole"] is True
    goal = (await call(client, "order", text=f"go to the {place}"))["goal"]
    ended = await call(client, "wait_for", goal=goal, seconds=LIMIT_S)
    assert (ended["came"], ended["state"]) == ("ended", "succeeded"), ended
    return str(goal)


def test_an_assistant_drives_by_both_transports_and_clears_no_stop(robot: Robot) -> None:
    made = robot.system.pons("people", "add", "Assistant", "--role", "agent", "--json")
    token = json.loads(made.stdout)["token"]
    near, far = robot.elsewhere(), robot.farthest()

    async def story(url: str) -> None:
        own = {**robot.system.environment, "PONS_AGENT_TOKEN": token}
        started = StdioServerParameters(
            command=sys.executable, args=["-m", "pons", "mcp"], cwd=ROOT, env=own
        )
        async with Client(started) as client:
            goal = await drive(client, near.id)
            assert robot.system.goal(goal)["by"] == "assistant"
            robot.assert_there(near)
        bearer = {"authorization": f"Bearer {token}"}
        async with (
            httpx2.AsyncClient(headers=bearer, timeout=LIMIT_S) as http,
            Client(streamable_http_client(url, http_client=http)) as client,
        ):
            await drive(client, far.id)
            robot.assert_there(far)
            given = await call(client, "order", text=f"go to the {near.id}")
            assert (await call(client, "stop"))["confirmed"] is True
            paused = await call(client, "wait_for", goal=given["goal"], seconds=LIMIT_S)
            assert paused["came"] == "paused"
            await call(client, "order", text=f"go to the {near.id}")
            now = await call(client, "status")
            assert now["held_by"] == "stop"
            while now["moving"]:  # it ramps to a stand first
                now = await call(client, "status")
            for each in now["open_goals"]:
                await call(client, "cancel", goal=each["goal"])

    with over_http(robot) as url:
        asyncio.run(story(url))
    robot.system.pons("people", "remove", "assistant")
