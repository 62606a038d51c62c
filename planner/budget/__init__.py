"""Keep the models' budget: limits per goal and per day, spent in one place, kept on disk."""

from __future__ import annotations

from typing import TYPE_CHECKING

from planner.budget.budget import Purse
from planner.budget.ledger import FOLDER, Ledger
from planner.budget.report import Amounts, BudgetLimits, BudgetRefusal, Usage
from planner.budget.utc_day import DayClocks

if TYPE_CHECKING:
    from pathlib import Path

    from planner.settings import Settings
    from planner.state_database import StateDatabase

__all__ = [
    "Amounts",
    "BudgetLimits",
    "BudgetRefusal",
    "DayClocks",
    "Ledger",
    "Purse",
    "Usage",
    "purse_of",
]


def purse_of(settings: Settings, home: Path, database: StateDatabase | None = None) -> Purse:
    """Return the purse of a home as the owner has set it; without a database, with one of its own.

    Raises:
        ConfigError: ``budget_unreadable``.
    """
    model = settings.model
    return Purse(
        settings.budget,
        Ledger.in_home(home) if database is None else Ledger(database, home / FOLDER),
        model=model.name if model is not None else None,
        most_reply=model.max_tokens if model is not None else 0,
    )
