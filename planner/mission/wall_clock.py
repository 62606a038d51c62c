"""Read people's clock: which moment HH:MM is, and whether it is that late. Pure but for the zone.

The zone is this computer's, with its rules for summer time; the moment is always given.
"""

from __future__ import annotations

from datetime import datetime, timedelta

MAX_AHEAD_S = 12 * 3600.0
"""An HH:MM whose next coming is farther off than this was meant for a time that is past."""


def local(unix_s: float) -> datetime:
    """Return a moment on people's clock."""
    return datetime.fromtimestamp(unix_s).astimezone()


def next_coming(time: str, now_unix_s: float) -> float | None:
    """Return when HH:MM comes next [Unix s]; None where that time is past.

    Args:
        time: HH:MM, checked before.
        now_unix_s: this moment.
    """
    now = local(now_unix_s)
    hour, minute = (int(part) for part in time.split(":"))
    wanted = now.replace(hour=hour, minute=minute, second=0, microsecond=0, tzinfo=None)
    due_s = wanted.astimezone().timestamp()
    if due_s < now_unix_s:
        due_s = (wanted + timedelta(days=1)).astimezone().timestamp()
    return due_s if due_s - now_unix_s <= MAX_AHEAD_S else None


def is_between(after: str | None, before: str | None, now_unix_s: float) -> bool:
    """Tell whether it is ``after`` already and not yet ``before``; over midnight where that is so.

    Args:
        after: HH:MM, or None for any.
        before: HH:MM, or None for any.
        now_unix_s: this moment.
    """
    now = local(now_unix_s).strftime("%H:%M")
    if after is None or before is None:
        return (after is None or after <= now) and (before is None or now < before)
    if after <= before:
        return after <= now < before
    return after <= now or now < before
