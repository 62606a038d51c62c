"""Judge each request to the fleet: host, origin, token, size and type, before any route sees it.

As at a robot: on loopback without a token set everybody is the operator; a viewer may look and
stop.
"""

from __future__ import annotations

import hmac
from dataclasses import dataclass
from typing import TYPE_CHECKING
from urllib.parse import urlsplit

from starlette.responses import JSONResponse

from fleet.errors import FleetError
from pons_assets.built_page import SECURITY_HEADERS

if TYPE_CHECKING:
    from collections.abc import Mapping

    from starlette.types import ASGIApp, Message, Receive, Scope, Send

LOOPBACK_NAMES = frozenset({"127.0.0.1", "localhost", "::1"})
READING = frozenset({"GET", "HEAD"})
STOP_PATH = "/v1/stop"
OPEN_PATHS = frozenset({"/healthz", "/"})
PAGE_FILES = "/assets/"
"""A page comes before its token, which stands behind the address's # where no server sees it."""
MAX_BODY_BYTES = 256 * 1024
MEDIA_TYPE = "application/problem+json"


@dataclass(frozen=True, slots=True)
class FleetAccess:
    """Hold the rules of one service."""

    hosts: frozenset[str] = LOOPBACK_NAMES
    operator_token: str = ""
    viewer_token: str = ""
    speaks_tls: bool = False

    def judge(self, method: str, path: str, headers: Mapping[str, str]) -> str:
        """Accept a request, and return who asks: ``operator`` or ``viewer``.

        Raises:
            FleetError: by its code.
        """
        host = headers.get("host", "")
        name = urlsplit(f"//{host}").hostname or ""
        if name not in self.hosts:
            raise FleetError("foreign_host", f"host {host[:80]!r}")
        origin, scheme = headers.get("origin"), "https" if self.speaks_tls else "http"
        if origin is not None and origin != f"{scheme}://{host}":
            raise FleetError("foreign_origin", f"origin {origin[:80]!r}")
        is_open = path in OPEN_PATHS or path.startswith(PAGE_FILES)
        role = "viewer" if is_open else self._judge_token(method, path, headers)
        stops = path == STOP_PATH
        if method in READING or stops:
            return role
        if headers.get("content-type", "").partition(";")[0].strip() != "application/json":
            raise FleetError("unsupported_media_type")
        return role

    def _judge_token(self, method: str, path: str, headers: Mapping[str, str]) -> str:
        kind, _, token = headers.get("authorization", "").partition(" ")
        given = token.strip() if kind.lower() == "bearer" else ""
        if not self.operator_token or _is_same(given, self.operator_token):
            return "operator"
        if not _is_same(given, self.viewer_token):
            raise FleetError("token_needed")
        if method not in READING and path != STOP_PATH:
            raise FleetError("operator_needed")
        return "viewer"


def _is_same(given: str, wanted: str) -> bool:
    return bool(wanted) and hmac.compare_digest(given.encode(), wanted.encode())


class AccessDoor:
    """Let through what the rules accept; refuse the rest with its code."""

    def __init__(self, app: ASGIApp, access: FleetAccess) -> None:
        self._app, self._access = app, access

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Judge one request."""
        if scope["type"] != "http":
            await self._app(scope, receive, send)
            return
        headers = {k.decode("latin-1"): v.decode("latin-1") for k, v in scope["headers"]}
        try:
            role = self._access.judge(scope["method"], scope["path"], headers)
            length = headers.get("content-length", "0")
            is_chunked = "transfer-encoding" in headers
            if is_chunked or not (length.isdecimal() and int(length) <= MAX_BODY_BYTES):
                raise FleetError("body_too_large")
        except FleetError as refused:
            await problem(refused)(scope, receive, _add_security_headers(send))
            return
        scope["state"] = {**scope.get("state", {}), "role": role}
        await self._app(scope, receive, _add_security_headers(send))


def _add_security_headers(send: Send) -> Send:
    """Return a way to send on which each answer gets the security headers."""

    async def sending(message: Message) -> None:
        if message["type"] == "http.response.start":
            given = list(message.get("headers", ()))
            is_kept = any(name.lower() == b"cache-control" for name, _ in given)
            unkept = () if is_kept else ((b"cache-control", b"no-store"),)
            message["headers"] = [*given, *SECURITY_HEADERS, *unkept]
        await send(message)

    return sending


def problem(error: FleetError) -> JSONResponse:
    """Return a refusal as an answer, in the shape of the robots' own."""
    content = {"type": f"urn:pons:problem:{error.code}", "status": error.status,
               "code": error.code, "detail": error.detail, "message": error.message}  # fmt: skip
    headers = {"www-authenticate": "Bearer"} if error.status == 401 else None
    return JSONResponse(content, error.status, headers=headers, media_type=MEDIA_TYPE)
