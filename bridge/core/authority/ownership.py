"""Keep the robot's owner, and tell whether it lives. The only writer of ``ownership``.

Alive means that the newest status the owner has shown to have seen was sent at most 300 ms ago.
"""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

from bridge.core.tick_context import sent_at
from wire import Owner

if TYPE_CHECKING:
    from bridge.core.tick_context import TickContext
    from wire import Heartbeat

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
