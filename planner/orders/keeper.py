"""Run the standing orders: tick, write down, give goals, tell. The shell around the scheduler.

Ten times a second the scheduler is told clocks and world; what it asks is written down by the
ledger and then done in order by one task, so that a slow disk delays standing orders and nothing
else. Every firing is on disk before its goal is given.
"""

from __future__ import annotations

import asyncio
import contextlib
import logging
from collections.abc import Callable
from dataclasses import replace
from typing import TYPE_CHECKING, Any

from planner.mission.errors import MissionError
from planner.mission.state import ORDER_SOURCE, Mission, MissionState
from planner.orders import scheduler, world
from planner.orders.interfaces import GoalGiver, OrderClocks
from planner.orders.ledger import End, FiringLedger, LedgerEntry
from planner.orders.notifier import Notifier, OrderAnnouncer
from planner.orders.order import Firing, FiringState, StandingOrder, key_of, new_nonce
from planner.orders.world import Watch, notice
from planner.plan import Bilingual, GoalState, QuietHours
from planner.state_database import StateUnavailable

if TYPE_CHECKING:
    from datetime import tzinfo

    from planner.navigation import ObstacleReport
    from planner.orders.store import OrderStore

log = logging.getLogger(__name__)

TICK_S = 0.1
SEEN_EVERY_S = 600.0
"""How far the clock is, is written down so often while there are orders."""
UNWRITABLE = "orders_unwritable"
MOST_ENDED = 20
"""Orders that were due once and are over stay so many, to be looked up."""


class OrderKeeper:
    """Own the order book while the planner runs."""

    def __init__(
        self,
        store: OrderStore,
        goals: GoalGiver,
        zone: tzinfo,
        quiet: QuietHours | None = None,
        notifier: Notifier | None = None,
        clocks: OrderClocks | None = None,
        report: Callable[[], ObstacleReport | None] = lambda: None,
    ) -> None:
        """Put the parts together; nothing is read yet."""
        self.book = scheduler.OrderBook(zone, quiet)
        self.version = 0  # rises with every change
        self.last_number = 0  # the highest that an order ever had, here or by the goals it gave
        self.failure: BaseException | None = None
        self._store, self.goals = store, goals
        self._ledger = FiringLedger(store, lambda: self.book.orders)
        self.clocks, self._report = clocks or OrderClocks(), report
        self.announcer = OrderAnnouncer(goals.publish, notifier, zone, self._unix_s)
        self._open: dict[str, Firing] = {}
        self._asked: set[str] = set()
        self._watch = Watch()
        self._ended: frozenset[str] | None = None
        self._done = self._failed = 0
        self._seen_s = float("-inf")
        self._tasks: list[asyncio.Task[None]] = []
        self.lock = asyncio.Lock()  # held while an order is taken or changed

    # Life ---------------------------------------------------------------------------------------

    async def start(self, *, rounds: bool = True) -> None:
        """Take up what is kept. A firing that was cut off is told, and never begun again.

        Raises:
            ConfigError, StateUnavailable: it can't be read.
        """
        orders, firings, seen_unix_s, number = await asyncio.to_thread(self._store.load)
        self.last_number = max(number, world.highest_number(self.goals.book.missions.values()))
        self.book = replace(self.book, floor_unix_s=seen_unix_s)
        for order in orders:
            self.book = scheduler.put(self.book, order)
        for firing in firings:
            self._take_up(firing)
        for old in (order for order in orders if not order.nonce):  # kept by an older program
            self._ledger.ask(
                scheduler.Keep(renewed := old.model_copy(update={"nonce": new_nonce()}))
            )
            self.book = scheduler.put(self.book, renewed)
        await self.work_off()
        if rounds:
            self._tasks = [
                asyncio.create_task(self._guard(self._tick_on()), name="standing orders"),
                asyncio.create_task(self._guard(self._work_on()), name="firings"),
            ]

    async def close(self) -> None:
        """End; what is due meanwhile is told at the next start."""
        for task in self._tasks:
            task.cancel()
        await asyncio.gather(*self._tasks, return_exceptions=True)
        await self.announcer.close()

    async def _guard(self, work: Any) -> None:
        try:
            await work
        except asyncio.CancelledError:
            raise
        except Exception as error:
            self.failure = error
            log.exception("the standing orders ended")
            raise

    @property
    def trouble(self) -> str | None:
        """Return why nothing can be written down, or None."""
        return self._ledger.trouble

    def _take_up(self, firing: Firing) -> None:
        order = self.book.orders.get(firing.order)
        if order is None:
            return
        goal = firing.goal or self.goals.find(key_of(order, firing.serial))
        if goal is None:
            self._miss(order, firing, scheduler.INTERRUPTED)
            return
        given = firing.model_copy(update={"state": FiringState.GIVEN, "goal": goal})
        self._open[firing.order] = given
        if given != firing:
            self._ledger.ask(End(order, given))
        if order.reminder is not None and self.goals.outcome(goal) is None:
            self.announcer.tell_reminder(order, given)  # it may not have been said to its end

    def _unix_s(self) -> float:
        return self.clocks.unix()

    # Time ---------------------------------------------------------------------------------------

    async def _tick_on(self) -> None:
        while True:
            self.turn()
            await asyncio.sleep(TICK_S)

    def turn(self) -> None:
        """Look at clocks and world once, and have done what follows."""
        now, awake_s, book = self.clocks.read(), self.clocks.monotonic(), self.goals.book
        ended, done, failed = world.count_ended(book.missions, self._ended or frozenset())
        if self._ended is not None:
            self._done, self._failed = self._done + done, self._failed + failed
        self._ended = ended
        facts = world.facts_now(book, self._report(), awake_s, self._done, self._failed)
        self._watch, happened = notice(self._watch, facts, awake_s)
        told = scheduler.RobotView(world.hindrance(book, awake_s), self._busy(book), happened)
        self.book, effects = scheduler.tick(self.book, told, now)
        for effect in effects:
            if isinstance(effect, scheduler.Fire):  # from now on, not from when it is written
                self._give_up(self._open.get(effect.order.id))
                self._open[effect.order.id] = effect.firing
            self._ledger.ask(effect)
        self._follow_goals()

    def _busy(self, book: MissionState) -> frozenset[str]:
        """Return the orders whose last goal is under way; a paused one gives way to the next."""
        paused = {i for i, m in book.missions.items() if m.state is GoalState.PAUSED}
        return frozenset(name for name, f in self._open.items() if f.goal not in paused)

    def _give_up(self, before: Firing | None) -> None:
        """End the paused goal of an order's last run: two of one order never wait."""
        if before is not None and before.goal is not None:
            self.goals.cancel(before.goal)

    async def _work_on(self) -> None:
        while True:
            await self._ledger.wait(1.0)
            await self.work_off()
            await self._note_clock()

    async def work_off(self) -> None:
        """Write down all that is asked for until now, and do it."""
        while entries := await self._ledger.write():
            for entry in entries:
                await self._do(entry)
            if not entries[-1].is_written:  # what the disk owes is tried again later
                return

    async def _do(self, entry: LedgerEntry) -> None:
        request = entry.request
        order = self.book.orders.get(request.order.id)  # as it is by now
        if order is None:  # removed meanwhile
            return
        match request:
            case scheduler.Fire(_, firing) if entry.is_written:
                await self._fire(order, firing)
            case scheduler.Fire(_, firing):
                self._miss(order, firing, UNWRITABLE)
            case scheduler.Note(_, firing):
                new = entry.kept is None or entry.kept.count == firing.count  # first in a row
                if firing.state is FiringState.MISSED and new:
                    self.announcer.tell_missed(order, firing)
                if not entry.is_written:
                    self._ledger.ask_again(End(order, firing))
            case scheduler.Keep() | End() if not entry.is_written:
                self._ledger.ask_again(request)
                return
        self.publish_change()

    async def _fire(self, order: StandingOrder, firing: Firing) -> None:
        key, source = key_of(order, firing.serial), f"{ORDER_SOURCE}{order.id}"
        try:
            goal = await self.goals.give(
                self.clocks.new_id(), order.order, order.language, key, source, order.steps
            )
        except MissionError as refused:
            self._miss(order, firing, refused.code)
            return
        given = firing.model_copy(update={"state": FiringState.GIVEN, "goal": goal})
        self._open[order.id] = given
        self._ledger.ask(End(order, given))
        if order.reminder is not None:
            self.announcer.tell_reminder(order, firing)

    def _miss(self, order: StandingOrder, firing: Firing, why: str) -> None:
        """Tell that a run which was begun is missed after all, and count it so."""
        self._open.pop(order.id, None)
        missed = firing.model_copy(update={"state": FiringState.MISSED, "reason": why})
        counted = self.book.orders[order.id].model_copy(
            update={"fired": max(0, order.fired - 1), "missed": order.missed + 1}
        )
        self.book = replace(self.book, orders={**self.book.orders, order.id: counted})
        self._ledger.ask(End(counted, missed))
        self.announcer.tell_missed(counted, missed)

    def _follow_goals(self) -> None:
        """Note the firings whose goals have ended, and tell those that wait for a word."""
        for name, firing in tuple(self._open.items()):
            if firing.goal is None:
                continue
            order = self.book.orders.get(name)
            mission = self.goals.outcome(firing.goal)
            gone = firing.goal not in self.goals.book.missions
            if order is None or gone:
                del self._open[name]
            elif mission is not None:
                del self._open[name]
                self._end(order, firing, mission)
            elif self.goals.waits(firing.goal) and firing.goal not in self._asked:
                self._asked.add(firing.goal)
                asking = self.goals.book.missions[firing.goal].outcome
                if asking is not None:
                    words = asking.message
                    self.announcer.tell_outcome(order, "asks", asking.code.value, words, firing)

    def _end(self, order: StandingOrder, firing: Firing, mission: Mission) -> None:
        outcome = mission.outcome
        code = outcome.code.value if outcome is not None else mission.state.value
        words = outcome.message if outcome is not None else Bilingual(en=code, zh=code)
        ended = firing.model_copy(update={"state": FiringState.ENDED, "code": code, "told": words})
        self._asked.discard(mission.id)
        self._ledger.ask(End(order, ended))
        done = mission.state is GoalState.SUCCEEDED
        if not (done and order.reminder is not None):  # its words were told as it fired
            kind = "done" if done else "failed"
            self.announcer.tell_outcome(order, kind, code, words, firing)
        self.publish_change()

    async def _note_clock(self) -> None:
        """Write down how far the clock is: a later start behind it is not believed."""
        now = self.clocks.read()
        if not self.book.orders or now.monotonic_s - self._seen_s < SEEN_EVERY_S or self.book.unset:
            return
        self._seen_s = now.monotonic_s
        with contextlib.suppress(OSError):
            await self._ledger.see(now.unix_s)

    # Orders -------------------------------------------------------------------------------------

    async def keep(self, order: StandingOrder) -> None:
        """Keep an order that a person gives; on return it is on disk.

        Raises:
            StateUnavailable: it can't be written; nothing has changed.
        """
        await self._ledger.keep(order, seen_unix_s=self.clocks.unix())
        self.last_number = max(self.last_number, order.number)
        self.book = scheduler.add(self.book, order)
        over = [o for o in self.book.orders.values() if o.ended and o.id not in self._open]
        for old in sorted(over, key=lambda o: o.number)[: max(0, len(over) - MOST_ENDED)]:
            await self._ledger.remove(old.id)
            self.book = scheduler.drop(self.book, old.id)
        self.publish_change()

    async def revise(self, order_id: str, **changes: Any) -> StandingOrder:
        """Change an order. It changes at once: no run begins by the old one while it is written.

        Raises:
            StateUnavailable: it can't be written; it is as before.
        """
        before = self.book.orders[order_id]
        changed = before.model_copy(update=changes)
        self.book = (scheduler.add if "rule" in changes else scheduler.put)(self.book, changed)
        try:
            await self._ledger.keep(changed)
        except StateUnavailable:
            names = changes.keys() - {"handled_unix_s"}  # runs may have come meanwhile
            old = {name: getattr(before, name) for name in names}
            self.book = scheduler.put(self.book, self.book.orders[order_id].model_copy(update=old))
            raise
        self.publish_change()
        return changed

    async def remove(self, order_id: str) -> None:
        """Forget an order. Raises StateUnavailable."""
        await self._ledger.remove(order_id)
        self.book = scheduler.drop(self.book, order_id)
        self._open.pop(order_id, None)
        self.announcer.told_unix_s.pop(order_id, None)
        self.publish_change()

    async def history(self, order_id: str, most: int) -> tuple[Firing, ...]:
        """Return an order's newest firings. Raises StateUnavailable."""
        return await asyncio.to_thread(self._store.history, order_id, most)

    async def newest(self, most: int) -> tuple[Firing, ...]:
        """Return the newest firings of all orders. Raises StateUnavailable."""
        return await asyncio.to_thread(self._store.newest, most)

    # Telling ------------------------------------------------------------------------------------

    def publish_change(self) -> None:
        """Have pages ask for the orders anew."""
        self.version += 1
        self.goals.publish({"type": "orders", "version": self.version})
