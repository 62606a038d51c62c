"""Serve a connection within the bounds of ``planner.api.crowd``: uvicorn's protocols, bounded.

``protocol`` is given to uvicorn as ``http``. What a request may take in seconds, bytes and fields
before it is complete ends here; uvicorn itself waits for ever and keeps everything.
"""

from __future__ import annotations

import asyncio
import json
from collections import deque
from functools import partial
from typing import TYPE_CHECKING, Any, ClassVar

from uvicorn.protocols.http.httptools_impl import (
    STATUS_LINE,
    HttpToolsProtocol,
    RequestResponseCycle,
)
from uvicorn.protocols.websockets.websockets_sansio_impl import WebSocketsSansIOProtocol

from planner.api import problems
from planner.api.access import STOPPING_PATHS
from planner.api.crowd import Bounds, Crowd, Standing, Visitor, address_of, raise_files

if TYPE_CHECKING:
    from uvicorn._types import ASGIReceiveEvent, ASGISendEvent
    from websockets.frames import Frame

SLICE_BYTES = 2_048
"""Of a socket's frames read in one turn of the loop: 340 of the smallest, about 3 ms."""
MOST_FRAGMENTS = 64
_STOPS = frozenset(path.encode() for path in STOPPING_PATHS)


class HttpConnection(HttpToolsProtocol):
    """Be uvicorn's connection of httptools, bounded.

    h11 bounds headers by itself, but costs 40 % more of a processor for each request.
    """

    crowd: ClassVar[Crowd]

    def connection_made(self, transport: asyncio.Transport) -> None:  # type: ignore[override]  # as uvicorn has it
        super().connection_made(transport)
        self._bounds = self.crowd.bounds
        self._overhead = self._fields = self._chunks = self._body = 0
        self._refused: tuple[int, str, str] | None = None
        self._begun = self._in_body = False
        address = address_of(self.client[0] if self.client else "")
        self.visitor = Visitor(address, transport, self._give_up)
        self.visitor.due_s = self.loop.time() + self._bounds.request_s
        self.crowd.enter(self.visitor)

    def connection_lost(self, exc: Exception | None) -> None:
        self.crowd.leave(self.visitor)
        super().connection_lost(exc)

    def data_received(self, data: bytes) -> None:
        if self._refused is not None:
            return
        if self.visitor.due_s is None:
            self._await(self._bounds.request_s)
        self._overhead += len(data)
        super().data_received(data)
        if self._overhead > self._bounds.head_bytes and self._refused is None:
            self._refuse(431, "headers_too_large", _TOO_LONG.format(self._bounds.head_bytes))

    def on_message_begin(self) -> None:
        super().on_message_begin()
        self._begun = True
        if self.visitor.due_s is None:  # it came with the end of the one before
            self._await(self._bounds.request_s)
        self._fields = self._chunks = self._body = 0

    def on_header(self, name: bytes, value: bytes) -> None:
        self._fields += 1
        if self._fields > self._bounds.fields:
            self._refused = (431, "headers_too_large", f"more than {self._bounds.fields} headers")
            raise _Refusal
        super().on_header(name, value)

    def on_headers_complete(self) -> None:
        if len(self.pipeline) >= self._bounds.pipelined:
            detail = f"more than {self._bounds.pipelined} requests before the first was answered"
            self._refused = (400, "malformed_request", detail)
            raise _Refusal
        self._in_body = True
        self._await(self._bounds.request_s)
        super().on_headers_complete()

    def on_chunk_header(self) -> None:
        self._chunks += 1
        if self._chunks > self._bounds.chunks:
            self._refused = (413, "body_too_large", f"more than {self._bounds.chunks} chunks")
            raise _Refusal

    def on_body(self, body: bytes) -> None:
        self._overhead -= len(body)
        self._body += len(body)
        if self.visitor.due_s is not None:
            self.visitor.due_s += len(body) / self._bounds.body_bytes_per_s
        if self._body > self._bounds.body_bytes:
            detail = f"the body passed {self._bounds.body_bytes} bytes, which is the cap"
            self._refused = (413, "body_too_large", detail)
            raise _Refusal
        super().on_body(body)

    def on_message_complete(self) -> None:
        self._begun = self._in_body = False
        self._overhead = 0
        self.visitor.due_s = None
        stops = self.url.partition(b"?")[0] in _STOPS
        self.crowd.stand(self.visitor, Standing.STOPPING if stops else Standing.ANSWERED)
        super().on_message_complete()

    def on_response_complete(self) -> None:
        super().on_response_complete()
        if not self.pipeline:
            self.crowd.stand(self.visitor, Standing.WAITING)

    def handle_websocket_upgrade(self) -> None:
        of_socket = partial(EventSocket, visitor=self.visitor, crowd=self.crowd)
        self.ws_protocol_class = of_socket  # type: ignore[assignment]  # made, never looked at
        super().handle_websocket_upgrade()

    def send_400_response(self, msg: str) -> None:
        """Answer a request that uvicorn's parser can't take."""
        status, code, detail = self._refused or (400, "malformed_request", msg)
        self._refuse(status, code, detail)

    def pause_writing(self) -> None:
        super().pause_writing()
        self.visitor.stalled_s = self.loop.time()

    def resume_writing(self) -> None:
        super().resume_writing()
        self.visitor.stalled_s = None

    def _await(self, seconds: float) -> None:
        self.visitor.due_s = self.loop.time() + seconds

    def _give_up(self) -> None:
        """End a request that takes too long; a connection that never began one just closes."""
        self.visitor.due_s = None
        if self._refused is not None:
            self.transport.abort()
        elif not self._begun:
            self.transport.close()
        else:
            what = "body" if self._in_body else "head"
            self._refuse(408, "request_timeout", f"the {what} was not complete in time")

    def _refuse(self, status: int, code: str, detail: str) -> None:
        """Answer where no other answer has begun, and hear no more.

        A route that waits for the body is told that the client is gone: a stop stops all the same.
        What still comes is read for a moment and thrown away, or the answer would be lost with it.
        """
        self._refused = (status, code, detail)
        cycle: RequestResponseCycle | None = self.cycle
        answering = cycle if cycle is not None and not cycle.response_complete else None
        if answering is not None:
            answering.disconnected = True
            answering.message_event.set()
        answered = self._in_body and cycle is not None and cycle.response_complete
        begun = answering is not None and answering.response_started
        silent = answered or begun or bool(self.pipeline)
        if not silent:
            self.transport.write(_answer(status, code, detail))
        if not silent and self.transport.can_write_eof():
            self.flow.resume_reading()
            self.transport.write_eof()
            self._await(self._bounds.linger_s)
            self.crowd.stand(self.visitor, Standing.WAITING)
        else:
            self.transport.close()


class EventSocket(WebSocketsSansIOProtocol):
    """Be uvicorn's WebSocket; read little at a time, and nothing from a peer that does not read."""

    def __init__(self, *, visitor: Visitor, crowd: Crowd, **given: Any) -> None:
        super().__init__(**given)
        self._visitor, self._crowd = visitor, crowd
        self._slices: deque[bytes] = deque()

    def connection_lost(self, exc: Exception | None) -> None:
        self._slices.clear()
        self._crowd.leave(self._visitor)
        super().connection_lost(exc)

    async def send(self, message: ASGISendEvent) -> None:
        if message["type"] == "websocket.accept":
            self._crowd.settle(self._visitor)
        await super().send(message)

    async def receive(self) -> ASGIReceiveEvent:
        message = await self.queue.get()
        if self.queue.empty():
            self.loop.call_soon(self._feed)
        return message

    def data_received(self, data: bytes) -> None:
        for start in range(0, len(data), SLICE_BYTES):
            self._slices.append(data[start : start + SLICE_BYTES])
        self._feed()

    def _feed(self) -> None:
        """Read a slice, the next one in another turn; none while the last one's words wait.

        Once we have said goodbye nobody takes them, and what is awaited is the other's goodbye.
        """
        idle = self.queue.empty() or self.close_sent
        if not idle:
            return
        if self._slices:
            super().data_received(self._slices.popleft())
        if self._slices:
            if not self.read_paused:
                self.read_paused = True
                self.transport.pause_reading()
            self.loop.call_soon(self._feed)
        elif self.read_paused and (self.queue.empty() or self.close_sent):
            self.read_paused = False
            self.transport.resume_reading()

    def handle_cont(self, event: Frame) -> None:
        if len(self.frames) >= MOST_FRAGMENTS:
            self.conn.fail(1009, "too many fragments")
            self.handle_parser_exception()
            return
        super().handle_cont(event)

    def handle_ping(self) -> None:
        if self.writable.is_set():
            super().handle_ping()
        else:
            self.conn.data_to_send()  # its pongs would pile up unread

    def pause_writing(self) -> None:
        super().pause_writing()
        self._visitor.stalled_s = self.loop.time()

    def resume_writing(self) -> None:
        super().resume_writing()
        self._visitor.stalled_s = None


def protocol(bounds: Bounds | None = None) -> type[HttpConnection]:
    """Return the protocol of one server, to be given to uvicorn as ``http``."""
    crowd = Crowd(bounds or Bounds().limit_to_files(raise_files()))
    return type("BoundedConnection", (HttpConnection,), {"crowd": crowd})


class _Refusal(Exception):
    """End the parser's work; the response stands in ``_refused``."""


_TOO_LONG = "a request may have {} bytes beside its body"


def _answer(status: int, code: str, detail: str) -> bytes:
    body = json.dumps(problems.body(status, code, detail), ensure_ascii=False).encode()
    head = (
        f"content-type: {problems.MEDIA_TYPE}\r\ncontent-length: {len(body)}\r\n"
        "cache-control: no-store\r\nx-content-type-options: nosniff\r\nconnection: close\r\n\r\n"
    )
    return STATUS_LINE[status] + head.encode("ascii") + body
