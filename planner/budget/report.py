"""Own the meter as people and monitors read it: the expense, the limits, and until when."""

from __future__ import annotations

from datetime import date

from pydantic import Field

from planner.plan import Bilingual, Frozen


class Amounts(Frozen):
    """Hold an expense."""

    calls: int
    prompt_tokens: int
    reply_tokens: int
    seconds: float
    money: float


class BudgetLimits(Frozen):
    """Hold the limits; none where money has none."""

    calls: int
    prompt_tokens: int
    reply_tokens: int
    seconds: float
    money: float | None


class BudgetRefusal(Frozen):
    """Say why a call was last refused: cleared by the next one that goes out."""

    code: str
    message: Bilingual


class Usage(Frozen):
    """Show the meter. Times are UTC; an idle robot's meter stands still."""

    model: str | None  # none: the offline brain plans, and nothing is spent
    day: date
    resets_in_s: float = Field(ge=0.0)
    currency: str | None  # none: no price is set, so money stays zero
    today: Amounts
    day_limits: BudgetLimits
    goal: Amounts | None = None  # what one goal has spent, where one was asked for
    goal_limits: BudgetLimits
    under_way: int = Field(ge=0)  # calls that have gone out and not ended
    calls_since_start: int = Field(ge=0)
    idle_calls: int = Field(ge=0)  # calls that no goal asked for: refused, and a defect
    refused: BudgetRefusal | None = None
