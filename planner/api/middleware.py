"""Stand before every route: judge access, slow guesses down, cap bodies, set security headers.

Plain ASGI, so that nothing of a request is parsed before it is allowed and small enough.
"""

from __future__ import annotations

import asyncio
import logging
import time
from collections import OrderedDict
from collections.abc import Callable
from typing import TYPE_CHECKING

from starlette.exceptions import HTTPException

from planner.api.access import Access, AccessError
from planner.api.crowd import address_of
from planner.api.problems import response
from planner.people import ASKER
from planner.voice import MAX_BYTES
from pons_assets.built_page import SECURITY_HEADERS

if TYPE_CHECKING:
    from starlette.types import ASGIApp, Message, Receive, Scope, Send

log = logging.getLogger(__name__)

MAX_BODY_BYTES = 256 * 1024
LARGE_BODIES = {"/v1/voice": MAX_BYTES}
WS_POLICY_VIOLATION = 1008
UNREAD_BYTES = 65_536
UNREAD_S = 0.5
"""Of a body whose request is refused: so much is read of it and thrown away, for so long."""
FREE = 3
"""So many wrong tokens of one address are typing mistakes."""
FIRST_S, LONGEST_S = 0.1, 2.0
FORGIVEN_S = 10.0
"""For so long without a guess, one is forgiven."""
MOST_ADDRESSES = 1_024
LOG_S = 10.0

_UNSTORED = (b"cache-control", b"no-store")
"""What no route says otherwise of is true for this moment, and may be the owner's alone."""


class Guard:
    """Let a request through only when it may ask and is not too large."""

    def __init__(self, app: ASGIApp, access: Access) -> None:
        self._app = app
        self._access = access
        self._guesses = Guesses()

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        if scope["type"] not in ("http", "websocket"):
            await self._app(scope, receive, send)
            return
        headers = {
            name.decode("latin-1"): value.decode("latin-1") for name, value in scope["headers"]
        }
        websocket = scope["type"] == "websocket"
        try:
            role = self._access.judge(
                scope.get("method", "GET"), scope["path"], headers, websocket=websocket
            )
        except AccessError as refusal:
            if refusal.guessed:
                await self._guesses.slow(scope.get("client"))
            await _refuse(refusal, scope, receive, send)
            return
        scope["state"] = {**scope.get("state", {}), "role": role}
        ASKER.set(self._access.person(headers, websocket=websocket))
        if websocket:
            await self._app(scope, receive, send)
        else:
            await self._cap_body(scope, receive, send)

    async def _cap_body(self, scope: Scope, receive: Receive, send: Send) -> None:
        counted = 0
        most = LARGE_BODIES.get(scope["path"], MAX_BODY_BYTES)

        async def counting_receive() -> Message:
            nonlocal counted
            message = await receive()
            counted += len(message.get("body", b""))
            if not counted <= most:
                raise HTTPException(413, f"the body passed {most} bytes, which is the cap")
            return message

        await self._app(scope, counting_receive, _add_headers(send))


def _add_headers(send: Send) -> Send:
    """Return a way to send on which each answer gets the security headers."""

    async def sending(message: Message) -> None:
        if message["type"] == "http.response.start":
            given = list(message.get("headers", ()))
            kept = any(name.lower() == b"cache-control" for name, _ in given)
            message["headers"] = [*given, *SECURITY_HEADERS, *(() if kept else (_UNSTORED,))]
        await send(message)

    return sending


async def _refuse(refusal: AccessError, scope: Scope, receive: Receive, send: Send) -> None:
    if scope["type"] == "websocket":
        await send({"type": "websocket.close", "code": WS_POLICY_VIOLATION,
                    "reason": refusal.code})  # fmt: skip
        return
    problem = response(refusal.status, refusal.code, refusal.detail)
    await _take_small_body(receive)
    await problem(scope, receive, _add_headers(send))


async def _take_small_body(receive: Receive) -> None:
    """Read what was sent, up to a bound of bytes and time, before a refusal closes the connection.

    A server that closes while bytes lie unread resets the connection (RFC 9112, 9.6), and a proxy
    in between may then lose the answer, as Caddy did once on a busy machine.
    """
    taken = 0
    try:
        async with asyncio.timeout(UNREAD_S):
            while taken <= UNREAD_BYTES:
                message = await receive()
                taken += len(message.get("body", b""))
                if not message.get("more_body", False):
                    return
    except TimeoutError:
        return


class Guesses:
    """Count wrong tokens by address: their answers come later each time, and the log says so.

    Only the answer to a wrong token waits. A right one is never looked up here, so whoever shares
    an address with a guesser is served as ever. The memory is bounded: the address that guessed
    longest ago is forgotten first.
    """

    def __init__(self, clock: Callable[[], float] = time.monotonic) -> None:
        self._clock = clock
        self._counts: OrderedDict[str, tuple[float, float]] = OrderedDict()
        self._logged_s = float("-inf")
        self._unlogged = 0

    def __len__(self) -> int:
        return len(self._counts)

    def note(self, host: str) -> float:
        """Count a wrong token; return how long its answer must wait [s]."""
        now_s, address = self._clock(), address_of(host)
        count, then_s = self._counts.pop(address, (0.0, now_s))
        count = max(0.0, count - (now_s - then_s) / FORGIVEN_S) + 1.0
        self._counts[address] = (count, now_s)
        if len(self._counts) > MOST_ADDRESSES:
            self._counts.popitem(last=False)
        self._tell(address, now_s)
        over = count - FREE
        return min(LONGEST_S, FIRST_S * 2.0 ** min(over - 1.0, 16.0)) if over > 0.0 else 0.0

    async def slow(self, client: tuple[str, int] | None) -> None:
        """Count a wrong token and wait before its answer."""
        await asyncio.sleep(self.note(client[0] if client else "unknown"))

    def _tell(self, address: str, now_s: float) -> None:
        self._unlogged += 1
        if now_s - self._logged_s >= LOG_S:
            log.warning("wrong_token: %d refused, the last from %r", self._unlogged, address[:80])
            self._logged_s, self._unlogged = now_s, 0
