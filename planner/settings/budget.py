"""Own the owner's settings about spending: limits per goal and per day, and the price of tokens.

Data only. A model is asked within these limits or not at all; there is no way to have none.
"""

from __future__ import annotations

from typing import Annotated

from pydantic import BaseModel, ConfigDict, Field

Count = Annotated[int, Field(ge=0, le=1_000_000_000)]
Amount = Annotated[float, Field(ge=0.0, le=1e9)]


class _Table(BaseModel):
    model_config = ConfigDict(
        frozen=True, extra="forbid", allow_inf_nan=False, hide_input_in_errors=True
    )


class Price(_Table):
    """Give the price of a million tokens, in any one currency."""

    prompt_per_million: Amount = 0.0
    reply_per_million: Amount = 0.0
    currency: Annotated[str, Field(pattern=r"^[A-Za-z]{1,8}$")] = "USD"


class GoalLimits(_Table):
    """Limit one goal's expense, from its first thought to its end."""

    calls: Count = 100
    """Beside its thoughts: a picture for each direction of every room that a search looks in."""
    prompt_tokens: Count = 210_000
    reply_tokens: Count = 60_000
    seconds: Amount = 300.0
    """Of waiting for the model."""
    money: Amount | None = None
    """None: tokens alone count."""


class DayLimits(_Table):
    """Limit one day's expense, from midnight to midnight UTC."""

    calls: Count = 2_000
    prompt_tokens: Count = 6_000_000
    reply_tokens: Count = 2_000_000
    seconds: Amount = 21_600.0
    money: Amount | None = None


Limits = GoalLimits | DayLimits


class BudgetSettings(_Table):
    """Hold the spending limits."""

    goal: GoalLimits = GoalLimits()
    day: DayLimits = DayLimits()
    price: Price | None = None
    """None: nothing is known to cost money, as with a model on this machine."""


def contradiction(budget: BudgetSettings, max_tokens: int | None) -> str | None:
    """Return why no call could ever keep these limits, or a limit that nothing could measure.

    Args:
        budget: what may be spent.
        max_tokens: of one reply; None without a model.
    """
    for name, limits in (("goal", budget.goal), ("day", budget.day)):
        if limits.money is not None and budget.price is None:
            return f"budget.{name}.money needs [budget.price] to be counted"
        if max_tokens is not None and 0 < limits.reply_tokens < max_tokens:
            most = f"model.max_tokens = {max_tokens}"
            return f"budget.{name}.reply_tokens = {limits.reply_tokens} is below {most}"
    return None
