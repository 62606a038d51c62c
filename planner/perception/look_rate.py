"""Decide when the eyes look, and when they listen to the camera. Told the time; asks no clock.

They look at their full rate while a step, a page or a question needs them, now and then else: twice
a second while the robot moves, for what is passed, and every other second while it stands. After a
failure of the detector they rest.
"""

from __future__ import annotations

from contextlib import contextmanager
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Iterator

POLL_S, IDLE_POLL_S = 0.01, 0.03
PASSING_HZ, STANDING_HZ = 2.0, 0.5
"""Nobody asks, yet what is passed is remembered, and what comes before a robot that stands."""
EARLY_S = 0.02
"""A picture that comes so much before its time is taken: cameras and clocks jitter."""
SHOWN_S = 3.0
"""A page that asked for the picture is taken to look on for so long."""
REST_S = 1.0
"""After a failure of the detector."""


class Attention:
    """Keep the eyes' users, since when they look and until when they rest."""

    def __init__(self, rate_hz: float, camera_hz: float) -> None:
        """Take the rate of looks while somebody needs eyes, and that of the camera."""
        self._rate_hz = rate_hz
        self._idle_poll_s = min(IDLE_POLL_S, max(POLL_S, 0.5 / camera_hz))
        self._wanted: set[str] = set()
        self._wide: set[str] = set()
        self._waiting = 0
        self._shown_s = self._began_s = self._rest_until_s = float("-inf")

    def attend(self, who: str, wanted: bool, *, wide: bool = False) -> None:
        """Take down that somebody needs eyes now, or no longer; ``wide``: for all kinds."""
        (self._wanted.add if wanted else self._wanted.discard)(who)
        (self._wide.add if wanted and wide else self._wide.discard)(who)

    @property
    def wide(self) -> bool:
        """Tell whether somebody needs wide looks."""
        return bool(self._wide)

    def note_shown(self, now_s: float) -> None:
        """Take down that a page was shown the picture."""
        self._shown_s = now_s

    @contextmanager
    def waiting(self) -> Iterator[None]:
        """Take down that somebody waits for a picture, as long as this lasts."""
        self._waiting += 1
        try:
            yield
        finally:
            self._waiting -= 1

    def began(self, now_s: float) -> None:
        """Take down that a look has begun."""
        self._began_s = now_s

    def rest(self, now_s: float) -> None:
        """Begin no look for a while."""
        self._rest_until_s = now_s + REST_S

    def poll_s(self, now_s: float) -> float:
        """Return how long to wait between two rounds [s]."""
        return POLL_S if self._is_needed(now_s) else self._idle_poll_s

    def due(self, now_s: float, *, moving: bool) -> bool:
        """Tell whether it is time for a look."""
        idle_hz = PASSING_HZ if moving else STANDING_HZ
        rate_hz = min(self._rate_hz if self._is_needed(now_s) else idle_hz, self._rate_hz)
        return now_s >= self._rest_until_s and now_s - self._began_s >= 1.0 / rate_hz - EARLY_S

    def listens(self, now_s: float, *, glance: bool) -> bool:
        """Tell whether pictures are wanted: by somebody, or for the ``glance`` that is due."""
        return glance or self._waiting > 0 or self._is_needed(now_s)

    def _is_needed(self, now_s: float) -> bool:
        return bool(self._wanted) or now_s - self._shown_s <= SHOWN_S
