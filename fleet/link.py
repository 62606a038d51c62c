"""Ask one robot over its HTTP API, judged by its pin; silence, refusal, a wrong robot differ."""

from __future__ import annotations

import json
import ssl
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

import httpx

from fleet.card import read_card
from fleet.errors import FleetError

if TYPE_CHECKING:
    from collections.abc import Mapping

    from fleet.pin import Pin

TIMEOUT = httpx.Timeout(5.0, connect=2.0)
MAX_ANSWER_BYTES = 4_000_000
TRY_AGAIN = frozenset({408, 429, 500, 502, 503, 504})
TOKEN_REFUSED = frozenset({401, 403})
_BY_THE_CLOCK = frozenset({9, 10})
"""OpenSSL's X509_V_ERR_CERT_NOT_YET_VALID and X509_V_ERR_CERT_HAS_EXPIRED."""


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
            RobotRefusal: ``robot_mismatch``: another robot answers here; ``card_unread``; or as of
                ``ask``.
        """
        try:
            card = read_card(await self.get("/v1/capabilities"), self.name)
        except FleetError as unread:
            raise RobotRefusal(502, unread.code, unread.detail, unread.message) from None
        found = str(card["robot_id"])
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
            RobotRefusal: it said no, or its certificate did not pass (``pin_mismatch``,
                ``certificate_dates``).
        """  # fmt: skip
        headers = {"authorization": f"Bearer {self.token}"} if self.token else {}
        if key:
            headers["idempotency-key"] = key
        try:
            answer = await self._open_client().request(
                method, path, params=dict(query or {}), json=body, headers=headers
            )
        except httpx.HTTPError as error:
            self.is_proven = False
            if (refused := _certificates_refusal(error)) is not None:
                dates = refused.verify_code in _BY_THE_CLOCK
                wrong = FleetError("certificate_dates" if dates else "pin_mismatch", name=self.name)
                raise RobotRefusal(409, wrong.code, str(error), wrong.message) from None
            raise RobotAway(f"{self.url}: {str(error) or type(error).__name__}") from None
        return self._judge(answer)

    def _open_client(self) -> httpx.AsyncClient:
        if self._client is None:
            self._client = httpx.AsyncClient(
                base_url=self.url, verify=self.pin.context(), timeout=TIMEOUT, trust_env=False,
                limits=httpx.Limits(max_connections=8, max_keepalive_connections=2),
            )  # fmt: skip
        return self._client

    def _judge(self, answer: httpx.Response) -> Any:
        try:
            if len(answer.content) > MAX_ANSWER_BYTES:
                raise ValueError("too long")
            content = json.loads(answer.content)
        except ValueError:
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


def _certificates_refusal(error: BaseException) -> ssl.SSLCertVerificationError | None:
    """Return why a certificate was refused, however deep the libraries wrapped it."""
    seen: BaseException | None = error
    while seen is not None:
        if isinstance(seen, ssl.SSLCertVerificationError):
            return seen
        seen = seen.__cause__ or seen.__context__
    return None
