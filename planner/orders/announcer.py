"""Tell what becomes of standing orders: on every page that listens, and to the owner where set."""

from __future__ import annotations

import logging
from typing import TYPE_CHECKING, Any

from planner.language.catalogue import say
from planner.orders.notifier import Message
from planner.orders.telling import tell_missed, tell_reminder

if TYPE_CHECKING:
    from collections.abc import Callable
    from datetime import tzinfo

    from planner.orders.notifier import Notifier
    from planner.orders.order import Firing, StandingOrder
    from planner.plan import Bilingual

log = logging.getLogger(__name__)


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
