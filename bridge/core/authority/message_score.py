"""Score the owner's messages: a bucket that fills with each bad one and empties with time.

Only messages of this epoch, of the owner and under a grant are scored, or of the hand that steers;
bytes that are no message are charged to whoever may use that key now.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from bridge.core.tick_context import TickContext

DRAIN_S = 0.5
"""The bucket loses one per good message, and one in this time."""
FULL = 10.0
"""It holds no more, so that a burst is forgiven within seconds."""

_KEYS = {"cmd/waypoints": "W", "cmd/external": "X", "cmd/teleop": "T"}


def drain(tick: TickContext) -> None:
    """Let the bucket empty with time."""
    if tick.s.bad_bucket > 0.0:
        tick.s.bad_bucket = max(0.0, tick.s.bad_bucket - tick.dt_s / DRAIN_S)


def bad(tick: TickContext, code: str) -> None:
    """Score one bad message and drop it."""
    tick.drop(code)
    tick.s.bad_bucket = min(FULL, tick.s.bad_bucket + 1.0)


def good(tick: TickContext) -> None:
    """Score one good message."""
    tick.s.bad_bucket = max(0.0, tick.s.bad_bucket - 1.0)


def hear_rejected(tick: TickContext) -> None:
    """Count bytes that were no message; score them where their key's owner is in charge."""
    letters = tick.s.sources() if tick.inbox.rejected else ""
    for item in tick.inbox.rejected:
        if _KEYS.get(item.key, "-") in letters:
            bad(tick, f"rejected_{item.why.code}")
        else:
            tick.drop(f"rejected_{item.why.code}")
