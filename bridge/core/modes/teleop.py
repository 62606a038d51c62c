"""Follow the hand on the stick. It outranks every brain and is outranked by every stop.

A source takes over only after it was seen with the dead-man released and then neutral in this
epoch; the first one that holds keeps the robot until it lets go. Its age runs like any command's.
"""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

from bridge.core.authority.epoch import hold, turn
from bridge.core.authority.message_score import bad, good
from bridge.core.geometry.message_age import sent_at
from bridge.core.modes.mode_table import Fact, Request
from bridge.core.modes.transition import go
from bridge.core.state_orders import Stick
from wire import HeldReason, Mode, Twist2

if TYPE_CHECKING:
    from bridge.core.tick_context import Tick
    from wire import Velocity

CAUSAL_S = 0.4
RECEIPT_S = 0.25
NEUTRAL_MPS, NEUTRAL_RADPS = 0.02, 0.05
_SOURCES = 8


def hear_teleop(tick: Tick, new: Velocity) -> None:
    """Take in one message of a stick; it may take over, steer or let go."""
    s = tick.s
    if new.dead_man:
        s.stick = replace(s.stick, pressed_s=tick.now_s)
    if new.epoch != tick.epoch:
        tick.drop("old_epoch")
        return
    sent_s = sent_at(s.voice.ring, s.voice.status_seq, new.seen)
    if sent_s is None or not tick.now_s - sent_s <= CAUSAL_S:
        tick.drop("teleop_stale")
        return
    holder = s.stick.source_id
    if holder is not None and holder != new.source_id:
        tick.drop("stick_taken")
    elif not new.dead_man:
        _let_go(tick, new)
    elif holder is None:
        _take_over(tick, new, sent_s)
    else:
        _steer(tick, new, sent_s)


def watch(tick: Tick) -> None:
    """Let a silent or stale stick go."""
    s = tick.s
    stick = s.stick
    if stick.source_id is None:
        return
    fresh = tick.now_s - stick.received_s <= RECEIPT_S and tick.now_s - stick.sent_s <= CAUSAL_S
    if not fresh:
        _release(tick, "teleop_stale")


def wanted(tick: Tick) -> Twist2:
    """Return what the stick asks for."""
    return Twist2(tick.s.stick.v_mps, tick.s.stick.w_radps)


def _neutral(new: Velocity) -> bool:
    return abs(new.v_mps) <= NEUTRAL_MPS and abs(new.w_radps) <= NEUTRAL_RADPS


def _let_go(tick: Tick, new: Velocity) -> None:
    if tick.s.stick.source_id is not None:
        _release(tick, "teleop_released")
    stick = tick.s.stick
    if new.source_id not in stick.released:
        stick = replace(stick, released=(*stick.released, new.source_id)[-_SOURCES:])
    tick.s.stick = stick
    _see_neutral(tick, new)


def _see_neutral(tick: Tick, new: Velocity) -> None:
    stick = tick.s.stick
    if _neutral(new) and new.source_id in stick.released and new.source_id not in stick.ready:
        tick.s.stick = replace(stick, ready=(*stick.ready, new.source_id)[-_SOURCES:])


def _take_over(tick: Tick, new: Velocity, sent_s: float) -> None:
    _see_neutral(tick, new)
    s = tick.s
    if new.source_id not in s.stick.ready or tick.stopped:
        tick.drop("stick_not_ready")
        return
    if tick.powered and s.grants.spent_hand_part() is not None:
        tick.drop("hand_spent")
        return
    if not go(tick, Request.TELEOP, f"teleop {new.source_id}"):
        tick.drop("teleop_not_now")
        return
    s.source = "T"
    s.stick = replace(
        s.stick,
        source_id=new.source_id,
        v_mps=new.v_mps,
        w_radps=new.w_radps,
        received_s=tick.now_s,
        sent_s=sent_s,
    )
    turn(tick, "teleop", keep_stick=True)
    hold(tick, HeldReason.TELEOP, new.source_id)
    s.grants = replace(s.grants, since_arm=False)


def _steer(tick: Tick, new: Velocity, sent_s: float) -> None:
    s = tick.s
    if not new.seq > s.stick.seq:
        if new.seq < s.stick.seq:
            bad(tick, "seq_backwards")
        else:
            tick.drop("repeated")
        return
    good(tick)
    s.stick = replace(
        s.stick,
        seq=new.seq,
        v_mps=new.v_mps,
        w_radps=new.w_radps,
        received_s=tick.now_s,
        sent_s=max(sent_s, s.stick.sent_s),
    )


def _release(tick: Tick, why: str) -> None:
    """End teleop: HOLD, held, and the same hand must show itself released and neutral anew."""
    s = tick.s
    source_id = s.stick.source_id or ""
    s.stick = Stick(pressed_s=s.stick.pressed_s)
    if s.mode is Mode.TELEOP and go(tick, Fact.RELEASED, why):
        hold(tick, HeldReason.TELEOP, source_id)
