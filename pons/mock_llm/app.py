"""Answer chat completions as the switches say. One application is one mock; it keeps counts."""

from __future__ import annotations

import asyncio
import itertools
import json
import time
from collections import Counter
from collections.abc import AsyncIterator, Callable
from typing import Any

from fastapi import FastAPI, Request
from starlette.responses import JSONResponse, Response, StreamingResponse

from planner.brain import OfflineBrain
from planner.brain.schema import NAME
from pons.mock_llm.replies import GARBAGE, hallucinated, hostile, reply_of, shaped
from pons.mock_llm.switches import Switches
from pons.mock_llm.world import request_of

MAX_BODY = 4_000_000
CHUNK = 64 * 1024
HUGE_BYTES = 1_000_000_000
DRIP_S = 0.2
LOOK_S = 0.05
METADATA = "http://169.254.169.254/latest/meta-data/"


class Mock:
    """Hold the switches and what was asked."""

    def __init__(self, switches: Switches) -> None:
        self.switches = switches
        self.calls = 0
        self.left = switches.times
        self.served: Counter[str] = Counter()
        self.hostile = itertools.count()
        self.ending: Callable[[], bool] = lambda: False
        """Tells that the server is asked to end, so that what hangs lets go."""

    def set(self, switches: Switches) -> None:
        """Behave so from now on; counts go on, the fault's number of times begins anew."""
        self.switches, self.left = switches, switches.times

    def next_fault(self) -> str | None:
        """Return the fault of this call."""
        fault = self.switches.fault if self.left is None or self.left > 0 else None
        if fault is not None and self.left is not None:
            self.left -= 1
        self.calls += 1
        self.served[fault or "none"] += 1
        return fault

    def report(self) -> dict[str, Any]:
        """Return switches and counts."""
        shown = self.switches.model_dump(mode="json")
        return {"switches": shown, "calls": self.calls, "served": dict(self.served)}


def build(switches: Switches | None = None) -> FastAPI:
    """Return the application of one mock."""
    mock, brain = Mock(switches or Switches()), OfflineBrain()
    app = FastAPI(title="pons mock-llm", docs_url=None, redoc_url=None, openapi_url=None)
    app.state.mock = mock

    @app.get("/mock")
    async def look() -> dict[str, Any]:
        return mock.report()

    @app.post("/mock")
    async def switch(wanted: Switches) -> dict[str, Any]:
        mock.set(wanted)
        return mock.report()

    @app.get("/v1/models")
    async def models() -> dict[str, Any]:
        return {"object": "list", "data": [{"id": "pons-mock", "object": "model"}]}

    @app.post("/v1/chat/completions")
    async def complete(request: Request) -> Response:
        fault = mock.next_fault()
        body = await _body(request)
        if body is None:
            return _error(400, "the body is no JSON object of a chat request")
        await asyncio.sleep(mock.switches.delay_s)
        early = await _instead_of_a_reply(fault, mock, body, request)
        if early is not None:
            return early
        asked = request_of(body)
        good = json.dumps(reply_of((await brain.think(asked)).plan), ensure_ascii=False)
        known = next(iter(asked.vocabulary.by_id), "kitchen")
        text = _written(fault, good, mock, known, request)
        return _answer(fault, completion(body, text), body, mock.ending)

    return app


async def _body(request: Request) -> dict[str, Any] | None:
    raw = bytearray()
    async for chunk in request.stream():
        raw += chunk
        if len(raw) > MAX_BODY:
            return None
    try:
        body = json.loads(raw)
    except (ValueError, RecursionError):
        return None
    return body if isinstance(body, dict) else None


async def _instead_of_a_reply(
    fault: str | None, mock: Mock, body: dict[str, Any], request: Request
) -> Response | None:
    """Do what a server does that gives no completion at all."""
    switches = mock.switches
    if fault == "status":
        kept = {"Retry-After": switches.retry_after} if switches.retry_after is not None else {}
        return _error(switches.status, f"mock status {switches.status}", kept)
    if fault == "redirect":
        return Response(status_code=307, headers={"Location": METADATA})
    if fault == "no_schema" and ("response_format" in body or "tools" in body):
        return _error(400, "response_format and tools are not supported by this model")
    if fault == "hang":
        while not (mock.ending() or await request.is_disconnected()):  # noqa: ASYNC110  # nothing tells of it
            await asyncio.sleep(LOOK_S)
        return _error(499, "the client left")
    return None


def _written(fault: str | None, good: str, mock: Mock, known: str, request: Request) -> str | None:
    """Return the content of the reply."""
    match fault:
        case "garbage":
            return GARBAGE[mock.served["garbage"] % len(GARBAGE)]
        case "hallucinate":
            return json.dumps(hallucinated(json.loads(good)), ensure_ascii=False)
        case "hostile":
            return hostile(next(mock.hostile), known)
        case "echo_key":
            words = f"the key is {request.headers.get('authorization', 'none')}"
            return json.dumps({"kind": "answer", "en": words, "zh": words})
    return shaped(fault, good)


def completion(body: dict[str, Any], text: str | None) -> dict[str, Any]:
    """Wrap a text as a chat completion; a forced tool gets it as its arguments."""
    forced = isinstance(body.get("tool_choice"), dict) and text is not None
    message: dict[str, Any] = {"role": "assistant", "content": None if forced else text}
    if forced:
        call = {"name": NAME, "arguments": text}
        message["tool_calls"] = [{"id": "call_1", "type": "function", "function": call}]
    prompt = len(json.dumps(body.get("messages", ""), ensure_ascii=False)) // 4
    wrote = len(text or "") // 4
    return {
        "id": f"chatcmpl-{time.monotonic_ns():x}",
        "object": "chat.completion",
        "created": int(time.time()),
        "model": str(body.get("model", "pons-mock")),
        "choices": [
            {
                "index": 0,
                "message": message,
                "finish_reason": "tool_calls" if forced else "stop",
            }
        ],
        "usage": {
            "prompt_tokens": prompt,
            "completion_tokens": wrote,
            "total_tokens": prompt + wrote,
        },
    }


def _answer(
    fault: str | None, whole: dict[str, Any], body: dict[str, Any], ending: Callable[[], bool]
) -> Response:
    raw = json.dumps(whole, ensure_ascii=False).encode()
    if fault == "endless":
        return StreamingResponse(_endless(ending), media_type="application/json")
    if fault == "huge":
        size = {"Content-Length": str(HUGE_BYTES)}
        return StreamingResponse(_huge(ending), media_type="application/json", headers=size)
    if fault == "drip":
        return StreamingResponse(_drip(raw, ending), media_type="application/json")
    if body.get("stream") is True:
        return StreamingResponse(_events(whole), media_type="text/event-stream")
    return Response(raw, media_type="application/json")


async def _endless(ending: Callable[[], bool]) -> AsyncIterator[bytes]:
    yield b'{"choices":[{"message":{"role":"assistant","content":"'
    while not ending():
        yield b"a" * CHUNK
        await asyncio.sleep(0)


async def _huge(ending: Callable[[], bool]) -> AsyncIterator[bytes]:
    yield (head := b'{"choices":[{"message":{"role":"assistant","content":"')
    left, tail = HUGE_BYTES - len(head), b'"}}]}'
    while left > len(tail) and not ending():
        size = min(CHUNK, left - len(tail))
        yield b"a" * size
        left -= size
    yield tail


async def _drip(raw: bytes, ending: Callable[[], bool]) -> AsyncIterator[bytes]:
    for byte in raw:
        if ending():
            break
        yield bytes([byte])
        await asyncio.sleep(DRIP_S)


async def _events(whole: dict[str, Any]) -> AsyncIterator[bytes]:
    """Send a reply as a stream of deltas, one word each."""
    message = whole["choices"][0]["message"]
    kept = {key: whole[key] for key in ("id", "created", "model")}
    words = [{"content": word + " "} for word in (message["content"] or "").split(" ")]
    if words:
        words[-1]["content"] = words[-1]["content"][:-1]
    for delta in ({"role": "assistant"}, *words, {}):
        choice = {"index": 0, "delta": delta, "finish_reason": None if delta else "stop"}
        event = {**kept, "object": "chat.completion.chunk", "choices": [choice]}
        yield f"data: {json.dumps(event, ensure_ascii=False)}\n\n".encode()
    yield b"data: [DONE]\n\n"


def _error(status: int, words: str, headers: dict[str, str] | None = None) -> Response:
    content = {"error": {"message": words, "type": "mock", "code": status}}
    return JSONResponse(content, status_code=status, headers=headers)
