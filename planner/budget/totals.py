"""Own the arithmetic of spending: amounts, sums, and the first limit that would be passed. Pure."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Literal

if TYPE_CHECKING:
    from planner.settings import Limits, Price

Kind = Literal["calls", "prompt_tokens", "reply_tokens", "seconds", "money"]
KINDS: tuple[Kind, ...] = ("calls", "prompt_tokens", "reply_tokens", "seconds", "money")


@dataclass(frozen=True, slots=True)
class Expense:
    """Hold an expense, past or expected. Never negative but as a correction."""

    calls: int = 0
    prompt_tokens: int = 0
    reply_tokens: int = 0
    seconds: float = 0.0
    money: float = 0.0

    def __add__(self, other: Expense) -> Expense:
        return Expense(
            self.calls + other.calls,
            self.prompt_tokens + other.prompt_tokens,
            self.reply_tokens + other.reply_tokens,
            self.seconds + other.seconds,
            self.money + other.money,
        )

    def __sub__(self, other: Expense) -> Expense:
        return self + Expense(
            -other.calls,
            -other.prompt_tokens,
            -other.reply_tokens,
            -other.seconds,
            -other.money,
        )


@dataclass(frozen=True, slots=True)
class Overrun:
    """Name a limit that the next call would pass."""

    per: Literal["goal", "day"]
    kind: Kind
    spent: float
    limit: float


def cost(price: Price | None, prompt_tokens: int, reply_tokens: int) -> float:
    """Return the money that tokens cost, in the price's currency."""
    if price is None:
        return 0.0
    prompt, reply = price.prompt_per_million, price.reply_per_million
    return (prompt_tokens * prompt + reply_tokens * reply) / 1e6


def overrun(
    per: Literal["goal", "day"], spent: Expense, more: Expense, limits: Limits
) -> Overrun | None:
    """Return the first limit that ``more`` would pass, or None.

    Seconds can't be known ahead: the call that passes their limit is the last one.
    """
    for kind in KINDS:
        limit = getattr(limits, kind)
        if limit is None:
            continue
        have, then = getattr(spent, kind), getattr(spent + more, kind)
        within = have < limit if kind == "seconds" else then <= limit
        if not within:
            return Overrun(per, kind, float(have), float(limit))
    return None
