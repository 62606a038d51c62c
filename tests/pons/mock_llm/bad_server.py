"""Be a model's server that fails in every way that ``faults`` names, step by step."""

from __future__ import annotations

import asyncio
import itertools
import json
import time
from collections.abc import AsyncIterator, Callable
from typing import Any

from starlette.requests import Request
from starlette.responses import Response, StreamingResponse

from planner.brain import ThinkRequest
from pons.mock_llm import MockServer, Switches
from pons.mock_llm.completion import EVENTS, completion, events
from pons.mock_llm.replies import reply_of
from pons.mock_llm.server import LOOK_S, error
from tests.pons.mock_llm.bad_replies import hallucinate, hostile
from tests.pons.mock_llm.faults import BadSwitches

Body = dict[str, Any]
METADATA = "http://169.254.169.254/latest/meta-data/"
HUGE_BYTES, CHUNK = 1_000_000_000, 64 * 1024
OPEN_S = 0.2
"""Between two comments of a stream that is left open."""
NO_FORMAT = "response_format and tools are not supported by this model"
CONTEXT = "the request exceeds the available context size (n_ctx 1024), try increasing it"
BROKEN_CHOICE = (
    b'data: {"choices":[{"index":0,"delta":{"content":""},"finish_reason":"error"}],'
    b'"error":{"code":502,"message":"Provider disconnected"}}\n\ndata: [DONE]\n\n'
)
BARREN: dict[str | None, Callable[[Body], bool]] = {
    "schema_barren": lambda body: _format(body) == "json_schema",
    "strict_barren": lambda body: bool(_format(body)) or "tools" in body,
    "tool_never": lambda body: "tools" in body,
}
"""Ways of asking that are taken and bring nothing."""


class BadServer(MockServer):
    """Spoil one step of an answer."""

    def __init__(self, switches: BadSwitches | None = None) -> None:
        super().__init__(switches or BadSwitches())
        self._hostile = itertools.count()
        self.is_loaded = False
        """Told of a cold model alone."""
        self.left_load = 0
        """Clients that left while it loaded, and so ended the load."""

    async def instead(self, fault: str | None, body: Body, request: Request) -> Response | None:
        wait = self.switches.retry_after
        match fault:
            case "cold":
                await self._load(request)
            case "loading":
                return error(503, "Loading model", {} if wait is None else {"Retry-After": wait})
            case "small_context":
                return error(400, CONTEXT)
            case "redirect":
                return Response(status_code=307, headers={"Location": METADATA})
            case "no_json_schema" if _format(body) == "json_schema":
                return error(400, "This response_format type is unavailable now")
            case "no_schema" if _format(body) or "tools" in body:
                return error(400, NO_FORMAT)
            case "tool_never" if _format(body):
                return error(400, "response_format is not supported")
        return await super().instead(fault, body, request)

    async def _load(self, request: Request) -> None:
        """Load a cold model while this client stays; one that leaves ends the load."""
        assert isinstance(self.switches, BadSwitches)
        began_s, load_s = time.monotonic(), self.switches.load_s
        while not (self.is_loaded or self.ending()):
            if await request.is_disconnected():
                self.left_load += 1
                return
            self.is_loaded = time.monotonic() - began_s >= load_s
            await asyncio.sleep(LOOK_S)

    def set(self, switches: Switches) -> None:
        super().set(switches)
        self.is_loaded = False

    def report(self) -> dict[str, Any]:
        return {**super().report(), "left_load": self.left_load}

    async def plan(self, fault: str | None, asked: ThinkRequest, body: Body) -> dict[str, Any]:
        if fault == "schema_ignored":
            return reply_of((await self.brain.think(asked)).plan, asked.text)
        return only_reply(body) or await super().plan(fault, asked, body)

    def write(
        self, fault: str | None, good: str, place: str, body: Body, request: Request
    ) -> tuple[str | None, Body]:
        if fault in BARREN and BARREN[fault](body):
            text = "" if fault != "tool_never" else "I will go to the kitchen for you!"
            return text, {**body, "tool_choice": None}
        match fault:
            case "hallucinate":
                return json.dumps(hallucinate(json.loads(good)), ensure_ascii=False), body
            case "hostile":
                return hostile(next(self._hostile), place), body
            case "fenced":
                return f"Here is your plan:\n```json\n{good}\n```\nHave a nice day!", body
        return super().write(fault, good, place, body, request)

    async def send(self, fault: str | None, text: str | None, body: Body) -> Response:
        if fault == "error_200":
            return Response(b'{"error":{"message":"the backend failed","code":500}}')
        if fault == "huge":
            size = {"Content-Length": str(HUGE_BYTES)}
            return StreamingResponse(self._huge(), headers=size, media_type="application/json")
        if body.get("stream") is True and (fault or "").startswith("stream_"):
            whole = events(completion(body, text), None, self.wrote)
            parts = self._stream(fault, whole)
            if fault != "stream_breaks":
                return StreamingResponse(parts, media_type=EVENTS)
        return await super().send(fault, text, body)

    async def _stream(self, fault: str | None, whole: AsyncIterator[bytes]) -> AsyncIterator[bytes]:
        """Send a stream's beginning, then what is wrong with it."""
        parts = [part async for part in whole]
        *deltas, finish, usage, done = parts
        if fault == "stream_error_choice":
            for part in (*deltas[: max(2, len(deltas) // 2)], BROKEN_CHOICE):
                yield part
            return
        for part in (*deltas, finish) if fault == "stream_open" else deltas:
            yield part
        while not self.ending():
            yield b": still here\n\n"
            await asyncio.sleep(OPEN_S)
        yield usage + done

    async def _huge(self) -> AsyncIterator[bytes]:
        """Write 1 GB, as announced."""
        head, tail = b'{"choices":[{"message":{"role":"assistant","content":"', b'"}}]}'
        yield head
        left = HUGE_BYTES - len(head) - len(tail)
        while left > 0 and not self.ending():
            yield b"a" * min(CHUNK, left)
            left -= CHUNK
            await asyncio.sleep(0)  # or all of it is written, to nobody, when the client has left
        yield tail


def _format(body: Body) -> str:
    wanted = body.get("response_format")
    return str(wanted.get("type", "")) if isinstance(wanted, dict) else ""


def only_reply(body: Body) -> Body | None:
    """Return the one reply that the request's schema allows, or None where it leaves a choice.

    The mock's model is none that a schema could hold, but for one that leaves nothing to it.
    """
    form, tools = body.get("response_format"), body.get("tools")
    schema = form.get("json_schema", {}).get("schema") if isinstance(form, dict) else None
    if schema is None and tools:
        schema = tools[0]["function"]["parameters"]
    if not isinstance(schema, dict) or "properties" not in schema or "required" not in schema:
        return None
    fields = schema["properties"]
    filled = {name: _only_value(fields[name]) for name in schema["required"]}
    return filled if filled and None not in filled.values() else None


def _only_value(shape: Body) -> object:
    words = shape.get("enum", ())
    return words[0] if len(words) == 1 else False if shape.get("type") == "boolean" else None
