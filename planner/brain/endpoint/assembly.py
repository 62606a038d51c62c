"""Put a streamed chat completion together, delta by delta, into what a plain one would be.

Streams cut tool calls in odd ways: no index, the name late or twice, the arguments as an object or
sent whole once more. A call is told from the next by its index, else by its id; whatever comes of
it is judged like any other reply, so a wrong guess costs a repair turn and never a motion.
"""

from __future__ import annotations

import json
from dataclasses import dataclass, field
from typing import Any

from planner.brain.endpoint.completion import complaint_of
from planner.brain.endpoint.reply_object import NoObject, one_object

MAX_CALLS = 8
MAX_NAME = 64


class StreamFailure(Exception):
    """The stream says that it failed. Holds why, and the server's own words if it has any."""

    def __init__(self, why: str, server: str = "") -> None:
        super().__init__(why)
        self.server = server


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

    @property
    def is_whole(self) -> bool:
        """Tell whether what has come is one object, closed, with nothing open behind it."""
        written = self.text.rstrip("` \r\n\t")
        if not written.endswith("}"):
            return False
        try:
            one_object(written)
        except (NoObject, RecursionError):
            return False
        return True

    def add(self, event: Any) -> None:
        """Take one event in; one that is no part of a completion is passed over.

        Raises:
            StreamFailure: it is an error, or no JSON at all.
        """
        if not isinstance(event, dict):
            raise StreamFailure("the stream holds an event that is no JSON object")
        if event.get("error"):  # whatever choices stand beside it: some send an empty one along
            said = complaint_of(event)
            raise StreamFailure(f"the stream says: {said}", said)
        if isinstance(event.get("usage"), dict):
            self._usage = event["usage"]
        choice = _first_dict(event.get("choices"))
        if choice.get("index") not in (None, 0):
            return
        finish = choice.get("finish_reason")
        self.finish = finish if isinstance(finish, str) else self.finish
        if finish == "error":
            raise StreamFailure("the stream ended in an error")
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
