"""Wrap a model's text as a chat completion, and as a fault would."""

from __future__ import annotations

import gzip
import json
import time
from typing import Any

from planner.brain.schema import NAME

CHARACTERS_PER_TOKEN = 4
_HTML = b"<html><body><h1>It works!</h1></body></html>"
_ELSEWHERE = '{"kind":"plan","steps":[{"kind":"return_home"}]}'


def completion(body: dict[str, Any], text: str | None, fault: str | None = None) -> dict[str, Any]:
    """Wrap a text as a chat completion; a forced tool gets it as its arguments."""
    message = _message(body, text, fault)
    called = "tool_calls" in message
    finish = "length" if fault == "length" else "tool_calls" if called else "stop"
    prompt = len(json.dumps(body.get("messages", ""), ensure_ascii=False)) // CHARACTERS_PER_TOKEN
    wrote = min(len(text or "") // CHARACTERS_PER_TOKEN, _max_tokens(body))
    return {
        "id": f"chatcmpl-{time.monotonic_ns():x}",
        "object": "chat.completion",
        "created": int(time.time()),
        "model": str(body.get("model", "pons-mock")),
        "choices": [{"index": 0, "message": message, "finish_reason": finish}],
        "usage": {
            "prompt_tokens": prompt,
            "completion_tokens": wrote,
            "total_tokens": prompt + wrote,
        },
    }


def _max_tokens(body: dict[str, Any]) -> int:
    """Return how many tokens the client wants at most: no server bills more than that."""
    asked = [body.get(name) for name in ("max_tokens", "max_completion_tokens")]
    return min((most for most in asked if isinstance(most, int) and most > 0), default=1_000_000)


def _message(body: dict[str, Any], text: str | None, fault: str | None) -> dict[str, Any]:
    message: dict[str, Any] = {"role": "assistant", "content": text}
    match fault:
        case "parts":
            message["content"] = [{"type": "text", "text": text}]
        case "reasoning":
            message |= {"content": None, "reasoning_content": _ELSEWHERE, "reasoning": _ELSEWHERE}
        case "declined":
            message |= {"content": None, "refusal": "I can't help with that."}
        case "unknown_tool":
            message |= _call("drive", text)
        case "object_arguments" if text is not None:
            message |= _call(_tool(body), json.loads(text))
        case _ if (text is not None and (fault or "").startswith("odd_")) or _is_tool_forced(body):
            message |= _call(_tool(body), text) if text is not None else {}
    return message


def _is_tool_forced(body: dict[str, Any]) -> bool:
    return isinstance(body.get("tool_choice"), dict)


def _tool(body: dict[str, Any]) -> str:
    """Return the name of the forced tool; ours where the request forces none by name."""
    choice = body.get("tool_choice")
    function = choice.get("function") if isinstance(choice, dict) else None
    name = function.get("name") if isinstance(function, dict) else None
    return name if isinstance(name, str) else NAME


def _call(name: str, arguments: object) -> dict[str, Any]:
    function = {"name": name, "arguments": arguments}
    call = {"id": "call_1", "type": "function", "function": function}
    return {"content": None, "tool_calls": [call]}


def bytes_of(whole: dict[str, Any], fault: str | None) -> tuple[bytes, dict[str, str]]:
    """Return a completion's bytes and headers, as a fault sends them."""
    raw = json.dumps(whole, ensure_ascii=False).encode()
    match fault:
        case "not_json":
            return _HTML, {"Content-Type": "text/html"}
        case "no_choices":
            raw = json.dumps({**whole, "choices": []}).encode()
        case "error_200":
            raw = b'{"error":{"message":"the backend failed","code":500}}'
        case "packed":
            return gzip.compress(raw), {"Content-Encoding": "gzip"}
    return raw, {}
