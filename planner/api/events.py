"""Stream what happens over a WebSocket: a snapshot, then deltas, each with a rising seq.

The same socket takes ``{"stop": true}``, so that a page whose POSTs hang can still stop the robot.
"""

from __future__ import annotations

import asyncio
import contextlib
import json
from typing import TYPE_CHECKING, Any

from fastapi import APIRouter, WebSocket, WebSocketDisconnect

from planner.api.ports import Services
from planner.api.robot import robot_view

if TYPE_CHECKING:
    from collections.abc import AsyncIterator

MAX_FROM_CLIENT = 1_000
ROBOT_PERIOD_S = 0.1


def routes(services: Services) -> APIRouter:
    """Return the event stream."""
    router = APIRouter(tags=["events"])

    @router.websocket("/v1/events")
    async def events(socket: WebSocket) -> None:
        await socket.accept()
        queue = services.goals.subscribe()
        await serve(services, socket, queue)

    return router


async def serve(
    services: Services, socket: WebSocket, changes: AsyncIterator[tuple[int, dict[str, Any]]]
) -> None:
    """Run one connection until either side ends it."""
    sender = _Sender(socket)
    await sender.send("snapshot", _snapshot(services))
    tasks = [
        asyncio.create_task(_robot(services, sender)),
        asyncio.create_task(_changes(sender, changes)),
        asyncio.create_task(_listen(services, socket, sender)),
    ]
    try:
        await asyncio.wait(tasks, return_when=asyncio.FIRST_COMPLETED)
    finally:
        for task in tasks:
            task.cancel()
        for task in tasks:
            with contextlib.suppress(asyncio.CancelledError, WebSocketDisconnect, RuntimeError):
                await task


class _Sender:
    """Number what is sent; two tasks share one socket."""

    def __init__(self, socket: WebSocket) -> None:
        self._socket = socket
        self._seq = 0
        self._lock = asyncio.Lock()

    async def send(self, kind: str, content: dict[str, Any]) -> None:
        async with self._lock:
            self._seq += 1
            message = {"seq": self._seq, "kind": kind, **content}
            await self._socket.send_text(json.dumps(message, ensure_ascii=False))


def _snapshot(services: Services) -> dict[str, Any]:
    goals = [goal.model_dump(mode="json") for goal in services.goals.goals(50)]
    return {"robot": robot_view(services), "goals": goals}


async def _robot(services: Services, sender: _Sender) -> None:
    """Send the robot's view at 10 Hz; a bridge that is silent shows by its ages."""
    while True:
        await asyncio.sleep(ROBOT_PERIOD_S)
        await sender.send("robot", {"robot": robot_view(services)})


async def _changes(sender: _Sender, changes: AsyncIterator[tuple[int, dict[str, Any]]]) -> None:
    async for _, change in changes:
        if change.get("type") != "status":  # the robot's view carries it, with ages
            await sender.send(str(change.get("type", "event")), {"change": change})


async def _listen(services: Services, socket: WebSocket, sender: _Sender) -> None:
    while True:
        text = await socket.receive_text()
        if _asks_to_stop(text):
            stopped = await services.goals.stop("page")
            await sender.send("stopped", {"confirmed": stopped.echoed})
        else:
            detail = 'expected {"stop": true}'
            await sender.send("problem", {"code": "unknown_message", "detail": detail})


def _asks_to_stop(text: str) -> bool:
    if len(text) > MAX_FROM_CLIENT:
        return False
    try:
        content = json.loads(text)
    except ValueError:
        return False
    return isinstance(content, dict) and content.get("stop") is True
