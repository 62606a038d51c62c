"""Stand before every route: judge access, count and cap bodies, set the security headers.

Plain ASGI, so that nothing of a request is parsed before it is allowed and small enough.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from starlette.exceptions import HTTPException

from planner.api.access import Access, AccessError
from planner.api.problems import response
from planner.api.token_guesses import Guesses
from planner.voice import MAX_BYTES

if TYPE_CHECKING:
    from starlette.types import ASGIApp, Message, Receive, Scope, Send

MAX_BODY_BYTES = 256 * 1024
LARGE_BODIES = {"/v1/voice": MAX_BYTES}
WS_POLICY_VIOLATION = 1008

_HEADERS = (
    (b"x-content-type-options", b"nosniff"),
    (b"referrer-policy", b"no-referrer"),
    (b"x-frame-options", b"DENY"),
    (b"cross-origin-resource-policy", b"same-origin"),
    (
        b"permissions-policy",
        b"microphone=(self), camera=(), display-capture=(), geolocation=(), payment=(), usb=()",
    ),
    (
        b"content-security-policy",
        (
            b"default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self' data:; "
            b"connect-src 'self'; base-uri 'none'; form-action 'none'; frame-ancestors 'none'"
        ),
    ),
)


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
            message["headers"] = [*given, *_HEADERS, *(() if kept else (_UNSTORED,))]
        await send(message)

    return sending


async def _refuse(refusal: AccessError, scope: Scope, receive: Receive, send: Send) -> None:
    if scope["type"] == "websocket":
        await send({"type": "websocket.close", "code": WS_POLICY_VIOLATION,
                    "reason": refusal.code})  # fmt: skip
        return
    problem = response(refusal.status, refusal.code, refusal.detail)
    await problem(scope, receive, _add_headers(send))
