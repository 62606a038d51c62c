"""Decide who owns the robot: by hello, standing, and only while nobody alive owns it.

Alive means that the newest status the owner has shown to have seen was sent at most 300 ms ago.
"""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

from bridge.core.authority.epoch import hold, turn
from bridge.core.authority.requests import refuse_openly, settle_openly
from bridge.core.geometry.message_age import sent_at
from wire import PROTOCOL, HeldReason, Owner

if TYPE_CHECKING:
    from collections.abc import Iterator

    from bridge.core.tick_context import Tick
    from wire import Heartbeat, Hello

LIVE_S = 0.3


_ANEW = "its {0} is not this bridge's; start the bridge and its owner anew with the same {0}"


def alive(tick: Tick) -> bool:
    """Tell whether there is an owner who has shown to live."""
    ownership = tick.s.ownership
    return (
        ownership.owner is not None
        and ownership.echo_s is not None
        and tick.now_s - ownership.echo_s <= LIVE_S
    )


def free_the_lost(tick: Tick) -> None:
    """Take the robot from an owner who fell silent, in a new epoch."""
    ownership = tick.s.ownership
    if ownership.owner is not None and not alive(tick):
        lost = ownership.owner.planner_id
        tick.s.ownership = replace(ownership, owner=None)
        turn(tick, "brain_lost")
        tick.say("owner_lost", lost)


def hear_hello(tick: Tick, hello: Hello) -> None:
    """Answer one hello: owner now, owner already, or refused with the reason."""
    ownership = tick.s.ownership
    sent_s = _sent(tick, hello.seen)
    if sent_s is None or not tick.now_s - sent_s <= LIVE_S:
        tick.drop("hello_stale")
        return
    if ownership.owner is not None and ownership.owner.planner_id == hello.planner_id:
        _echo(tick, sent_s)
        return
    refusal = next(_against(tick, hello), None)
    if refusal is not None:
        refuse_openly(tick, "hello", hello.planner_id, *refusal)
        return
    settle_openly(tick, "hello", hello.planner_id)
    _own(tick, hello, sent_s)


def hear_heartbeat(tick: Tick, heartbeat: Heartbeat) -> None:
    """Note that the owner lives and which status its mission loop last used."""
    if of_owner(tick, heartbeat.planner_id, heartbeat.epoch, heartbeat.seen) is None:
        return
    used_s = _sent(tick, heartbeat.used)
    ownership = tick.s.ownership
    if used_s is not None and (ownership.used_s is None or used_s > ownership.used_s):
        tick.s.ownership = replace(ownership, used_s=used_s)


def of_owner(tick: Tick, sender: str, epoch: str, seen: int) -> float | None:
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
    sent_s = _sent(tick, seen)
    if sent_s is None:
        tick.drop("seen_unknown")
        return None
    _echo(tick, sent_s)
    return sent_s


def _sent(tick: Tick, seen: int) -> float | None:
    voice = tick.s.voice
    return sent_at(voice.ring, voice.status_seq, seen)


def _echo(tick: Tick, sent_s: float) -> None:
    ownership = tick.s.ownership
    if ownership.echo_s is None or sent_s > ownership.echo_s:
        tick.s.ownership = replace(ownership, echo_s=sent_s)


def _against(tick: Tick, hello: Hello) -> Iterator[tuple[str, str]]:
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
    if alive(tick):
        owner = tick.s.ownership.owner
        yield "owner_alive", f"owner is {owner.planner_id if owner else 'nobody'}"
    if not tick.still_for(0.0):
        yield "not_standing", "ownership changes only while the robot stands"


def _own(tick: Tick, hello: Hello, sent_s: float) -> None:
    before = tick.s.ownership
    if before.last_owner_id not in {None, hello.planner_id}:
        turn(tick, "owner_changed")
        hold(tick, HeldReason.NEW_PLANNER, hello.planner_id)
    tick.s.ownership = replace(
        tick.s.ownership,
        owner=Owner(planner_id=hello.planner_id, kind=hello.kind),
        last_owner_id=hello.planner_id,
        echo_s=sent_s,
        used_s=sent_s,
        waypoints_seq=None,
        external_seq=None,
    )
    tick.say("owner", f"{hello.kind} {hello.planner_id}")
