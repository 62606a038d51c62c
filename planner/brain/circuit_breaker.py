"""Decide whether a model that failed is asked again. Pure: told the time, keeps no clock.

Closed, it lets all through; `TRIPS` failures in a row open it for a rest that doubles with each
failed trial. After the rest one trial goes through at a time, and only `HEALS` good ones in a row
close it: a server that answers now and then does not make every second goal wait.
"""

from __future__ import annotations

from dataclasses import dataclass

TRIPS = 3
HEALS = 2
FIRST_REST_S = 20.0
LONGEST_REST_S = 300.0


@dataclass(slots=True)
class Breaker:
    """Remember how the last calls went."""

    failures: int = 0
    """In a row, while closed."""
    successes: int = 0
    """In a row, on trial."""
    first_rest_s: float = FIRST_REST_S
    rest_s: float = 0.0
    """The next rest; begins with the first one again once all is well."""
    open_until_s: float | None = None
    """None: closed."""
    trying: bool = False
    """A trial is under way."""

    def __post_init__(self) -> None:
        self.rest_s = self.first_rest_s

    @property
    def is_closed(self) -> bool:
        """Tell whether the model counts as well."""
        return self.open_until_s is None

    def rests_s(self, now_s: float) -> float:
        """Return how much longer the model rests [s]; 0 where it may be asked."""
        if self.open_until_s is None:
            return 0.0
        return min(max(0.0, self.open_until_s - now_s), LONGEST_REST_S)  # the sum is rounded

    def lets(self, now_s: float) -> bool:
        """Tell whether a call may go through now; on trial, that call is the trial."""
        if self.open_until_s is None:
            return True
        if self.trying or not now_s >= self.open_until_s:
            return False
        self.trying = True
        return True

    def note_success(self) -> None:
        """Note an answer."""
        self.failures, self.trying = 0, False
        if self.open_until_s is not None:
            self.successes += 1
            if self.successes >= HEALS:
                self.open_until_s, self.successes, self.rest_s = None, 0, self.first_rest_s

    def note_failure(self, now_s: float, *, hopeless: bool = False) -> None:
        """Note a failure; a hopeless one (a wrong key) opens at once."""
        self.trying, self.successes = False, 0
        if self.open_until_s is not None:
            if now_s >= self.open_until_s:  # late failures of older calls do not add up
                self.rest_s = min(2.0 * self.rest_s, LONGEST_REST_S)
                self.open_until_s = now_s + self.rest_s
            return
        self.failures += 1
        if hopeless or self.failures >= TRIPS:
            self.failures, self.open_until_s = 0, now_s + self.rest_s

    def note_cancel(self) -> None:
        """Note that a call was cancelled: it says nothing about the model."""
        self.trying = False
