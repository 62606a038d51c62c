"""Play the life of a scheduler: a disk that keeps orders, a process that dies, clocks that jump."""

from __future__ import annotations

from dataclasses import dataclass, field

from planner.orders.order import StandingOrder
from planner.orders.scheduler import ClockReading, Fire, Note, OrderBook, RobotView, put, tick
from planner.plan import Language, QuietHours
from planner.plan.timing import Rule
from tests.planner.orders.fakes import BERLIN, NOON_UNIX_S

SEEN_EVERY_S = 600.0
TICK_S = 0.05
WAITS_S = 10.0
"""Between ticks while something that is due waits."""


def order(number: int, rule: Rule, now_s: float = NOON_UNIX_S) -> StandingOrder:
    return StandingOrder(
        id=f"o{number}", number=number, text="t", order="say hello", language=Language.EN,
        rule=rule, created_unix_s=now_s, handled_unix_s=now_s,
    )  # fmt: skip


@dataclass
class Player:
    """Be disk, process and clocks of one robot's standing orders."""

    orders: dict[str, StandingOrder]
    unix_s: float = NOON_UNIX_S
    monotonic_s: float = 1000.0
    quiet: QuietHours | None = None
    book: OrderBook = field(default_factory=lambda: OrderBook(BERLIN))
    fired: list[tuple[str, float, float]] = field(default_factory=list)
    """Which, when it was due, when it fired."""
    told: list[tuple[str, float, float, int]] = field(default_factory=list)
    """Which, the first due and the last of these, how many."""
    reasons: list[str | None] = field(default_factory=list)
    """Why each of these did not fire; None where quiet hours left it out."""
    seen_unix_s: float = 0.0
    """How far the clock was, as the keeper writes it down; 0: it never did."""
    noted_s: float = float("-inf")

    def start(self) -> None:
        """Begin a process with what the disk holds."""
        self.book = OrderBook(BERLIN, self.quiet, floor_unix_s=self.seen_unix_s)
        for kept in self.orders.values():
            self.book = put(self.book, kept)

    def tick(self, world: RobotView = RobotView()) -> None:  # noqa: B008  # frozen
        now = ClockReading(self.unix_s, self.monotonic_s)
        self.book, effects = tick(self.book, world, now)
        for effect in effects:
            self.orders[effect.order.id] = effect.order
            if isinstance(effect, Fire):
                due_s = effect.firing.due_unix_s
                self.fired.append((effect.order.id, due_s, self.unix_s))
            elif isinstance(effect, Note):
                told = effect.firing
                last_s = told.until_unix_s or told.due_unix_s
                self.told.append((told.order, told.due_unix_s, last_s, told.count))
                self.reasons.append(told.reason)

    def note_clock(self) -> None:
        """Write down how far the clock is, as often as the keeper does."""
        if not self.book.unset and self.monotonic_s - self.noted_s >= SEEN_EVERY_S:
            self.seen_unix_s, self.noted_s = self.unix_s, self.monotonic_s

    def pass_s(self, seconds: float) -> None:
        self.unix_s += seconds
        self.monotonic_s += seconds

    def live(self, seconds: float) -> None:
        """Let time pass with ticks as something is due; between these no tick has an effect."""
        end_s = self.monotonic_s + seconds
        while self.monotonic_s < end_s:
            due_s = min(self.book.due.values(), default=float("inf")) - self.unix_s
            step_s = min(due_s + TICK_S if due_s > 0.0 else WAITS_S, SEEN_EVERY_S)
            self.pass_s(min(step_s, end_s - self.monotonic_s))
            self.tick()
            self.note_clock()
