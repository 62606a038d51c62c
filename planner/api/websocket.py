"""Stream the planner's events over a WebSocket: a snapshot, then deltas, each with a rising seq.

The same socket takes ``{"stop": true}``, so that a page whose POSTs hang can still stop the robot,
and ``{"snapshot": true}`` from a page that has lost count, in text or in bytes. A stop is taken at
any rate, by any socket that is open; how many may be is bounded.
"""

from __future__ import annotations

import asyncio
import contextlib
import json
import time
from collections import Counter
from typing import TYPE_CHECKING, Any

from fastapi import APIRouter, WebSocket, WebSocketDisconnect

from planner.api import problems
from planner.api.access import SUBPROTOCOL
from planner.api.crowd import address_of
from planner.api.interfaces import Services
from planner.api.listing import list_goals
from planner.api.live_state import Body, Feed, Listener, text_of
from planner.api.objects import sight_view
from planner.api.rates import Rate
from planner.api.robot import about, obstacle_view, path_view, robot_view, scan_view
from planner.api.usage import usage_view
from planner.people import name_asker

if TYPE_CHECKING:
    from collections.abc import AsyncIterator, Mapping

MAX_FROM_CLIENT = 1_000
SNAPSHOT_S = 1.0
"""Between two snapshots that one socket asks for; what is asked meanwhile is one more, later."""
APART_S = 0.01
"""Between two snapshots of all sockets: each holds the loop for some milliseconds, and where many
pages open at once a stop comes in between."""
A_SECOND, AT_ONCE = 20.0, 100
"""Messages of one socket that are no stop; who sends more is no page of ours, and is closed."""
MOST_SOCKETS, MOST_OF_AN_ADDRESS = 128, 64
POLICY_VIOLATION = 1008


class Seats:
    """Count open sockets by address."""

    def __init__(self) -> None:
        self._taken: Counter[str] = Counter()

    def take(self, address: str) -> bool:
        """Return whether there is room for one more, and count it if so."""
        room = self._taken.total() < MOST_SOCKETS and self._taken[address] < MOST_OF_AN_ADDRESS
        if room:
            self._taken[address] += 1
        return room

    def give_back(self, address: str) -> None:
        """Count one less."""
        self._taken[address] -= 1
        self._taken += Counter()  # drops those that have none


def routes(services: Services) -> APIRouter:
    """Return the event stream."""
    router = APIRouter(tags=["events"])
    feed, seats, turns = Feed(services), Seats(), asyncio.Lock()

    @router.websocket("/v1/events")
    async def events(socket: WebSocket) -> None:
        address = address_of(socket.client.host) if socket.client else ""
        if not seats.take(address):
            detail = f"{MOST_SOCKETS} sockets may be open, {MOST_OF_AN_ADDRESS} of one address"
            await socket.send_denial_response(problems.response(503, "too_many_sockets", detail))
            return
        try:
            await _attend(services, feed, socket, turns)
        finally:
            seats.give_back(address)

    return router


async def _attend(services: Services, feed: Feed, socket: WebSocket, turns: asyncio.Lock) -> None:
    offered = socket.scope.get("subprotocols", ())
    await socket.accept(subprotocol=SUBPROTOCOL if SUBPROTOCOL in offered else None)
    queue = services.goals.subscribe()
    listener = feed.listen()
    try:
        await serve(services, socket, queue, listener, turns)
    finally:
        feed.leave(listener)


async def serve(
    services: Services,
    socket: WebSocket,
    changes: AsyncIterator[tuple[int, dict[str, Any]]],
    listener: Listener,
    turns: asyncio.Lock,
) -> None:
    """Run one connection until either side ends it."""
    sender, wanted = _Sender(socket, turns), asyncio.Event()
    tasks = [
        asyncio.create_task(_begin(services, sender, listener)),
        asyncio.create_task(_changes(sender, changes)),
        asyncio.create_task(_listen(services, socket, sender, wanted)),
        asyncio.create_task(_show_again(services, sender, wanted)),
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
    """Number the messages of a socket that several tasks share."""

    def __init__(self, socket: WebSocket, turns: asyncio.Lock) -> None:
        self._socket, self._turns = socket, turns
        self._seq = 0
        self._lock = asyncio.Lock()
        self._begun = asyncio.Event()

    async def send(self, kind: str, content: dict[str, Any]) -> None:
        await self.send_body(text_of(kind, content))

    async def show(self, services: Services) -> None:
        """Send a snapshot, in this socket's turn; all later messages follow the first one."""
        async with self._turns:
            await asyncio.sleep(APART_S)
        self._begun.set()
        await self.send("snapshot", snapshot(services))

    async def send_body(self, body: Body) -> None:
        await self._begun.wait()
        async with self._lock:
            self._seq += 1
            await self._socket.send_text(f'{{"seq":{self._seq},{body}')


def snapshot(services: Services) -> dict[str, Any]:
    """Return all that a page needs to begin, or to begin again."""
    return {
        "robot": robot_view(services),
        "goals": list_goals(services.goals.goals(50)),
        "about": about(services),
        "path": path_view(services),
        "scan": scan_view(services),
        "obstacles": obstacle_view(services),
        "usage": usage_view(services),
        "places_version": services.memory.version,
        "sight": sight_view(services),
    }


async def _begin(services: Services, sender: _Sender, listener: Listener) -> None:
    """Send the snapshot, then what all watch; a bridge that is silent shows by its ages."""
    await sender.show(services)
    while True:
        for body in await listener.take():
            await sender.send_body(body)


async def _changes(sender: _Sender, changes: AsyncIterator[tuple[int, dict[str, Any]]]) -> None:
    async for _, change in changes:
        if change.get("type") != "status":  # the robot's view carries it, with ages
            await sender.send(str(change.get("type", "event")), {"change": change})


async def _show_again(services: Services, sender: _Sender, wanted: asyncio.Event) -> None:
    while True:
        await wanted.wait()
        wanted.clear()
        await sender.show(services)
        await asyncio.sleep(SNAPSHOT_S)


async def _listen(
    services: Services, socket: WebSocket, sender: _Sender, wanted: asyncio.Event
) -> None:
    rate = Rate(A_SECOND, AT_ONCE, time.monotonic())
    while True:
        message = await socket.receive()
        if message["type"] != "websocket.receive":
            return
        order = _order(message)
        if order.get("stop") is True:
            stopped = await services.goals.stop(name_asker("page"))
            await sender.send("stopped", {"confirmed": stopped.is_echoed})
        elif not rate.take(time.monotonic()):
            detail = f"at most {AT_ONCE} messages at once, then {A_SECOND:g} a second"
            await sender.send("problem", {"code": "too_many_messages", "detail": detail})
            await socket.close(POLICY_VIOLATION, "too_many_messages")
            return
        elif order.get("snapshot") is True:
            wanted.set()
        else:
            detail = 'expected {"stop": true} or {"snapshot": true}'
            await sender.send("problem", {"code": "unknown_message", "detail": detail})


def _order(message: Mapping[str, Any]) -> dict[str, Any]:
    """Return the order in a frame, of text or of bytes; None where it can't be read."""
    said: str | bytes = message.get("text") or message.get("bytes") or ""
    if len(said) > MAX_FROM_CLIENT:
        return {}
    try:
        content = json.loads(said)
    except (ValueError, RecursionError):
        return {}
    return content if isinstance(content, dict) else {}
