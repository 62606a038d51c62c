"""Turn a time that people ask about into its bounds, by the home's own clock. Pure."""

from __future__ import annotations

from datetime import datetime, timedelta
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from planner.plan import Span

Bounds = tuple[float | None, float | None]
"""Since and until, in seconds of the wall clock; None: unbounded."""
_HOURS = {"today": (0, 24), "morning": (5, 12), "afternoon": (12, 18), "evening": (18, 24)}


def bounds_of(when: Span | None, now: datetime) -> Bounds:
    """Return since and until; a part of the day that has not begun means yesterday's."""
    midnight = now.replace(hour=0, minute=0, second=0, microsecond=0)
    match when:
        case None:
            return None, None
        case "hour":
            return (now - timedelta(hours=1)).timestamp(), now.timestamp()
        case "week":
            return (now - timedelta(days=7)).timestamp(), now.timestamp()
        case "yesterday":
            return _day_before(midnight).timestamp(), midnight.timestamp()
        case "night":  # of the evening before until the morning
            since = _day_before(midnight).replace(hour=18)
            return since.timestamp(), midnight.replace(hour=6).timestamp()
    first, last = _HOURS[when]
    if now < midnight.replace(hour=first):
        midnight = _day_before(midnight)
    until = midnight.replace(hour=last) if last < 24 else midnight + timedelta(days=1)
    return midnight.replace(hour=first).timestamp(), until.timestamp()


def _day_before(midnight: datetime) -> datetime:
    """Return the midnight before; a day on which clocks change has 23 or 25 hours."""
    before = (midnight - timedelta(hours=12)).astimezone()
    return before.replace(hour=0, minute=0, second=0, microsecond=0)
