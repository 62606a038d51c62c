"""Read a chat completion: the model's words, its refusal, what it cost.

Servers differ in everything around the text; only the text counts, and it is judged elsewhere.
Reasoning fields are never read as the reply.
"""

from __future__ import annotations

import json
import re
from dataclasses import dataclass
from typing import Any

from pydantic_core import from_json

from planner.brain.endpoint.reply_object import without_thoughts
from planner.brain.errors import BrainDown
from planner.brain.schema import NAME

MAX_TOKENS = 10_000_000
_DECLINED = "The model declined."


_FILTERED = frozenset({"content_filter", "data_inspection_failed"})
"""What Azure and DashScope answer with 400 where a filter of theirs refuses an order."""


def complaint_of(content: object) -> str:
    """Return a server's words about an error, in one short line; none without JSON."""
    words = "" if content is None else content
    for _ in range(3):
        if not isinstance(words, dict):
            break
        words = words.get("error") or words.get("message") or words.get("detail") or ""
    return " ".join(str(words)[:400].split())


_TOO_LONG = re.compile(r"context (?:length|window|size)|maximum context|prompt is too long")
_LOADS = re.compile(r"\bloading\b|\bbeing loaded\b|\bnot (?:yet )?loaded\b", re.IGNORECASE)


def is_too_long(said: str) -> bool:
    """Tell whether a server's words are that the request does not fit into its context."""
    return _TOO_LONG.search(said.lower()) is not None


def is_loading(said: str) -> bool:
    """Tell whether a server's words are that the model is not loaded yet."""
    return _LOADS.search(said) is not None


def why_down(said: str) -> str:
    """Return the code of a failure that a server reports in words alone."""
    if is_too_long(said):
        return "context_too_small"
    return "loading" if is_loading(said) else "server_error"


def generated_by(content: object) -> str | None:
    """Return the model's text where a server refuses it as an error of its own, or None."""
    written = _error(content).get("failed_generation")
    return written if isinstance(written, str) else None


def declined_by(content: object) -> bool:
    """Tell whether a filter of the server's refused the order itself."""
    code = _error(content).get("code")
    return isinstance(code, str) and code in _FILTERED


def _error(content: object) -> dict[str, Any]:
    error = content.get("error") if isinstance(content, dict) else None
    return error if isinstance(error, dict) else {}


@dataclass(frozen=True, slots=True)
class Tokens:
    """Count the tokens billed."""

    total: int = 0
    prompt: int = 0
    reply: int = 0

    def __add__(self, other: Tokens) -> Tokens:
        return Tokens(
            self.total + other.total, self.prompt + other.prompt, self.reply + other.reply
        )


_OPENS = re.compile(r"[{[]")


@dataclass(frozen=True, slots=True)
class ModelReply:
    """Hold one reply. ``refusal``: the model declined, in its words."""

    text: str
    refusal: str | None = None
    trouble: str | None = None
    """Why there may be nothing in the text, told to the model where it is repaired."""
    tokens: Tokens = Tokens()
    cut: bool = False
    """It ended at the token limit."""
    called: bool = False
    """It called a tool, be it a wrong one."""

    @property
    def is_barren(self) -> bool:
        """Tell whether it holds nothing that could be the reply: no object, no list, no refusal.

        Where the token limit cut it, thoughts may have taken the room: no fault of the way in which
        it was asked for.
        """
        spoken = without_thoughts(self.text)
        excused = self.refusal is not None or self.cut or self.called
        return not excused and _OPENS.search(spoken) is None


def read_reply(content: object, tool: str = NAME) -> ModelReply:
    """Return a server's answer with status 200; ``tool``: the only one that may be called.

    Raises:
        BrainDown: ``bad_reply``: it is no chat completion; ``server_error``: it says so itself.
    """
    if not isinstance(content, dict):
        raise BrainDown("the reply is no JSON object", why="bad_reply")
    choice = _first(content.get("choices"))
    if choice is None:
        said = complaint_of(content)
        if said:
            raise BrainDown(f"the server says: {said}", why=why_down(said), server=said)
        raise BrainDown("the reply has no choices", why="bad_reply")
    message = choice.get("message")
    if not isinstance(message, dict):
        raise BrainDown("the reply's choice has no message", why="bad_reply")
    finish, usage = choice.get("finish_reason"), _tokens(content.get("usage"))
    refusal = message.get("refusal")
    if isinstance(refusal, str) and refusal.strip():
        return ModelReply("", refusal=refusal, tokens=usage)
    if finish in ("content_filter", "refusal"):  # whatever was written until then
        return ModelReply("", refusal=_DECLINED, tokens=usage)
    text, trouble = _text(message, tool)
    called = bool(message.get("tool_calls") or message.get("function_call"))
    if finish == "length":
        trouble = "the reply was cut off at the token limit; reply shorter, without thoughts"
    return ModelReply(text, trouble=trouble, tokens=usage, cut=finish == "length", called=called)


def read_json(raw: bytes) -> Any:
    """Return a body's JSON, or None where it is none: NaN, broken text and depth included."""
    try:
        return from_json(raw, allow_inf_nan=False)
    except ValueError:
        return None


def _text(message: dict[str, Any], tool: str) -> tuple[str, str | None]:
    """Return the words of a message, and its oddity if it has one."""
    content = message.get("content")
    if isinstance(content, list):  # parts, as some servers write them
        parts = [part.get("text") for part in content if isinstance(part, dict)]
        content = "".join(part for part in parts if isinstance(part, str))
    said = content if isinstance(content, str) else ""
    calls = message.get("tool_calls")
    if not (isinstance(calls, list) and calls) and isinstance(message.get("function_call"), dict):
        calls = [{"function": message["function_call"]}]  # as it was called before 2024
    if not isinstance(calls, list) or not calls:
        return said, None if said.strip() else "the reply is empty"
    arguments = _join_arguments(calls, tool)
    if arguments is None:  # whoever calls what does not exist has not understood the question
        return "", f"a tool was called that does not exist; the only tool is {tool}"
    if "{" in said:  # a second plan beside the call, if it is another one, is found later on
        return f"{said.replace('`', ' ')}\n{arguments}", None
    return arguments, None if arguments.strip() else "the call has no arguments"


def _join_arguments(calls: list[Any], tool: str) -> str | None:
    """Return the arguments of all calls; None where one is not of our tool.

    The same call twice is found to be one later on, two that differ are found to be two.
    """
    written: list[str] = []
    for call in calls:
        function = call.get("function") if isinstance(call, dict) else None
        function = function if isinstance(function, dict) else {}
        if function.get("name") != tool:
            return None
        arguments = function.get("arguments")
        if isinstance(arguments, dict):
            arguments = json.dumps(arguments, ensure_ascii=False)
        written.append(arguments if isinstance(arguments, str) else "")
    return "\n".join(written)


def _first(value: object) -> dict[str, Any] | None:
    if isinstance(value, list) and value and isinstance(value[0], dict):
        return value[0]
    return None


def _tokens(usage: object) -> Tokens:
    if not isinstance(usage, dict):
        return Tokens()
    prompt, reply = _count(usage.get("prompt_tokens")), _count(usage.get("completion_tokens"))
    return Tokens(_count(usage.get("total_tokens")) or prompt + reply, prompt, reply)


def _count(value: object) -> int:
    known = isinstance(value, int) and not isinstance(value, bool) and 0 <= value <= MAX_TOKENS
    return value if known and isinstance(value, int) else 0
