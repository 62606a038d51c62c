"""Hold what a sentence makes of the newest order, as steps or as a part of its own words."""

from __future__ import annotations

from planner.plan.base import Frozen
from planner.plan.steps import Step


class ChangedOrder(Frozen):
    """Say what the built-in brain plans for a sentence that leans on the newest order."""

    steps: tuple[Step, ...] = ()
    """The newest order's steps with the one change that the sentence asks for."""
    words: str = ""
    """The part of the sentence that is an order by itself, where there are no such steps."""
