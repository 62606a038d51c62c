"""Serve MCP over Streamable HTTP: each request with its agent's own token, Host and Origin judged.

No session is kept, so any request may reach any process. The token goes on to the planner, which
judges it again: there is no second list of who may.
"""

from __future__ import annotations

import json
from typing import TYPE_CHECKING, Any

from mcp.server.transport_security import TransportSecuritySettings

from pons.mcp.planner_door import TOKEN, DoorError
from pons.settings import allowed_hosts

if TYPE_CHECKING:
    from mcp.server.mcpserver import MCPServer
    from starlette.types import ASGIApp, Receive, Scope, Send

    from pons.mcp.planner_door import PlannerDoor

MAX_BODY_BYTES = 256 * 1024
PATH = "/mcp"
LOOPBACK = ("127.0.0.1", "localhost", "[::1]")


def build_app(
    server: MCPServer[Any], door: PlannerDoor, named: tuple[str, ...] = (), *, tls: bool = False
) -> ASGIApp:
    """Return the application that answers at ``/mcp``, by these names and on the loopback."""
    names = {*LOOPBACK, *allowed_hosts(), *named} - {"0.0.0.0", "::"}
    scheme = "https" if tls else "http"
    security = TransportSecuritySettings(
        allowed_hosts=[each for name in names for each in (name, f"{name}:*")],
        allowed_origins=[each for name in names
                         for each in (f"{scheme}://{name}", f"{scheme}://{name}:*")],
    )  # fmt: skip
    served = server.streamable_http_app(
        streamable_http_path=PATH, stateless_http=True, json_response=True,
        max_request_body_size=MAX_BODY_BYTES, transport_security=security,
    )  # fmt: skip
    return AgentsOnly(served, door)


class AgentsOnly:
    """Let a request through that carries an agent's token."""

    def __init__(self, app: ASGIApp, door: PlannerDoor) -> None:
        """Take what is behind."""
        self._app, self._door = app, door

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Judge one request."""
        if scope["type"] != "http":
            await self._app(scope, receive, send)
            return
        headers = dict(scope["headers"])
        scheme, _, token = headers.get(b"authorization", b"").decode("latin-1").partition(" ")
        TOKEN.set(token.strip() if scheme.lower() == "bearer" else "")
        try:
            if not TOKEN.get():
                raise DoorError("token_needed", "send Authorization: Bearer with an agent's token",
                                401)  # fmt: skip
            await self._door.name_agent()
        except DoorError as refused:
            await _refuse(send, refused)
            return
        await self._app(scope, receive, send)


async def _refuse(send: Send, refused: DoorError) -> None:
    body = json.dumps({"code": refused.code, "detail": str(refused)}).encode()
    status = refused.status or 503
    headers = [(b"content-type", b"application/problem+json")]
    if status == 401:
        headers.append((b"www-authenticate", b"Bearer"))
    await send({"type": "http.response.start", "status": status, "headers": headers})
    await send({"type": "http.response.body", "body": body})
