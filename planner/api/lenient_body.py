"""Serve a route with any body: for a stop, an odd body is no reason to refuse.

A hurried ``curl -d '{}'`` without a content type, half a JSON, a megabyte of noise, a connection
that breaks off, or a body that does not come: each still stops, as if the body had been empty.
"""

from __future__ import annotations

import asyncio
from typing import TYPE_CHECKING, Any

from fastapi.exceptions import RequestValidationError
from fastapi.routing import APIRoute
from starlette.exceptions import HTTPException
from starlette.requests import ClientDisconnect, Request

if TYPE_CHECKING:
    from collections.abc import Callable, Coroutine

    from starlette.responses import Response
    from starlette.types import Message

BODY_S = 0.5
"""How long a stop waits for the rest of its body, which says no more than who asks."""
_OF_THE_BODY = frozenset({b"content-type", b"content-length", b"transfer-encoding"})


class LenientRoute(APIRoute):
    """Answer a request with an unusable body as if it had none."""

    def get_route_handler(self) -> Callable[[Request], Coroutine[Any, Any, Response]]:
        """Return the handler that tries a second time, bare; the route ran in neither case yet."""
        handle = super().get_route_handler()

        async def answer(request: Request) -> Response:
            try:
                async with asyncio.timeout(BODY_S):
                    await request.body()  # kept by the request
            except (TimeoutError, ClientDisconnect, HTTPException):
                return await handle(_bare(request))
            try:
                return await handle(request)
            except (RequestValidationError, HTTPException):
                return await handle(_bare(request))

        return answer


def _bare(request: Request) -> Request:
    headers = [pair for pair in request.scope["headers"] if pair[0] not in _OF_THE_BODY]
    return Request({**request.scope, "headers": headers}, _nothing)


async def _nothing() -> Message:
    return {"type": "http.request", "body": b"", "more_body": False}
