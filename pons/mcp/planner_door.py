"""Ask the planner's HTTP API in an agent's name; a refusal reaches the caller with its cure."""

from __future__ import annotations

import ssl
import time
from collections import OrderedDict
from contextvars import ContextVar
from typing import TYPE_CHECKING, Any

import httpx
from mcp.server.mcpserver.exceptions import ToolError

from pons.http import AUTHORITY

if TYPE_CHECKING:
    from pons.settings import LaunchSettings

TOKEN: ContextVar[str] = ContextVar("token", default="")
"""Of the agent whose request is served now; over stdio there is one for the whole process."""
ROLE = "agent"
TIMEOUT_S = 10.0
CONNECTIONS = 32
KNOWN_S = 30.0
"""So long an agent's name is taken as known; the planner judges each request anyway."""
MOST_KNOWN = 64
UNREACHED = "the robot does not answer; is `pons up` running?"
NO_AGENT = (
    "this is no agent's token; the robot's owner makes one with `pons people add NAME --role agent`"
)


class DoorError(ToolError):
    """Say why the planner did not do it: ``code: detail``."""

    def __init__(self, code: str, told: str, status: int = 0) -> None:
        super().__init__(f"{code}: {told}")
        self.code, self.status = code, status


class PlannerDoor:
    """Hold the connections to one planner."""

    def __init__(self, base_url: str, transport: httpx.AsyncBaseTransport | None = None,
                 verify: ssl.SSLContext | bool = True) -> None:  # fmt: skip
        """Take the planner's address, and in tests the way to it."""
        limits = httpx.Limits(max_connections=CONNECTIONS)
        self._client = httpx.AsyncClient(
            base_url=base_url, transport=transport, verify=verify, limits=limits, timeout=TIMEOUT_S,
            trust_env=False,
        )  # fmt: skip
        self._known: OrderedDict[str, tuple[float, str]] = OrderedDict()

    @classmethod
    def of(cls, settings: LaunchSettings) -> PlannerDoor:
        """Return the door of this robot; over TLS it is judged by the robot's own authority."""
        if not settings.tls:
            return cls(settings.url)
        file = settings.authority or settings.home / AUTHORITY
        return cls(settings.url, verify=ssl.create_default_context(cafile=str(file)))

    async def close(self) -> None:
        """Close all connections."""
        await self._client.aclose()

    async def get(self, path: str, **query: Any) -> Any:
        """Return the JSON of an answer."""
        given = {name: value for name, value in query.items() if value is not None}
        return (await self._ask("GET", path, params=given)).json()

    async def read(self, path: str) -> tuple[bytes, str]:
        """Return an answer's bytes and their type."""
        answer = await self._ask("GET", path)
        return answer.content, answer.headers.get("content-type", "application/octet-stream")

    async def post(self, path: str, body: dict[str, Any] | None = None) -> Any:
        """Ask for an act, and return the JSON of the answer."""
        return (await self._ask("POST", path, json=body or {})).json()

    async def name_agent(self) -> str:
        """Return the id of the agent that asks.

        Raises:
            DoorError: ``agent_token_needed``, or what the planner says.
        """
        token, now_s = TOKEN.get(), time.monotonic()
        known = self._known.get(token)
        if known is not None and now_s - known[0] < KNOWN_S:
            return known[1]
        told = await self.get("/v1/people") if token else {}
        you = told.get("you") or {}
        if you.get("role") != ROLE:
            raise DoorError("agent_token_needed", NO_AGENT, 403)
        self._known[token] = (now_s, str(you["id"]))
        if len(self._known) > MOST_KNOWN:
            self._known.popitem(last=False)
        return str(you["id"])

    async def _ask(self, method: str, path: str, **more: Any) -> httpx.Response:
        headers = {"authorization": f"Bearer {TOKEN.get()}"}
        try:
            answer = await self._client.request(method, path, headers=headers, **more)
        except httpx.HTTPError as error:
            raise DoorError("planner_down", UNREACHED) from error
        if answer.is_success:
            return answer
        raise _refusal(answer)


def _refusal(answer: httpx.Response) -> DoorError:
    try:
        problem = answer.json()
    except ValueError:
        problem = {}
    code = str(problem.get("code", f"http_{answer.status_code}"))
    told, detail = problem.get("message"), str(problem.get("detail", ""))
    said = str(told.get("en", "")) if isinstance(told, dict) else ""
    parts = dict.fromkeys(part for part in (said, detail) if part)
    return DoorError(code, " ".join(parts)[:600] or "refused", answer.status_code)
