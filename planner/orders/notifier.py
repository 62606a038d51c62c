"""Tell what becomes of standing orders: on every page that listens, and to the owner where set.

The owner is told at the one address that the owner named. Blocks nothing and keeps nothing. A
message is tried three times within half a minute and then dropped, with a line in the log; while
the address does not answer, at most ``MOST_WAITING`` wait and the oldest gives way. Where it may be
and what leaves with it is ``planner.outbound``'s law: no redirect, no proxy, no metadata service.
"""

from __future__ import annotations

import asyncio
import contextlib
import logging
from collections import deque
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from planner.language.catalogue import say
from planner.loops import keep_going
from planner.orders.telling import tell_missed, tell_reminder
from planner.outbound import Address, CallFailure

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping
    from datetime import tzinfo

    from planner.orders.order import Firing, StandingOrder
    from planner.outbound.caller import Caller
    from planner.plan import Bilingual, Language
    from planner.settings import NotifySettings

log = logging.getLogger(__name__)

PAUSES_S = (0.0, 2.0, 10.0)
TIMEOUT_S = 5.0
MOST_WAITING = 32
MOST_CHARACTERS = 1000
TITLE = "Pons"
MOST_ANSWER_BYTES = 65_536
_AGAIN = frozenset({"unreachable", "timeout", "rate_limited", "server_error"})
"""Failures after which another try may do better."""


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
        token: str = "",
        transport: Any = None,
        pauses_s: tuple[float, ...] = PAUSES_S,
    ) -> None:
        """Take the address; ``transport`` and ``pauses_s`` are the tests' own.

        Raises:
            ConfigError: ``orders.notify_url``: it leads nowhere that may be asked.
        """
        self._settings, self._token, self._pauses_s = settings, token, pauses_s
        self._address = Address.parse(settings.url, "", "orders.notify")
        self._transport = transport
        self._caller: Caller | None = None
        self._waiting: deque[Message] = deque()
        self._wake = asyncio.Event()
        self._task: asyncio.Task[None] | None = None
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
            self._task = asyncio.create_task(keep_going("notify", self._run), name="notify")

    async def close(self) -> None:
        """End at once; what was not sent yet is dropped."""
        if self._task is not None:
            self._task.cancel()
            with contextlib.suppress(asyncio.CancelledError):
                await self._task
        if self._caller is not None:
            await self._caller.close()

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
        if self._caller is None:
            from planner.outbound.caller import Caller  # httpx costs 0.1 s: only where one is told

            self._caller = Caller(
                self._address, self._token, timeout_s=TIMEOUT_S, transport=self._transport
            )
        why = ""
        for pause_s in self._pauses_s:
            await asyncio.sleep(pause_s)
            try:
                async with asyncio.timeout(TIMEOUT_S):
                    await self._post(self._caller, message)
            except CallFailure as failure:
                why = failure.why
                if why not in _AGAIN:
                    break
            except TimeoutError:
                why = "timeout"
            else:
                return True
        log.warning(
            "notify_failed: %s was not told (%s): %s", self._address.host, message.kind, why
        )
        return False

    async def _post(self, caller: Caller, message: Message) -> None:
        headers = self._headers(message)
        if self._settings.form == "ntfy":
            text = self._text(message).encode()
            await caller.post(most_bytes=MOST_ANSWER_BYTES, content=text, headers=headers)
        else:
            body = self._body(message)
            await caller.post(most_bytes=MOST_ANSWER_BYTES, json=body, headers=headers)

    def _headers(self, message: Message) -> Mapping[str, str]:
        if self._settings.form != "ntfy":
            return {}
        urgent = message.kind in ("failed", "missed", "asks")
        return {"Title": TITLE, "Tags": message.kind, "Priority": "4" if urgent else "3"}

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


class OrderAnnouncer:
    """Say each thing once, at once; nothing is waited for."""

    def __init__(
        self,
        publish: Callable[[dict[str, Any]], None],
        notifier: Notifier | None,
        zone: tzinfo,
        unix_s: Callable[[], float],
    ) -> None:
        self._publish, self._notifier, self._zone, self._unix_s = publish, notifier, zone, unix_s
        self.told_unix_s: dict[str, float] = {}
        """When each reminder's words were last told, by this process; also as missed."""

    def tell_missed(self, order: StandingOrder, firing: Firing) -> None:
        """Tell that a run was missed, and why."""
        told = tell_missed(order, firing, self._zone, self._unix_s())
        self._note(order)
        self._tell(order, "missed", firing.reason or "late", told, firing)

    def tell_reminder(self, order: StandingOrder, firing: Firing) -> None:
        """Tell a reminder's words as it fires."""
        self._note(order)
        self._tell(order, "reminder", "reminder", tell_reminder(order), firing)

    def tell_outcome(
        self, order: StandingOrder, kind: str, code: str, outcome: Bilingual, firing: Firing
    ) -> None:
        """Tell how a firing's goal ended, or what it asks."""
        told = say("standing.ended", text=order.text, outcome=outcome)
        self._tell(order, kind, code, told, firing)

    async def close(self) -> None:
        """End the telling; what was not sent yet is dropped."""
        if self._notifier is not None:
            await self._notifier.close()

    def _note(self, order: StandingOrder) -> None:
        if order.reminder is not None:
            self.told_unix_s[order.id] = self._unix_s()

    def _tell(
        self, order: StandingOrder, kind: str, code: str, told: Bilingual, firing: Firing
    ) -> None:
        log.info("standing order %s: %s (%s)", order.id, kind, code)
        self._publish(
            {
                "type": "told",
                "order": order.id,
                "kind": kind,
                "code": code,
                "message": told.model_dump(),
            }
        )
        if self._notifier is not None:
            self._notifier.tell(
                Message(kind, order.id, code, order.language, told, firing.due_unix_s)
            )
