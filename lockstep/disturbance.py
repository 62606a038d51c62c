"""Say how messages are spoilt on their way: lost, doubled, late, out of order. Data only."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from wire.keys import Party


@dataclass(frozen=True, slots=True)
class Disturbance:
    """Spoil what one party says on some keys."""

    keys: tuple[str, ...] = ()
    """Paths (``cmd/waypoints``); empty means every key."""
    sender: Party | None = None
    """None means everybody."""
    drop: float = 0.0
    """Share of messages lost."""
    duplicate: float = 0.0
    """Share of messages that arrive twice."""
    delay_ticks: tuple[int, int] = (0, 0)
    """Least and most ticks added."""
    reorder: bool = False
    """Later messages may overtake earlier ones."""

    def fits(self, sender: Party, path: str) -> bool:
        """Tell whether a message is spoilt by this."""
        named = not self.keys or path in self.keys
        return named and (self.sender is None or self.sender is sender)


QUIET = Disturbance()
