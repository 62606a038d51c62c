"""Say good things at the wrong time: old, early, again, out of order, or thinking on stale data."""

from __future__ import annotations

import json
import time
from itertools import count
from typing import TYPE_CHECKING

from pons.conformance.driver import pack
from pons.conformance.fault import (
    COMMANDS,
    DRIVES_ON,
    SILENT,
    USED_S,
    Fault,
    W,
    X,
    everything,
    spoil,
)
from pons.conformance.reference_client import number

if TYPE_CHECKING:
    from collections.abc import Callable

    from pons.conformance.driver import Breaker, Sent
    from pons.conformance.fault import Message
    from pons.conformance.fault_context import FaultContext
    from wire import Status

AHEAD = 3
"""Statuses; one more than could be sent while a message is on its way."""
BEHIND = 10
"""Half a second of statuses."""
AGAIN = 4
"""Recorded messages sent on each status: faster than they were recorded."""
HOUR_S = 3600.0


def _replay(stage: FaultContext) -> Breaker:
    """Send the last seconds' messages once more, byte for byte."""
    recorded, turn = list(stage.driver.sent), count()

    def breaker(_said: list[tuple[str, Message]], _status: Status) -> list[Sent]:
        return [recorded[next(turn) % len(recorded)] for _ in range(AGAIN)]

    return breaker


def _renumber(stage: FaultContext) -> Breaker:
    """Say the newest commands once more with fresh numbers, the owner silent otherwise."""
    recorded = [item for item in stage.driver.sent if item[0] in COMMANDS][-4:]
    turn = count()

    def breaker(_said: list[tuple[str, Message]], _status: Status) -> list[Sent]:
        key, payload = recorded[next(turn) % len(recorded)]
        message = json.loads(payload) | {"seq": number(time.monotonic())}
        return [(key, pack(message))]

    return breaker


def _shift_seen(change: int) -> Breaker:
    def shift(message: Message, status: Status) -> object:
        fields = {name for name in ("seen", "used") if name in message}
        return message | dict.fromkeys(fields, max(0, status.seq + change))

    return everything(shift)


def _stale_seen(stage: FaultContext) -> Breaker:
    """Go on talking about one status for ever."""
    seen = stage.status.seq
    return everything(lambda message, _status: message | {"seen": seen})


def _stale_used(stage: FaultContext) -> Breaker:
    """Live, but think on one status for ever."""
    used = stage.status.seq

    def freeze(message: Message, _status: Status) -> object:
        return message | ({"used": used} if "used" in message else {})

    return everything(freeze)


def _no_heartbeat(_stage: FaultContext) -> Breaker:
    def breaker(said: list[tuple[str, Message]], _status: Status) -> list[Sent]:
        return [(key, pack(message)) for key, message in said if key != "cmd/heartbeat"]

    return breaker


def _reorder(stage: FaultContext) -> Breaker:
    """Keep three commands back and send them in the wrong order."""
    kept: list[Sent] = []

    def breaker(said: list[tuple[str, Message]], _status: Status) -> list[Sent]:
        out: list[Sent] = []
        for key, message in said:
            (kept if key in COMMANDS else out).append((key, pack(message)))
        if len(kept) >= 3:
            stage.chance.shuffle(kept)
            out += reversed(kept)
            kept.clear()
        return out

    return breaker


def _duplicate(_stage: FaultContext) -> Breaker:
    def breaker(said: list[tuple[str, Message]], _status: Status) -> list[Sent]:
        return [(key, pack(message)) for key, message in said for _ in range(3)]

    return breaker


def _skew(offset_s: float, rate: float) -> Callable[[FaultContext], None]:
    """Return the play of a brain whose clock is wrong and runs wrong."""

    def play(stage: FaultContext) -> None:
        began_s = time.monotonic()

        def clock() -> float:
            return offset_s + (time.monotonic() - began_s) * rate

        stage.begin()
        stage.driver.clock = clock
        stage.brain.sent_s = clock()
        try:
            stage.wait()
        finally:
            stage.end()
            stage.driver.clock = time.monotonic
            stage.brain.sent_s = time.monotonic()

    return play


FAULTS = (
    Fault("replayed", "all of the last 2 s again, byte for byte", spoil(_replay), SILENT),
    Fault("renumbered", "old commands with fresh numbers", spoil(_renumber), SILENT, quick=(X,)),
    Fault("clock_ahead", "the sender's clock an hour ahead and 25 % fast", _skew(HOUR_S, 1.25),
          DRIVES_ON),
    Fault("clock_behind", "the sender's clock an hour behind and 25 % slow",
          _skew(-HOUR_S, 0.75), DRIVES_ON),
    Fault("seen_ahead", f"claims a status {AHEAD} ahead of the newest",
          spoil(lambda _stage: _shift_seen(AHEAD)), SILENT),
    Fault("seen_behind", f"answers what was said {BEHIND} statuses ago",
          spoil(lambda _stage: _shift_seen(-BEHIND)), SILENT),
    Fault("stale_seen", "one status named for ever", spoil(_stale_seen), SILENT),
    Fault("stale_used", "lives, but thinks on one status for ever", spoil(_stale_used),
          {W: USED_S}, kinds=(W,)),
    Fault("no_heartbeat", "commands, but no heartbeats: velocities are a lease by themselves",
          spoil(_no_heartbeat, stand=False), DRIVES_ON, kinds=(X,)),
    Fault("no_heartbeat", "commands, but no heartbeats", spoil(_no_heartbeat), {W: USED_S},
          kinds=(W,)),
    Fault("reordered", "three commands at a time, shuffled", spoil(_reorder, stand=False),
          DRIVES_ON),
    Fault("duplicated", "each message three times", spoil(_duplicate, stand=False), DRIVES_ON),
)  # fmt: skip
