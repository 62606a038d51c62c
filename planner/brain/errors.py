"""Class a brain's errors by who must act. Standard library alone."""

from __future__ import annotations


class PlanRejected(Exception):
    """The model's fault: goes back to it, at most as often as the budget has repairs."""

    code = "bad_plan"


class BrainDown(Exception):
    """Nobody's fault here: back off, then fall back to the offline brain."""

    code = "model_unavailable"


class Misconfigured(Exception):
    """Ours: refuse to start."""

    code = "misconfigured"
