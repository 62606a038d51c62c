"""Be an endpoint that answers at once: one fixed plan, plainly or as a stream, and it counts.

Raw sockets on an event loop of its own process: what a contender takes is then its own. ``POST
/hang`` makes it take requests and answer none; ``GET /counts`` tells calls and bytes by model.
"""

from __future__ import annotations

import argparse
import asyncio
import contextlib
import json
from collections import Counter

PLAN = {
    "kind": "plan",
    "steps": [
        {"kind": "go_to", "place": "living_room"},
        {"kind": "go_to", "place": "kitchen"},
        {"kind": "wait", "seconds": 10},
        {"kind": "come_back"},
    ],
}
_WRITTEN = json.dumps(PLAN, separators=(",", ":"))
_USAGE = {"prompt_tokens": 1000, "completion_tokens": 50, "total_tokens": 1050}
_KEPT = {"id": "chatcmpl-1", "created": 1, "model": "instant"}
_WHOLE = json.dumps(
    {
        **_KEPT,
        "object": "chat.completion",
        "choices": [
            {
                "index": 0,
                "finish_reason": "stop",
                "message": {"role": "assistant", "content": _WRITTEN},
            }
        ],
        "usage": _USAGE,
    }
).encode()


def _event(delta: dict[str, str], finish: str | None, **more: object) -> bytes:
    choice = {"index": 0, "delta": delta, "finish_reason": finish}
    event = {**_KEPT, "object": "chat.completion.chunk", "choices": [choice], **more}
    return f"data: {json.dumps(event)}\n\n".encode()


_STREAM = (
    _event({"role": "assistant", "content": _WRITTEN}, None)
    + _event({}, "stop", usage=_USAGE)
    + b"data: [DONE]\n\n"
)


class Instant:
    """Hold the counts and the switch of one server."""

    def __init__(self) -> None:
        self.calls: Counter[str] = Counter()
        self.bytes: Counter[str] = Counter()
        self.hangs = False

    async def serve(self, reader: asyncio.StreamReader, writer: asyncio.StreamWriter) -> None:
        """Answer one connection's requests until it closes."""
        with contextlib.suppress(asyncio.IncompleteReadError, ConnectionError):
            while True:
                head = await reader.readuntil(b"\r\n\r\n")
                lines = head.lower().split(b"\r\n")
                sizes = [int(line[15:]) for line in lines if line.startswith(b"content-length:")]
                body = await reader.readexactly(sizes[0]) if sizes else b""
                answer = self._answer(head.split(b" ", 2)[1], body)
                if answer is None:
                    await reader.read()  # until the client is tired of it
                    break
                writer.write(answer)
                await writer.drain()
        writer.close()
        with contextlib.suppress(ConnectionError):
            await writer.wait_closed()

    def _answer(self, path: bytes, body: bytes) -> bytes | None:
        if path == b"/counts":
            return _http(json.dumps({"calls": self.calls, "bytes": self.bytes}).encode())
        if path == b"/hang":
            self.hangs = json.loads(body)["on"] is True
            return _http(b"{}")
        asked = json.loads(body)
        self.calls[asked["model"]] += 1
        self.bytes[asked["model"]] += len(json.dumps(asked["messages"], ensure_ascii=False))
        if self.hangs:
            return None
        if asked.get("stream") is True:
            return _http(_STREAM, b"text/event-stream")
        return _http(_WHOLE)


def _http(body: bytes, kind: bytes = b"application/json") -> bytes:
    return b"HTTP/1.1 200 OK\r\nContent-Type: %b\r\nContent-Length: %d\r\n\r\n%b" % (
        kind,
        len(body),
        body,
    )


async def _run(port: int) -> None:
    server = await asyncio.start_server(Instant().serve, "127.0.0.1", port, limit=1 << 20)
    async with server:
        await server.serve_forever()


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--port", type=int, required=True)
    with contextlib.suppress(KeyboardInterrupt):
        asyncio.run(_run(parser.parse_args().port))
