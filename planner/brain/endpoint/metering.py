"""Let every HTTP call of a model pass the meter: first tries, second tries, probes and repairs.

It stands where the bytes leave, so that no way of asking can go round it. What a server says of its
bill is read out of the raw reply; where it says nothing, an estimate on the high side counts.
"""

from __future__ import annotations

import re
from collections.abc import AsyncIterator
from typing import TYPE_CHECKING

import httpx

from planner.brain.prompt_tokens import PICTURE_TOKENS

if TYPE_CHECKING:
    from planner.brain.usage_meter import Bill, Meter

MAX_WRAPPING = 400
"""Bytes of an event that are not the model's, at most."""
_KEPT = 16
"""Of a line's beginning: it tells an event from a comment and from the stream's end."""


class Weight:
    """Weigh a stream that does not say what it cost: how much of it is the model's own.

    Servers wrap each token in some 300 bytes, so a stream's size tells little. Of each event the
    size of the least one is taken off, which holds next to nothing but the wrapping; an event
    counts as one token at least. The bytes themselves are not kept.
    """

    def __init__(self) -> None:
        self._head, self._length = b"", 0
        self._events, self._size, self._least = 0, 0, MAX_WRAPPING

    def add(self, chunk: bytes) -> None:
        """Take the next bytes, cut wherever they are."""
        *whole, rest = chunk.replace(b"\r", b"\n").split(b"\n")
        for piece in whole:
            self._grow(piece)
            self._end()
        self._grow(rest)

    def tokens(self, per_token: int) -> int:
        """Return the tokens of a reply, of so many bytes each."""
        self._end()
        own = self._size - self._events * self._least
        return max(self._events, own // per_token)

    def _grow(self, piece: bytes) -> None:
        self._head = (self._head + piece[:_KEPT])[:_KEPT]
        self._length += len(piece)

    def _end(self) -> None:
        if self._head.startswith(b"data:") and not self._head[5:].lstrip().startswith(b"[DONE]"):
            self._events += 1
            self._size += self._length
            self._least = min(self._least, self._length)
        self._head, self._length = b"", 0


CHARACTERS_PER_TOKEN = 4
HEAD_BYTES = 4096
TAIL_BYTES = 8192
"""Where servers write what they bill: at an end of the reply. Quotes inside of a string are
escaped, so the words of a model can't pass for it."""
_PROMPT = re.compile(rb'"(?:prompt_tokens|input_tokens)"\s*:\s*(\d{1,7})(?=[\s,}])')
_REPLY = re.compile(rb'"(?:completion_tokens|output_tokens)"\s*:\s*(\d{1,7})(?=[\s,}])')
_TOTAL = re.compile(rb'"total_tokens"\s*:\s*(\d{1,7})(?=[\s,}])')
_DATA_URL = re.compile(rb'"data:image/jpeg;base64,[A-Za-z0-9+/=]*"')
_DONE = re.compile(rb"(?:^|[\r\n])data:\s*\[DONE\]")
_OBJECT = re.compile(rb'(?<!\\)"arguments"\s*:\s*\{')
"""Arguments that a server sends as an object: the model's own words, whose quotes stand bare."""
_NEVER_SENT = (
    httpx.ConnectError,
    httpx.ConnectTimeout,
    httpx.PoolTimeout,
    httpx.UnsupportedProtocol,
)


class MeteredTransport(httpx.AsyncBaseTransport):
    """Ask the meter before each request, and tell it how the request ended."""

    def __init__(self, inner: httpx.AsyncBaseTransport, meter: Meter) -> None:
        self._inner, self._meter = inner, meter

    async def handle_async_request(self, request: httpx.Request) -> httpx.Response:
        """Send one request.

        Raises:
            OutOfBudget: it may not go out.
        """
        sent = tokens_of(request.content)
        bill = await self._meter.open(sent)
        try:
            response = await self._inner.handle_async_request(request)
        except _NEVER_SENT:
            bill.close(0, 0)
            raise
        except BaseException:  # it may have been read, and a server may bill what nobody took
            bill.close(sent, bill.max_reply_tokens)
            raise
        if not isinstance(response.stream, httpx.AsyncByteStream):
            raise TypeError(f"an async stream was expected; got {type(response.stream).__name__}")
        return httpx.Response(
            response.status_code,
            headers=response.headers,
            stream=_Read(response.stream, bill, sent, response),
            extensions=response.extensions,
        )

    async def aclose(self) -> None:
        """Give the connections back."""
        await self._inner.aclose()


class _Read(httpx.AsyncByteStream):
    """Pass a reply through, keep its two ends, and close the bill with it."""

    def __init__(
        self, inner: httpx.AsyncByteStream, bill: Bill, sent: int, response: httpx.Response
    ) -> None:
        self._inner, self._bill, self._sent = inner, bill, sent
        self._status = response.status_code
        kind = response.headers.get("content-type", "").lower()
        self._weight = Weight() if kind.startswith("text/event-stream") else None
        self._head, self._tail = bytearray(), bytearray()
        self._size, self._whole, self._open = 0, False, True

    async def __aiter__(self) -> AsyncIterator[bytes]:
        async for chunk in self._inner:
            self._size += len(chunk)
            if self._weight is not None:
                self._weight.add(chunk)
            self._head += chunk[: HEAD_BYTES - len(self._head)]
            self._tail += chunk[-TAIL_BYTES:]
            del self._tail[:-TAIL_BYTES]
            yield chunk
        self._whole = True

    async def aclose(self) -> None:
        """Close the connection's part and the bill, the bill once."""
        if self._open:
            self._open = False
            self._bill.close(*self._cost())
        await self._inner.aclose()

    def _cost(self) -> tuple[int, int]:
        """Return the tokens of prompt and reply; errors are not billed anywhere known.

        What was cut stays at its worst: the figures so far are not the last ones.
        """
        ends = bytes(self._tail) if self._size <= TAIL_BYTES else bytes(self._head + self._tail)
        whole = self._whole or (self._weight is not None and _DONE.search(self._tail) is not None)
        said = read_usage(ends) if whole else None
        if said is not None:
            return said
        if self._status >= 300:
            return 0, 0
        return self._sent, self._wrote() if whole else self._bill.max_reply_tokens

    def _wrote(self) -> int:
        """Return the possible cost [tokens] of a reply without figures."""
        weight, each = self._weight, CHARACTERS_PER_TOKEN
        wrote = self._size // each if weight is None else weight.tokens(each)
        return min(self._bill.max_reply_tokens, wrote)


def read_usage(reply: bytes) -> tuple[int, int] | None:
    """Return the tokens of prompt and reply that a server says it billed, or None.

    The last figures count, as streams repeat them. Thoughts that only the total holds are reply.
    Where a call's arguments are an object, figures may be the model's own, and none is believed.
    """
    if _OBJECT.search(reply):
        return None
    prompt, reply_tokens, total = (
        int(found[-1]) if (found := kind.findall(reply)) else None
        for kind in (_PROMPT, _REPLY, _TOTAL)
    )
    if prompt is None or (reply_tokens is None and total is None):
        return None
    return prompt, max(reply_tokens or 0, (total or 0) - prompt)


def _weigh_pictures(body: bytes) -> tuple[bytes, int]:
    """Return a body without its pictures, and the tokens that they may cost."""
    plain, count = _DATA_URL.subn(b"", body)
    return plain, count * PICTURE_TOKENS


def tokens_of(body: bytes) -> int:
    """Estimate the tokens of a body: four plain characters each, and one for each other one.

    A picture counts as what it may cost at most, whatever its bytes.
    """
    words, pictures = _weigh_pictures(body)
    plain = len(words.translate(None, _NOT_PLAIN))
    wide = (len(words) - plain) // 3
    return plain // CHARACTERS_PER_TOKEN + wide + pictures


_NOT_PLAIN = bytes(range(128, 256))
