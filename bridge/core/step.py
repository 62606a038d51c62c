"""Take one tick: sense, listen, judge, decide, shape, meter, tell. Pure, total, never raises.

The order is the law: facts before orders, stops before everything that came with them, rows before
motion, and exactly one command at the end.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from bridge.core.authority import epoch, marks, message_limits, ownership, requests
from bridge.core.authority.epoch import revoke
from bridge.core.authority.external_velocity import hear_external
from bridge.core.authority.leg_tracking import hear_waypoints
from bridge.core.authority.ownership import hear_grant, meter
from bridge.core.decision import Decision
from bridge.core.faults.fault_latch import clear_on_grant
from bridge.core.modes import operator, selftest, teleop
from bridge.core.modes.mode_logic import decide, detect
from bridge.core.motion import braking, motion_gates, wheel_command
from bridge.core.motion.wheel_command import command
from bridge.core.reporting.report import events_of, odometry_of, status_of
from bridge.core.sensing import sensor_update, stop_inputs
from bridge.core.state import BridgeState, draft
from bridge.core.state_orders import Marks, Operator
from bridge.core.tick_context import TickContext
from wire.fingerprint import fingerprint

if TYPE_CHECKING:
    from bridge.core.config import CoreConfig
    from bridge.core.inbox import Inbox


def initial(config: CoreConfig, now_s: float) -> BridgeState:
    """Return the state before the first tick: BOOT, disabled, first epoch, no nonce yet.

    Args:
        config: what the steps to come will be given.
        now_s: this host's monotonic clock.
    """
    return BridgeState(
        now_s=now_s,
        started_s=now_s,
        mode_since_s=now_s,
        operator=Operator(nonce_made_s=now_s),
        learnt=config.learnt,
        marks=Marks(config.marks, fingerprint(config.marks.encode()) if config.marks else None),
        braking_trouble=config.braking_trouble,
    )


def step(config: CoreConfig, state: BridgeState, inbox: Inbox, now_s: float) -> Decision:
    """Decide one tick. Same arguments, same decision. Never raises.

    Args:
        config: what is fixed during the run.
        state: of the last tick; left as it is.
        inbox: what arrived since, received now.
        now_s: this host's monotonic clock; one that runs backwards stands still.
    """
    if not now_s >= state.now_s:
        now_s = state.now_s
    s = draft(state)
    tick = TickContext(config, s, inbox, now_s, now_s - state.now_s)
    s.now_s = now_s
    s.tick += 1
    wheel_command.forget_after_gap(tick)
    sensor_update.sense(tick)
    _listen(tick)
    stop_inputs.note_pressed(tick)
    detect(tick)
    decide(tick)
    if s.gate.blocked:
        motion_gates.forget_block(tick)
    wheel_command.move(tick)
    braking.watch(tick, state)
    meter(tick, state)
    sends = not selftest.withholds(tick)
    return Decision(
        state=s,
        command=command(tick) if sends else None,
        status=status_of(tick, state),
        odometry=odometry_of(tick),
        events=events_of(tick),
        reasons=tuple(tick.reasons),
    )


def _listen(tick: TickContext) -> None:
    """Hear all parties in the order of rank; a stop voids the messages that came with it."""
    inbox = tick.inbox = message_limits.rate_limited(tick)
    message_limits.drain(tick)
    requests.renew_nonce(tick)
    epoch.free_lost_owner(tick)
    operator.hear_stops(tick)
    for op in inbox.ops:
        operator.hear_op(tick, op)
    if tick.stopped:
        _void(tick)
        _locate(tick)
    else:
        _obey(tick)
    for fence in inbox.fences:
        requests.hear_fence(tick, fence)
    if inbox.fence_done is not None:
        requests.hear_done(tick, inbox.fence_done)
    for drawn in inbox.marks:
        marks.hear_marks(tick, drawn)
    if inbox.marks_done is not None:
        marks.hear_marks_done(tick, inbox.marks_done)
    if inbox.rejected:
        message_limits.hear_rejected(tick)
    teleop.watch(tick)


def _obey(tick: TickContext) -> None:
    """Hear the owner, the stick and the external brain, in this order.

    Who owns comes before what is granted, the pose before waypoints that start at it, and the hand
    on the stick before the brains that it outranks.
    """
    for new in tick.inbox.hellos:
        epoch.hear_hello(tick, new)
    for grant in tick.inbox.grants:
        granted = hear_grant(tick, grant)
        if granted is not None:
            clear_on_grant(tick)  # rows go down before the grant is said to be given
            tick.say("granted", granted)
    for heartbeat in tick.inbox.heartbeats:
        ownership.hear_heartbeat(tick, heartbeat)
    _locate(tick)
    for velocity in tick.inbox.teleop:
        teleop.hear_teleop(tick, velocity)
    for velocity in tick.inbox.external:
        hear_external(tick, velocity)
    for waypoints in tick.inbox.waypoints:
        before = tick.s.leg
        hear_waypoints(tick, waypoints)
        wheel_command.take_horizon(tick, before)


def _locate(tick: TickContext) -> None:
    """Find the robot in ``map``; where it was displaced, earlier grants are void."""
    if sensor_update.locate(tick):
        revoke(tick)


def _void(tick: TickContext) -> None:
    """Count the messages that came with a stop and are not obeyed."""
    inbox = tick.inbox
    came = (inbox.hellos, inbox.grants, inbox.heartbeats, inbox.teleop, inbox.external)
    for messages in (*came, inbox.waypoints):
        for _ in messages:
            tick.drop("void_by_stop")
