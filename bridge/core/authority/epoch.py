"""Change the epoch: nothing that was meant for the old one is obeyed afterwards.

The only writer of ``epoch_no`` and ``held``. What an epoch voids is voided by each record's own
module, in the order below.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from bridge.core.authority import external_velocity, stick
from bridge.core.authority.grants import end_grant
from bridge.core.authority.leg_tracking import forget_horizon, forget_refusal
from bridge.core.authority.ownership import restart_numbers
from wire import Held, HeldReason

if TYPE_CHECKING:
    from bridge.core.tick_context import TickContext


def new_epoch(tick: TickContext, why: str, *, keep_stick: bool = False) -> None:
    """Mint the next epoch: sequence numbers restart, grant, horizon and stick are void.

    Args:
        tick: the tick in the making.
        why: stable code for the event.
        keep_stick: the hand that takes over goes on; every other change needs it released again.
    """
    tick.s.epoch_no += 1
    restart_numbers(tick)
    end_grant(tick)
    forget_refusal(tick)
    external_velocity.forget(tick)
    stick.restart(tick, keeps_hand=keep_stick)
    tick.say("epoch", why)


def hold(tick: TickContext, reason: HeldReason, held_id: str) -> None:
    """Refuse every grant from now on, until arm or resume."""
    tick.s.held = Held(reason=reason, id=held_id)
    tick.say("held", f"{reason.value} {held_id}")


def revoke(tick: TickContext) -> None:
    """End the grant and the leg; the remainder stays in the book for another grant."""
    end_grant(tick)
    forget_horizon(tick)


def release(tick: TickContext) -> None:
    """Let grants count again: a person has armed or resumed."""
    tick.s.held = None
