"""Spend: the one place where a call is allowed or refused, counted before it goes, and settled.

A call is counted at its worst when it goes out (one call, the tokens that are sent, a reply of full
length) and corrected when it ends, so that one which dies with the process stays counted.
"""

from __future__ import annotations

import asyncio
import logging
from dataclasses import asdict
from datetime import date
from typing import TYPE_CHECKING

from planner.brain.errors import OutOfBudget
from planner.brain.usage_meter import THINKING_ABOUT
from planner.budget.report import Amounts, BudgetLimits, BudgetRefusal, Usage
from planner.budget.totals import Expense, Overrun, cost, overrun
from planner.budget.utc_day import DayClocks, Days
from planner.language.catalogue import say
from planner.plan import say_same

if TYPE_CHECKING:
    from collections.abc import Callable

    from planner.budget.ledger import Judge, Ledger
    from planner.settings import BudgetSettings

log = logging.getLogger(__name__)

LOOK_S = 0.5
MAX_TOKENS = 10_000_000
"""Of one call; a server that claims more is not believed."""
UNWRITABLE = say("budget.unwritable")
IDLE = say("budget.idle")


class Purse:
    """Keep one home's budget."""

    def __init__(
        self,
        budget: BudgetSettings,
        ledger: Ledger,
        *,
        model: str | None = None,
        most_reply: int = 0,
        clocks: DayClocks | None = None,
    ) -> None:
        """Take up the earlier expense.

        Args:
            budget: limits and prices.
            ledger: where it is kept.
            model: whose calls these are, for people; None without a model.
            most_reply: tokens that one reply may have.
            clocks: other clocks than the system's.

        Raises:
            ConfigError: ``budget_unreadable``.
        """
        self._budget, self._ledger, self._model = budget, ledger, model
        self._most_reply = most_reply
        self._clocks = clocks or DayClocks()
        self._days = Days(ledger.newest, self._clocks)
        self._day = self._days.today()
        ledger.remember(self._day)
        self._under_way = self._calls = self._idle = 0
        self._refused: BudgetRefusal | None = None
        self.on_settled: list[Callable[[str, float, int, int], None]] = []
        """Are told each call that ended: its goal, seconds, tokens sent, tokens of the reply."""
        self.changes = 0
        """Rises with every change of the meter, so that who shows it knows when to look."""

    def adopt(self, budget: BudgetSettings) -> None:
        """Keep to other limits and prices from the next call on."""
        self._budget = budget
        self.changes += 1

    def prepare(self) -> None:
        """Make the ledger's database, so that no call waits for that. Blocks on the disk."""
        if self._model is not None:
            self._ledger.prepare()

    async def open(self, prompt_tokens: int) -> OpenCall:
        """Count a call that is about to go out.

        Raises:
            OutOfBudget: it may not go out.
        """
        goal = THINKING_ABOUT.get()
        if goal is None:
            self._idle += 1
            log.error("a call that no goal asked for was refused")
            raise self._refuse(OutOfBudget("no goal asked for this call", IDLE))
        worst = self._price(1, prompt_tokens, self._most_reply)
        day = self._today()
        try:
            over = await self._ledger.spend(day, goal, worst, self._judge(worst))
        except OSError as error:
            log.warning("what the model costs can't be written: %s", error.strerror)
            raise self._refuse(OutOfBudget("it can't be written down", UNWRITABLE)) from None
        if over is not None:
            raise self._refuse(refusal(over, self._days.resets_in_s(), self._currency))
        self._under_way += 1
        self._calls += 1
        self._refused = None
        self.changes += 1
        return OpenCall(self, day, goal, worst, self._clocks.monotonic_s())

    def settle(self, call: OpenCall, prompt_tokens: int, reply_tokens: int) -> None:
        """Correct a call's estimate by its real cost."""
        prompt, reply = (min(MAX_TOKENS, max(0, n)) for n in (prompt_tokens, reply_tokens))
        seconds = max(0.0, self._clocks.monotonic_s() - call.began_s)
        came_to = self._price(1, prompt, reply) + Expense(seconds=seconds)
        self._under_way -= 1
        self.changes += 1
        self._ledger.settle(call.day, call.goal, came_to - call.counted)
        for told in self.on_settled:
            told(call.goal, seconds, prompt, reply)

    def usage(self, goal: str | None = None) -> Usage:
        """Return the meter as of now; what another program spends is seen at the next look."""
        day = self._today()
        self._ledger.look(day)
        return Usage(
            model=self._model,
            day=day,
            resets_in_s=round(self._days.resets_in_s()),
            currency=self._currency,
            today=_amounts(self._ledger.of_day(day)),
            day_limits=BudgetLimits(**self._budget.day.model_dump()),
            goal=None if goal is None else _amounts(self._ledger.of_goal(goal)),
            goal_limits=BudgetLimits(**self._budget.goal.model_dump()),
            under_way=self._under_way,
            calls_since_start=self._calls,
            idle_calls=self._idle,
            refused=self._refused,
        )

    async def look(self, goal: str | None = None) -> None:
        """Read what every program of this home has spent; a disk that hangs is not waited for."""
        looking = self._ledger.look(self._today(), goal or "")
        if looking is not None:
            await asyncio.wait({asyncio.wrap_future(looking)}, timeout=LOOK_S)

    def close(self) -> None:
        """Give the ledger back."""
        self._ledger.close()

    @property
    def _currency(self) -> str | None:
        return self._budget.price.currency if self._budget.price is not None else None

    def _price(self, calls: int, prompt: int, reply: int) -> Expense:
        money = cost(self._budget.price, prompt, reply)
        return Expense(calls=calls, prompt_tokens=prompt, reply_tokens=reply, money=money)

    def _judge(self, worst: Expense) -> Judge:
        """Return how the sums of a day and a goal are held against the limits; see ``Ledger``."""

        def judge(today: Expense, mine: Expense) -> Overrun | None:
            return overrun("goal", mine, worst, self._budget.goal) or overrun(
                "day", today, worst, self._budget.day
            )

        return judge

    def _today(self) -> date:
        day = self._days.today()
        if day < self._day:  # a clock that had leapt ahead was found out
            log.warning("the day is %s again; what was spent on later days is set aside", day)
            self._ledger.set_aside(day)
        if day != self._day:
            self._day = day
            self.changes += 1
        return day

    def _refuse(self, error: OutOfBudget) -> OutOfBudget:
        self._refused = BudgetRefusal(code=error.code, message=error.said)
        self.changes += 1
        return error


class OpenCall:
    """Be one call that has gone out; see `planner.brain.usage_meter.Bill`."""

    def __init__(
        self, purse: Purse, day: date, goal: str, counted: Expense, began_s: float
    ) -> None:
        self._purse = purse
        self.day, self.goal, self.counted, self.began_s = day, goal, counted, began_s
        self._open = True

    @property
    def max_reply_tokens(self) -> int:
        """Return the tokens that the reply may have at most."""
        return self.counted.reply_tokens

    def close(self, prompt_tokens: int, reply_tokens: int) -> None:
        """Settle the call, once."""
        if self._open:
            self._open = False
            self._purse.settle(self, prompt_tokens, reply_tokens)


def _amounts(spent: Expense) -> Amounts:
    rounded = asdict(spent) | {"seconds": round(spent.seconds, 3), "money": round(spent.money, 6)}
    return Amounts(**rounded)


def refusal(over: Overrun, resets_in_s: float, currency: str | None) -> OutOfBudget:
    """Return the error of a limit that the next call would pass."""
    unit = say_same(currency or "") if over.kind == "money" else say(f"budget.{over.kind}")
    spent, limit = _number(over.spent), _number(over.limit)
    minutes = int(resets_in_s // 60) + 1
    later = say("budget.at_midnight", hours=minutes // 60, minutes=minutes % 60)
    when = say("budget.never") if over.per == "goal" else later
    per = say(f"budget.per_{over.per}")
    said = say("budget.refusal", per=per, spent=spent, limit=limit, unit=unit, when=when)
    return OutOfBudget(f"{over.kind} per {over.per}: {spent} of {limit}", said)


def _number(value: float) -> str:
    return f"{value:.0f}" if value == int(value) else f"{value:.4g}"
