"""Hold the detectors of loop, power, sight, flood and window to their numbers, by single calls."""

from __future__ import annotations

from dataclasses import replace
from math import nan

import pytest

from bridge.core import ArrivedAt, LoopFacts
from bridge.core.authority import rate_limit
from bridge.core.faults import detectors
from bridge.core.geometry.debounce import fill
from bridge.core.sensing import sensor_update
from bridge.core.state import RowUp
from bridge.core.state_senses import Flood
from bridge.core.tick_context import TickContext
from tests.bridge.core.reached import reached
from tests.bridge.core.table import table
from tests.bridge.core.test_quick_core import ROBOT, tick_of

EPS = 1e-6
Dirty = list[tuple[str, str]]


def at(start: str = "active") -> TickContext:
    return tick_of(reached(start))


@table(
    ("level_s", "dt_s", "top_s", "dirty", "after_s"),
    [
        (0.0, 0.01, 1.0, True, 0.01),
        (0.5, 0.04, 1.0, False, 0.49),
        (0.005, 0.04, 1.0, False, 0.0),
        (0.0, 9.0, 1.0, True, 0.05),
        (0.5, 9.0, 1.0, False, 0.4875),
        (0.5, -1.0, 1.0, True, 0.5),
        (0.99, 0.04, 1.0, True, 1.0),
    ],
)
def test_a_window_fills_four_times_as_fast_as_it_drains(
    level_s: float, dt_s: float, top_s: float, dirty: bool, after_s: float
) -> None:
    assert fill(level_s, dt_s, top_s, dirty=dirty) == pytest.approx(after_s)


@table(
    ("facts", "before_s", "dt_s", "rows"),
    [
        (LoopFacts(late_s=0.005), (-0.9, -0.8, -0.7, -0.6), 0.01, []),
        (LoopFacts(late_s=0.005 + EPS), (-0.9, -0.8, -0.7, -0.6), 0.01, ["LOOP_LATE.0"]),
        (LoopFacts(late_s=1.0), (-1.0 - EPS, -0.8, -0.7, -0.6), 0.01, []),
        (LoopFacts(late_s=1.0), (-1.0 + EPS, -0.8, -0.7, -0.6), 0.01, ["LOOP_LATE.0"]),
        (LoopFacts(late_s=1.0), (-9.0, -0.9, -0.8, -0.7, -0.6), 0.01, ["LOOP_LATE.0"]),
        (LoopFacts(late_s=1.0), (-0.8, -0.7, -0.6), 0.01, []),
        (LoopFacts(missed_ticks=1), (), 0.01, []),
        (LoopFacts(missed_ticks=2), (), 0.01, ["LOOP_LATE.0"]),
        (LoopFacts(late_s=1, missed_ticks=2), (-0.8,) * 4, 0.01, ["LOOP_LATE.0"]),
        (LoopFacts(), (), 0.1, []),
        (LoopFacts(), (), 0.1 + EPS, ["LOOP_LATE.1"]),
        (LoopFacts(), (), nan, ["LOOP_LATE.1"]),
    ],
)
def test_a_late_loop_is_seen_at_its_edges(
    facts: LoopFacts, before_s: tuple[float, ...], dt_s: float, rows: list[str]
) -> None:
    tick = at()
    tick.inbox = replace(tick.inbox, loop=facts)
    late_at_s = tuple(tick.now_s + one for one in before_s)
    tick.s.loop = replace(tick.s.loop, late_at_s=late_at_s, missed=5)
    tick.dt_s = dt_s
    dirty: Dirty = []
    sensor_update.note_lateness(tick)
    detectors.loop(tick, dirty)
    assert [name for name, _ in dirty] == rows
    assert tick.s.loop.missed == 5 + facts.missed_ticks
    assert len(tick.s.loop.late_at_s) <= 5
    if facts.late_s > 0.005:
        assert tick.s.loop.late_at_s[-1] == tick.now_s


@table(
    ("gaps_s", "ticks", "rows"),
    [
        ((-5.0,), 9, ["LOOP_LATE.1"]),
        ((-10.0 - EPS, -5.0), 9, ["LOOP_LATE.1"]),
        ((-10.0 + EPS, -5.0), 9, ["LOOP_LATE.1", "LOOP_LATE.2"]),
        ((-99.0, -9.0, -5.0), 9, ["LOOP_LATE.1", "LOOP_LATE.2"]),
        ((-9.0, -5.0), 2, ["LOOP_LATE.1", "LOOP_LATE.2"]),
        ((-9.0, -5.0), 1, []),
    ],
)
def test_three_gaps_in_ten_seconds(gaps_s: tuple[float, ...], ticks: int, rows: list[str]) -> None:
    tick = at()
    tick.s.tick, tick.dt_s = ticks, 0.2
    tick.s.loop = replace(tick.s.loop, gaps_at_s=tuple(tick.now_s + one for one in gaps_s))
    dirty: Dirty = []
    sensor_update.note_lateness(tick)
    detectors.loop(tick, dirty)
    assert [name for name, _ in dirty] == rows
    assert len(tick.s.loop.gaps_at_s) == min(3, len(gaps_s) + bool(rows))


@table(("granted", "virtual", "seen"), [(True, False, 0), (False, True, 0), (False, False, 1)])
def test_rights_refused_matter_on_a_real_drive(granted: bool, virtual: bool, seen: int) -> None:
    tick = at()
    tick.s.loop = replace(tick.s.loop, real_time=granted)
    drive = ROBOT.drive.model_copy(update={"kind": "sim" if virtual else "metal"})
    tick.config = replace(tick.config, robot=ROBOT.model_copy(update={"drive": drive}))
    dirty: Dirty = []
    detectors.rights(tick, dirty)
    assert len(dirty) == seen


def drawing(
    amps: float | None, *, peak_s: float = 0.0, heat: float = 0.0
) -> tuple[TickContext, Dirty]:
    tick = at()
    state = tick.s.drive.newest
    assert state is not None
    tick.s.drive.newest = state.model_copy(update={"current_a": amps})
    tick.s.watch.peak_s, tick.s.watch.heat_a2s = peak_s, heat
    dirty: Dirty = []
    detectors.current(tick, dirty)
    return tick, dirty


def test_a_peak_of_current_counts_for_100_ms_and_heat_adds_up() -> None:
    peak, lasting = ROBOT.drive.peak_current_a, ROBOT.drive.continuous_current_a
    full = 2.0 * (peak * peak - lasting * lasting)
    for amps, peak_s, rows in (
        (peak, 0.095, 0),
        (peak + EPS, 0.085, 0),
        (peak + EPS, 0.095, 1),
        (-peak - EPS, 0.095, 1),
        (nan, 0.095, 1),
    ):
        tick, dirty = drawing(amps, peak_s=peak_s)
        assert len(dirty) == rows, amps
    tick, dirty = drawing(peak, heat=1.0)
    gained = (peak * peak - lasting * lasting) * 0.01
    assert tick.s.watch.heat_a2s == pytest.approx(1.0 + gained)
    tick, dirty = drawing(0.0, heat=full)
    assert tick.s.watch.heat_a2s == pytest.approx(full - lasting * lasting * 0.01)
    assert dirty == []
    tick, dirty = drawing(0.0)
    assert tick.s.watch.heat_a2s == 0.0
    tick, dirty = drawing(peak, heat=full - gained / 2)
    assert tick.s.watch.heat_a2s == full
    assert [evidence for _, evidence in dirty] == [f"{peak:.1f} A for too long"]
    tick, dirty = drawing(lasting, heat=full - gained / 2)
    assert dirty == []
    tick, dirty = drawing(None, peak_s=1.0, heat=full)
    assert dirty == []


@table(
    ("charge", "low_s", "empty_s", "up", "rows"),
    [
        (0.20, 1.995, 1.995, (), []),
        (0.20 - EPS, 1.985, 0.0, (), []),
        (0.20 - EPS, 1.995, 0.0, (), ["BATTERY.0"]),
        (0.10, 2.0, 1.995, (), ["BATTERY.0"]),
        (0.10 - EPS, 2.0, 1.995, (), ["BATTERY.0", "BATTERY.1"]),
        (0.25 - EPS, 0.01, 0.0, ("BATTERY.0",), ["BATTERY.0"]),
        (0.25, 0.01, 0.0, ("BATTERY.0",), []),
        (0.15 - EPS, 0.01, 0.01, ("BATTERY.1",), ["BATTERY.1"]),
        (0.15 + EPS, 0.01, 0.01, ("BATTERY.1",), []),
        (0.9, 0.0, 0.0, ("BATTERY.0",), []),
        # a gauge that falls silent lifts nothing and raises nothing
        (None, 0.0, 0.0, ("BATTERY.0",), ["BATTERY.0"]),
        (None, 0.0, 0.0, ("BATTERY.0", "BATTERY.1"), ["BATTERY.0", "BATTERY.1"]),
        (None, 2.0, 2.0, (), []),
        (None, 2.0, 2.0, ("STUCK.0",), []),
    ],
)
def test_a_battery_is_low_after_two_seconds_until_well_above(
    charge: float | None, low_s: float, empty_s: float, up: tuple[str, ...], rows: list[str]
) -> None:
    tick = at()
    state = tick.s.drive.newest
    assert state is not None
    tick.s.drive.newest = state.model_copy(update={"battery": charge})
    tick.s.watch.low_s, tick.s.watch.empty_s = low_s, empty_s
    tick.s.rows = {name: RowUp(0.0, 0.0, "old") for name in up}
    dirty: Dirty = []
    detectors.battery(tick, dirty)
    assert [name for name, _ in dirty] == rows
    if charge is None:
        assert {evidence for _, evidence in dirty} <= {"old"}
        assert (tick.s.watch.low_s, tick.s.watch.empty_s) == (low_s, empty_s)


@table(
    ("returns", "normal", "blind_s", "rows"),
    [
        (5, 100.0, 4.995, []),
        (4, 100.0, 0.285, []),
        (4, 100.0, 0.295, ["LIDAR_BLIND.0"]),
        (4, 100.0, 4.985, ["LIDAR_BLIND.0"]),
        (4, 100.0, 4.995, ["LIDAR_BLIND.0", "LIDAR_BLIND.1"]),
        (1, 10.0, 4.995, []),
        (0, 10.0, 4.995, ["LIDAR_BLIND.0", "LIDAR_BLIND.1"]),
    ],
)
def test_a_lidar_is_blind_where_few_beams_come_back(
    returns: int, normal: float, blind_s: float, rows: list[str]
) -> None:
    tick = at()
    picture = tick.s.lidar.picture
    assert picture is not None
    picture = replace(picture, returns=returns)
    tick.s.lidar = replace(tick.s.lidar, picture=picture, baseline_returns=normal)
    tick.s.watch.blind_s = blind_s
    dirty: Dirty = []
    detectors.blind(tick, dirty)
    assert [name for name, _ in dirty] == rows


@table(
    ("start", "scan", "up", "seen"),
    [
        ("active", True, (), 0),
        ("active", False, (), 2),
        ("active", True, ("LIDAR_STALE.1",), 2),
        ("active", True, ("LIDAR_STALE.0",), 0),
        ("selftest", False, (), 0),
        ("boot", False, (), 0),
        ("disarmed", False, (), 2),
    ],
)
def test_somebody_must_watch_for_obstacles(
    start: str, scan: bool, up: tuple[str, ...], seen: int
) -> None:
    tick = at(start)
    newest = reached("active").state.lidar.newest if scan else None
    tick.s.lidar = replace(tick.s.lidar, newest=newest)
    tick.s.rows = {name: RowUp(0.0, 0.0, "old") for name in up}
    dirty: Dirty = []
    detectors.no_range(tick, dirty)
    assert [name for name, _ in dirty] == ["NO_RANGE.0", "NO_RANGE.1"][:seen]


LIMITS = {
    "cmd/waypoints": 4,
    "cmd/teleop": 7,
    "cmd/external": 7,
    "cmd/grant": 13,
    "cmd/heartbeat": 13,
    "cmd/hello": 13,
}
"""rate x 0.25 s x 1.2, and one more."""


@table(("key", "limit"), LIMITS.items())
@table("before", [False, True])
def test_each_key_has_its_limit_in_two_halves(key: str, limit: int, before: bool) -> None:
    for count, over in ((limit, False), (limit + 1, True)):
        tick = at()
        counts = tuple(2 * before * (one == key) for one in LIMITS)
        tick.s.flood = Flood(tick.now_s - 0.1, (0,) * 6, counts)
        arrived = ArrivedAt(key, count - 2 * before)
        tick.inbox = replace(tick.inbox, arrived=(arrived,))
        rate_limit.rate_limited(tick)
        assert (tick.s.flood.level_s > 0.0) is over
        assert tick.s.flood.key == (key if over else "")


@table(
    ("passed_s", "half_began", "counts", "before"),
    [
        (0.125 - EPS, False, 3, 2),
        (0.125 + EPS, True, 0, 3),
        (0.25 - EPS, True, 0, 3),
        (0.25 + EPS, True, 0, 0),
    ],
)
def test_halves_follow_each_other(
    passed_s: float, half_began: bool, counts: int, before: int
) -> None:
    had, older = (3, 0, 0, 0, 0, 0), (2, 0, 0, 0, 0, 0)
    turned = rate_limit._half_windows(Flood(100.0, had, older), 100.0 + passed_s)
    assert turned[0][0] == counts
    assert turned[1][0] == before
    assert turned[2] == (100.0 + passed_s if half_began else 100.0)


def test_a_flood_is_one_after_a_second_of_it() -> None:
    for level_s, seen in ((1.0 - EPS, 0), (1.0, 1)):
        tick = at()
        tick.s.flood = Flood(0.0, (), (), level_s, "cmd/hello")
        dirty: Dirty = []
        detectors.flood(tick, dirty)
        assert len(dirty) == seen
