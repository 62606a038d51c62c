"""Ask one robot over its HTTP API, judged by its pin; silence, refusal, a wrong robot differ."""

from __future__ import annotations

import asyncio
import json
import ssl
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

import httpx

from fleet.answers import check_answer, read_card
from fleet.errors import FleetError

if TYPE_CHECKING:
    from collections.abc import Mapping

    from fleet.pin import Pin

TIMEOUT = httpx.Timeout(5.0, connect=2.0)
WHOLE_S = 10.0
"""For one answer to its last byte: httpx bounds each read alone, were it of one byte."""
MAX_ANSWER_BYTES = {"/v1/map": 4_000_000}
MAX_OTHER_BYTES = 1_000_000
"""A planner's longest list has 0.9 MB; to read more of many robots would take others' turns."""
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
    """The robot has told the id that it was added with over the connection that was made last."""
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
        headers["accept-encoding"] = "identity"
        if key:
            headers["idempotency-key"] = key
        try:
            async with asyncio.timeout(WHOLE_S):
                status, raw = await self._fetch(method, path, query or {}, body, headers)
        except TimeoutError:
            self.is_proven = False
            raise RobotAway(f"{self.url}: no whole answer in {WHOLE_S:g} s") from None
        except httpx.HTTPError as error:
            self.is_proven = False
            if (refused := _certificates_refusal(error)) is not None:
                dates = refused.verify_code in _BY_THE_CLOCK
                wrong = FleetError("certificate_dates" if dates else "pin_mismatch", name=self.name)
                raise RobotRefusal(409, wrong.code, str(error), wrong.message) from None
            raise RobotAway(f"{self.url}: {str(error) or type(error).__name__}") from None
        content = self._judge(status, raw, MAX_ANSWER_BYTES.get(path, MAX_OTHER_BYTES))
        try:
            return check_answer(method, path, content)
        except ValueError as wrong:
            raise RobotAway(
                f"{self.url}: {method} {path} is answered by nonsense: {wrong}"
            ) from None

    async def _fetch(
        self, method: str, path: str, query: Mapping[str, Any], body: Mapping[str, Any] | None,
        headers: Mapping[str, str],
    ) -> tuple[int, bytes]:  # fmt: skip
        """Return an answer's status and bytes; of one that is too long, too many by some."""
        raw = bytearray()
        asked = self._open_client().stream(
            method, path, params=dict(query), json=body, headers=dict(headers),
            extensions={"trace": self._note_connection},
        )  # fmt: skip
        async with asked as answer:
            async for piece in answer.aiter_raw():  # unpacked here, a small one could be huge
                raw += piece
                if len(raw) > MAX_ANSWER_BYTES.get(path, MAX_OTHER_BYTES):
                    break
        return answer.status_code, bytes(raw)

    async def _note_connection(self, event: str, _told: Mapping[str, Any]) -> None:
        """Forget who answers where httpx connects anew: the robot may have been restarted."""
        if event == "connection.connect_tcp.started":
            self.is_proven = False

    def _open_client(self) -> httpx.AsyncClient:
        if self._client is None:
            self._client = httpx.AsyncClient(
                base_url=self.url, verify=self.pin.context(), timeout=TIMEOUT, trust_env=False,
                limits=httpx.Limits(max_connections=8, max_keepalive_connections=2),
            )  # fmt: skip
        return self._client

    def _judge(self, status: int, raw: bytes, most: int) -> Any:
        try:
            if len(raw) > most:
                raise ValueError("too long")
            content = json.loads(raw)
        except (ValueError, RecursionError):
            if status in TRY_AGAIN:
                raise RobotBusy(f"status {status}") from None
            raise RobotAway(f"{self.url}: an answer that is no JSON") from None
        if 200 <= status < 300:
            return content
        problem = content if isinstance(content, dict) else {}
        code = str(problem.get("code", f"http_{status}"))[:64]
        detail, told = str(problem.get("detail", ""))[:600], problem.get("message")
        if status in TRY_AGAIN:
            raise RobotBusy(f"{code}: {detail}")
        told = told if isinstance(told, dict) else {}
        told = {str(name)[:8]: text[:600] for name, text in told.items() if isinstance(text, str)}
        raise RobotRefusal(status, code, detail, told)


def _certificates_refusal(error: BaseException) -> ssl.SSLCertVerificationError | None:
    """Return why a certificate was refused, however deep the libraries wrapped it."""
    seen: BaseException | None = error
    while seen is not None:
        if isinstance(seen, ssl.SSLCertVerificationError):
            return seen
        seen = seen.__cause__ or seen.__context__
    return None
