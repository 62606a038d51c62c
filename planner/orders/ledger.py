"""Write down what the scheduler asks, and hand back what is then to be done. Gives no goal.

Law: an order and all its firings that are not written yet go to disk in one transaction. An order
is written as it is by now, which is beyond each of them: written alone it would say that a run is
over of which the disk knows nothing, and after a kill nobody would tell it.
"""

from __future__ import annotations

import asyncio
import logging
from collections import deque
from contextlib import suppress
from dataclasses import dataclass
from typing import TYPE_CHECKING

from planner.orders.scheduler import Fire, Keep, Note

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping

    from planner.orders.order import Firing, StandingOrder
    from planner.orders.store import OrderStore

log = logging.getLogger(__name__)

MOST_OWED = 1000
"""Entries that a full disk refused are tried again; so many are kept for it."""


@dataclass(frozen=True, slots=True)
class End:
    """Write down what became of a firing."""

    order: StandingOrder
    firing: Firing


Request = Fire | Note | Keep | End


@dataclass(frozen=True, slots=True)
class LedgerEntry:
    """Hold a request that was written down, or that could not be."""

    request: Request
    is_written: bool
    kept: Firing | None = None
    """The firing as the disk has it: with the count of those before that came to the same."""


class FiringLedger:
    """Be the one writer of standing orders and their firings."""

    def __init__(
        self, store: OrderStore, orders: Callable[[], Mapping[str, StandingOrder]]
    ) -> None:
        """Take the tables, and how all orders are read as they are by now."""
        self._store, self._orders = store, orders
        self.trouble: str | None = None
        """Why nothing can be written down, or None."""
        self._asked: deque[Request] = deque()
        self._entries: deque[LedgerEntry] = deque()
        self._wake = asyncio.Event()
        self._lock = asyncio.Lock()

    def ask(self, request: Request) -> None:
        """Have a request written down, soon."""
        self._asked.append(request)
        self._wake.set()

    def ask_again(self, request: Request) -> None:
        """Have a request that the disk has refused written with whatever comes next."""
        if len(self._asked) < MOST_OWED:
            self._asked.append(request)

    async def wait(self, limit_s: float) -> None:
        """Return when there is something to write, or after a while."""
        with suppress(TimeoutError):
            async with asyncio.timeout(limit_s):
                await self._wake.wait()
        self._wake.clear()

    async def write(self) -> tuple[LedgerEntry, ...]:
        """Write down all that was asked for; return it, and what ``keep`` has written meanwhile."""
        async with self._lock:
            if self._asked:
                try:
                    await self._write(())
                except OSError as error:
                    self._complain(error)
                    self._entries += [LedgerEntry(each, is_written=False) for each in self._asked]
                    self._asked.clear()
            entries = tuple(self._entries)
            self._entries.clear()
        return entries

    async def keep(self, *new: StandingOrder, seen_unix_s: float | None = None) -> None:
        """Write down orders, and with them all that was asked for; on return it is on disk.

        Raises:
            StateUnavailable: it can't be written; nothing has changed.
        """
        async with self._lock:
            await self._write(new, seen_unix_s)
            self._wake.set()

    async def remove(self, order_id: str) -> None:
        """Forget an order and its firings. Raises StateUnavailable."""
        async with self._lock:
            await asyncio.to_thread(self._store.remove, order_id)

    async def see(self, unix_s: float) -> None:
        """Write down how far the clock is. Raises StateUnavailable."""
        await asyncio.to_thread(self._store.see, unix_s)

    async def _write(
        self, new: tuple[StandingOrder, ...], seen_unix_s: float | None = None
    ) -> None:
        known, asked = self._orders(), tuple(self._asked)
        live = [each for each in asked if each.order.id in known]  # the others were removed
        orders = {each.order.id: known[each.order.id] for each in live}
        orders |= {order.id: order for order in new}
        firings = [each.firing for each in live if not isinstance(each, Keep)]
        written = iter(
            await asyncio.to_thread(self._store.keep, orders.values(), firings, seen_unix_s)
        )
        self.trouble = None
        for _ in asked:  # what was asked for meanwhile stays
            self._asked.popleft()
        for each in live:
            kept = next(written) if not isinstance(each, Keep) else None
            self._entries.append(LedgerEntry(each, is_written=True, kept=kept))

    def _complain(self, error: OSError) -> None:
        if self.trouble is None:
            log.error("orders_unwritable: %s", error)
        self.trouble = str(error)
