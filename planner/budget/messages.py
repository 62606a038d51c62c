"""Say in both languages which budget is used up, how much of it, and when it comes back."""

from __future__ import annotations

from planner.brain.errors import OutOfBudget
from planner.budget.totals import Overrun
from planner.language.catalogue import say
from planner.plan import same


def refusal(over: Overrun, resets_in_s: float, currency: str | None) -> OutOfBudget:
    """Return the error of a limit that the next call would pass."""
    unit = same(currency or "") if over.kind == "money" else say(f"budget.{over.kind}")
    spent, limit = _number(over.spent), _number(over.limit)
    minutes = int(resets_in_s // 60) + 1
    later = say("budget.at_midnight", hours=minutes // 60, minutes=minutes % 60)
    when = say("budget.never") if over.per == "goal" else later
    per = say(f"budget.per_{over.per}")
    said = say("budget.refusal", per=per, spent=spent, limit=limit, unit=unit, when=when)
    return OutOfBudget(f"{over.kind} per {over.per}: {spent} of {limit}", said)


UNWRITABLE = say("budget.unwritable")
IDLE = say("budget.idle")


def _number(value: float) -> str:
    return f"{value:.0f}" if value == int(value) else f"{value:.4g}"
