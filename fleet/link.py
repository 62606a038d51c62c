"""Ask one robot over its HTTP API, judged by its pin; silence, refusal, a wrong robot differ."""

from __future__ import annotations

import asyncio
import json
import ssl
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

import httpx

from fleet.errors import FleetError

if TYPE_CHECKING:
    from collections.abc import Mapping

    from fleet.pin import Pin

TIMEOUT = httpx.Timeout(5.0, connect=2.0)
MAX_ANSWER_BYTES = 4_000_000
WHOLE_S = 20.0
"""So long may one answer take to come whole."""
TRY_AGAIN = frozenset({408, 429, 500, 502, 503, 504})
TOKEN_REFUSED = frozenset({401, 403})


class RobotAway(Exception):
    """No answer came: nothing is known of whether the robot acted."""


class RobotBusy(Exception):
    """The robot answered that it can't now; nothing was done, and the same may be asked again."""


class RobotRefusal(Exception):
    """The robot answered and refused; ``code`` is its own, or of the pin's."""

    def __init__(self, status: int, code: str, detail: str, told: Mapping[str, Any] | None) -> None:
        super().__init__(f"{code}: {detail}")
        self.status, self.code, self.detail = status, code, detail
        self.message = {"en": detail, "zh": detail, **(told or {})}


@dataclass(slots=True)
class FleetLink:
    """Hold the connections to one robot."""

    name: str
    url: str
    robot_id: str
    pin: Pin
    token: str = field(repr=False)
    is_proven: bool = False
    """The robot at the other end has told the id that it was added with, since it was last away."""
    _client: httpx.AsyncClient | None = field(default=None, repr=False)

    async def close(self) -> None:
        """Close all connections."""
        if self._client is not None:
            await self._client.aclose()
            self._client = None

    async def get(self, path: str, **query: Any) -> Any:
        """Return the JSON of an answer. Raises as ``ask``."""
        return await self.ask("GET", path, query=query)

    async def post(self, path: str, body: Mapping[str, Any] | None = None, key: str = "") -> Any:
        """Ask for an act, known again by its key where it has one. Raises as ``ask``."""
        return await self.ask("POST", path, body=body or {}, key=key)

    async def prove(self) -> dict[str, Any]:
        """Return the robot's card, once it tells the id that was added.

        Raises:
            RobotAway, RobotBusy: it can't be told now.
            RobotRefusal: ``robot_mismatch``: another robot answers here; or as of ``ask``.
        """
        card: dict[str, Any] = await self.get("/v1/capabilities")
        found = str(card.get("robot_id", "?"))[:64]
        if found != self.robot_id:
            self.is_proven = False
            wrong = FleetError("robot_mismatch", name=self.name, found=found)
            raise RobotRefusal(409, wrong.code, wrong.detail, wrong.message)
        self.is_proven = True
        return card

    async def ask(
        self,
        method: str,
        path: str,
        *,
        query: Mapping[str, Any] | None = None,
        body: Mapping[str, Any] | None = None,
        key: str = "",
    ) -> Any:
        """Return the JSON of an answer.

        Raises:
            RobotAway: no answer, or one that is no robot's.
            RobotBusy: it may be asked again.
            RobotRefusal: it said no, or shows another certificate (``pin_mismatch``).
        """  # fmt: skip
        headers = {"accept-encoding": "identity"}  # what is squeezed may unfold to any size
        if self.token:
            headers["authorization"] = f"Bearer {self.token}"
        if key:
            headers["idempotency-key"] = key
        try:
            async with (
                asyncio.timeout(WHOLE_S),
                self._open_client().stream(
                    method, path, params=dict(query or {}), json=body, headers=headers
                ) as answer,
            ):
                raw = await _read(answer)
        except TimeoutError:
            self.is_proven = False
            raise RobotAway(f"{self.url}: an answer that does not end") from None
        except httpx.HTTPError as error:
            self.is_proven = False
            if _is_certificates(error):
                wrong = FleetError("pin_mismatch", name=self.name)
                raise RobotRefusal(409, wrong.code, str(error), wrong.message) from None
            raise RobotAway(f"{self.url}: {str(error) or type(error).__name__}") from None
        return self._judge(answer, raw)

    def _open_client(self) -> httpx.AsyncClient:
        if self._client is None:
            self._client = httpx.AsyncClient(
                base_url=self.url, verify=self.pin.context(), timeout=TIMEOUT, trust_env=False,
                limits=httpx.Limits(max_connections=8, max_keepalive_connections=2),
            )  # fmt: skip
        return self._client

    def _judge(self, answer: httpx.Response, raw: bytes) -> Any:
        try:
            if len(raw) > MAX_ANSWER_BYTES:
                raise ValueError("too long")
            content = json.loads(raw)
        except (ValueError, RecursionError):
            if answer.status_code in TRY_AGAIN:
                raise RobotBusy(f"status {answer.status_code}") from None
            raise RobotAway(f"{self.url}: an answer that is no JSON") from None
        if answer.is_success:
            return content
        problem = content if isinstance(content, dict) else {}
        code = str(problem.get("code", f"http_{answer.status_code}"))[:64]
        detail, told = str(problem.get("detail", ""))[:600], problem.get("message")
        if answer.status_code in TRY_AGAIN:
            raise RobotBusy(f"{code}: {detail}")
        told = told if isinstance(told, dict) else None
        raise RobotRefusal(answer.status_code, code, detail, told)


async def _read(answer: httpx.Response) -> bytes:
    """Return an answer's body as it came, at most a little more than is accepted."""
    raw = bytearray()
    async for piece in answer.aiter_raw():
        raw += piece
        if len(raw) > MAX_ANSWER_BYTES:
            break
    return bytes(raw)


def _is_certificates(error: BaseException) -> bool:
    """Return whether a certificate was the trouble, however deep the libraries wrapped it."""
    seen: BaseException | None = error
    while seen is not None:
        if isinstance(seen, ssl.SSLCertVerificationError):
            return True
        seen = seen.__cause__ or seen.__context__
    return False
