"""Change owner and epoch: nothing that was meant for the old one is obeyed afterwards.

The only writer of ``epoch_no`` and ``held``. What an epoch voids is voided by each record's own
module, in the order below. An owner comes by hello, standing, and only while there is no living
owner; one that falls silent loses the robot.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from bridge.core.authority import external_velocity, stick
from bridge.core.authority.leg_tracking import forget_horizon, forget_refusal
from bridge.core.authority.ownership import (
    LIVE_S,
    begin_ownership,
    end_grant,
    end_ownership,
    is_alive,
    note_echo,
    restart_numbers,
    sent_when,
)
from bridge.core.authority.requests import refuse_openly, settle_openly
from wire import PROTOCOL, HeldReason, Owner, StandingHold

if TYPE_CHECKING:
    from collections.abc import Iterator

    from bridge.core.tick_context import TickContext
    from wire import Hello


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
    tick.s.held = StandingHold(reason=reason, id=held_id)
    tick.say("held", f"{reason.value} {held_id}")


def revoke(tick: TickContext) -> None:
    """End the grant and the leg; the remainder stays in the book for another grant."""
    end_grant(tick)
    forget_horizon(tick)


def release(tick: TickContext) -> None:
    """Let grants count again: a person has armed or resumed."""
    tick.s.held = None


_ANEW = "its {0} is not this bridge's; start the bridge and its owner anew with the same {0}"


def free_lost_owner(tick: TickContext) -> None:
    """Take the robot from an owner who fell silent, in a new epoch."""
    ownership = tick.s.ownership
    if ownership.owner is not None and not is_alive(tick):
        lost = ownership.owner.planner_id
        end_ownership(tick)
        new_epoch(tick, "brain_lost")
        tick.say("owner_lost", lost)


def hear_hello(tick: TickContext, hello: Hello) -> None:
    """Answer one hello: owner now, owner already, or refused with the reason."""
    ownership = tick.s.ownership
    sent_s = sent_when(tick, hello.seen)
    if sent_s is None or not tick.now_s - sent_s <= LIVE_S:
        tick.drop("hello_stale")
        return
    if ownership.owner is not None and ownership.owner.planner_id == hello.planner_id:
        note_echo(tick, sent_s)
        return
    refusal = next(_against(tick, hello), None)
    if refusal is not None:
        refuse_openly(tick, "hello", hello.planner_id, *refusal)
        return
    settle_openly(tick, "hello", hello.planner_id)
    _own(tick, hello, sent_s)


def _against(tick: TickContext, hello: Hello) -> Iterator[tuple[str, str]]:
    """Yield code and detail of everything that speaks against this owner-to-be."""
    config = tick.config
    for code, came, expected, to_do in (
        ("protocol_mismatch", hello.protocol, PROTOCOL, "run both of one version"),
        ("robot_mismatch", hello.robot_hash, config.robot_hash, _ANEW.format("robot.toml")),
        ("fence_mismatch", hello.fence_hash, config.fence_hash, _ANEW.format("fence.json")),
        ("map_mismatch", hello.map_id, config.map_id, _ANEW.format("map")),
    ):
        if came != expected:
            yield code, f"came {came}, expected {expected}: {to_do}"
    if is_alive(tick):
        owner = tick.s.ownership.owner
        yield "owner_alive", f"owner is {owner.planner_id if owner else 'nobody'}"
    if not tick.still_for(0.0):
        yield "not_standing", "ownership changes only while the robot stands"


def _own(tick: TickContext, hello: Hello, sent_s: float) -> None:
    before = tick.s.ownership
    if before.last_owner_id not in {None, hello.planner_id}:
        new_epoch(tick, "owner_changed")
        hold(tick, HeldReason.NEW_PLANNER, hello.planner_id)
    begin_ownership(tick, Owner(planner_id=hello.planner_id, kind=hello.kind), sent_s)
    tick.say("owner", f"{hello.kind} {hello.planner_id}")
