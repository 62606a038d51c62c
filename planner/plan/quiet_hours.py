"""Own hours of the day in which something rests: a span that may go past midnight. Pure."""

from __future__ import annotations

import re
from dataclasses import dataclass

_SPAN = re.compile(r"([01]?\d|2[0-3]):([0-5]\d) ?[-–] ?([01]?\d|2[0-3]):([0-5]\d)")
MINUTES = 24 * 60


@dataclass(frozen=True, slots=True)
class QuietHours:
    """Hold the first minute of the day that is quiet and the first that is not."""

    from_min: int
    until_min: int

    @classmethod
    def read(cls, text: str) -> QuietHours:
        """Return the span that a text like ``22:00-07:00`` names.

        Raises:
            ValueError: the text is none, or both ends are the same.
        """
        found = _SPAN.fullmatch(text.strip())
        if found is None:
            raise ValueError(f"{text[:40]!r} is no span of the day; expected one like 22:00-07:00")
        first, last = (60 * int(found[at]) + int(found[at + 1]) for at in (1, 3))
        if first == last:
            raise ValueError(f"{text[:40]!r} begins when it ends: leave it out, or make it a span")
        return cls(first, last)

    def holds(self, minute: int) -> bool:
        """Return whether a minute of the day, 0 to 1439, lies within."""
        after = (minute - self.from_min) % MINUTES
        return after < (self.until_min - self.from_min) % MINUTES

    @property
    def text(self) -> str:
        """Return them as people read them: 22:00–07:00."""
        first, last = divmod(self.from_min, 60), divmod(self.until_min, 60)
        return f"{first[0]:02}:{first[1]:02}–{last[0]:02}:{last[1]:02}"
