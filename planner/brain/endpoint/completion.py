"""Read a chat completion, whole or delta by delta: the model's words, its refusal, what it cost.

Servers differ in everything around the text; only the text counts, and it is judged elsewhere.
Reasoning fields are never read as the reply. Streams cut tool calls in odd ways: no index, the name
late or twice, the arguments as an object or sent whole once more. A call is told from the next by
its index, else by its id; whatever comes of it is judged like any other reply, so a wrong guess
costs a repair turn and never a motion.
"""

from __future__ import annotations

import json
from dataclasses import dataclass, field
from typing import Any

from pydantic_core import from_json

from planner.brain.errors import BrainDown
from planner.brain.schema import NAME

MAX_TOKENS = 10_000_000
_DECLINED = "The model declined."


_FILTERED = frozenset({"content_filter", "data_inspection_failed"})
"""What Azure and DashScope answer with 400 where a filter of theirs refuses an order."""


def complaint_of(content: object) -> str:
    """Return a server's words about an error, in one short line."""
    words = content
    for _ in range(3):
        if not isinstance(words, dict):
            break
        words = words.get("error") or words.get("message") or words.get("detail") or ""
    return " ".join(str(words)[:400].split())


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


@dataclass(frozen=True, slots=True)
class ModelReply:
    """Hold one reply. ``refusal``: the model declined, in its words."""

    text: str
    refusal: str | None = None
    trouble: str | None = None
    """Why there may be nothing in the text, told to the model where it is repaired."""
    tokens: Tokens = Tokens()


def read_reply(content: object, tool: str = NAME) -> ModelReply:
    """Return a server's answer with status 200; ``tool``: the only one that may be called.

    Raises:
        BrainDown: ``bad_reply``: it is no chat completion; ``server_error``: it says so itself.
    """
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
        return ModelReply("", refusal=refusal, tokens=usage)
    if finish in ("content_filter", "refusal"):  # whatever was written until then
        return ModelReply("", refusal=_DECLINED, tokens=usage)
    text, trouble = _text(message, tool)
    if finish == "length":
        trouble = "the reply was cut off at the token limit; reply shorter, without thoughts"
    return ModelReply(text, trouble=trouble, tokens=usage)


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


MAX_CALLS = 8
MAX_NAME = 64


class StreamFailure(Exception):
    """The stream says that it failed. Holds its words."""


@dataclass(slots=True)
class _StreamedCall:
    index: object = None
    id: str = ""
    name: str = ""
    pieces: list[str] = field(default_factory=list)

    @property
    def arguments(self) -> str:
        return "".join(self.pieces)

    def whole(self) -> dict[str, Any]:
        return {"id": self.id, "function": {"name": self.name, "arguments": self.arguments}}


class Assembly:
    """Collect the first choice of a stream."""

    def __init__(self) -> None:
        self._content: list[str] = []
        self._refusal: list[str] = []
        self._calls: list[_StreamedCall] = []
        self._whole: dict[str, Any] | None = None
        self._usage: Any = None
        self._opened = False
        self.finish: str | None = None
        self.begun = False
        """Something of the model's own has come."""
        self.size = 0
        """Of what is kept, about [bytes]."""

    @property
    def text(self) -> str:
        """Return the model's text so far: its words, else the first call's arguments."""
        content = "".join(self._content)
        return content if content.strip() or not self._calls else self._calls[0].arguments

    @property
    def is_cut(self) -> bool:
        """Tell whether the message was opened and holds nothing, or an object that is not closed.

        llama-cpp-python ends a stream so, with its last line and no reason, where another request
        comes in (its ``interrupt_requests``).
        """
        opened = self._opened and not self.begun
        return opened or self.text.count("{") > self.text.count("}")

    def add(self, event: Any) -> None:
        """Take one event in; one that is no part of a completion is passed over.

        Raises:
            StreamFailure: it is an error, or no JSON at all.
        """
        if not isinstance(event, dict):
            raise StreamFailure("the stream holds an event that is no JSON object")
        if event.get("error") and not event.get("choices"):
            raise StreamFailure(f"the stream says: {event['error']!s:.200}")
        if isinstance(event.get("usage"), dict):
            self._usage = event["usage"]
        choice = _first_dict(event.get("choices"))
        if choice.get("index") not in (None, 0):
            return
        finish = choice.get("finish_reason")
        self.finish = finish if isinstance(finish, str) else self.finish
        if isinstance(choice.get("message"), dict):  # some end with the whole message
            self._whole, self.begun = choice["message"], True
        delta = choice.get("delta")
        if isinstance(delta, dict):
            self._opened = True
            self._add(delta)

    def _add(self, delta: dict[str, Any]) -> None:
        content = delta.get("content")
        if isinstance(content, list):
            content = "".join(str(part.get("text") or "") for part in _dicts(content))
        if isinstance(content, str) and content:
            self._content.append(content)
            self.size += len(content)
            self.begun = True
        if isinstance(delta.get("refusal"), str):
            self._refusal.append(delta["refusal"])
            self.size += len(delta["refusal"])
        for piece in _dicts(delta.get("tool_calls")):
            self._add_call(piece)
        legacy = delta.get("function_call")
        if isinstance(legacy, dict):
            self._add_call({"index": 0, "function": legacy})

    def _add_call(self, piece: dict[str, Any]) -> None:
        call = self._call_of(piece)
        if call is None:
            return
        self.begun = True
        function = piece.get("function")
        function = function if isinstance(function, dict) else piece
        name, arguments = function.get("name"), function.get("arguments")
        if isinstance(name, str) and name != call.name:  # in pieces, or once more as a whole
            call.name = (call.name + name)[:MAX_NAME]
        if isinstance(arguments, dict):
            arguments = json.dumps(arguments, ensure_ascii=False)
        if isinstance(arguments, str) and arguments:
            call.pieces.append(arguments)
            self.size += len(arguments)

    def _call_of(self, piece: dict[str, Any]) -> _StreamedCall | None:
        """Return the call that a piece belongs to, a new one where it begins one."""
        index, id_ = piece.get("index"), piece.get("id")
        id_ = id_ if isinstance(id_, str) else ""
        if isinstance(index, int):
            known = [call for call in self._calls if call.index == index]
            fresh = not known or (id_ and known[-1].id and id_ != known[-1].id)
        else:
            known = [call for call in self._calls if id_ and call.id == id_] or self._calls[-1:]
            fresh = not known or (id_ and known[-1].id and id_ != known[-1].id)
        if not fresh:
            known[-1].id = known[-1].id or id_
            return known[-1]
        if len(self._calls) >= MAX_CALLS:
            return None
        self._calls.append(_StreamedCall(index, id_))
        return self._calls[-1]

    def completion(self) -> dict[str, Any]:
        """Return all of it as a plain completion."""
        message: dict[str, Any] = {"role": "assistant", "content": "".join(self._content) or None}
        if self._calls:
            message["tool_calls"] = [call.whole() for call in self._calls]
        if self._whole is not None and not (self._content or self._calls):
            message = dict(self._whole)
        refusal = "".join(self._refusal) or (self._whole or {}).get("refusal")
        if refusal:  # wherever it stands, it counts
            message["refusal"] = refusal
        choice = {"index": 0, "message": message, "finish_reason": self.finish}
        return {"choices": [choice], "usage": self._usage}


def _first_dict(value: object) -> dict[str, Any]:
    found = _dicts(value)
    return found[0] if found else {}


def _dicts(value: object) -> list[dict[str, Any]]:
    return [each for each in value if isinstance(each, dict)] if isinstance(value, list) else []
