"""Send a completion as a stream of deltas as odd servers do, or as a body that never ends."""

from __future__ import annotations

import asyncio
import json
from collections.abc import AsyncIterator, Callable, Iterator
from typing import Any

from planner.brain.schema import NAME
from pons.mock_llm.completion import event, tokens

CHUNK = 64 * 1024
HUGE_BYTES = 1_000_000_000
DRIP_S = 0.2
OPEN_S = 0.2
"""Between two comments of a stream that is left open."""
Ending = Callable[[], bool]
_HEAD = b'{"choices":[{"message":{"role":"assistant","content":"'
_MIDDLE = {
    "stream_breaks",
    "stream_error",
    "stream_unfinished",
    "stream_garbage",
    "stream_error_choice",
}


async def endless(ending: Ending) -> AsyncIterator[bytes]:
    """Write for ever."""
    yield _HEAD
    while not ending():
        yield b"a" * CHUNK
        await asyncio.sleep(0)


async def huge(ending: Ending) -> AsyncIterator[bytes]:
    """Write 1 GB, as announced."""
    yield _HEAD
    left, tail = HUGE_BYTES - len(_HEAD), b'"}}]}'
    while left > len(tail) and not ending():
        size = min(CHUNK, left - len(tail))
        yield b"a" * size
        left -= size
        await asyncio.sleep(0)  # or all of it is written, to nobody, when the client has left
    yield tail


async def drip(raw: bytes, ending: Ending) -> AsyncIterator[bytes]:
    """Write one byte at a time."""
    for byte in raw:
        if ending():
            break
        yield bytes([byte])
        await asyncio.sleep(DRIP_S)


async def half(raw: bytes) -> AsyncIterator[bytes]:
    """Write the first half."""
    yield raw[: len(raw) // 2]


async def bad_events(
    whole: dict[str, Any],
    fault: str | None,
    tokens_per_s: float | None,
    ending: Ending,
    wrote: Callable[[], None] = lambda: None,
) -> AsyncIterator[bytes]:
    """Send a reply as a stream of deltas, one token each; ``wrote`` hears that the last is out."""
    deltas = list(_deltas(whole["choices"][0]["message"], fault))
    pause_s = 0.0 if tokens_per_s is None else 1.0 / tokens_per_s
    line_end = "\r\n" if fault == "stream_comments" else "\n"
    broken_at = max(2, len(deltas) // 2) if fault in _MIDDLE else None
    if fault == "stream_comments":
        yield b": the model is warming up\r\n\r\n"
        yield _event(whole, line_end, choices=[])
    yield _event(whole, line_end, {"role": "assistant"})
    for number, delta in enumerate(deltas):
        if pause_s:
            await asyncio.sleep(pause_s)
        if number == broken_at:
            for bad in _break_stream(fault):
                yield bad
            return
        yield _event(whole, line_end, delta)
    wrote()
    while fault == "stream_endless" and not ending():
        yield _event(whole, line_end, {"content": " " * CHUNK})
        await asyncio.sleep(0)
    if fault != "stream_silent":
        yield _event(whole, line_end, {}, finish=whole["choices"][0]["finish_reason"])
    while fault in ("stream_open", "stream_silent") and not ending():
        yield b": still here\n\n"
        await asyncio.sleep(OPEN_S)
    yield _event(whole, line_end, choices=[], usage=whole["usage"])
    yield f"data: [DONE]{line_end}{line_end}".encode()


def _break_stream(fault: str | None) -> Iterator[bytes]:
    if fault == "stream_error":
        yield b'data: {"error":{"message":"the backend failed","code":500}}\n\n'
    elif fault == "stream_error_choice":
        yield (
            b'data: {"choices":[{"index":0,"delta":{"content":""},"finish_reason":"error"}],'
            b'"error":{"code":502,"message":"Provider disconnected"}}\n\ndata: [DONE]\n\n'
        )
    elif fault == "stream_garbage":
        yield b'data: {"choices":[{"delta":{"content":\n\ndata: [DONE]\n\n'


def _event(whole: dict[str, Any], line_end: str, *delta: Any, **more: Any) -> bytes:
    return event(whole, *delta, **more).replace(b"\n", line_end.encode())


def _deltas(message: dict[str, Any], fault: str | None) -> Iterator[dict[str, Any]]:
    for name in ("reasoning_content", "refusal"):
        if name in message:
            yield {name: message[name]}
    content = message["content"]
    if isinstance(content, list):
        content = "".join(part["text"] for part in content)
    yield from ({"content": token} for token in tokens(content or ""))
    for call in message.get("tool_calls", ()):
        yield from ({"tool_calls": [piece]} for piece in _pieces(call, fault))


def _pieces(call: dict[str, Any], fault: str | None) -> Iterator[dict[str, Any]]:
    """Cut a call as servers do: name and id first, then its arguments."""
    name, arguments = call["function"]["name"], call["function"]["arguments"]
    place: dict[str, Any] = {} if fault in ("odd_index", "odd_object") else {"index": 0}
    if isinstance(arguments, dict) or fault == "odd_object":
        whole = arguments if isinstance(arguments, dict) else json.loads(arguments)
        yield {**place, "id": "call_1", "function": {"name": name, "arguments": whole}}
        return
    late = fault in ("odd_name", "odd_id")
    first = {} if late else {"id": "call_1", "type": "function"}
    named = {} if fault == "odd_name" else {"name": name}
    yield {**place, **first, "function": {**named, "arguments": ""}}
    for token in tokens(arguments):
        yield {**place, "id": None, "function": {"name": None, "arguments": token}}
    if late:
        yield {**place, "id": "call_1", "function": {"name": NAME, "arguments": ""}}
    if fault == "odd_repeat":
        yield {**place, **first, "function": {"name": name, "arguments": arguments}}
