"""Tell the others: when a status, an odometry or an event is due, and with which number.

A status goes out 20 times a second, and at once when mode, epoch, owner, mission, leg, held or an
answer changes, at most 40 times a second: what then waits goes out with the next.
"""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

from bridge.core.reporting.status import build
from bridge.core.tick_context import append_sent
from wire import Event, Odometry

if TYPE_CHECKING:
    from bridge.core.state import BridgeState
    from bridge.core.tick_context import TickContext
    from wire import Status

EVERY_S = 0.05
AT_LEAST_S = 0.025
_EARLY_S = 0.001
"""Ticks jitter: a status due within this is sent now, or 20 Hz would become 16."""
_DETAIL = 400
_ODOM_TICKS = 2


def status_of(tick: TickContext, before: BridgeState) -> Status | None:
    """Return the status if one is due, and remember when it was sent."""
    s = tick.s
    if tick.dropped:
        s.voice = replace(s.voice, dropped=s.voice.dropped + tick.dropped)
    pending = s.voice.pending or _has_news(before, s)
    last_s = s.voice.status_s
    wait_s = AT_LEAST_S if pending else EVERY_S
    if last_s is not None and tick.now_s - last_s < wait_s - _EARLY_S:
        if pending and not s.voice.pending:
            s.voice = replace(s.voice, pending=True)
        return None
    s.voice = replace(
        s.voice,
        status_seq=s.voice.status_seq + 1,
        status_s=tick.now_s,
        pending=False,
        ring=append_sent(s.voice.ring, tick.now_s),
    )
    return build(tick)


def odometry_of(tick: TickContext) -> Odometry | None:
    """Return odometry every other tick, stamped when the drive measured it."""
    s = tick.s
    newest = s.drive.newest
    if newest is None or s.tick % _ODOM_TICKS:
        return None
    gyro = s.pose.imu.yaw_rate_radps if s.pose.imu is not None else None
    stamp_s = newest.stamp_s if tick.inbox.sensors_same_host else s.drive.received_s
    return Odometry(
        odom_id=tick.config.boot,
        seq=s.tick,
        stamp_s=stamp_s if stamp_s is not None else tick.now_s,
        base_in_odom=s.odometry.base_in_odom,
        twist=s.odometry.measured,
        yaw_rate_radps=gyro,
    )


def events_of(tick: TickContext) -> tuple[Event, ...]:
    """Number this tick's events."""
    if not tick.events:
        return ()
    s = tick.s
    first = s.voice.event_seq + 1
    s.voice = replace(s.voice, event_seq=s.voice.event_seq + len(tick.events))
    return tuple(
        Event(
            boot=tick.config.boot,
            seq=first + index,
            tick=s.tick,
            at_s=max(0.0, tick.now_s),
            code=code,
            mode=s.mode,
            detail=detail[:_DETAIL],
        )
        for index, (code, detail) in enumerate(tick.events)
    )


def _has_news(old: BridgeState, new: BridgeState) -> bool:
    """Tell whether something changed that must be told at once."""
    return (
        old.mode is not new.mode
        or old.epoch_no != new.epoch_no
        or old.held is not new.held
        or old.operator is not new.operator
        or old.ownership.owner is not new.ownership.owner
        or old.grants.mission != new.grants.mission
        or old.gate.blocked != new.gate.blocked
        or (old.leg is not new.leg and _leg(old) != _leg(new))
    )


def _leg(state: BridgeState) -> tuple[object, ...]:
    leg = state.leg
    return leg.mission, leg.leg, leg.reached, leg.refusal
