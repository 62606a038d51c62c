"""Tell the others: when a status, an odometry or an event is due, and what it says.

A status goes out 20 times a second, and at once when mode, epoch, owner, mission, leg, held or an
answer changes, at most 40 times a second: what then waits goes out with the next. It holds
everything that others may rely on, as of now. What a status says is read from the state.
"""

from __future__ import annotations

from dataclasses import replace
from itertools import islice
from typing import TYPE_CHECKING

from bridge.core.authority.leg_tracking import residual
from bridge.core.authority.requests import answers_to_echo, nonce_text
from bridge.core.faults.fault_latch import binds, worst
from bridge.core.faults.fault_table import STAGES
from bridge.core.modes.operator import arm_lacks, is_outside_fence
from bridge.core.modes.selftest import waits_for
from bridge.core.motion.limiter import stopping_m
from bridge.core.motion.obstacle_gate import weak_m
from bridge.core.sensing.sensor_update import recorder_lack
from bridge.core.tick_context import POWERED, append_sent
from wire import (
    PROTOCOL,
    SEVERITY,
    BrakingReport,
    DriveReport,
    Event,
    GrantLeft,
    LegReport,
    LimitsInForce,
    Mode,
    Odometry,
    RowReport,
    Status,
    TickStats,
)

if TYPE_CHECKING:
    from bridge.core.state import BridgeState
    from bridge.core.tick_context import TickContext

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
        or (old.leg is not new.leg and _leg_of(old) != _leg_of(new))
    )


def _leg_of(state: BridgeState) -> tuple[object, ...]:
    leg = state.leg
    return leg.mission, leg.leg, leg.reached, leg.refusal


_EVIDENCE = 400
_MOST_S = 1e9
_MOST_US = 1e9


def build(tick: TickContext) -> Status:
    """Return the status of this tick."""
    s, config = tick.s, tick.config
    action = s.stopping.action if s.stopping is not None else worst(tick)[0]
    return Status(
        protocol=PROTOCOL,
        robot=config.robot.id,
        boot=config.boot,
        seq=s.voice.status_seq,
        at_s=_between(tick.now_s, _MOST_S),
        mode=s.mode,
        action=action,
        epoch=tick.epoch,
        nonce=nonce_text(tick),
        owner=s.ownership.owner,
        held=s.held,
        grant=_grant(tick),
        leg=_leg(tick),
        base_in_odom=s.odometry.base_in_odom,
        base_in_map=tick.robot_in_map,
        asked=s.motion.asked,
        sent=s.motion.limiter.sent,
        measured=s.odometry.measured,
        limits=_limits(tick),
        rows=_rows(tick),
        answers=answers_to_echo(tick),
        waiting_for=tuple(islice(_waiting(tick), 8)),
        blocked=s.gate.blocked,
        robot_hash=config.robot_hash,
        fence_hash=config.fence_hash,
        marks_hash=s.marks.hash,
        map_id=config.map_id,
        operator_metres=s.grants.operator_metres,
        operator_seconds=s.grants.operator_seconds,
        drive=_drive(tick),
        braking=_braking(tick),
        ticks=_ticks(tick),
    )


def _grant(tick: TickContext) -> GrantLeft | None:
    grants = tick.s.grants
    if grants.mission is None:
        return None
    return GrantLeft(mission=grants.mission, metres=grants.metres, seconds=grants.seconds)


def _leg(tick: TickContext) -> LegReport | None:
    leg = tick.s.leg
    if leg.mission is None:
        return None
    residual_m, residual_rad = residual(tick)
    return LegReport(
        mission=leg.mission,
        leg=leg.leg,
        following=tick.s.mode is Mode.ACTIVE
        and leg.horizon is not None
        and bool(leg.horizon.points),
        reached=leg.reached,
        residual_m=_between(residual_m, 100_000.0),
        residual_rad=_between(residual_rad, 7.0),
        refusal=leg.refusal,
    )


def _limits(tick: TickContext) -> LimitsInForce:
    motion, robot, learnt = tick.s.motion, tick.config.robot, tick.s.learnt
    margin_m = None
    if motion.free_m is not None:
        sent = motion.limiter.sent
        lag_s = robot.drive.late_s + learnt.lag_more_s
        stop_m = stopping_m(sent, 0.0, robot.base, robot.limits, tick.config.period_s)
        stop_m += weak_m(sent, robot, learnt.decel_share)
        margin_m = motion.free_m - stop_m - abs(sent.v_mps) * lag_s
    return LimitsInForce(
        v_mps=robot.limits.max_speed_mps * motion.cap,
        w_radps=robot.limits.max_turn_radps * motion.cap,
        by=motion.bound_by,
        free_m=motion.free_m,
        margin_m=margin_m,
    )


def _rows(tick: TickContext) -> tuple[RowReport, ...]:
    """Show each row once, by its worst stage."""
    letters = tick.s.sources()
    worst_of: dict[str, str] = {}
    for name in tick.s.rows:
        stage = STAGES[name]
        shown_name = worst_of.get(stage.row)
        if shown_name is None or _rank(name, letters) > _rank(shown_name, letters):
            worst_of[stage.row] = name
    return tuple(
        RowReport(
            row=row,
            action=STAGES[name].action,
            for_s=_between(tick.now_s - tick.s.rows[name].since_s, _MOST_S),
            evidence=tick.s.rows[name].evidence[:_EVIDENCE],
            binding=binds(STAGES[name], letters),
        )
        for row, name in worst_of.items()
    )


def _rank(name: str, letters: str) -> tuple[bool, int]:
    stage = STAGES[name]
    return binds(stage, letters), SEVERITY[stage.action]


def _waiting(tick: TickContext) -> tuple[str, ...]:
    s = tick.s
    if s.mode is Mode.SELFTEST:
        return tuple(waits_for(tick))
    if s.mode is Mode.FAULT and s.fault is not None:
        return (s.fault,)
    outside = ("fence_excludes_robot",) if is_outside_fence(tick) else ()
    if s.mode is Mode.DISARMED:
        return (*outside, *dict.fromkeys(code for code, _ in arm_lacks(tick)))
    if s.mode not in POWERED:
        return ()
    if not s.loop.recorder_ok:  # it drives on; the next arming would be refused
        return (*outside, recorder_lack(tick.inbox)[0])
    return outside


def _drive(tick: TickContext) -> DriveReport:
    s, drive = tick.s, tick.config.robot.drive
    newest = s.drive.newest
    return DriveReport(
        kind=drive.kind,
        virtual=drive.virtual,
        enabled=newest is not None and newest.enabled,
        timed_out=newest is not None and newest.timed_out,
        boot_id=newest.boot_id if newest is not None else None,
        battery=newest.battery if newest is not None else None,
        real_time=s.loop.real_time,
    )


def _braking(tick: TickContext) -> BrakingReport:
    robot, learnt = tick.config.robot, tick.s.learnt
    return BrakingReport(
        lag_s=robot.drive.late_s + learnt.lag_more_s,
        decel_mps2=robot.limits.max_decel_mps2 * learnt.decel_share,
        learnt=learnt.lag_more_s > 0.0 or learnt.decel_share < 1.0,
        stops=learnt.stops,
        trouble=tick.s.braking_trouble,
    )


def _ticks(tick: TickContext) -> TickStats:
    facts = tick.inbox.loop
    return TickStats(
        ticks=tick.s.tick,
        missed=tick.s.loop.missed,
        late_p50_us=_between(facts.late_p50_us, _MOST_US),
        late_max_us=_between(facts.late_max_us, _MOST_US),
        step_max_us=_between(facts.step_max_us, _MOST_US),
        dropped=tick.s.voice.dropped,
        record_gaps=facts.record_gaps,
    )


def _between(value: float, most: float) -> float:
    """Hold a number that is only shown within what the wire can say; none is 0."""
    return value if 0.0 <= value <= most else (most if value > most else 0.0)
