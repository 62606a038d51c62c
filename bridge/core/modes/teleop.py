"""Follow the hand on the stick. It outranks every brain and is outranked by every stop.

A source takes over only after it was seen with the dead-man released and then neutral in this
epoch; the first one that holds keeps the robot until it lets go. Its age runs like any command's.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from bridge.core.authority import stick
from bridge.core.authority.epoch import hold, new_epoch
from bridge.core.authority.message_limits import bad, good
from bridge.core.authority.ownership import forget_arming
from bridge.core.modes.mode_table import Fact, RequestCause
from bridge.core.modes.transition import go
from bridge.core.tick_context import sent_at
from wire import HeldReason, Mode, Twist2

if TYPE_CHECKING:
    from bridge.core.tick_context import TickContext
    from wire import Velocity

CAUSAL_S = 0.4
RECEIPT_S = 0.25
VOIDED = "stick"
"""Names the hand in what is held once a new epoch has voided it."""


def hear_teleop(tick: TickContext, new: Velocity) -> None:
    """Take in one message of a stick; it may take over, steer or let go."""
    s = tick.s
    if new.dead_man:
        stick.note_pressed(tick)
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


def watch(tick: TickContext) -> None:
    """Let a silent or stale stick go, and one that a new epoch has voided while it steered."""
    hand = tick.s.stick
    if hand.source_id is None:
        if tick.s.mode is Mode.TELEOP:
            _release(tick, "teleop_stale")
        return
    fresh = tick.now_s - hand.received_s <= RECEIPT_S and tick.now_s - hand.sent_s <= CAUSAL_S
    if not fresh:
        _release(tick, "teleop_stale")


def requested_twist(tick: TickContext) -> Twist2:
    """Return the twist that the stick asks for."""
    return Twist2(tick.s.stick.v_mps, tick.s.stick.w_radps)


def _let_go(tick: TickContext, new: Velocity) -> None:
    if tick.s.stick.source_id is not None:
        _release(tick, "teleop_released")
    stick.note_released(tick, new.source_id)
    stick.note_neutral(tick, new)


def _take_over(tick: TickContext, new: Velocity, sent_s: float) -> None:
    stick.note_neutral(tick, new)
    s = tick.s
    if new.source_id not in s.stick.ready or tick.stopped:
        tick.drop("stick_not_ready")
        return
    if tick.is_powered and s.grants.spent_hand_part() is not None:
        tick.drop("hand_spent")
        return
    if not go(tick, RequestCause.TELEOP, f"teleop {new.source_id}", source="T"):
        tick.drop("teleop_not_now")
        return
    stick.give(tick, new, sent_s)
    new_epoch(tick, "teleop", keep_stick=True)
    hold(tick, HeldReason.TELEOP, new.source_id)
    forget_arming(tick)


def _steer(tick: TickContext, new: Velocity, sent_s: float) -> None:
    s = tick.s
    if not new.seq > s.stick.seq:
        if new.seq < s.stick.seq:
            bad(tick, "seq_backwards")
        else:
            tick.drop("repeated")
        return
    good(tick)
    stick.steer(tick, new, sent_s)


def _release(tick: TickContext, why: str) -> None:
    """End teleop: HOLD, held, and the same hand must show itself released and neutral anew."""
    s = tick.s
    source_id = s.stick.source_id or VOIDED
    stick.let_go(tick)
    if s.mode is Mode.TELEOP and go(tick, Fact.RELEASED, why):
        hold(tick, HeldReason.TELEOP, source_id)
