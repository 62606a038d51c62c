"""Read an HTTP answer, never more of it than there may be, and class it by its status.

An answer is a reply, whole or as server-sent events; a body to be made simpler; or a failure that
another try may mend, or not. Servers differ in the status with which they refuse a mode that they
don't know, so its words count as well.
"""

from __future__ import annotations

import asyncio
import contextlib
import re
from collections.abc import AsyncIterator, Callable, Iterator
from dataclasses import dataclass
from typing import Any

import httpx

from planner.brain.endpoint.assembly import Assembly, StreamFailure
from planner.brain.endpoint.completion import (
    complaint_of,
    declined_by,
    generated_by,
    is_loading,
    read_json,
    why_down,
)
from planner.brain.endpoint.dialect import not_taken
from planner.brain.errors import BrainDown
from planner.outbound import Secret

BUSY = frozenset({408, 409, 425, 429})
LOADING_STATUS = 503
PAUSE_S = 0.5
"""Before the second try, where the server names no time."""
_MODES = re.compile(
    r"response_format|json_schema|json_object|json schema|tool_choice|structured.?output|guided_"
    r"|grammar|\btools?\b.{0,40}support|support.{0,40}\btools?\b|requested parameters"
)
_NO_MODEL = re.compile(r"\bmodel\b.{0,60}\b(?:not exist|not found|does not exist|doesn't exist)")
"""What DeepSeek and others answer with 400: no simpler body would find the model."""


class BadRequest(Exception):
    """The server refused the body: perhaps a simpler one pleases it. Holds its words.

    ``generated``: the model did reply, and the server itself found that it does not fit (Groq).
    ``declined``: the server's own filter refused the order; no other body will please it.
    """

    def __init__(self, said: str, generated: str | None = None, declined: bool = False) -> None:
        super().__init__(said)
        self.generated = generated
        self.declined = declined


@dataclass(frozen=True, slots=True)
class RetryableFailure:
    """Hold a failure that another try may mend, and when."""

    down: BrainDown
    after_s: float = 0.0
    lost: bool = False
    """The connection was lost; perhaps it had only idled too long."""


def classify_status(response: httpx.Response, content: object, said: str) -> RetryableFailure:
    """Class an answer that is no 2xx; ``said`` are its words without the key.

    Raises:
        BadRequest: another body may do.
        BrainDown: everything else that no other try mends, with ``why``.
    """
    status = response.status_code
    if 300 <= status < 400:
        raise BrainDown(f"status {status}; redirects are not followed", why="redirect")
    server = said.partition(": ")[2]
    if status in (401, 403):
        raise BrainDown(said, why="bad_key", server=server)
    if status in BUSY:
        down = BrainDown(said, why="rate_limited", server=server)
        return RetryableFailure(down, _wait_s(response))
    words = said.lower()
    modes = _MODES.search(words) is not None or not_taken(words)
    if status in (400, 422) and _NO_MODEL.search(words) and not modes:
        raise BrainDown(said, why="unknown_model", server=server)
    if status in (400, 422) or modes:
        raise BadRequest(said, generated_by(content), declined_by(content))
    if status in (404, 405, 410):
        raise BrainDown(said, why="unknown_model", server=server)
    if status >= 500:
        loads = status == LOADING_STATUS and (is_loading(said) or "load" in words)
        why = "loading" if loads else why_down(server)
        return RetryableFailure(BrainDown(said, why=why, server=server), _wait_s(response))
    raise BrainDown(said, why="bad_request", server=server)


def words_of(status: int, content: object) -> str:
    """Return an answer's words in one short line."""
    return f"status {status}: {complaint_of(content)}"


def _wait_s(response: httpx.Response) -> float:
    """Return the pause before the next try [s]; a time that is no number counts as for ever."""
    asked = response.headers.get("retry-after")
    if asked is None:
        return PAUSE_S
    try:
        seconds = float(asked)
    except ValueError:
        return float("inf")
    return seconds if seconds >= 0.0 else float("inf")


DONE = b"[DONE]"


class Events:
    """Cut bytes, as they come, into whole server-sent events.

    Of the format only what chat servers send: ``data:`` lines, comments that keep a connection
    awake, and ``event: error``. Lines end by LF, CRLF or CR.
    Source: html.spec.whatwg.org, "Server-sent events", parsing an event stream.
    """

    def __init__(self) -> None:
        self._line = bytearray()
        self._data: list[bytes] = []
        self._after_cr = False
        self.done = False
        """The server said that it is through."""

    def feed(self, raw: bytes) -> Iterator[Any]:
        """Yield the JSON of each event that these bytes complete; None for one that is no JSON."""
        if self._after_cr and raw.startswith(b"\n"):
            raw = raw[1:]
        self._after_cr = raw.endswith(b"\r")
        *lines, rest = raw.replace(b"\r\n", b"\n").replace(b"\r", b"\n").split(b"\n")
        for line in lines:
            self._line += line
            whole, self._line = bytes(self._line), bytearray()
            yield from self._take(whole)
        self._line += rest

    def end(self) -> Iterator[Any]:
        """Yield the events in the last bytes: some servers end without an empty line."""
        whole, self._line = bytes(self._line), bytearray()
        yield from self._take(whole)
        yield from self._take(b"")

    def _take(self, line: bytes) -> Iterator[Any]:
        if line.startswith(b"data:"):
            self._data.append(line[5:].strip())
            if len(self._data) == 1:  # nearly always the whole event, whatever line follows
                yield from self._event(whole=False)
        elif not line and self._data:
            yield from self._event(whole=True)

    def _event(self, *, whole: bool) -> Iterator[Any]:
        """Yield what stands in the event's lines; one that goes on is no JSON yet."""
        data = b"\n".join(self._data)
        value = None if data == DONE else read_json(data)
        if data == DONE:
            self.done = True
        elif value is not None or (whole and data):
            yield value
        elif not whole:
            return
        self._data = []


MAX_REPLY_BYTES = 1_000_000
MAX_STREAM_BYTES = 8_000_000
"""A stream wraps each token in some 300 bytes, and thoughts are streamed too, though not kept."""
MAX_ERROR_BYTES = 64_000
END_S = 0.02
"""For the end of a stream after its last event: only what was read whole is used again."""

FINISHED_S = 0.5
"""For what follows ``finish_reason``: the bill, and the last line, which some never send."""
WHOLE_S = 2.0
"""Of silence behind one closed object without a ``finish_reason``: a slow model writes a token in
0.5 s."""

Told = Callable[[Callable[[], str]], None]
"""Takes a way to read what the model has written so far, and reads it when it likes."""


class StreamBroken(Exception):
    """The stream ended before the reply did: a plain call may do better. Holds why.

    ``server``: what the server itself said of it.
    """

    def __init__(self, why: str, server: str = "") -> None:
        super().__init__(why)
        self.server = server


async def read(
    response: httpx.Response,
    secret: Secret,
    assembly: Assembly,
    told: Told | None,
    heard: Callable[[], None] = lambda: None,
) -> Any | RetryableFailure:
    """Return the JSON of a reply, put together where it is a stream; None where it is none.

    ``heard`` is called at the server's first word.

    Raises:
        BadRequest, BrainDown: see ``status.judged``; ``too_large``, ``bad_reply``.
        StreamBroken: as it says.
    """
    code = response.status_code
    if not 200 <= code < 300:
        content = read_json(secret.struck_bytes(await _body(response, MAX_ERROR_BYTES)))
        if code != LOADING_STATUS:
            heard()
        return classify_status(response, content, secret.redact(words_of(code, content)))
    if response.headers.get("content-type", "").lower().startswith("text/event-stream"):
        return await _listen(response, secret, assembly, told, heard)
    raw = await _body(response, MAX_REPLY_BYTES)
    heard()
    return read_json(secret.struck_bytes(raw))


async def _listen(
    response: httpx.Response,
    secret: Secret,
    assembly: Assembly,
    told: Told | None,
    heard: Callable[[], None],
) -> dict[str, Any]:
    """Put a stream together and tell of it as it grows."""
    _refuse_packed(response)
    events, size, chunks = Events(), 0, response.aiter_raw()
    silence = _Silence(assembly)
    try:
        async with silence:
            async for chunk in chunks:
                size += len(chunk)
                if size > MAX_STREAM_BYTES or assembly.size > MAX_REPLY_BYTES:
                    told_bytes = f"{MAX_REPLY_BYTES} bytes, {MAX_STREAM_BYTES} on the wire"
                    raise BrainDown(f"the stream is over {told_bytes}", why="too_large")
                for event in events.feed(chunk):
                    heard()  # comments keep a connection awake while a model loads: not a word
                    assembly.add(event)
                if events.done:
                    await _let_end(chunks)
                    break
                silence.set_limit()
                if told is not None and assembly.begun:
                    told(lambda: secret.struck_growing(assembly.text))
            for event in events.end():
                assembly.add(event)
    except StreamFailure as broken:
        raise StreamBroken(secret.redact(str(broken)), secret.redact(broken.server)) from None
    ended = events.done or silence.passed
    if assembly.finish is None and (not ended or assembly.is_cut):
        raise StreamBroken("it ended before the reply did")
    return assembly.completion()


class _Silence:
    """End the wait for a stream that goes on although its reply is there.

    Law: only behind ``finish_reason``, or behind one whole object, is silence an end; whatever else
    still comes is waited for until the goal's own deadline.
    """

    def __init__(self, assembly: Assembly) -> None:
        self._assembly = assembly
        self._limit = asyncio.timeout(None)
        self._size = -1
        self.passed = False

    async def __aenter__(self) -> None:
        await self._limit.__aenter__()

    async def __aexit__(self, *raised: Any) -> bool:
        try:
            await self._limit.__aexit__(*raised)
        except TimeoutError:
            self.passed = True
        return self.passed

    def set_limit(self) -> None:
        """Set, move or lift the limit, by what has come so far; what brings nothing moves none."""
        assembly, set_s = self._assembly, self._limit.when()
        silent_s: float | None
        if assembly.finish is not None:
            silent_s = FINISHED_S
        elif assembly.size == self._size:
            return
        else:
            silent_s = WHOLE_S if assembly.is_whole else None
        self._size = assembly.size
        if silent_s is None:
            self._limit.reschedule(None)
            return
        end_s = asyncio.get_running_loop().time() + silent_s
        self._limit.reschedule(end_s if set_s is None else min(set_s, end_s))


async def _let_end(chunks: AsyncIterator[bytes]) -> None:
    """Read to the end of a stream that said it was through, so that its connection stays."""
    with contextlib.suppress(TimeoutError, httpx.HTTPError):
        async with asyncio.timeout(END_S):
            async for _ in chunks:
                pass


async def _body(response: httpx.Response, cap: int) -> bytes:
    """Return a body of at most ``cap`` bytes, as it is on the wire; an error is cut there.

    Raises:
        BrainDown: ``too_large``, as soon as it is; ``bad_reply``: it is packed unasked.
    """
    _refuse_packed(response)
    body = bytearray()
    async for chunk in response.aiter_raw():
        if len(body) + len(chunk) > cap:
            if response.status_code != 200:
                break
            raise BrainDown(f"the reply is over {cap} bytes", why="too_large")
        body += chunk
    return bytes(body)


def _refuse_packed(response: httpx.Response) -> None:
    if response.headers.get("content-encoding", "identity").lower() not in ("identity", ""):
        raise BrainDown("the reply is packed, though that was not asked for", why="bad_reply")
