"""Act as a rosbridge server for one graph of topics, on a thread of its own (protocol 2.1).

A second implementation, written from the protocol's page: advertise, publish, subscribe with
throttle_rate, call_service of /rosapi/topic_type, status. Numbers that JSON lacks go out as null.
"""

from __future__ import annotations

import asyncio
import json
import threading
import time
from collections import deque
from dataclasses import dataclass, field
from math import isfinite
from typing import Any

from websockets.asyncio.server import ServerConnection, serve
from websockets.exceptions import ConnectionClosed

from wire import ConfigError

Message = dict[str, Any]
START_S = 5.0


@dataclass(slots=True)
class _Subscription:
    every_s: float
    sent_s: float = float("-inf")


@dataclass(slots=True, eq=False)
class _Client:
    socket: ServerConnection
    topics: dict[str, _Subscription] = field(default_factory=dict)


class RosbridgeServer:
    """Serve topics of known types; hold what clients publish until it is taken."""

    def __init__(self, port: int, types: dict[str, str]) -> None:
        """Listen on the loopback.

        Args:
            port: 0 takes a free one.
            types: of the topics that the graph has; clients may advertise more.

        Raises:
            ConfigError: ``twin_port``, where the port is another's.
        """
        self.types = types
        self._heard: deque[tuple[str, Message]] = deque(maxlen=256)
        self._clients: set[_Client] = set()
        self._loop = asyncio.new_event_loop()
        self._ready = threading.Event()
        self._error = ""
        self._end: asyncio.Event | None = None
        self.port = port
        self._thread = threading.Thread(target=self._run, name="rosbridge-twin", daemon=True)
        self._thread.start()
        if not self._ready.wait(START_S) or self._error:
            raise ConfigError("twin_port", f"127.0.0.1:{port}: {self._error or 'no answer'}")

    def take(self) -> list[tuple[str, Message]]:
        """Return what clients have published since the last call, oldest first."""
        found = []
        while self._heard:
            found.append(self._heard.popleft())
        return found

    def publish(self, topic: str, message: Message) -> None:
        """Send a message to all who subscribed. Waits for nobody."""
        if self._clients:
            self._loop.call_soon_threadsafe(self._send_all, topic, message)

    def hang_up(self) -> None:
        """Cut every connection without a word, as a server that is killed does."""
        self._loop.call_soon_threadsafe(self._abort_all)

    def close(self) -> None:
        """Stop listening and end the thread."""
        if self._end is not None:
            self._loop.call_soon_threadsafe(self._end.set)
        self._thread.join(START_S)

    def _run(self) -> None:
        try:
            self._loop.run_until_complete(self._serve())
        except OSError as error:
            self._error = str(error)
        finally:
            self._ready.set()
            self._loop.close()

    async def _serve(self) -> None:
        self._end = asyncio.Event()
        async with serve(
            self._attend, "127.0.0.1", self.port, compression=None, close_timeout=0.2
        ) as server:
            self.port = next(iter(server.sockets)).getsockname()[1]
            self._ready.set()
            await self._end.wait()
            self._abort_all()

    async def _attend(self, socket: ServerConnection) -> None:
        client = _Client(socket)
        self._clients.add(client)
        try:
            async for frame in socket:
                self._obey(client, frame)
        except ConnectionClosed:
            return
        finally:
            self._clients.discard(client)

    def _obey(self, client: _Client, frame: str | bytes) -> None:
        try:
            raw = json.loads(frame)
            operation, topic = raw.get("op"), raw.get("topic")
            if operation == "publish":
                self._hear(client, topic, raw["msg"])
            elif operation == "subscribe":
                self._subscribe(client, raw)
            elif operation == "unsubscribe":
                client.topics.pop(topic, None)
            elif operation == "unadvertise":
                pass  # the graph is of known topics; none goes
            elif operation == "advertise":
                self._advertise(client, topic, raw["type"])
            elif operation == "call_service":
                self._answer(client, raw)
            else:
                self._say(client, "error", f"Unknown operation: {operation}")
        except (ValueError, KeyError, AttributeError, TypeError) as error:
            self._say(client, "error", f"{type(error).__name__}: {error}")

    def _hear(self, client: _Client, topic: str, message: Message) -> None:
        if topic not in self.types:
            self._say(client, "error", f"Cannot infer type for topic {topic}, not yet advertised")
        else:
            self._heard.append((topic, message))

    def _subscribe(self, client: _Client, raw: Message) -> None:
        topic, kind = raw["topic"], raw.get("type")
        known = self.types.get(topic)
        if known is not None and kind is not None and kind != known:
            self._say(client, "error", f"Tried to subscribe {topic} with {kind}, it is {known}")
        else:
            client.topics[topic] = _Subscription(raw.get("throttle_rate", 0) / 1000.0)

    def _advertise(self, client: _Client, topic: str, kind: str) -> None:
        known = self.types.setdefault(topic, kind)
        if known != kind:
            self._say(client, "error", f"Tried to advertise {topic} as {kind}, it is {known}")

    def _answer(self, client: _Client, raw: Message) -> None:
        answer: Message = {"op": "service_response", "service": raw["service"]}
        if "id" in raw:
            answer["id"] = raw["id"]
        if raw["service"] == "/rosapi/topic_type":
            kind = self.types.get(raw["args"]["topic"], "")
            self._send(client, answer | {"values": {"type": kind}, "result": True})
        else:
            why = f"Service {raw['service']} does not exist"
            self._send(client, answer | {"values": why, "result": False})

    def _say(self, client: _Client, level: str, text: str) -> None:
        self._send(client, {"op": "status", "level": level, "msg": text})

    def _send_all(self, topic: str, message: Message) -> None:
        now_s = time.monotonic()
        for client in tuple(self._clients):
            wanted = client.topics.get(topic)
            if wanted is not None and now_s - wanted.sent_s >= wanted.every_s:
                wanted.sent_s = now_s
                self._send(client, {"op": "publish", "topic": topic, "msg": message})

    def _send(self, client: _Client, operation: Message) -> None:
        if client.socket.transport.get_write_buffer_size() > 1 << 16:
            return  # its queue of one: what a client does not take is lost
        text = json.dumps(_without_holes(operation))
        task = self._loop.create_task(_send(client.socket, text))
        task.add_done_callback(lambda done: done.cancelled() or done.exception())

    def _abort_all(self) -> None:
        for client in tuple(self._clients):
            client.socket.transport.abort()


async def _send(socket: ServerConnection, text: str) -> None:
    await socket.send(text)


def _without_holes(value: Any) -> Any:
    """Return a value in which null stands for infinities and not-a-number."""
    if isinstance(value, float):
        return value if isfinite(value) else None
    if isinstance(value, dict):
        return {key: _without_holes(one) for key, one in value.items()}
    if isinstance(value, list):
        return [_without_holes(one) for one in value]
    return value
