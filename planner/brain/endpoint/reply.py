"""Read a chat completion: what the model wrote, whether it declined, what it cost.

Servers differ in everything around the text; only the text counts, and it is judged elsewhere.
Reasoning fields are never read as the reply.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from pydantic_core import from_json

from planner.brain.errors import BrainDown
from planner.brain.schema import NAME

MAX_TOKENS = 10_000_000
_DECLINED = "The model declined."


@dataclass(frozen=True, slots=True)
class Reply:
    """Hold one reply. ``refusal``: the model declined, in its words."""

    text: str
    refusal: str | None = None
    trouble: str | None = None
    """Why there may be nothing in the text, told to the model where it is repaired."""
    tokens: int = 0


def read_reply(raw: bytes) -> Reply:
    """Return what a server answered with 200.

    Raises:
        BrainDown: ``bad_reply``: it is no chat completion; ``server_error``: it says so itself.
    """
    content = read_json(raw)
    if not isinstance(content, dict):
        raise BrainDown("the reply is no JSON object", why="bad_reply")
    choice = _first(content.get("choices"))
    if choice is None:
        if content.get("error"):
            raise BrainDown(f"the server says: {complaint_of(content)}", why="server_error")
        raise BrainDown("the reply has no choices", why="bad_reply")
    message = choice.get("message")
    if not isinstance(message, dict):
        raise BrainDown("the reply's choice has no message", why="bad_reply")
    finish, usage = choice.get("finish_reason"), _tokens(content.get("usage"))
    refusal = message.get("refusal")
    if isinstance(refusal, str) and refusal.strip():
        return Reply("", refusal=refusal, tokens=usage)
    text, trouble = _text(message)
    if finish == "content_filter" and not text.strip():
        return Reply("", refusal=_DECLINED, tokens=usage)
    if finish == "length":
        trouble = "the reply was cut off at the token limit; reply shorter, without thoughts"
    return Reply(text, trouble=trouble, tokens=usage)


def read_json(raw: bytes) -> Any:
    """Return a body's JSON, or None where it is none: NaN, broken text and depth included."""
    try:
        return from_json(raw, allow_inf_nan=False)
    except ValueError:
        return None


def complaint_of(content: object) -> str:
    """Return a server's words about an error, in one short line."""
    words = content
    for _ in range(3):
        if not isinstance(words, dict):
            break
        words = words.get("error") or words.get("message") or words.get("detail") or ""
    return " ".join(str(words)[:400].split())


def generated_by(content: object) -> str | None:
    """Return what the model wrote where a server refuses it as an error of its own, or None."""
    error = content.get("error") if isinstance(content, dict) else None
    written = error.get("failed_generation") if isinstance(error, dict) else None
    return written if isinstance(written, str) else None


def _text(message: dict[str, Any]) -> tuple[str, str | None]:
    """Return the words of a message, and what is odd about it."""
    content = message.get("content")
    if isinstance(content, list):  # parts, as some servers write them
        parts = [part.get("text") for part in content if isinstance(part, dict)]
        content = "".join(part for part in parts if isinstance(part, str))
    if isinstance(content, str) and content.strip():
        return content, None
    called = _first(message.get("tool_calls"))
    if called is None:
        return "", "the reply is empty"
    function = called.get("function")
    function = function if isinstance(function, dict) else {}
    if function.get("name") != NAME:
        return "", "a tool was called, but there are no tools"
    arguments = function.get("arguments")
    return (arguments, None) if isinstance(arguments, str) else ("", "the call has no arguments")


def _first(value: object) -> dict[str, Any] | None:
    if isinstance(value, list) and value and isinstance(value[0], dict):
        return value[0]
    return None


def _tokens(usage: object) -> int:
    total = usage.get("total_tokens") if isinstance(usage, dict) else None
    known = isinstance(total, int) and not isinstance(total, bool) and 0 <= total <= MAX_TOKENS
    return total if known and isinstance(total, int) else 0
