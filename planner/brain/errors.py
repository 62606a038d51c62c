"""Class a brain's errors by the party that must act. Standard library alone."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from collections.abc import Awaitable, Callable

    from planner.plan import Bilingual, BrainTag


class BadPlan(Exception):
    """The model's fault: goes back to it, at most as often as the budget has repairs."""

    def __init__(
        self,
        detail: str,
        brain: BrainTag | None = None,
        *,
        calls: int = 0,
        tokens: int = 0,
        code: str = "bad_plan",
    ) -> None:
        super().__init__(detail)
        self.code = code
        """One of ``planner.brain.model_error_codes``."""
        self.brain = brain
        """Who thought last, where another than the brain that was asked."""
        self.calls, self.tokens = calls, tokens
        """What the replies that are no plan have cost."""


class BrainDown(Exception):
    """Nobody's fault here: back off, then fall back to the offline brain.

    ``why`` is one of the keys of ``planner.brain.model_error_codes``.
    """

    code = "model_unavailable"

    def __init__(
        self,
        detail: str,
        brain: BrainTag | None = None,
        *,
        why: str = "unavailable",
        server: str = "",
    ) -> None:
        super().__init__(detail)
        self.brain = brain
        self.why = why
        self.server = server
        """What the server said of it, for a person. Anybody may have written it: shown, bounded,
        and never told to a model."""


class StillLoading(BrainDown):
    """Nobody's fault: a server on this machine has not said a word yet, and may be loading.

    Its connection stays open, for a server ends the load where the client leaves.
    """

    def __init__(
        self, detail: str, later: Callable[[], Awaitable[Any]], drop: Callable[[], None]
    ) -> None:
        super().__init__(detail, why="loading")
        self.later = later
        """Waits for what was asked for, within a bound of its own."""
        self.drop = drop
        """Gives up what was asked for, though not the one connection that loads."""


class OutOfBudget(BrainDown):
    """Nobody's fault: the owner's budget is spent, so no call went out."""

    code = "out_of_budget"

    def __init__(self, detail: str, said: Bilingual, brain: BrainTag | None = None) -> None:
        super().__init__(detail, brain, why="out_of_budget")
        self.said = said
        """Which budget, how much, and when it comes back, for a person."""


class BrainConfigError(Exception):
    """Ours: refuse to start."""

    code = "misconfigured"
