"""Hold how long an owner lives, and what of its messages counts."""

from __future__ import annotations

from dataclasses import replace

from bridge.core.authority import epoch, ownership
from bridge.core.tick_context import TickContext
from tests.bridge.core.reached import reached, tick_of
from tests.bridge.core.table import table
from wire import Heartbeat

EPS = 1e-6


def at(start: str) -> TickContext:
    return tick_of(reached(start))


@table(("age_s", "lives"), [(0.0, True), (0.3 - EPS, True), (0.3 + EPS, False)])
def test_an_owner_lives_for_300_ms(age_s: float, lives: bool) -> None:
    tick = at("active")
    tick.s.ownership = replace(tick.s.ownership, echo_s=tick.now_s - age_s)
    assert ownership.is_alive(tick) is lives
    epoch_no = tick.s.epoch_no
    epoch.free_lost_owner(tick)
    assert (tick.s.ownership.owner is not None) is lives
    assert tick.s.epoch_no == epoch_no + (not lives)
    assert (("owner_lost", "p1") in tick.events) is not lives
    for part in ({"owner": None}, {"echo_s": None}):
        tick.s.ownership = replace(at("active").s.ownership, **part)
        assert not ownership.is_alive(tick)
    tick.s.ownership = replace(tick.s.ownership, owner=None, echo_s=None)
    tick.events.clear()
    epoch.free_lost_owner(tick)
    assert tick.events == []


def test_no_message_makes_an_owner_older_or_its_use_younger_than_it_is() -> None:
    tick = at("active")
    status = reached("active").status
    assert status is not None
    before = tick.s.ownership
    ring = tick.s.voice.ring
    assert ownership.sent_at_if_owner(tick, "p1", tick.epoch, status.seq - 5) == ring[-6]
    assert tick.s.ownership == before
    beat_used = before.used_s
    assert beat_used is not None
    for seen, used_s in ((status.seq - 9, beat_used), (status.seq, ring[-1])):
        world = reached("active")
        assert world.planner is not None
        [beat] = world.planner._on_status(status)["heartbeats"]
        beat = beat.model_copy(update={"used": seen, "epoch": tick.epoch})
        ownership.hear_heartbeat(tick, beat)
        assert tick.s.ownership.used_s == used_s
        assert tick.s.ownership.echo_s == ring[-1]


@table(
    ("had_s", "back", "rightful", "used"),
    [
        (None, 0, True, True),
        (0.0, 0, True, True),
        (1e9, 0, True, False),
        (0.0, -1, True, False),  # of a status that was never sent
        (0.0, 0, False, False),
    ],
)
def test_what_a_brain_has_used_only_grows_newer(
    had_s: float | None, back: int, rightful: bool, used: bool
) -> None:
    tick = at("active")
    tick.s.ownership = replace(tick.s.ownership, used_s=had_s)
    newest = tick.s.voice.status_seq
    epoch = tick.epoch if rightful else "old-1"
    beat = Heartbeat(planner_id="p1", epoch=epoch, seen=newest, used=newest - back)
    ownership.hear_heartbeat(tick, beat)
    assert tick.s.ownership.used_s == (tick.s.voice.ring[-1] if used else had_s)
