"""Tell the owner, at the one address that the owner named. Blocks nothing and keeps nothing.

A message is tried three times within half a minute and then dropped, with a line in the log; while
the address does not answer, at most ``MOST_WAITING`` wait and the oldest gives way. No redirect is
followed, no proxy of the environment used: words go to the named host or nowhere.
"""

from __future__ import annotations

import asyncio
import contextlib
import logging
from collections import deque
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any
from urllib.parse import urlsplit

if TYPE_CHECKING:
    from collections.abc import Mapping

    import httpx

    from planner.plan import Bilingual, Language
    from planner.settings import NotifySettings

log = logging.getLogger(__name__)

PAUSES_S = (0.0, 2.0, 10.0)
TIMEOUT_S = 5.0
MOST_WAITING = 32
MOST_CHARACTERS = 1000
TITLE = "Pons"
_AGAIN = frozenset({408, 425, 429})
_REFUSED, _BROKEN = 400, 500


@dataclass(frozen=True, slots=True)
class Message:
    """Hold what the owner is told once."""

    kind: str
    """``reminder``, ``missed``, ``failed``, ``done`` or ``asks``."""
    order: str
    code: str
    language: Language
    text: Bilingual
    at_unix_s: float


class Notifier:
    """Send messages one after the other, beside everything else."""

    def __init__(
        self,
        settings: NotifySettings,
        token: str | None = None,
        client: httpx.AsyncClient | None = None,
        pauses_s: tuple[float, ...] = PAUSES_S,
    ) -> None:
        """Take the address; ``client`` and ``pauses_s`` are the tests' own."""
        self._settings, self._token, self._pauses_s = settings, token, pauses_s
        self._client = client
        self._waiting: deque[Message] = deque()
        self._wake = asyncio.Event()
        self._task: asyncio.Task[None] | None = None
        self._host = urlsplit(settings.url).hostname or ""
        self.sent = self.dropped = 0

    def tell(self, message: Message) -> None:
        """Have a message sent; returns at once."""
        if message.kind not in self._settings.tells:
            return
        if len(self._waiting) >= MOST_WAITING:
            self._waiting.popleft()
            self.dropped += 1
        self._waiting.append(message)
        self._wake.set()
        if self._task is None:
            self._task = asyncio.create_task(self._run(), name="notify")

    async def close(self) -> None:
        """End at once; what was not sent yet is dropped."""
        if self._task is not None:
            self._task.cancel()
            with contextlib.suppress(asyncio.CancelledError):
                await self._task
        if self._client is not None:
            await self._client.aclose()

    async def _run(self) -> None:
        while True:
            await self._wake.wait()
            self._wake.clear()
            while self._waiting:
                message = self._waiting.popleft()
                if await self._send(message):
                    self.sent += 1
                else:
                    self.dropped += 1

    async def _send(self, message: Message) -> bool:
        import httpx  # it costs 0.1 s: only where somebody is told

        if self._client is None:
            self._client = httpx.AsyncClient(
                timeout=TIMEOUT_S, follow_redirects=False, trust_env=False
            )
        why = ""
        for pause_s in self._pauses_s:
            await asyncio.sleep(pause_s)
            try:
                status = await asyncio.wait_for(self._post(message), TIMEOUT_S)
            except (httpx.HTTPError, httpx.InvalidURL, OSError, TimeoutError) as error:
                why = type(error).__name__
                continue
            if status < 300:  # HTTP's own
                return True
            why = f"status {status}"
            if _REFUSED <= status < _BROKEN and status not in _AGAIN:
                break
        log.warning("notify_failed: %s was not told (%s): %s", self._host, message.kind, why)
        return False

    async def _post(self, message: Message) -> int:
        if self._client is None:
            raise OSError("closed")
        headers = self._headers(message)
        if self._settings.form == "ntfy":
            text = self._text(message).encode()
            async with self._client.stream(
                "POST", self._settings.url, content=text, headers=headers
            ) as answer:
                return answer.status_code
        body = self._body(message)
        async with self._client.stream(
            "POST", self._settings.url, json=body, headers=headers
        ) as answer:  # the answer's body is nobody's: it is not read
            return answer.status_code

    def _headers(self, message: Message) -> Mapping[str, str]:
        headers = {"User-Agent": "pons"}
        if self._token is not None:
            headers["Authorization"] = f"Bearer {self._token}"
        if self._settings.form == "ntfy":
            urgent = message.kind in ("failed", "missed", "asks")
            headers |= {"Title": TITLE, "Tags": message.kind, "Priority": "4" if urgent else "3"}
        return headers

    def _text(self, message: Message) -> str:
        if not self._settings.words:
            return f"{message.kind}: {message.order} ({message.code})"
        return message.text.of(message.language)[:MOST_CHARACTERS]

    def _body(self, message: Message) -> dict[str, Any]:
        body: dict[str, Any] = {
            "kind": message.kind, "order": message.order, "code": message.code,
            "at_unix_s": round(message.at_unix_s, 3),
        }  # fmt: skip
        if self._settings.words:
            text = message.text
            body["text"] = {"en": text.en[:MOST_CHARACTERS], "zh": text.zh[:MOST_CHARACTERS]}
        return body
