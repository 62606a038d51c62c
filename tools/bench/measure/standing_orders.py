"""Measure standing orders: 1 000 simulated days with restarts, and kill -9.

The days are played by the scheduler itself, with a disk that keeps what it asked to keep; a process
may die between any two of its effects, also after a firing was written and before its goal was
given. The kills are real: a keeper with its database in a process of its own.
"""

from __future__ import annotations

import random
import signal
import subprocess
import sys
import tempfile
import time
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING
from zoneinfo import ZoneInfo

from planner.orders.order import StandingOrder
from planner.orders.rule import next_due
from planner.orders.scheduler import ClockReading, Fire, Note, OrderBook, RobotView, put, tick
from planner.orders.store import OrderStore
from planner.plan import Language
from planner.plan.timing import CronRule, EveryRule, Rule
from planner.state_database import StateDatabase
from tools.bench.report import ReportRow, row_of

if TYPE_CHECKING:
    from tools.bench.context import BenchLab

NAME = "standing_orders"
TITLE = "standing orders: 1 000 simulated days with restarts; kill -9 of a keeper"
LONG_ONLY = False
DAYS = 1000
TICK_S = 0.1
ZONE = ZoneInfo("Europe/Berlin")
BEGIN_UNIX_S = 1_800_010_800.0
RULES: tuple[Rule, ...] = (
    *(CronRule(cron=c) for c in ("0 20 * * *", "30 2 * * *", "30 8 * * 1-5", "0 * * * *")),
    CronRule(cron="15 12 * * 0,6"),
    EveryRule(seconds=5400.0, anchor_unix_s=BEGIN_UNIX_S),
)
KILLS, KILLED_EVERY_S, BEGINS_WITHIN_S = 8, 1.3, 60.0


@dataclass
class SimulatedLife:
    """Play days: ticks come where something is due, a process dies now and then, disks keep."""

    chance: random.Random
    disk: dict[str, StandingOrder]
    book: OrderBook = field(default_factory=lambda: OrderBook(ZONE))
    unix_s: float = BEGIN_UNIX_S
    monotonic_s: float = 100.0
    fired: list[tuple[str, float, float]] = field(default_factory=list)
    cut_off: int = 0
    covered: dict[str, int] = field(default_factory=dict)
    restarts: int = 0

    def start(self) -> None:
        """Begin a process with what the disk holds."""
        self.book = OrderBook(ZONE)
        for order in self.disk.values():
            self.book = put(self.book, order)

    def play(self, until_unix_s: float) -> None:
        """Go from one due instant to the next; between them no tick has an effect."""
        self.start()
        self._tick(RobotView())
        while self.unix_s < until_unix_s:
            due_s = min(self.book.due.values())
            wait_s = max(0.0, due_s - self.unix_s) + self.chance.uniform(0.0, TICK_S)
            if self.chance.random() < 0.02:
                self._restart(wait_s)
                continue
            self._pass_s(wait_s)
            held = self.chance.random() < 0.03
            self._tick(RobotView(hindrance="held" if held else None))

    def _restart(self, wait_s: float) -> None:
        """Die before, at or after the next run, and be off for a second to a few hours."""
        self._pass_s(wait_s * self.chance.choice((0.5, 0.999, 1.0)))
        self._pass_s(self.chance.choice((1.0, 30.0, 600.0, 7200.0, 30_000.0)))
        self.restarts += 1
        self.start()
        self._tick(RobotView())

    def _pass_s(self, seconds: float) -> None:
        self.unix_s += seconds
        self.monotonic_s += seconds

    def _tick(self, view: RobotView) -> None:
        self.book, effects = tick(self.book, view, ClockReading(self.unix_s, self.monotonic_s))
        for effect in effects:
            dies = self.chance.random() < 0.01
            if dies and self.chance.random() < 0.5:  # before it was written
                self._die()
                return
            self.disk[effect.order.id] = effect.order
            count = effect.firing.count if isinstance(effect, (Fire, Note)) else 0
            name = effect.order.id
            self.covered[name] = self.covered.get(name, 0) + count
            if dies:  # written, and its goal not given: told as cut off at the next start
                self.cut_off += isinstance(effect, Fire)
                self._die()
                return
            if isinstance(effect, Fire):
                self.fired.append((name, effect.firing.due_unix_s, self.unix_s))

    def _die(self) -> None:
        self.restarts += 1
        self._pass_s(self.chance.choice((0.2, 5.0, 600.0)))
        self.start()


def measure(lab: BenchLab) -> list[ReportRow]:
    """Play the days, then kill real processes."""
    del lab
    begun = time.perf_counter()
    orders = {f"o{n}": _order(n, rule) for n, rule in enumerate(RULES)}
    life = SimulatedLife(random.Random(5), orders)  # dice, no secret
    life.play(BEGIN_UNIX_S + DAYS * 86_400.0)
    took_s = time.perf_counter() - begun
    wanted = {name: _count_due(order, life) for name, order in orders.items()}
    late_s = [fired_s - due_s for _, due_s, fired_s in life.fired]
    twice = len(life.fired) - len({(name, due_s) for name, due_s, _ in life.fired})
    silent = sum(wanted[name] - life.covered.get(name, 0) for name in orders)
    n = len(life.fired)
    note = f"{DAYS} days, {life.restarts} restarts, {life.cut_off} cut off and told, {took_s:.1f} s"
    rows = [
        row_of("fired after its time", "s", "max <= 1", late_s, note),
        ReportRow("doubled", "", "0", value=str(twice), note=f"n = {n}, 3/n = {3 / n:.1g}"),
        ReportRow("missed silently", "", "0", value=str(silent), note=f"of {sum(wanted.values())}"),
    ]
    return [*rows, *_kills()]


def _order(number: int, rule: Rule) -> StandingOrder:
    return StandingOrder(
        id=f"o{number}", number=number, text="t", order="say hello", language=Language.EN,
        rule=rule, created_unix_s=BEGIN_UNIX_S, handled_unix_s=BEGIN_UNIX_S,
    )  # fmt: skip


def _count_due(order: StandingOrder, life: SimulatedLife) -> int:
    """Return how many runs were due until the newest that is over."""
    count, due_s = 0, next_due(order.rule, BEGIN_UNIX_S, ZONE)
    while due_s is not None and due_s <= life.disk[order.id].handled_unix_s:
        count, due_s = count + 1, next_due(order.rule, due_s, ZONE)
    return count


def _kills() -> list[ReportRow]:
    """Kill a keeper that fires every half second, again and again; read what it did."""
    with tempfile.TemporaryDirectory() as folder:
        home = Path(folder)
        order = replace_rule(_order(1, EveryRule(seconds=0.5, anchor_unix_s=time.time())))
        OrderStore(StateDatabase(home)).keep([order])
        log = home / "given"
        for _ in range(KILLS):
            program = [sys.executable, "-m", "tools.bench.order_keeper_process", str(home)]
            with subprocess.Popen(program) as child:
                started = time.monotonic()
                while time.monotonic() - started < BEGINS_WITHIN_S and not (home / "up").exists():
                    time.sleep(0.02)
                (home / "up").unlink(missing_ok=True)
                time.sleep(KILLED_EVERY_S * random.uniform(0.5, 1.5))
                child.send_signal(signal.SIGKILL)
        given = log.read_text().split() if log.exists() else []
    twice = len(given) - len(set(given))
    note = f"{KILLS} kills, {len(given)} firings, 3/n = {3 / max(1, len(given)):.1g}"
    return [ReportRow("kill -9: given twice", "", "0", value=str(twice), note=note)]


def replace_rule(order: StandingOrder) -> StandingOrder:
    """Return the order as if it was given now."""
    now_s = time.time()
    return order.model_copy(update={"created_unix_s": now_s, "handled_unix_s": now_s})
