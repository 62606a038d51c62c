"""Decide which standing orders fire now. Pure: told the clocks and the world, answers what to do.

Laws, each held by a test:
- A run fires at most once, whatever restarts, and whatever the clock does: all that was due until
  ``handled_unix_s`` is over, and that is written down before the goal is given.
- A run that did not fire is told: it was missed, with the reason, or left out in quiet hours.
- What was missed is never caught up: one run fires, the newest, or none.
- Nothing fires while the robot is held, disarmed or paused by a person.

Time has two clocks: ``unix_s``, by which people live and which may jump, and ``monotonic_s``, which
never does, and goes on while the machine is suspended. Where they part by over a second, the clock
was put right: rules that were counted from an instant ("in 20 minutes") move along, times of day
stay.
"""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING

from planner.orders.order import COOLDOWN_S, Firing, FiringState, StandingOrder, end_pauses
from planner.orders.rule import day_at, is_quiet, next_run
from planner.plan import QuietHours
from planner.plan.timing import AtRule, EventRule, EveryRule, WorldEvent

if TYPE_CHECKING:
    from datetime import tzinfo

STEP_S = 1.0
"""The clocks may part by so much between two ticks before that is a step; slewing is slower."""
LATE_S = 60.0
"""A run fires so late at most, where the planner was held up; one of before its start, never."""
WAITS_S = 10.0
"""For the bridge's first word, after a start."""
BACK_S = 26 * 3600.0
"""A clock that is put back by more was wrong before, and so were the runs of that time."""
UNSET_S = 600.0
"""A clock that is behind what was written down before is not believed for so long."""
BEHIND_S = 60.0
NEVER_SET_UNIX_S = 1_793_491_200.0
"""2026-11-01, before this was written: a clock that shows less was reset, and is not set yet."""
MOST_COUNTED = 1000
"""Missed runs that are counted; more are "at least so many"."""
BRIDGE_SILENT = "bridge_silent"
WAS_OFF, CLOCK_MOVED, LATE = "was_off", "clock_moved", "late"
STILL_RUNNING, INTERRUPTED = "still_running", "interrupted"


@dataclass(frozen=True, slots=True)
class ClockReading:
    """Hold now on both clocks."""

    unix_s: float
    monotonic_s: float


@dataclass(frozen=True, slots=True)
class RobotView:
    """Say what the scheduler must know of the robot."""

    hindrance: str | None = None
    """Why nothing may fire now (a stable code), or None."""
    busy: frozenset[str] = frozenset()
    """Orders whose last goal has not ended."""
    happened: tuple[WorldEvent, ...] = ()
    """What was noticed since the last tick."""


@dataclass(frozen=True, slots=True)
class OrderBook:
    """Hold all standing orders of one robot. Frozen; its dictionaries are replaced, not changed."""

    zone: tzinfo
    quiet: QuietHours | None = None
    orders: dict[str, StandingOrder] = field(default_factory=dict)
    due: dict[str, float] = field(default_factory=dict)
    """When each order is due next; orders upon events have none."""
    began: ClockReading | None = None
    """The first tick of this process."""
    ticked: ClockReading | None = None
    floor_unix_s: float = 0.0
    """The clock was once this far: before it, it may not be set yet."""
    fired_s: dict[str, float] = field(default_factory=dict)
    """When each order upon an event last fired, monotonic."""
    stepped: bool = False
    """The clock was put right just now."""
    unset: bool = False
    """The clock began behind the floor, and nobody has set it yet."""
    fresh: frozenset[str] = frozenset()
    """Orders given to this process: their instants are on its clock, right or wrong."""


@dataclass(frozen=True, slots=True)
class Fire:
    """Write this firing down with its order, then give its goal."""

    order: StandingOrder
    firing: Firing


@dataclass(frozen=True, slots=True)
class Note:
    """Write down a run that did not fire, and tell it where it was missed."""

    order: StandingOrder
    firing: Firing


@dataclass(frozen=True, slots=True)
class Keep:
    """Write an order down that the clock has changed."""

    order: StandingOrder


Effect = Fire | Note | Keep


def put(book: OrderBook, order: StandingOrder) -> OrderBook:
    """Return the book with an order that is new or has changed; its next run is worked out."""
    due = {name: s for name, s in book.due.items() if name != order.id}
    if not (order.paused or order.ended or order.is_event):
        next_s = next_run(order, order.handled_unix_s, book.zone)
        if next_s is not None:
            due[order.id] = next_s
    return replace(book, orders={**book.orders, order.id: order}, due=due)


def add(book: OrderBook, order: StandingOrder) -> OrderBook:
    """Return the book with an order that a person gives now."""
    return replace(put(book, order), fresh=book.fresh | {order.id})


def drop(book: OrderBook, order_id: str) -> OrderBook:
    """Return the book without an order."""
    return replace(
        book,
        orders={name: order for name, order in book.orders.items() if name != order_id},
        due={name: s for name, s in book.due.items() if name != order_id},
        fired_s={name: s for name, s in book.fired_s.items() if name != order_id},
        fresh=book.fresh - {order_id},
    )


def tick(
    book: OrderBook, world: RobotView, now: ClockReading
) -> tuple[OrderBook, tuple[Effect, ...]]:
    """Return the book after this instant, and what is to be done. Same arguments, same answer."""
    at = _Instant(book, world, now)
    at.follow_clock()
    at.believe_clock()
    for order in () if at.book.unset else end_pauses(at.book.orders.values(), now.unix_s):
        at.ask(Keep(order))
    for name, due_s in sorted(at.book.due.items(), key=lambda item: item[1]):
        if due_s > now.unix_s:
            break
        if not at.waits(at.book.orders[name]):
            at.run(at.book.orders[name], due_s)
    for event in dict.fromkeys(world.happened):
        for order in tuple(at.book.orders.values()):
            if isinstance(order.rule, EventRule) and order.rule.event is event:
                at.happen(order, order.rule)
    return replace(at.book, ticked=now, stepped=False), tuple(at.effects)


@dataclass(slots=True)
class _Instant:
    """Work on one tick: the book as it becomes, and what is asked; local to it."""

    book: OrderBook
    world: RobotView
    now: ClockReading
    effects: list[Effect] = field(default_factory=list)

    def ask(self, effect: Effect) -> None:
        """Have an order written down, which is in the book so from now on."""
        self.effects.append(effect)
        self.book = put(self.book, effect.order)

    def follow_clock(self) -> None:
        """Move along what was counted from an instant where the clock was put right."""
        book, now, before = self.book, self.now, self.book.ticked
        if before is None:
            unset = not now.unix_s >= book.floor_unix_s - BEHIND_S
            live = (order for order in book.orders.values() if not order.ended)
            unset |= any(order.handled_unix_s - now.unix_s > BACK_S for order in live)
            self.book = replace(book, began=now, unset=unset)
            return
        step_s = (now.unix_s - before.unix_s) - (now.monotonic_s - before.monotonic_s)
        if not abs(step_s) > STEP_S:
            return
        floor_s = min(book.floor_unix_s, now.unix_s)
        self.book = replace(book, stepped=True, unset=False, floor_unix_s=floor_s)
        for order in book.orders.values():
            moves = order.id in book.fresh or not book.unset  # else they lie on the clock of before
            moved = _move_along(order, step_s if moves else 0.0, now)
            if moved is not order:
                self.ask(Keep(moved))

    def believe_clock(self) -> None:
        """Have orders be due again that a clock far ahead handled, which a start has put right.

        The process that was there then saw no step, and without this they would wait for that year.
        """
        now, alive_s = self.now, self._alive_s()
        if not (self.book.unset and alive_s >= UNSET_S and now.unix_s >= NEVER_SET_UNIX_S):
            return
        for order in tuple(self.book.orders.values()):
            ahead_s = order.handled_unix_s - now.unix_s
            if ahead_s > BACK_S and not order.ended:
                self.ask(Keep(_move_along(order, -ahead_s, now)))
                self.book = replace(self.book, unset=False, floor_unix_s=now.unix_s)

    def _alive_s(self) -> float:
        began = self.book.began
        return self.now.monotonic_s - began.monotonic_s if began is not None else 0.0

    def waits(self, order: StandingOrder) -> bool:
        """Tell whether nothing can be said of a run yet."""
        relative = isinstance(order.rule, EveryRule) or getattr(order.rule, "relative", False)
        if self.book.unset and not (relative and order.id in self.book.fresh):
            return self._alive_s() < UNSET_S
        return self.world.hindrance == BRIDGE_SILENT and self._alive_s() < WAITS_S

    def run(self, order: StandingOrder, due_s: float) -> None:
        """Fire the newest run that is due, or say why not; those before it are missed."""
        now, skipped, before_s, newest_s = self.now, 0, due_s, due_s
        while skipped < MOST_COUNTED:
            next_s = next_run(order, newest_s, self.book.zone)
            if next_s is None or next_s > now.unix_s:
                break
            skipped, before_s, newest_s = skipped + 1, newest_s, next_s
        if skipped >= MOST_COUNTED:  # counted so far: no later run of these is looked for
            newest_s = now.unix_s - LATE_S - STEP_S
        why = self._too_late(newest_s)
        if why is not None:
            self.ask(_miss_run(order, due_s, now, why, skipped + 1, newest_s))
            return
        if skipped:
            why = CLOCK_MOVED if self.book.stepped else LATE
            older = _miss_run(order, due_s, now, why, skipped, before_s)
            self.effects.append(older)
            order = older.order
        self._fire(order, newest_s)

    def _too_late(self, due_s: float) -> str | None:
        book, now = self.book, self.now
        began_s = book.began.unix_s if book.began is not None else now.unix_s
        if book.stepped:
            return CLOCK_MOVED if now.unix_s - due_s > LATE_S else None
        if due_s < began_s - STEP_S and now.unix_s >= began_s:
            return WAS_OFF
        return LATE if now.unix_s - due_s > LATE_S else None

    def _fire(self, order: StandingOrder, due_s: float) -> None:
        quiet, now = self.book.quiet, self.now
        rests = quiet is not None and not order.is_once and is_quiet(quiet, due_s, self.book.zone)
        why = STILL_RUNNING if order.id in self.world.busy else self.world.hindrance
        if rests:
            self.ask(_note_run(order, due_s, now, FiringState.QUIET, None))
        elif why is not None:
            self.ask(_miss_run(order, due_s, now, why, 1, due_s))
        else:
            begun = _handle(order, due_s).model_copy(update={"fired": order.fired + 1})
            firing = Firing(
                order=order.id, serial=begun.serial, due_unix_s=due_s, at_unix_s=now.unix_s,
                state=FiringState.BEGUN,
            )  # fmt: skip
            self.ask(Fire(begun, firing))

    def happen(self, order: StandingOrder, rule: EventRule) -> None:
        """Fire an order upon its event, within the hours in which it counts."""
        book, now, last_s = self.book, self.now, self.book.fired_s.get(order.id, float("-inf"))
        hours = rule.hours
        if hours is not None and not is_quiet(QuietHours.read(hours), now.unix_s, book.zone):
            return
        left_out = order.paused or day_at(now.unix_s, book.zone) in order.skipped
        if left_out or now.monotonic_s - last_s < COOLDOWN_S:
            return
        self.book = replace(book, fired_s={**book.fired_s, order.id: now.monotonic_s})
        self._fire(order, now.unix_s)


def _move_along(order: StandingOrder, step_s: float, now: ClockReading) -> StandingOrder:
    rule = order.rule
    if isinstance(rule, AtRule) and rule.relative and not order.ended:
        rule = rule.model_copy(update={"unix_s": max(0.0, rule.unix_s + step_s)})
    elif isinstance(rule, EveryRule):
        anchor_s = max(0.0, rule.anchor_unix_s + step_s)
        rule = rule.model_copy(update={"anchor_unix_s": anchor_s})
    if rule != order.rule:
        handled_s = order.handled_unix_s + step_s
        return order.model_copy(update={"rule": rule, "handled_unix_s": handled_s})
    if order.handled_unix_s - now.unix_s > BACK_S:
        return order.model_copy(update={"handled_unix_s": now.unix_s})
    return order


def _miss_run(
    order: StandingOrder, due_s: float, now: ClockReading, why: str, count: int, until_s: float
) -> Note:
    return _note_run(order, due_s, now, FiringState.MISSED, why, count, until_s)


def _note_run(
    order: StandingOrder,
    due_s: float,
    now: ClockReading,
    state: FiringState,
    why: str | None,
    count: int = 1,
    until_s: float | None = None,
) -> Note:
    last_s = until_s if until_s is not None else due_s
    changed = _handle(order, last_s)
    if state is FiringState.MISSED:
        changed = changed.model_copy(update={"missed": order.missed + count})
    firing = Firing(
        order=order.id, serial=changed.serial, due_unix_s=due_s, at_unix_s=now.unix_s, state=state,
        reason=why, count=count, until_unix_s=until_s if count > 1 else None,
    )  # fmt: skip
    return Note(changed, firing)


def _handle(order: StandingOrder, due_s: float) -> StandingOrder:
    """Return an order of which everything until a run is over; one that was due once has ended."""
    handled_s = due_s if order.is_event else max(due_s, order.handled_unix_s)
    return order.model_copy(
        update={"handled_unix_s": handled_s, "serial": order.serial + 1, "ended": order.is_once}
    )
