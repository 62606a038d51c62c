"""Wrap a model's text as a chat completion, whole or as a stream of deltas at a model's pace."""

from __future__ import annotations

import asyncio
import json
import time
from collections.abc import AsyncIterator, Callable, Iterator
from typing import TYPE_CHECKING, Any

from starlette.responses import Response

from planner.brain.schema import NAME

if TYPE_CHECKING:
    from starlette.types import Receive, Scope, Send

CHARACTERS_PER_TOKEN = 4
MOST_DELTAS = 2000
EVENTS = "text/event-stream"


def completion(body: dict[str, Any], text: str | None) -> dict[str, Any]:
    """Wrap a text as a chat completion; a forced tool gets it as its arguments."""
    message: dict[str, Any] = {"role": "assistant", "content": text}
    if isinstance(body.get("tool_choice"), dict) and text is not None:
        message |= call_of(tool_name(body), text)
    prompt = len(json.dumps(body.get("messages", ""), ensure_ascii=False)) // CHARACTERS_PER_TOKEN
    wrote = min(len(text or "") // CHARACTERS_PER_TOKEN, _max_tokens(body))
    usage = {"prompt_tokens": prompt, "completion_tokens": wrote, "total_tokens": prompt + wrote}
    finish = "tool_calls" if "tool_calls" in message else "stop"
    return {
        "id": f"chatcmpl-{time.monotonic_ns():x}",
        "object": "chat.completion",
        "created": int(time.time()),
        "model": str(body.get("model", "pons-mock")),
        "choices": [{"index": 0, "message": message, "finish_reason": finish}],
        "usage": usage,
    }


def _max_tokens(body: dict[str, Any]) -> int:
    """Return how many tokens the client wants at most: no server bills more than that."""
    asked = [body.get(name) for name in ("max_tokens", "max_completion_tokens")]
    return min((most for most in asked if isinstance(most, int) and most > 0), default=1_000_000)


def tool_name(body: dict[str, Any]) -> str:
    """Return the name of the forced tool; ours where the request forces none by name."""
    choice = body.get("tool_choice")
    function = choice.get("function") if isinstance(choice, dict) else None
    name = function.get("name") if isinstance(function, dict) else None
    return name if isinstance(name, str) else NAME


def call_of(name: str, arguments: object) -> dict[str, Any]:
    """Return the fields of a message that calls a tool."""
    call = {"id": "call_1", "type": "function", "function": {"name": name, "arguments": arguments}}
    return {"content": None, "tool_calls": [call]}


async def events(
    whole: dict[str, Any],
    tokens_per_s: float | None,
    wrote: Callable[[], None],
    *,
    breaks: bool = False,
) -> AsyncIterator[bytes]:
    """Send a reply as deltas, one token each; ``wrote`` hears that the last is out."""
    deltas = list(_deltas(whole["choices"][0]["message"]))
    yield event(whole, {"role": "assistant"})
    for number, delta in enumerate(deltas):
        if tokens_per_s is not None:
            await asyncio.sleep(1.0 / tokens_per_s)
        if breaks and number == max(2, len(deltas) // 2):
            return
        yield event(whole, delta)
    wrote()
    yield event(whole, {}, finish=whole["choices"][0]["finish_reason"])
    yield event(whole, choices=[], usage=whole["usage"])
    yield b"data: [DONE]\n\n"


def event(
    whole: dict[str, Any],
    delta: dict[str, Any] | None = None,
    finish: str | None = None,
    **more: Any,
) -> bytes:
    """Return one event of a stream."""
    told = {key: whole[key] for key in ("id", "created", "model")}
    told |= {"object": "chat.completion.chunk"}
    if delta is not None:
        told["choices"] = [{"index": 0, "delta": delta, "finish_reason": finish}]
    return f"data: {json.dumps(told | more, ensure_ascii=False)}\n\n".encode()


def _deltas(message: dict[str, Any]) -> Iterator[dict[str, Any]]:
    yield from ({"content": token} for token in tokens(message["content"] or ""))
    for call in message.get("tool_calls", ()):
        named = {"name": call["function"]["name"], "arguments": ""}
        yield {"tool_calls": [{**call, "index": 0, "function": named}]}
        for token in tokens(call["function"]["arguments"]):
            piece = {"index": 0, "id": None, "function": {"name": None, "arguments": token}}
            yield {"tool_calls": [piece]}


def tokens(text: str) -> Iterator[str]:
    """Yield a text in pieces of a token, longer where it is very long."""
    size = max(CHARACTERS_PER_TOKEN, len(text) // MOST_DELTAS)
    for at in range(0, len(text), size):
        yield text[at : at + size]


class Cut(Response):
    """Begin a reply and close the connection in the middle of it."""

    def __init__(self, parts: AsyncIterator[bytes], media_type: str) -> None:
        super().__init__(media_type=media_type)
        del self.headers["content-length"]
        self._parts = parts

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Send the parts and no end: the server then drops the connection."""
        start = {"type": "http.response.start", "status": 200, "headers": self.raw_headers}
        await send(start)
        async for part in self._parts:
            await send({"type": "http.response.body", "body": part, "more_body": True})
