"""Put a streamed completion together, delta by delta, into what a plain call would have returned.

Servers cut tool calls in odd ways: no index, the name late or twice, the arguments as an object or
sent whole once more. A call is told from the next by its index, else by its id; whatever comes of
it is judged like any other reply, so a wrong guess costs a repair turn and never a motion.
"""

from __future__ import annotations

import json
from dataclasses import dataclass, field
from typing import Any

MAX_CALLS = 8
MAX_NAME = 64


class Broken(Exception):
    """The stream says that it failed. Holds its words."""


@dataclass(slots=True)
class _Call:
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
        self._calls: list[_Call] = []
        self._whole: dict[str, Any] | None = None
        self._usage: Any = None
        self.finish: str | None = None
        self.begun = False
        """Something of the model's own has come."""
        self.size = 0
        """Of what is kept, about [bytes]."""

    @property
    def text(self) -> str:
        """Return what the model has written so far: its words, else the first call's arguments."""
        content = "".join(self._content)
        return content if content.strip() or not self._calls else self._calls[0].arguments

    def add(self, event: Any) -> None:
        """Take one event in; what is none of a completion is passed over.

        Raises:
            Broken: it is an error, or no JSON at all.
        """
        if not isinstance(event, dict):
            raise Broken("the stream holds an event that is no JSON object")
        if event.get("error") and not event.get("choices"):
            raise Broken(f"the stream says: {event['error']!s:.200}")
        if isinstance(event.get("usage"), dict):
            self._usage = event["usage"]
        choice = _first(event.get("choices"))
        if choice.get("index") not in (None, 0):
            return
        finish = choice.get("finish_reason")
        self.finish = finish if isinstance(finish, str) else self.finish
        if isinstance(choice.get("message"), dict):  # some end with the whole message
            self._whole, self.begun = choice["message"], True
        delta = choice.get("delta")
        if isinstance(delta, dict):
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

    def _call_of(self, piece: dict[str, Any]) -> _Call | None:
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
        self._calls.append(_Call(index, id_))
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


def _first(value: object) -> dict[str, Any]:
    found = _dicts(value)
    return found[0] if found else {}


def _dicts(value: object) -> list[dict[str, Any]]:
    return [each for each in value if isinstance(each, dict)] if isinstance(value, list) else []
