"""Read people's clock: when HH:MM comes next, and whether it is that late. Pure arithmetic.

Local time is Unix time and an offset from UTC [s] that was read when the planner began: where
summer time begins or ends while it runs, HH:MM is an hour off until it is started anew.
"""

from __future__ import annotations

DAY_S = 86400.0
MAX_AHEAD_S = 12 * 3600.0
"""An HH:MM whose next coming is farther off than this was meant for a time that is past."""


def clock_time(local_s: float) -> str:
    """Return HH:MM of a local time [s]."""
    minutes = int(local_s % DAY_S // 60)
    return f"{minutes // 60:02d}:{minutes % 60:02d}"


def seconds_until(time: str, local_s: float) -> float | None:
    """Return how long it is until HH:MM comes next [s]; None where that time is past."""
    hour, minute = (int(part) for part in time.split(":"))
    ahead_s = (3600.0 * hour + 60.0 * minute - local_s) % DAY_S
    return ahead_s if ahead_s <= MAX_AHEAD_S else None


def is_between(after: str | None, before: str | None, local_s: float) -> bool:
    """Tell whether it is ``after`` already and not yet ``before``, over midnight too."""
    now = clock_time(local_s)
    if after is None or before is None:
        return (after is None or after <= now) and (before is None or now < before)
    if after <= before:
        return after <= now < before
    return after <= now or now < before
