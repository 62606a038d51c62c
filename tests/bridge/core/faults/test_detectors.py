"""Hold the detectors to their numbers, by single calls on states made by hand."""

from __future__ import annotations

from dataclasses import replace
from math import nan

import pytest

from bridge.core import LoopFacts
from bridge.core.faults import detectors
from bridge.core.sensing import sensor_update
from bridge.core.state import RowUp
from bridge.core.state_orders import External
from bridge.core.state_senses import Flood
from bridge.core.tick_context import TickContext
from tests.bridge.core.reached import at, reached
from tests.bridge.core.scripted import ROBOT
from tests.bridge.core.table import table

EPS = 1e-6
Dirty = list[tuple[str, str]]


NOW_S = 100.0


def at_now(start: str = "active") -> TickContext:
    tick = at(start)
    tick.now_s = NOW_S
    return tick


def seen(detector: str, tick: TickContext) -> list[str]:
    dirty: Dirty = []
    getattr(detectors, detector)(tick, dirty)
    return [name for name, _ in dirty]


@table(
    ("facts", "before_s", "dt_s", "rows"),
    [
        (LoopFacts(late_s=0.005), (-0.9, -0.8, -0.7, -0.6), 0.01, []),
        (LoopFacts(late_s=0.005 + EPS), (-0.9, -0.8, -0.7, -0.6), 0.01, ["LOOP_LATE.0"]),
        (LoopFacts(late_s=0.005), (-0.95, -0.9, -0.8, -0.7, -0.6), 0.01, []),
        (LoopFacts(late_s=1.0), (-1.0 - EPS, -0.8, -0.7, -0.6), 0.01, []),
        (LoopFacts(late_s=1.0), (-1.0, -0.8, -0.7, -0.6), 0.01, ["LOOP_LATE.0"]),
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
    tick = at_now()
    tick.inbox = replace(tick.inbox, loop=facts)
    late_at_s = tuple(tick.now_s + one for one in before_s)
    tick.s.loop = replace(tick.s.loop, late_at_s=late_at_s, missed=5)
    tick.dt_s = dt_s
    sensor_update.note_lateness(tick)
    assert seen("loop", tick) == rows
    assert tick.s.loop.missed == 5 + facts.missed_ticks
    assert len(tick.s.loop.late_at_s) <= 5
    if facts.late_s > 0.005:
        assert tick.s.loop.late_at_s[-1] == tick.now_s


@table(
    ("gaps_s", "ticks", "rows"),
    [
        ((-5.0,), 9, ["LOOP_LATE.1"]),
        ((-10.0 - EPS, -5.0), 9, ["LOOP_LATE.1"]),
        ((-10.0, -5.0), 9, ["LOOP_LATE.1", "LOOP_LATE.2"]),
        ((-99.0, -9.0, -5.0), 9, ["LOOP_LATE.1", "LOOP_LATE.2"]),
        ((-9.0, -5.0), 2, ["LOOP_LATE.1", "LOOP_LATE.2"]),
        ((-9.0, -5.0), 1, []),
    ],
)
def test_three_gaps_in_ten_seconds(gaps_s: tuple[float, ...], ticks: int, rows: list[str]) -> None:
    tick = at_now()
    tick.s.tick, tick.dt_s = ticks, 0.2
    tick.s.loop = replace(tick.s.loop, gaps_at_s=tuple(tick.now_s + one for one in gaps_s))
    sensor_update.note_lateness(tick)
    assert seen("loop", tick) == rows
    assert len(tick.s.loop.gaps_at_s) == min(3, len(gaps_s) + bool(rows))


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
    assert seen("blind", tick) == rows


@table(
    ("start", "scan", "up", "count"),
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
    start: str, scan: bool, up: tuple[str, ...], count: int
) -> None:
    tick = at(start)
    newest = reached("active").state.lidar.newest if scan else None
    tick.s.lidar = replace(tick.s.lidar, newest=newest)
    tick.s.rows = {name: RowUp(0.0, 0.0, "old") for name in up}
    assert seen("no_range", tick) == ["NO_RANGE.0", "NO_RANGE.1"][:count]


def test_a_flood_is_one_after_a_second_of_it() -> None:
    for level_s, count in ((1.0 - EPS, 0), (1.0, 1)):
        tick = at()
        tick.s.flood = Flood(0.0, (), (), level_s, "cmd/hello")
        assert len(seen("flood", tick)) == count


@table(
    ("age_s", "equal", "moved_m", "up_s", "stages"),
    [
        (0.25, 1, 9.0, None, 0), (0.25 + EPS, 1, 0.0, None, 1), (0.25 + EPS, 1, 0.0, 5.0, 2),
        (0.25 + EPS, 1, 0.0, 5.0 - EPS, 1), (0.0, 5, 0.02 + EPS, None, 1),
        (0.0, 4, 9.0, None, 0), (0.0, 5, 0.02 - EPS, None, 0), (0.0, 6, 0.5, 5.0, 2),
        (0.0, 1, 0.0, 9.0, 0),
    ],
)  # fmt: skip
def test_a_scan_is_old_or_the_same_again(
    age_s: float, equal: int, moved_m: float, up_s: float | None, stages: int
) -> None:
    tick = at_now()
    scan = tick.s.lidar.newest
    assert scan is not None
    newest = scan.model_copy(update={"stamp_s": NOW_S})
    tick.s.odometry = replace(tick.s.odometry, travelled_m=30.0)
    tick.s.lidar = replace(
        tick.s.lidar, newest=newest, received_s=NOW_S - age_s, equal=equal,
        equal_from_m=30.0 - moved_m,
    )  # fmt: skip
    tick.s.rows = {} if up_s is None else {"LIDAR_STALE.0": RowUp(NOW_S - up_s, NOW_S, "old")}
    assert seen("lidar", tick) == ["LIDAR_STALE.0", "LIDAR_STALE.1"][:stages]


def test_a_scan_five_times_over_exactly_2_cm_is_a_frozen_lidar() -> None:
    tick = at_now()
    tick.s.odometry = replace(tick.s.odometry, travelled_m=0.02)
    tick.s.lidar = replace(tick.s.lidar, received_s=NOW_S, equal=5, equal_from_m=0.0)
    tick.inbox = replace(tick.inbox, sensors_same_host=False)
    assert seen("lidar", tick) == ["LIDAR_STALE.0"]


def test_a_pose_is_lost_or_jumps() -> None:
    tick = at_now()
    assert seen("pose", tick) == ["POSE_LOST.0", "POSE_LOST.1"], "the tick has not looked for it"
    tick.robot_in_map = tick.s.odometry.base_in_odom
    assert seen("pose", tick) == []
    tick.s.pose = replace(tick.s.pose, jumped_s=NOW_S)
    assert seen("pose", tick) == ["POSE_JUMP.0"]
    tick.s.pose = replace(tick.s.pose, jumped_s=NOW_S - 0.01)
    assert seen("pose", tick) == []


@table(
    ("age_s", "behind", "reborn_s", "rows"),
    [
        (0.0, 0, None, []),
        (0.08 - EPS, 10, 99.99, []),
        (0.08 + EPS, 11, None, ["ENC_STALE.0", "DRIVER_NACK.0"]),
        (0.25, 0, None, ["ENC_STALE.0"]),
        (0.25 + EPS, 50, None, ["ENC_STALE.0", "ENC_STALE.1", "DRIVER_NACK.0"]),
        (0.0, 51, NOW_S, ["DRIVER_NACK.0", "DRIVER_NACK.1", "DRIVE_REBOOT.0"]),
    ],
)
def test_a_drive_reports_and_hears(
    age_s: float, behind: int, reborn_s: float | None, rows: list[str]
) -> None:
    tick = at_now()
    state = tick.s.drive.newest
    assert state is not None
    tick.s.drive.newest = state.model_copy(update={"stamp_s": NOW_S})
    tick.s.drive.received_s, tick.s.drive.behind = NOW_S - age_s, behind
    tick.s.drive.reborn_s = reborn_s
    assert seen("drive", tick) == rows
    tick.s.drive.received_s = None
    assert seen("drive", tick) == []
    tick.s.drive.newest, tick.s.drive.received_s = None, 0.0
    assert seen("drive", tick) == []


@table(
    ("charge", "low_s", "empty_s", "after"),
    [
        (0.18, 0.0, 0.0, (0.01, 0.0)), (0.05, 0.0, 0.0, (0.01, 0.01)),
        (0.9, 0.5, 0.0, (0.4975, 0.0)), (0.9, 0.5, 0.5, (0.4975, 0.4975)),
        (0.22, 0.0, 0.0, (0.0, 0.0)), (0.9, 0.0, 0.0, (0.0, 0.0)),
        (0.9, 1.0, 1.0, (0.9975, 0.9975)),
    ],
)  # fmt: skip
def test_a_low_charge_fills_its_windows(
    charge: float, low_s: float, empty_s: float, after: tuple[float, float]
) -> None:
    tick = at_now()
    state = tick.s.drive.newest
    assert state is not None
    tick.s.drive.newest = state.model_copy(update={"battery": charge})
    tick.s.watch.low_s, tick.s.watch.empty_s = low_s, empty_s
    detectors.battery(tick, [])
    assert (tick.s.watch.low_s, tick.s.watch.empty_s) == pytest.approx(after)


def test_a_lidar_that_sees_again_drains_its_window_and_a_zone_left_is_none() -> None:
    tick = at_now()
    tick.s.watch.blind_s, tick.s.watch.zone_mps = 0.5, 0.2
    detectors.blind(tick, [])
    assert tick.s.watch.blind_s == pytest.approx(0.4975)
    for level_s, after_s in ((0.0, 0.0), (1.0, 0.9975)):
        tick.s.watch.blind_s = level_s
        detectors.blind(tick, [])
        assert tick.s.watch.blind_s == pytest.approx(after_s)
    detectors.zone(tick, [])
    zone_mps: float | None = tick.s.watch.zone_mps
    assert zone_mps is None


@table(
    ("echo_age_s", "since_arm", "start", "source", "rows"),
    [
        (0.15, True, "active", "W", []),
        (0.15 + EPS, True, "active", "W", ["BRAIN_LATE.0"]),
        (0.3, True, "active", "W", ["BRAIN_LATE.0"]),
        (0.3 + EPS, True, "active", "W", ["BRAIN_LOST.0"]),
        (5.0, True, "active", "W", ["BRAIN_LOST.0"]),
        (5.0 + EPS, True, "active", "W", ["BRAIN_LOST.0", "BRAIN_GONE.0"]),
        (5.0 + EPS, False, "active", "W", ["BRAIN_LOST.0"]),
        (5.0 + EPS, True, "disarmed", "", ["BRAIN_LOST.0"]),
        (5.0 + EPS, True, "teleop", "T", ["BRAIN_LOST.0"]),
        (None, True, "active", "W", []),
    ],
)
def test_a_brain_is_late_lost_or_gone(
    echo_age_s: float | None, since_arm: bool, start: str, source: str, rows: list[str]
) -> None:
    tick = at(start)
    tick.now_s, echo_s = echo_age_s or 0.0, None if echo_age_s is None else 0.0
    tick.s.ownership = replace(tick.s.ownership, echo_s=echo_s, used_s=None)
    tick.s.grants = replace(tick.s.grants, since_arm=since_arm)
    tick.s.source = source
    assert seen("brain", tick) == rows


@table(
    ("changes", "rows"),
    [
        ({}, []),
        ({"age_s": 0.5}, []),
        ({"age_s": 0.5 + EPS}, ["CMD_STALE.0"]),
        ({"age_s": 9.0, "reached": True}, []),
        ({"age_s": 9.0, "points": False}, []),
        ({"external_age_s": 0.25}, []),
        ({"external_age_s": 0.25 + EPS}, ["CMD_STALE.1"]),
        ({"bucket": 5.0 - EPS}, []),
        ({"bucket": 5.0}, ["CMD_BAD.0"]),
        ({"metres": 0.0}, ["BUDGET.0"]),
        ({"metres": 0.0, "mission": None}, []),
    ],
)
def test_commands_grow_stale_bad_and_spent(changes: dict[str, object], rows: list[str]) -> None:
    tick = at_now()
    told = {"age_s": 0.0, "reached": False, "points": True, "bucket": 0.0, "metres": 5.0,
            "mission": "m1", "external_age_s": None} | changes  # fmt: skip
    horizon = tick.s.leg.horizon
    assert horizon is not None
    points = horizon.points if told["points"] else ()
    tick.s.leg = replace(
        tick.s.leg,
        horizon=horizon.model_copy(update={"points": points}),
        reached=bool(told["reached"]),
        sent_s=tick.now_s - float(str(told["age_s"])),
    )
    if told["external_age_s"] is not None:
        age_s = float(str(told["external_age_s"]))
        tick.s.external = External(0.1, 0.0, dead_man=True, sent_s=tick.now_s - age_s)
    tick.s.bad_bucket = float(str(told["bucket"]))
    mission = None if told["mission"] is None else "m1"
    tick.s.grants = replace(tick.s.grants, metres=float(str(told["metres"])), mission=mission)
    assert seen("commands", tick) == rows


@table(("ago_s", "told"), [(1.0, ["HAND_BUDGET.0"]), (1.0 + EPS, [])])
def test_a_hand_without_budget_is_told_for_a_second_after_it_pressed(
    ago_s: float, told: list[str]
) -> None:
    tick = at_now("hold")
    tick.s.grants = replace(tick.s.grants, hand_metres=0.0)
    tick.s.stick = replace(tick.s.stick, pressed_s=NOW_S - ago_s)
    assert seen("hand", tick) == told


@table(
    ("first_ago_s", "rows"),
    [(60.0, ["POSE_JUMP.0", "POSE_JUMP.1"]), (60.0 + EPS, ["POSE_JUMP.0"])],
)
def test_three_jumps_in_a_minute_are_worse_than_one(first_ago_s: float, rows: list[str]) -> None:
    tick = at_now()
    tick.robot_in_map = tick.s.odometry.base_in_odom
    jumps_at_s = (NOW_S - first_ago_s, NOW_S - 5.0, NOW_S)
    drift = replace(tick.s.pose.drift, jumps_at_s=jumps_at_s)
    tick.s.pose = replace(tick.s.pose, jumped_s=NOW_S, drift=drift)
    assert seen("pose", tick) == rows


@table(("less_s", "rows"), [(0.0, ["LIDAR_BLIND.0"]), (EPS, [])])
def test_a_lidar_is_blind_once_its_window_is_full(less_s: float, rows: list[str]) -> None:
    tick = at_now()
    tick.dt_s = 0.0
    tick.s.lidar = replace(tick.s.lidar, baseline_returns=1e6)
    tick.s.watch.blind_s = detectors.BLIND_S - less_s
    assert seen("blind", tick) == rows
