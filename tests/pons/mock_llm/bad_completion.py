"""Wrap a model's text as a chat completion as a fault would, and send its bytes so."""

from __future__ import annotations

import gzip
import json
from typing import Any

from pons.mock_llm.completion import call_of, completion, tool_name

_HTML = b"<html><body><h1>It works!</h1></body></html>"
_ELSEWHERE = '{"kind":"plan","steps":[{"kind":"return_home"}]}'


def bad_completion(body: dict[str, Any], text: str | None, fault: str | None) -> dict[str, Any]:
    """Wrap a text as a chat completion, as a fault would."""
    whole = completion(body, text)
    choice = whole["choices"][0]
    message = choice["message"]
    if fault in ("parts", "reasoning", "declined"):
        message.pop("tool_calls", None)
    match fault:
        case "parts":
            message["content"] = [{"type": "text", "text": text}]
        case "reasoning":
            message |= {"content": None, "reasoning_content": _ELSEWHERE, "reasoning": _ELSEWHERE}
        case "declined":
            message |= {"content": None, "refusal": "I can't help with that."}
        case "unknown_tool":
            message |= call_of("drive", text)
        case "object_arguments" if text is not None:
            message |= call_of(tool_name(body), json.loads(text))
        case _ if text is not None and (fault or "").startswith("odd_"):
            message |= call_of(tool_name(body), text)
    called = "tool_calls" in message
    choice["finish_reason"] = "length" if fault == "length" else "tool_calls" if called else "stop"
    return whole


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
