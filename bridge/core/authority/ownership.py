"""Keep the robot's owner and the motion granted to it.

The only writer of ``ownership`` and ``grants``. An owner is alive while the newest status that it
has shown to have seen was sent at most 300 ms ago. Motion is metered: the budget left to a mission,
and the way driven since a person last acted. What is left belongs to the mission id and survives
epochs; no later grant adds to it. A hand on the stick is a person's, but its messages bear no proof
and may be anybody's: it has a meter of its own.
"""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

from bridge.core.authority.requests import refuse_openly, settle_openly
from bridge.core.state_orders import Grants
from bridge.core.tick_context import sent_at
from wire import Mode, Owner

if TYPE_CHECKING:
    from bridge.core.state import BridgeState
    from bridge.core.tick_context import TickContext
    from wire import Grant, Heartbeat

LIVE_S = 0.3


def is_alive(tick: TickContext) -> bool:
    """Return whether there is an owner that has shown to live."""
    ownership = tick.s.ownership
    return (
        ownership.owner is not None
        and ownership.echo_s is not None
        and tick.now_s - ownership.echo_s <= LIVE_S
    )


def hear_heartbeat(tick: TickContext, heartbeat: Heartbeat) -> None:
    """Note that the owner lives and which status its mission loop last used."""
    if sent_at_if_owner(tick, heartbeat.planner_id, heartbeat.epoch, heartbeat.seen) is None:
        return
    used_s = sent_when(tick, heartbeat.used)
    ownership = tick.s.ownership
    if used_s is not None and (ownership.used_s is None or used_s > ownership.used_s):
        tick.s.ownership = replace(ownership, used_s=used_s)


def sent_at_if_owner(tick: TickContext, sender: str, epoch: str, seen: int) -> float | None:
    """Return when the status this message has seen was sent; None where it must not be obeyed.

    An old epoch, another sender or a status nobody remembers: dropped and counted, never scored.
    """
    owner = tick.s.ownership.owner
    if owner is None or owner.planner_id != sender:
        tick.drop("not_owner")
        return None
    if epoch != tick.epoch:
        tick.drop("old_epoch")
        return None
    sent_s = sent_when(tick, seen)
    if sent_s is None:
        tick.drop("seen_unknown")
        return None
    note_echo(tick, sent_s)
    return sent_s


def sent_when(tick: TickContext, seen: int) -> float | None:
    """Return when the status that a message has seen was sent; None where that is unknown."""
    voice = tick.s.voice
    return sent_at(voice.ring, voice.status_seq, seen)


def note_echo(tick: TickContext, sent_s: float) -> None:
    """Remember the newest status that the owner has shown to have seen."""
    ownership = tick.s.ownership
    if ownership.echo_s is None or sent_s > ownership.echo_s:
        tick.s.ownership = replace(ownership, echo_s=sent_s)


def begin_ownership(tick: TickContext, owner: Owner, sent_s: float) -> None:
    """Give the robot to an owner whose hello has seen the status sent at that time."""
    tick.s.ownership = replace(
        tick.s.ownership,
        owner=owner,
        last_owner_id=owner.planner_id,
        echo_s=sent_s,
        used_s=sent_s,
        waypoints_seq=None,
        external_seq=None,
    )


def end_ownership(tick: TickContext) -> None:
    """Take the robot from its owner; the newest status it has seen stays known."""
    tick.s.ownership = replace(tick.s.ownership, owner=None)


def note_waypoints(tick: TickContext, seq: int) -> None:
    """Remember the number of the owner's newest waypoints."""
    tick.s.ownership = replace(tick.s.ownership, waypoints_seq=seq)


def note_external(tick: TickContext, seq: int) -> None:
    """Remember the number of the owner's newest velocity."""
    tick.s.ownership = replace(tick.s.ownership, external_seq=seq)


def restart_numbers(tick: TickContext) -> None:
    """Let the owner's messages count from any number once more: a new epoch begins."""
    tick.s.ownership = replace(tick.s.ownership, waypoints_seq=None, external_seq=None)


OPERATOR_METRES = 500.0
OPERATOR_SECONDS = 3600.0
HAND_METRES = 50.0
HAND_SECONDS = 600.0
"""Through a large flat and back; 50 m at 0.2 m/s take 250 s."""
OUTSIDE_COUNTS = 10.0
METERED = frozenset({"W", "X"})
"""Whose motion is metered by mission; a hand on the stick is metered by itself."""


def hear_grant(tick: TickContext, grant: Grant) -> str | None:
    """Allow a mission of the owner to move, unless held, unpowered or spent.

    Returns:
        What to say of a new grant, once rows that it ends are let go; None where nothing is new.
    """
    sent_s = sent_at_if_owner(tick, grant.planner_id, grant.epoch, grant.seen)
    if sent_s is None or tick.s.grants.mission == grant.mission:
        return None
    jumped_s = tick.s.pose.jumped_s
    if jumped_s is not None and not sent_s > jumped_s:
        tick.drop("grant_before_jump")
        return None
    metres, seconds = _rest_of(tick.s.grants, grant)
    refusal = _refusal(tick, metres, seconds)
    if refusal is not None:
        refuse_openly(tick, "grant", grant.mission, *refusal)
        return None
    settle_openly(tick, "grant", grant.mission)
    grants = tick.s.grants.return_budget()
    book = tuple(item for item in grants.book if item.mission != grant.mission)
    tick.s.grants = replace(
        grants,
        mission=grant.mission,
        metres=metres,
        seconds=seconds,
        book=book,
        since_arm=True,
    )
    return f"{grant.mission} {metres:.1f} m {seconds:.0f} s"


def renew_budgets(tick: TickContext) -> None:
    """Refill the budget for driving between two acts of a person."""
    tick.s.grants = replace(
        tick.s.grants,
        operator_metres=OPERATOR_METRES,
        operator_seconds=OPERATOR_SECONDS,
        hand_metres=HAND_METRES,
        hand_seconds=HAND_SECONDS,
    )


def void_hand_budget(tick: TickContext) -> None:
    """Take from a hand on the stick all that it may drive, until a person signs an act.

    Messages of a stick bear no proof: any client at the bridge's door could otherwise drive on
    after a person's stop.
    """
    tick.s.grants = replace(tick.s.grants, hand_metres=0.0, hand_seconds=0.0)


def end_grant(tick: TickContext) -> None:
    """End the grant; its remainder stays in the book for another grant of the same mission."""
    tick.s.grants = tick.s.grants.return_budget()


def forget_arming(tick: TickContext) -> None:
    """Count no grant as given since arming: the brain's death alone then does not disarm."""
    tick.s.grants = replace(tick.s.grants, since_arm=False)


def meter(tick: TickContext, before: BridgeState) -> None:
    """Charge one tick's way and time to the mission or operator that caused the motion.

    The way of a stop counts too, or a planner that is stopped again and again would go further than
    granted. Its time does not: a robot that must stop uses nothing up.
    """
    if before.mode is Mode.TELEOP or (before.stopping and before.stopping.source == "T"):
        _meter_hand(tick, before)
        return
    if before.mode is Mode.ACTIVE:
        used_s = tick.dt_s
    elif before.mode is Mode.STOPPING and before.stopping is not None:
        if before.stopping.source not in METERED:
            return
        used_s = 0.0
    else:
        return
    grants = tick.s.grants
    moved_m = tick.s.odometry.travelled_m - before.odometry.travelled_m
    granted = grants.mission is not None  # a stop may have taken the grant with it
    tick.s.grants = Grants(  # every tick: a replace would take three times as long
        grants.mission,
        max(0.0, grants.metres - moved_m) if granted else 0.0,
        max(0.0, grants.seconds - used_s) if granted else 0.0,
        grants.book,
        max(0.0, grants.operator_metres - moved_m),
        max(0.0, grants.operator_seconds - used_s),
        grants.hand_metres,
        grants.hand_seconds,
        grants.since_arm,
    )


def _meter_hand(tick: TickContext, before: BridgeState) -> None:
    """Meter a hand on the stick; its ramp to standstill counts as the ways of other stops do."""
    grants, s = tick.s.grants, tick.s
    counts = OUTSIDE_COUNTS if s.watch.outside else 1.0
    moved_m = counts * (s.odometry.travelled_m - before.odometry.travelled_m)
    used_s = tick.dt_s if before.mode is Mode.TELEOP else 0.0
    s.grants = replace(
        grants,
        hand_metres=max(0.0, grants.hand_metres - moved_m),
        hand_seconds=max(0.0, grants.hand_seconds - used_s),
    )


def _rest_of(grants: Grants, grant: Grant) -> tuple[float, float]:
    for item in grants.book:
        if item.mission == grant.mission:
            return item.metres, item.seconds
    return grant.metres, grant.seconds


def _refusal(tick: TickContext, metres: float, seconds: float) -> tuple[str, str] | None:
    s = tick.s
    if s.held is not None:
        return "held", f"{s.held.reason.value} {s.held.id}; arm or resume first"
    if not tick.is_powered:
        return "not_armed", f"mode is {s.mode.value}"
    if not (metres > 0.0 and seconds > 0.0):
        return "budget", f"left for this mission: {metres:.2f} m, {seconds:.1f} s"
    if not (s.grants.operator_metres > 0.0 and s.grants.operator_seconds > 0.0):
        return "operator_budget", "the distance or time since the last operator act is spent"
    return None
