"""Start tool servers for tests: the SDK's own, and one that answers whatever it is told to."""

from __future__ import annotations

import asyncio
import json
import socket
import subprocess
import sys
import time
from collections.abc import AsyncIterator, Awaitable, Callable, Iterator
from contextlib import asynccontextmanager, contextmanager
from pathlib import Path
from typing import Any

from planner.settings import ToolServerSettings
from planner.state_database import StateDatabase
from planner.tool_servers import ToolDesk

CALENDAR = Path(__file__).parent / "calendar_server.py"


def free_port() -> int:
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        port: int = probe.getsockname()[1]
        return port


@contextmanager
def calendar_server() -> Iterator[str]:
    """Yield the URL of a server of the SDK's, in a process of its own."""
    port = free_port()
    command = [sys.executable, str(CALENDAR), str(port)]
    with subprocess.Popen(command, stderr=subprocess.DEVNULL) as process:
        try:
            end_s = time.monotonic() + 30.0
            while time.monotonic() < end_s:
                with socket.socket() as probe:
                    if probe.connect_ex(("127.0.0.1", port)) == 0:
                        break
                time.sleep(0.05)
            yield f"http://127.0.0.1:{port}/mcp"
        finally:
            process.kill()


Answering = Callable[[dict[str, Any], asyncio.StreamWriter], Awaitable[None]]


@asynccontextmanager
async def raw_server(answering: Answering) -> AsyncIterator[str]:
    """Yield the URL of a server that hands each request of JSON-RPC to a function."""

    async def serve(reader: asyncio.StreamReader, writer: asyncio.StreamWriter) -> None:
        try:
            head = await reader.readuntil(b"\r\n\r\n")
            lines = head.decode().lower().split("\r\n")
            size = next(int(x.split(":")[1]) for x in lines if x.startswith("content-length:"))
            await answering(json.loads(await reader.readexactly(size)), writer)
        except (ConnectionError, asyncio.IncompleteReadError, asyncio.CancelledError):
            pass
        finally:
            writer.close()

    server = await asyncio.start_server(serve, "127.0.0.1", 0)
    port = server.sockets[0].getsockname()[1]
    try:
        yield f"http://127.0.0.1:{port}/mcp"
    finally:
        server.close()


async def write_json(writer: asyncio.StreamWriter, body: object, status: str = "200 OK") -> None:
    raw = body if isinstance(body, bytes) else json.dumps(body).encode()
    head = f"HTTP/1.1 {status}\r\nContent-Type: application/json\r\nContent-Length: {len(raw)}\r\n"
    writer.write(head.encode() + b"Connection: close\r\n\r\n" + raw)
    await writer.drain()


def tool(name: str, about: str = "", **more: Any) -> dict[str, Any]:
    """Return a tool as a server lists it, marked as one that only reads."""
    shape = {"name": name, "description": about, "inputSchema": {"type": "object"}}
    return {**shape, "annotations": {"readOnlyHint": True}, **more}


def answer_with(listed: object, called: object) -> Answering:
    """Return a well-formed server of one list and one result."""

    async def answering(request: dict[str, Any], writer: asyncio.StreamWriter) -> None:
        result = listed if request["method"] == "tools/list" else called
        await write_json(writer, {"jsonrpc": "2.0", "id": request.get("id"), "result": result})

    return answering


def desk_of(home: Path, url: str, **settings: Any) -> ToolDesk:
    """Return a desk with one server, ``calendar``."""
    server = ToolServerSettings.model_validate({"url": url, "timeout_s": 20.0, **settings})
    return ToolDesk({"calendar": server}, StateDatabase(home))
