"""Follow another brain's velocities: owned and granted like a planner's waypoints."""

from __future__ import annotations

from typing import TYPE_CHECKING

from bridge.core.authority.message_limits import bad, good
from bridge.core.authority.ownership import note_external, sent_at_if_owner
from bridge.core.state_orders import External
from wire import STILL, Twist2

if TYPE_CHECKING:
    from bridge.core.tick_context import TickContext
    from wire import Velocity

TTL_S = 0.25


def hear_external(tick: TickContext, new: Velocity) -> None:
    """Follow this velocity from now on, or drop it."""
    sent_s = sent_at_if_owner(tick, new.source_id, new.epoch, new.seen)
    if sent_s is None:
        return
    s = tick.s
    owner = s.ownership.owner
    if s.grants.mission is None or owner is None or owner.kind != "external":
        tick.drop("no_grant")
        return
    last = s.ownership.external_seq
    if last is not None and not new.seq > last:
        if new.seq < last:
            bad(tick, "seq_backwards")
        else:
            tick.drop("repeated")
        return
    note_external(tick, new.seq)
    good(tick)
    held = new.dead_man
    s.external = External(new.v_mps if held else 0.0, new.w_radps if held else 0.0, held, sent_s)


def forget(tick: TickContext) -> None:
    """Follow no velocity until another one comes."""
    tick.s.external = None


def asks_to_move(tick: TickContext) -> bool:
    """Tell whether a fresh velocity asks the robot to move."""
    external = tick.s.external
    return external is not None and external.dead_man and tick.now_s - external.sent_s <= TTL_S


def requested_twist(tick: TickContext) -> Twist2:
    """Return the twist that the external brain asks for."""
    external = tick.s.external
    return STILL if external is None else Twist2(external.v_mps, external.w_radps)
