"""Be the person of a trial who sits at a page: asks by a number, and counts as gone when silent.

Written by two threads: the engine asks and tells, the node brings what the page said. Each value is
replaced whole, so that no lock is needed.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from pons.robot.trial_parties import TrialRefusal
from wire.trial_dialogue import UNWATCHED_S, TrialStep

if TYPE_CHECKING:
    from collections.abc import Callable

MOST_CHARACTERS = 400


class PagePerson:
    """Hold what was asked, told and answered."""

    def __init__(self, clock: Callable[[], float]) -> None:
        self._clock = clock
        self._watched_s = clock()
        self._answered = 0
        self._stopped = False
        self.steps: tuple[TrialStep, ...] = ()
        self.asked = 0
        """The number of the newest question."""
        self.code: str | None = None
        """The question that waits; None where none does."""

    def ask(self, code: str) -> None:
        """Ask for something to be done."""
        self.asked += 1
        self.code = code

    def has_answered(self) -> bool:
        """Tell whether it is done."""
        if self._answered != self.asked:
            return False
        self.code = None
        return True

    def tell(self, step: str, seen: str = "") -> None:
        """Note what the step before saw, and that a step begins."""
        done = self.steps
        if done:
            done = (*done[:-1], TrialStep(step=done[-1].step, seen=seen[:MOST_CHARACTERS]))
        self.steps = (*done, TrialStep(step=step, seen=""))

    def require_watch(self) -> None:
        """Go on only while the page speaks and nobody has stopped.

        Raises:
            TrialRefusal: ``trial_stopped`` or ``trial_unwatched``.
        """
        if self._stopped:
            raise TrialRefusal("trial_stopped")
        silent_s = self._clock() - self._watched_s
        if not silent_s <= UNWATCHED_S:
            raise TrialRefusal("trial_unwatched", f"silent for {silent_s:.1f} s")

    def watch(self, answered: int) -> None:
        """Take a word of the page: it is there, and has answered so far."""
        self._watched_s = self._clock()
        self._answered = answered

    def stop(self) -> None:
        """End the trial at the engine's next tick; nothing takes it back."""
        self._stopped = True
