"""Read an answer off the wire, whole or as a stream, never more of it than there may be."""

from __future__ import annotations

import asyncio
import contextlib
from collections.abc import AsyncIterator, Callable
from typing import Any

import httpx

from planner.brain.endpoint import http_status
from planner.brain.endpoint.completion_parser import read_json
from planner.brain.endpoint.http_status import Again
from planner.brain.endpoint.key_redaction import Secret
from planner.brain.endpoint.sse import Events
from planner.brain.endpoint.stream_assembler import Assembly, Broken
from planner.brain.errors import BrainDown

MAX_REPLY_BYTES = 1_000_000
MAX_STREAM_BYTES = 8_000_000
"""A stream wraps each token in some 300 bytes, and thoughts are streamed too, though not kept."""
MAX_ERROR_BYTES = 64_000
END_S = 0.02
"""For the end of a stream after its last event: only what was read whole is used again."""

Told = Callable[[Callable[[], str]], None]
"""Takes a way to read what the model has written so far, and reads it when it likes."""


class StreamBroken(Exception):
    """The stream ended before the reply did: a plain call may do better. Holds why."""


async def read(
    response: httpx.Response, secret: Secret, assembly: Assembly, told: Told | None
) -> Any | Again:
    """Return the JSON of a reply, put together where it is a stream; None where it is none.

    Raises:
        BadRequest, BrainDown: see ``status.judged``; ``too_large``, ``bad_reply``.
        StreamBroken: as it says.
    """
    code = response.status_code
    if not 200 <= code < 300:
        content = read_json(secret.struck_bytes(await _body(response, MAX_ERROR_BYTES)))
        return http_status.judged(
            response, content, secret.struck(http_status.words_of(code, content))
        )
    if response.headers.get("content-type", "").lower().startswith("text/event-stream"):
        return await _listen(response, secret, assembly, told)
    return read_json(secret.struck_bytes(await _body(response, MAX_REPLY_BYTES)))


async def _listen(
    response: httpx.Response, secret: Secret, assembly: Assembly, told: Told | None
) -> dict[str, Any]:
    """Put a stream together and tell of it as it grows."""
    _refuse_packed(response)
    events, size, chunks = Events(), 0, response.aiter_raw()
    try:
        async for chunk in chunks:
            size += len(chunk)
            if size > MAX_STREAM_BYTES or assembly.size > MAX_REPLY_BYTES:
                told_bytes = f"{MAX_REPLY_BYTES} bytes, {MAX_STREAM_BYTES} on the wire"
                raise BrainDown(f"the stream is over {told_bytes}", why="too_large")
            for event in events.feed(chunk):
                assembly.add(event)
            if events.done:
                await _let_end(chunks)
                break
            if told is not None and assembly.begun:
                told(lambda: secret.struck_growing(assembly.text))
        for event in events.end():
            assembly.add(event)
    except Broken as broken:
        raise StreamBroken(secret.struck(str(broken))) from None
    if not events.done and assembly.finish is None:
        raise StreamBroken("it ended before the reply did")
    return assembly.completion()


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
