"""Count contact episodes: touching, however it rattles, is one until clear for a while. Pure."""

from __future__ import annotations

CLEAR_S = 0.2
"""Contacts closer together than this belong to one bump; a robot bounces off a wall for less."""


class Episodes:
    """Follow contact counts sampled at a fixed period."""

    def __init__(self, period_s: float) -> None:
        self._clear_ticks = round(CLEAR_S / period_s)
        self._since_contact = self._clear_ticks
        self.now = 0
        self.total = 0

    def sample(self, contacts: int) -> None:
        """Add the number of contacts at one instant."""
        self.now = contacts
        if contacts == 0:
            self._since_contact += 1
            return
        if self._since_contact >= self._clear_ticks:
            self.total += 1
        self._since_contact = 0
