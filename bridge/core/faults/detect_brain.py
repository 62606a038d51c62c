"""Detect an owner who is late, lost, gone or thinking on stale data; and commands grown old."""

from __future__ import annotations

from typing import TYPE_CHECKING

from bridge.core.authority.rate_limit import FULL_S
from bridge.core.tick_context import POWERED
from wire import Mode

if TYPE_CHECKING:
    from bridge.core.faults.fault_latch import Dirty
    from bridge.core.tick_context import Tick

LATE_S, LOST_S, GONE_S = 0.15, 0.3, 5.0
USED_S = 1.0
EXTERNAL_S = 0.25
BAD_TRIPS = 5.0
HAND_SHOWN_S = 1.0


def brain(tick: Tick, dirty: Dirty) -> None:
    """Judge the owner by the newest status it has shown to have seen."""
    s = tick.s
    echo_s = s.ownership.echo_s
    if echo_s is None:
        return
    age_s = tick.now_s - echo_s
    if not age_s <= LATE_S:
        if age_s > LOST_S:
            dirty.append(("BRAIN_LOST.0", f"silent for {age_s:.2f} s"))
            if age_s > GONE_S and s.grants.since_arm and s.mode in POWERED and s.source != "T":
                dirty.append(("BRAIN_GONE.0", f"silent for {age_s:.1f} s"))
        else:
            dirty.append(("BRAIN_LATE.0", f"echo {1000 * age_s:.0f} ms old"))
    used_s = s.ownership.used_s
    if s.ownership.owner is not None and used_s is not None and not tick.now_s - used_s <= USED_S:
        dirty.append(("BRAIN_STALE.0", f"uses a status {tick.now_s - used_s:.2f} s old"))


def commands(tick: Tick, dirty: Dirty) -> None:
    """Judge what is being followed, the owner's manners, and what may still be driven."""
    s = tick.s
    horizon = s.leg.horizon
    if horizon is not None and horizon.points and not s.leg.reached:
        age_s = tick.now_s - s.leg.sent_s
        if not age_s <= horizon.ttl_s:
            dirty.append(("CMD_STALE.0", f"horizon {age_s:.2f} s old, ttl {horizon.ttl_s} s"))
    if s.external is not None:
        age_s = tick.now_s - s.external.sent_s
        if not age_s <= EXTERNAL_S:
            dirty.append(("CMD_STALE.1", f"velocity {age_s:.2f} s old"))
    if not s.bad_bucket < BAD_TRIPS:
        dirty.append(("CMD_BAD.0", f"{s.bad_bucket:.0f} bad messages"))
    if s.grants.mission is not None:
        what = s.grants.spent_part()
        if what is not None:
            dirty.append(("BUDGET.0", f"{what} are spent"))


def hand(tick: Tick, dirty: Dirty) -> None:
    """Judge what a hand on the stick may still drive, while it drives or asks to."""
    s = tick.s
    pressed_s = s.stick.pressed_s
    asks = pressed_s is not None and tick.now_s - pressed_s <= HAND_SHOWN_S
    if s.mode is Mode.TELEOP or (s.mode in POWERED and asks):
        what = s.grants.spent_hand_part()
        if what is not None:
            dirty.append(("HAND_BUDGET.0", f"{what} are spent"))


def flood(tick: Tick, dirty: Dirty) -> None:
    """Call it a flood once it has lasted for four windows."""
    flood = tick.s.flood
    if not flood.level_s < FULL_S:
        dirty.append(("CMD_FLOOD.0", f"more than allowed on {flood.key}"))
