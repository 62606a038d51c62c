"""Stream what happens over a WebSocket: a snapshot, then deltas, each with a rising seq.

The same socket takes ``{"stop": true}``, so that a page whose POSTs hang can still stop the robot,
and ``{"snapshot": true}`` from a page that has lost count.
"""

from __future__ import annotations

import asyncio
import contextlib
import json
from typing import TYPE_CHECKING, Any

from fastapi import APIRouter, WebSocket, WebSocketDisconnect

from planner.api.access import SUBPROTOCOL
from planner.api.feed import Body, Feed, Listener, text_of
from planner.api.objects import sight_view
from planner.api.ports import Services
from planner.api.robot import about, path_view, robot_view, scan_view
from planner.api.usage import usage_view

if TYPE_CHECKING:
    from collections.abc import AsyncIterator

MAX_FROM_CLIENT = 1_000


def routes(services: Services) -> APIRouter:
    """Return the event stream."""
    router = APIRouter(tags=["events"])
    feed = Feed(services)

    @router.websocket("/v1/events")
    async def events(socket: WebSocket) -> None:
        offered = socket.scope.get("subprotocols", ())
        await socket.accept(subprotocol=SUBPROTOCOL if SUBPROTOCOL in offered else None)
        queue = services.goals.subscribe()
        listener = feed.listen()
        try:
            await serve(services, socket, queue, listener)
        finally:
            feed.leave(listener)

    return router


async def serve(
    services: Services,
    socket: WebSocket,
    changes: AsyncIterator[tuple[int, dict[str, Any]]],
    listener: Listener,
) -> None:
    """Run one connection until either side ends it."""
    sender = _Sender(socket)
    tasks = [
        asyncio.create_task(_begin(services, sender, listener)),
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
    """Number what is sent; several tasks share one socket."""

    def __init__(self, socket: WebSocket) -> None:
        self._socket = socket
        self._seq = 0
        self._lock = asyncio.Lock()

    async def send(self, kind: str, content: dict[str, Any]) -> None:
        await self.send_body(text_of(kind, content))

    async def send_body(self, body: Body) -> None:
        async with self._lock:
            self._seq += 1
            await self._socket.send_text(f'{{"seq":{self._seq},{body}')


def snapshot(services: Services) -> dict[str, Any]:
    """Return all that a page needs to begin, or to begin again."""
    return {
        "robot": robot_view(services),
        "goals": [goal.model_dump(mode="json") for goal in services.goals.goals(50)],
        "about": about(services),
        "path": path_view(services),
        "scan": scan_view(services),
        "usage": usage_view(services),
        "places_version": services.memory.version,
        "sight": sight_view(services),
    }


async def _begin(services: Services, sender: _Sender, listener: Listener) -> None:
    """Send the snapshot, then what all watch; a bridge that is silent shows by its ages."""
    await sender.send("snapshot", snapshot(services))
    while True:
        for body in await listener.take():
            await sender.send_body(body)


async def _changes(sender: _Sender, changes: AsyncIterator[tuple[int, dict[str, Any]]]) -> None:
    async for _, change in changes:
        if change.get("type") != "status":  # the robot's view carries it, with ages
            await sender.send(str(change.get("type", "event")), {"change": change})


async def _listen(services: Services, socket: WebSocket, sender: _Sender) -> None:
    while True:
        order = _order(await socket.receive_text())
        if order.get("stop") is True:
            stopped = await services.goals.stop("page")
            await sender.send("stopped", {"confirmed": stopped.echoed})
        elif order.get("snapshot") is True:
            await sender.send("snapshot", snapshot(services))
        else:
            detail = 'expected {"stop": true} or {"snapshot": true}'
            await sender.send("problem", {"code": "unknown_message", "detail": detail})


def _order(text: str) -> dict[str, Any]:
    if len(text) > MAX_FROM_CLIENT:
        return {}
    try:
        content = json.loads(text)
    except (ValueError, RecursionError):
        return {}
    return content if isinstance(content, dict) else {}
