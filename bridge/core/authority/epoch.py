"""Change the epoch: nothing that was meant for the old one is obeyed afterwards."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

from bridge.core.state_orders import MAX_MISSIONS, MissionLeft, Stick
from wire import Held, HeldReason

if TYPE_CHECKING:
    from bridge.core.state_orders import Grants
    from bridge.core.tick_context import Tick


def turn(tick: Tick, why: str, *, keep_stick: bool = False) -> None:
    """Mint the next epoch: sequence numbers restart, grant, horizon and stick are void.

    Args:
        tick: the tick in the making.
        why: stable code for the event.
        keep_stick: the hand that takes over goes on; every other change needs it released again.
    """
    s = tick.s
    s.epoch_no += 1
    s.ownership = replace(s.ownership, waypoints_seq=None, external_seq=None)
    s.grants = shelved(s.grants)
    s.leg = replace(s.leg, horizon=None, path=None, refusal=None)
    s.external = None
    s.stick = replace(s.stick, seq=-1) if keep_stick else Stick()
    tick.say("epoch", why)


def hold(tick: Tick, reason: HeldReason, held_id: str) -> None:
    """Refuse every grant from now on, until arm or resume."""
    tick.s.held = Held(reason=reason, id=held_id)
    tick.say("held", f"{reason.value} {held_id}")


def revoke(tick: Tick) -> None:
    """End what is granted and followed now; its remainder stays in the book for another grant."""
    s = tick.s
    s.grants = shelved(s.grants)
    s.leg = replace(s.leg, horizon=None, path=None)


def shelved(grants: Grants) -> Grants:
    """Put the granted mission's remainder in the book; nothing is granted any more."""
    if grants.mission is None:
        return grants
    left = MissionLeft(grants.mission, grants.metres, grants.seconds)
    book = (*(item for item in grants.book if item.mission != left.mission), left)
    return replace(grants, mission=None, metres=0.0, seconds=0.0, book=book[-MAX_MISSIONS:])
