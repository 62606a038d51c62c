"""Ask one MCP server of the owner's for its tools, and call one: bounded in time and in bytes.

Speaks MCP by Streamable HTTP as its specification of 2026-07-28 has it (each request whole, without
a session), and the handshake of the versions before it where a server knows no other. It opens no
stream of its own and answers nothing that a server asks: no sampling, no elicitation, no roots. A
call is sent once. Knows JSON-RPC; not what a tool is for.
"""

from __future__ import annotations

import asyncio
import json
from dataclasses import dataclass
from itertools import count
from typing import TYPE_CHECKING, Any, TypeVar

from planner.outbound.address import Address
from planner.outbound.caller import CallAnswer, Caller, Transport
from planner.outbound.errors import CallFailure

if TYPE_CHECKING:
    from collections.abc import Coroutine

T = TypeVar("T")
PROTOCOL = "2026-07-28"
OLDER_PROTOCOL = "2025-11-25"
"""What is offered in the handshake; the server answers with the version that it speaks."""
MOST_TOOLS, MOST_PAGES = 128, 8
_META = "io.modelcontextprotocol/"
_CLIENT = {"name": "pons", "version": "1"}
_ENVELOPE = {
    f"{_META}protocolVersion": PROTOCOL,
    f"{_META}clientInfo": _CLIENT,
    f"{_META}clientCapabilities": {},
}
_ACCEPTED = {"Accept": "application/json, text/event-stream", "Content-Type": "application/json"}
_STREAM = "text/event-stream"
_SESSION = "mcp-session-id"
_MODERN: dict[str, str] = {}
"""Headers of the protocol without sessions, beside those of each request."""


@dataclass(frozen=True, slots=True)
class ToolReply:
    """Hold what a tool answered: words of a stranger."""

    text: str
    is_error: bool = False


class ToolServer:
    """Be the client of one server."""

    def __init__(
        self,
        address: Address,
        key: str = "",
        *,
        timeout_s: float,
        most_bytes: int,
        transport: Transport | None = None,
    ) -> None:
        """Open nothing yet; the arguments are those of a server's settings."""
        self._caller = Caller(address, key, timeout_s=timeout_s, transport=transport)
        self._timeout_s, self._most_bytes = timeout_s, most_bytes
        self._ids = count(1)
        self._session: dict[str, str] | None = None
        """Headers that go with each request; None: it is not known yet what the server speaks."""

    async def close(self) -> None:
        """Give the connections back."""
        await self._caller.close()

    async def list_tools(self) -> list[dict[str, Any]]:
        """Return the server's tools as it describes them, at most ``MOST_TOOLS``.

        Raises:
            CallFailure: those of ``Caller.post``, or ``bad_reply``.
        """
        return await self._in_time(self._list())

    async def call(self, name: str, arguments: dict[str, Any]) -> ToolReply:
        """Return what a tool answers.

        Raises:
            CallFailure: those of ``Caller.post``, ``bad_reply``, ``tool_error`` (JSON-RPC's own)
                or ``needs_input`` (it wants more from a person first).
        """
        result = await self._in_time(self._call(name, arguments))
        if result.get("resultType", "complete") != "complete":
            raise CallFailure("the tool asks for more first", why="needs_input")
        return ToolReply(self._caller.secret.redact(_words(result)), result.get("isError") is True)

    async def _list(self) -> list[dict[str, Any]]:
        if self._session is not _MODERN:  # a session may be over, and a server may have grown
            self._session = await self._meet()
        tools: list[dict[str, Any]] = []
        given: dict[str, Any] = {}
        for _ in range(MOST_PAGES):
            result = await self._ask("tools/list", given)
            listed, cursor = result.get("tools"), result.get("nextCursor")
            if not isinstance(listed, list):
                raise CallFailure("the list of tools is none", why="bad_reply")
            tools += [each for each in listed if isinstance(each, dict)]
            if not isinstance(cursor, str) or not cursor or len(tools) >= MOST_TOOLS:
                break
            given = {"cursor": cursor}
        return tools[:MOST_TOOLS]

    async def _call(self, name: str, arguments: dict[str, Any]) -> dict[str, Any]:
        if self._session is None:
            self._session = await self._meet()
        return await self._ask("tools/call", {"name": name, "arguments": arguments}, name)

    async def _in_time(self, work: Coroutine[Any, Any, T]) -> T:
        try:
            return await asyncio.wait_for(work, self._timeout_s)
        except TimeoutError:
            raise CallFailure(f"no answer within {self._timeout_s:g} s", why="timeout") from None

    async def _meet(self) -> dict[str, str]:
        """Return the headers of each request, by which protocol the server speaks.

        Only what is a harmless question is sent to find it out.
        """
        self._session = _MODERN
        try:
            await self._ask("tools/list", {})
        except CallFailure as refused:
            if refused.why not in ("bad_request", "unknown_route", "tool_error"):
                raise
        else:
            return _MODERN
        params = {
            "protocolVersion": OLDER_PROTOCOL, "capabilities": {}, "clientInfo": _CLIENT,
        }  # fmt: skip
        self._session = {}
        result, answer = await self._send("initialize", params, {})
        spoken = result.get("protocolVersion")
        version = spoken if isinstance(spoken, str) and len(spoken) <= 20 else OLDER_PROTOCOL
        session = {"Mcp-Protocol-Version": version}
        if given := answer.headers.get(_SESSION):
            session["Mcp-Session-Id"] = given
        told = {"jsonrpc": "2.0", "method": "notifications/initialized"}
        await self._caller.post(
            most_bytes=self._most_bytes, json=told, headers={**_ACCEPTED, **session}
        )
        return session

    async def _ask(self, method: str, params: dict[str, Any], name: str = "") -> dict[str, Any]:
        if self._session is not _MODERN:
            try:
                return (await self._send(method, params, self._session or {}))[0]
            except CallFailure as refused:
                if refused.why == "unknown_route":  # the session is over: nothing was carried out
                    self._session = None
                raise
        headers = {"Mcp-Protocol-Version": PROTOCOL, "Mcp-Method": method}
        named = {**headers, "Mcp-Name": name} if name else headers
        return (await self._send(method, {**params, "_meta": _ENVELOPE}, named))[0]

    async def _send(
        self, method: str, params: dict[str, Any], headers: dict[str, str]
    ) -> tuple[dict[str, Any], CallAnswer]:
        number = next(self._ids)
        asked = {"jsonrpc": "2.0", "id": number, "method": method, "params": params}
        heard = _EventReader(number)
        answer = await self._caller.post(
            most_bytes=self._most_bytes,
            json=asked,
            headers={**_ACCEPTED, **headers},
            is_whole=heard.take,
        )
        return _result_of(answer, number), answer


class _EventReader:
    """Find the answer to one request in a stream of server-sent events, piece by piece."""

    def __init__(self, number: int) -> None:
        self._number = number
        self._line, self._data = bytearray(), bytearray()
        self.answer: dict[str, Any] | None = None

    def take(self, piece: bytes) -> bool:
        """Take the next piece; return whether the answer is whole."""
        first, *rest = piece.split(b"\n")
        self._line += first
        for line in rest:
            self._end_line(bytes(self._line).rstrip(b"\r"))
            self._line = bytearray(line)
        return self.answer is not None

    def _end_line(self, line: bytes) -> None:
        if line.startswith(b"data:"):
            self._data += line[5:].strip() + b"\n"
        elif not line and self._data:
            message = _parse(bytes(self._data))
            self._data = bytearray()
            if isinstance(message, dict) and _answers(message, self._number):
                self.answer = self.answer or message


def _result_of(answer: CallAnswer, number: int) -> dict[str, Any]:
    if answer.kind == _STREAM:
        reader = _EventReader(number)
        reader.take(answer.body + b"\n\n")
        message: object = reader.answer
    else:
        message = _parse(answer.body)
    if not isinstance(message, dict) or not _answers(message, number):
        raise CallFailure(f"no answer of JSON-RPC came, but {answer.kind[:40]}", why="bad_reply")
    error, result = message.get("error"), message.get("result")
    if isinstance(error, dict):
        told = f"{error.get('code')}: {error.get('message')}"[:200]
        raise CallFailure(" ".join(told.split()), why="tool_error")
    if not isinstance(result, dict):
        raise CallFailure("the answer has no result", why="bad_reply")
    return result


def _answers(message: dict[str, Any], number: int) -> bool:
    """Tell whether a message answers a request; a server numbers requests of its own, too."""
    return message.get("id") == number and "method" not in message


def _parse(raw: bytes) -> object:
    try:
        return json.loads(raw)
    except (ValueError, RecursionError):
        return None


def _words(result: dict[str, Any]) -> str:
    """Return the text of an answer; of what is no text, its kind in brackets."""
    content = result.get("content")
    blocks = (
        [each for each in content if isinstance(each, dict)] if isinstance(content, list) else []
    )
    told = [
        each["text"] if isinstance(each.get("text"), str) else f"[{str(each.get('type'))[:20]}]"
        for each in blocks
    ]
    if not told and isinstance(result.get("structuredContent"), dict):
        return json.dumps(result["structuredContent"], ensure_ascii=False)
    return "\n".join(told)
