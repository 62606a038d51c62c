"""Say how old things are, on this clock alone. No sender can make anything younger.

A command names the newest status its origin had seen; its age runs from when that status was sent.
A sensor's age runs from receipt, or from its stamp where that is on this host's clock and older.
"""

from __future__ import annotations

from wire import STATUS_RING


def append_sent(ring: tuple[float, ...], sent_s: float) -> tuple[float, ...]:
    """Return the ring of sending times with one more, the oldest let go."""
    return (*ring[-(STATUS_RING - 1) :], sent_s)


def sent_at(ring: tuple[float, ...], newest_seq: int, seen: int) -> float | None:
    """Return when the status ``seen`` was sent; None if never, or longer ago than the ring."""
    back = newest_seq - seen
    if 0 <= back < len(ring):
        return ring[-1 - back]
    return None


def sensor_age_s(now_s: float, received_s: float, stamp_s: float, *, same_host: bool) -> float:
    """Return the age of a reading [s]: the larger of the two, a stamp of the future ignored."""
    if same_host and stamp_s < received_s:
        return now_s - stamp_s
    return now_s - received_s
