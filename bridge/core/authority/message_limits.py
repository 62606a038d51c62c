"""Bound how often and how badly a sender may speak: rows CMD_FLOOD and CMD_BAD.

Payloads on a command key are counted as they arrive, parsed or not, in a sliding 250 ms made of two
halves. A key over its limit is not heard in that tick: a flooded heartbeat is no heartbeat. Stops
and operators' requests are never counted and never dropped here.

Bad messages fill a bucket that empties with time. Only messages of this epoch, of the owner and
under a grant are scored, or of the hand that steers; bytes that are no message are charged to
whoever may use that key now.
"""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING, Any

from bridge.core.state_senses import Flood
from bridge.core.tick_context import fill

if TYPE_CHECKING:
    from bridge.core.inbox import Inbox
    from bridge.core.tick_context import TickContext

RATES_HZ = {
    "cmd/waypoints": 10.0,
    "cmd/teleop": 20.0,
    "cmd/external": 20.0,
    "cmd/grant": 40.0,
    "cmd/heartbeat": 40.0,
    "cmd/hello": 40.0,
}
"""As often as each may be said; the last three answer statuses, of which there are 40/s at most."""
WINDOW_S = 0.25
SLACK, ONE_MORE = 1.2, 1
FULL_S = 4 * WINDOW_S

_KEYS = tuple(RATES_HZ)
_LIMITS = tuple(int(rate * WINDOW_S * SLACK) + ONE_MORE for rate in RATES_HZ.values())
_NONE = (0,) * len(_KEYS)
_FIELDS = ("waypoints", "teleop", "external", "grants", "heartbeats", "hellos")


def rate_limited(tick: TickContext) -> Inbox:
    """Return this tick's inbox without messages that came too fast; remember the counts."""
    inbox, flood = tick.inbox, tick.s.flood
    goes_on = not flood.counts or tick.now_s - flood.half_since_s < WINDOW_S / 2
    if goes_on and not inbox.arrived and flood.level_s == 0.0:
        return inbox
    counts, before, half_s = _half_windows(flood, tick.now_s)
    if inbox.arrived:
        came = {item.key: item.count for item in inbox.arrived}
        counts = tuple(n + came.get(key, 0) for n, key in zip(counts, _KEYS, strict=True))
    over = [
        index for index, limit in enumerate(_LIMITS) if not counts[index] + before[index] <= limit
    ]
    level_s = fill(flood.level_s, tick.dt_s, FULL_S, dirty=bool(over))
    key = _KEYS[over[0]] if over else flood.key
    quiet = counts == _NONE and before == _NONE
    tick.s.flood = Flood(half_s, () if quiet else counts, () if quiet else before, level_s, key)
    return _drop_keys(tick, inbox, over) if over else inbox


def _half_windows(flood: Flood, now_s: float) -> tuple[tuple[int, ...], tuple[int, ...], float]:
    """Begin a new half window when it is time to."""
    counts, before = flood.counts or _NONE, flood.before or _NONE
    passed_s = now_s - flood.half_since_s
    if passed_s < WINDOW_S / 2:
        return counts, before, flood.half_since_s
    return _NONE, (counts if passed_s < WINDOW_S else _NONE), now_s


def _drop_keys(tick: TickContext, inbox: Inbox, over: list[int]) -> Inbox:
    for index in over:
        for _ in getattr(inbox, _FIELDS[index]):
            tick.drop("flood")
    none: dict[str, Any] = {_FIELDS[index]: () for index in over}
    return replace(inbox, **none)


DRAIN_S = 0.5
"""The bucket loses one per good message, and one in this time."""
FULL = 10.0
"""It holds no more, so that a burst is forgiven within seconds."""

_LETTERS = {"cmd/waypoints": "W", "cmd/external": "X", "cmd/teleop": "T"}


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
        if _LETTERS.get(item.key, "-") in letters:
            bad(tick, f"rejected_{item.why.code}")
        else:
            tick.drop(f"rejected_{item.why.code}")
