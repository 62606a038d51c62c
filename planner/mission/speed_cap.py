"""Change the speed cap that a person leaves to a running goal: slower only, and back."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from planner.mission.state import Mission
    from planner.mission.transaction import Transaction
    from planner.plan import StepPlan

LEAST_SPEED_SHARE = 0.25
"""Slower than that a robot blocks people's way for minutes; who wants less says stop."""


SLOW_SHARE = 0.5
"""Of the planned speeds, for an order to do something slowly; "faster" takes it back."""


def share_of(plan: StepPlan) -> float:
    """Return the share of the planned speeds that an order leaves."""
    return SLOW_SHARE if plan.pace == "slow" else 1.0


def change_speed(turn: Transaction, mission: Mission, *, slower: bool) -> None:
    """Halve the speed cap of a running goal, or double it up to the whole; no lower than a quarter.

    The bridge's own limits hold as ever: this can only make the robot slower than planned.
    """
    share = mission.speed_share / 2.0 if slower else mission.speed_share * 2.0
    turn.put(mission, speed_share=min(1.0, max(LEAST_SPEED_SHARE, share)))
