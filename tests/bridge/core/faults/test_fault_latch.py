"""Hold how rows rise, last, bind and end."""

from __future__ import annotations

from dataclasses import replace
from math import inf

import pytest

from bridge.core.faults import fault_latch
from bridge.core.faults.fault_table import STAGES, Clears
from bridge.core.state import RowUp
from bridge.core.tick_context import TickContext
from tests.bridge.core.reached import at, reached
from tests.bridge.core.table import table
from wire import Action, Mode

EPS_S = 1e-6


def up(tick: TickContext, *names: str, age_s: float = 0.0) -> TickContext:
    at_s = tick.now_s - age_s
    tick.s.rows = {name: RowUp(at_s - 1.0, at_s, "old") for name in names}
    return tick


def test_trouble_keeps_since_when_it_lasts_and_tells_its_newest_evidence() -> None:
    tick = up(at(), "STUCK.0", age_s=0.3)
    since_s = tick.now_s - 1.3
    fault_latch.update(tick, [("STUCK.0", "new"), ("LOOP_LATE.0", "late")])
    assert tick.s.rows == {
        "STUCK.0": RowUp(since_s, tick.now_s, "new"),
        "LOOP_LATE.0": RowUp(tick.now_s, tick.now_s, "late"),
    }
    assert tick.events == [("row_up", "LOOP_LATE.0 late")]


AUTO = sorted(n for n, s in STAGES.items() if s.clears is Clears.AUTO and s.clean_s > 0)
STAY = sorted(n for n, s in STAGES.items() if s.clears is not Clears.AUTO and s.row != "BRAIN_LOST")


@table("name", AUTO)
def test_a_row_ends_when_it_has_been_clean_for_its_time(name: str) -> None:
    clean_s = STAGES[name].clean_s
    tick = at()
    tick.now_s = 100.0
    before = up(tick, name, age_s=clean_s - EPS_S).s.rows
    fault_latch.update(tick, [])
    assert tick.s.rows == before
    assert tick.events == []
    up(tick, name, age_s=clean_s)
    fault_latch.update(tick, [])
    assert tick.s.rows == {}
    assert tick.events == [("row_down", name)]


@table("name", STAY)
def test_what_needs_somebody_stays(name: str) -> None:
    tick = up(at("hold"), name, age_s=1e6)
    fault_latch.update(tick, [])
    assert set(tick.s.rows) == {name}


@table(
    ("start", "owned", "ends"),
    [
        ("hold", True, True),
        ("disarmed", True, True),
        ("hold", False, False),
        ("active", True, False),
        ("stopping_by_row", True, False),
    ],
)
def test_a_lost_brain_is_over_with_an_owner_where_nothing_moves(
    start: str, owned: bool, ends: bool
) -> None:
    tick = up(at(start), "BRAIN_LOST.0")
    if not owned:
        tick.s.ownership = replace(tick.s.ownership, owner=None)
    fault_latch.update(tick, [])
    assert (tick.s.rows == {}) is ends


@table(
    ("start", "letters"),
    [
        ("active", "WW"),
        ("active_external", "XX"),
        ("teleop", "T"),
        ("hold", ""),
        ("hold_granted", "W"),
    ],
)
def test_who_moves_and_who_may_is_named(start: str, letters: str) -> None:
    state = reached(start).state
    assert state.sources() == letters
    if state.grants.mission is not None:
        state.ownership = replace(state.ownership, owner=None)
        assert state.sources() == state.source


@table(
    ("start", "names", "zone_mps", "cap"),
    [
        ("active", (), None, (1.0, "robot")),
        ("active", ("LOOP_LATE.0",), None, (0.5, "loop_late")),
        ("active", ("LOOP_LATE.0", "BRAIN_LATE.0"), None, (0.5, "loop_late")),
        ("active", ("LOOP_LATE.0", "NOT_RT.0"), None, (0.4, "not_rt")),
        ("active", ("BATTERY.0",), None, (0.6, "battery")),
        ("active", ("SPEED_ZONE.0",), 0.1, (0.2, "speed_zone")),
        ("active", ("SPEED_ZONE.0",), None, (0.0, "speed_zone")),
        ("active", ("SPEED_ZONE.0",), inf, (1.0, "robot")),
        ("active", ("STUCK.0",), None, (1.0, "robot")),
        ("active", ("POSE_LOST.1",), None, (1.0, "robot")),
        ("teleop", ("POSE_LOST.1",), None, (0.4, "pose_lost")),
    ],
)
def test_the_lowest_cap_that_binds_counts(
    start: str,
    names: tuple[str, ...],
    zone_mps: float | None,
    cap: tuple[float, str],
) -> None:
    tick = up(at(start), *names)
    tick.s.watch.zone_mps = zone_mps
    factor, by = fault_latch.cap(tick)
    assert factor == pytest.approx(cap[0])
    assert by == cap[1]


EVERY = ("BRAIN_LOST.0", "ENC_STALE.1", "DRIVER_NACK.1", "NOT_RT.0", "STUCK.0")
"""One of each way to end: grant, arm, reset, never, by itself."""


@table(
    ("clear", "left"),
    [
        (fault_latch.clear_on_grant, EVERY[1:]),
        (fault_latch.clear_on_arm, EVERY[3:]),
        (fault_latch.clear_on_reset, (*EVERY[:2], *EVERY[3:])),
    ],
)
def test_each_act_ends_what_it_may(clear: object, left: tuple[str, ...]) -> None:
    tick = up(at("hold"), *EVERY)
    assert callable(clear)
    clear(tick)
    assert tuple(tick.s.rows) == left
    assert tick.events == [("row_down", name) for name in EVERY if name not in left]
    tick.events.clear()
    clear(tick)
    assert tick.events == []
    assert tick.s.mode is Mode.HOLD


@table(
    ("names", "worst"),
    [
        ((), (Action.NONE, "", False)),
        (("LOOP_LATE.0",), (Action.CAP, "loop_late", False)),
        (("LOOP_LATE.0", "STUCK.0"), (Action.HOLD2, "stuck", False)),
        (("STUCK.0", "LIDAR_STALE.0"), (Action.HOLD2, "stuck", False)),
        (("STUCK.0", "DRIVER_NACK.1", "LOOP_LATE.0"), (Action.STOP1, "driver_nack", True)),
        (("DRIVER_NACK.1", "RUNAWAY.1", "ENC_STALE.1"), (Action.CUT0, "runaway", True)),
        (("ESTOP.0", "STUCK.0"), (Action.HOLD2, "stuck", False)),
        (("POSE_LOST.1", "NO_RANGE.1"), (Action.NONE, "", False)),  # they bind the stick alone
    ],
)
def test_the_worst_that_binds_is_found(
    names: tuple[str, ...], worst: tuple[Action, str, bool]
) -> None:
    assert fault_latch.worst(up(at(), *names)) == worst
