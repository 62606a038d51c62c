"""Hold what decides the mode to its numbers, by single calls on states made by hand."""

from __future__ import annotations

from dataclasses import replace

import pytest

from bridge.core.faults import detectors
from bridge.core.faults.fault_table import ROWS
from bridge.core.faults.hazards import HAZARDS
from bridge.core.modes import mode_logic
from bridge.core.modes import mode_logic as decide_module
from bridge.core.modes.mode_logic import activate, arrive, decide, expire_holding
from bridge.core.motion.motion_gates import forget_block
from bridge.core.state import RowUp
from bridge.core.state_motion import Gate, LimiterState, Stopping, StopPlan
from bridge.core.tick_context import TickContext
from tests.bridge.core.reached import at, reached
from tests.bridge.core.scripted import ROBOT
from tests.bridge.core.table import table
from wire import STILL, Action, HeldReason, Mode, Twist2

EPS_S = 1e-6


def waiting(
    start: str, since_s: float | None, *, blocked: bool, must_stop: bool, by: str = "obstacle"
) -> TickContext:
    """Let a mission have waited for so long when a tick begins; call what tires of it."""
    tick = at(start)
    tick.now_s = 1000.0
    tick.s.waits_since_s = None if since_s is None else tick.now_s - since_s
    tick.s.gate = Gate(blocked=blocked, by=by, free_scans=2)
    if must_stop:
        tick.s.rows = {"LIDAR_STALE.0": RowUp(tick.now_s, tick.now_s, "by hand")}
    expire_holding(tick, must_stop=must_stop)
    forget_block(tick)
    return tick


@table(
    ("start", "since_s", "blocked", "must_stop", "waits"),
    [
        ("hold_granted", None, False, True, True),
        ("hold_granted", None, True, False, True),
        ("hold_granted", None, False, False, False),
        ("hold_granted", 1.0, False, False, False),
        ("hold_granted", 30.0 - EPS_S, False, True, True),
        ("hold_granted", 300.0 - EPS_S, True, False, True),
        ("hold", 1.0, True, True, False),
        ("active", 1.0, True, True, False),
    ],
)
def test_a_mission_waits_while_it_stands_granted_before_trouble(
    start: str, since_s: float | None, blocked: bool, must_stop: bool, waits: bool
) -> None:
    tick = waiting(start, since_s, blocked=blocked, must_stop=must_stop)
    mission = reached(start).state.grants.mission
    assert tick.s.waits_since_s == ((tick.now_s - (since_s or 0.0)) if waits else None)
    assert tick.s.grants.mission == mission
    assert tick.s.held == reached(start).state.held
    assert tick.events == []
    assert tick.s.gate.blocked is (blocked and mission is not None)


@table(
    ("since_s", "blocked", "must_stop", "why"),
    [
        (30.0, False, True, "lidar_stale"),
        (30.0, True, True, "lidar_stale"),
        (300.0, True, False, "obstacle"),
        (300.0, True, False, "fence"),
    ],
)
def test_a_mission_that_waited_too_long_is_revoked_and_its_rest_kept(
    since_s: float, blocked: bool, must_stop: bool, why: str
) -> None:
    gate = "obstacle" if must_stop else why
    tick = waiting("hold_granted", since_s, blocked=blocked, must_stop=must_stop, by=gate)
    assert tick.s.waits_since_s is None
    assert tick.s.grants.mission is None
    assert [left.mission for left in tick.s.grants.book] == ["m1"]
    assert tick.s.held is not None
    assert (tick.s.held.reason, tick.s.held.id) == (HeldReason.FAULT, why)
    assert ("mission_revoked", f"m1 {why}") in tick.events
    assert not tick.s.gate.blocked


@table(
    ("start", "age_s", "kept"),
    [("hold_granted", 0.0, True), ("hold_granted", 9.0, False), ("stopping_by_row", 9.0, True)],
)
def test_a_horizon_grown_old_is_forgotten_where_the_robot_stands(
    start: str, age_s: float, kept: bool
) -> None:
    tick = at(start)
    leg = reached("active").state.leg
    tick.s.leg = replace(leg, sent_s=tick.now_s - age_s)
    expire_holding(tick, must_stop=False)
    assert (tick.s.leg.horizon is not None) is kept
    assert (tick.s.leg.path is not None) is kept


@table(
    ("rows", "gate", "mode", "why"),
    [
        ((), Gate(), Mode.ACTIVE, ""),
        ((), Gate(blocked=True), Mode.STOPPING, "obstacle"),
        ((), Gate(blocked=True, by="fence"), Mode.STOPPING, "fence"),
        (("LOOP_LATE.0",), Gate(blocked=True, by="contact"), Mode.STOPPING, "contact"),
        (("LIDAR_STALE.0",), Gate(), Mode.STOPPING, "lidar_stale"),
        (("LIDAR_STALE.0",), Gate(blocked=True), Mode.STOPPING, "lidar_stale"),
    ],
)
def test_a_blocked_way_holds_unless_something_worse_does(
    rows: tuple[str, ...], gate: Gate, mode: Mode, why: str
) -> None:
    tick = at()
    tick.s.gate = gate
    tick.s.rows = {name: RowUp(tick.now_s, tick.now_s, "by hand") for name in rows}
    decide(tick)
    assert tick.s.mode is mode
    if mode is Mode.STOPPING:
        assert tick.s.stopping is not None
        assert (tick.s.stopping.action, tick.s.stopping.cause) == (Action.HOLD2, why)


def calling(start: str) -> TickContext:
    """Return a tick in which a horizon or an external brain calls a standing robot."""
    tick = at("hold_granted")
    other = reached(start).state
    tick.s.leg = replace(other.leg, sent_s=tick.now_s)
    if other.external is not None:
        tick.s.external = replace(other.external, sent_s=tick.now_s)
        tick.s.ownership = other.ownership
    return tick


@table(("start", "source"), [("active", "W"), ("active_external", "X")])
def test_who_calls_moves_the_robot(start: str, source: str) -> None:
    tick = calling(start)
    activate(tick)
    assert (tick.s.mode, tick.s.source) == (Mode.ACTIVE, source)


@table("against", ["held", "mission", "blocked", "stopped", "mode", "silence"])
def test_nobody_is_called_against_what_forbids_it(against: str) -> None:
    tick = calling("active")
    if against == "held":
        tick.s.held = reached("estopped").state.held
        assert tick.s.held is not None
    elif against == "mission":
        tick.s.grants = replace(tick.s.grants, mission=None)
    elif against == "blocked":
        tick.s.gate = Gate(blocked=True)
    elif against == "stopped":
        tick.stopped = True
    elif against == "mode":
        tick.s.mode = Mode.DISARMED
    else:
        tick.s.leg = replace(tick.s.leg, horizon=None)
    before = tick.s.mode
    activate(tick)
    assert tick.s.mode is before


@table(
    ("start", "stands", "at_end", "mode"),
    [
        ("active", True, True, Mode.HOLD),
        ("active", True, False, Mode.ACTIVE),
        ("active", False, True, Mode.ACTIVE),
        ("active_external", True, False, Mode.HOLD),
        ("active_external", False, True, Mode.ACTIVE),
    ],
)
def test_who_stands_at_the_end_has_arrived(
    start: str, stands: bool, at_end: bool, mode: Mode
) -> None:
    tick = at(start)
    tick.s.drive.still_since_s = tick.now_s if stands else None
    tick.s.external = None
    if tick.s.leg.horizon is not None:
        last = tick.s.leg.horizon.model_copy(update={"final": True})
        tick.s.leg = replace(tick.s.leg, horizon=last)
    arrive(tick, at_end=at_end)
    assert tick.s.mode is mode
    assert tick.s.leg.reached is (mode is Mode.HOLD and start == "active")
    if mode is Mode.HOLD:
        why = "reached" if start == "active" else "released"
        assert tick.events[-1] == ("mode", f"ACTIVE HOLD {why}")


def test_each_detector_that_a_hazard_names_is_run_and_no_other() -> None:
    rows = {row.id for row in ROWS}
    named = {hazard.function for hazard in HAZARDS if hazard.guard in rows}
    run = [
        f"{one.__module__.removeprefix('bridge.core.')}.{one.__name__}"
        for one in detectors.DETECTORS
    ]
    assert sorted(run) == sorted(named)
    tick = at()
    tick.s.drive.reborn_s = tick.now_s
    decide_module.detect(tick)
    assert "DRIVE_REBOOT.0" in tick.s.rows


@table(("resumes", "mode"), [(True, Mode.ACTIVE), (False, Mode.STOPPING)])
def test_only_a_stop_that_may_go_on_goes_on(resumes: bool, mode: Mode) -> None:
    tick = at("stopping_by_row")
    assert tick.s.stopping is not None
    tick.s.stopping = replace(tick.s.stopping, resumes=resumes)
    tick.s.leg = replace(reached("active").state.leg, sent_s=tick.now_s)
    activate(tick)
    assert tick.s.mode is mode


LAG_S = ROBOT.drive.lag_s
PLAN = StopPlan(Twist2(0.5, 0.0), 0.5, 0.2, 1.0, 0.08, 0.4, 0.1)


"""Rises in 0.08 s, brakes flat for 0.4 s, fades in 0.1 s."""


def stop_of(since_s: float, **more: object) -> Stopping:
    stop = Stopping(Action.HOLD2, "row", since_s, PLAN, "W", resumes=True)
    return replace(stop, **more)  # type: ignore[arg-type]  # names of its fields


def standing(start: str = "stopping_by_row", /, **more: object) -> TickContext:
    """Return a tick in which the robot has stood for 0.2 s and is told to stand."""
    tick = at(start)
    tick.s.drive.still_since_s = tick.now_s - 0.2
    tick.s.motion.limiter = LimiterState()
    tick.s.stopping = stop_of(tick.now_s - 0.3, **more)
    return tick


@table(
    ("more", "mode"),
    [
        ({}, Mode.HOLD),
        ({"action": Action.STOP1}, Mode.DISARMED),
        ({"action": Action.FAST1}, Mode.DISARMED),
        ({"reset_needed": True}, Mode.FAULT),
        ({"reset_needed": True, "action": Action.STOP1}, Mode.FAULT),
    ],
)
def test_a_stop_ends_as_its_action_says(more: dict[str, object], mode: Mode) -> None:
    tick = standing(**more)
    mode_logic.judge(tick)
    assert (tick.s.mode, tick.s.stopping) == (mode, None)
    assert tick.events[-1] == ("mode", f"STOPPING {mode.value} row")


@table("start", ["estopped", "hold"])
def test_where_the_mode_stays_only_the_ramp_is_over(start: str) -> None:
    tick = standing(start, reset_needed=True)
    before = tick.s.mode
    mode_logic.judge(tick)
    assert (tick.s.mode, tick.s.stopping) == (before, None)


@table(("silent_s", "ends"), [(0.25, False), (0.25 + EPS_S, True)])
def test_a_stop_that_nobody_measures_ends_when_its_time_is_over(
    silent_s: float, ends: bool
) -> None:
    for elapsed_s, over in ((0.5, False), (1.5 * (0.58 + LAG_S) + 0.3 + EPS_S, True)):
        tick = standing()
        tick.now_s, tick.s.drive.still_since_s = 100.0, None
        tick.s.odometry = replace(tick.s.odometry, measured=STILL)
        tick.s.drive.received_s = tick.now_s - silent_s
        tick.s.stopping = stop_of(tick.now_s - elapsed_s)
        mode_logic.judge(tick)
        said = ("stop_unmeasured", "row") in tick.events
        assert said is (ends and over)
        if said:
            assert tick.s.mode is Mode.HOLD
        tick.s.drive.received_s = None
        assert mode_logic._is_unmeasured(tick)


def rolling(speed_mps: float, elapsed_s: float, **more: object) -> TickContext:
    tick = at("stopping_by_row")
    tick.s.drive.still_since_s = None
    tick.s.odometry = replace(tick.s.odometry, measured=Twist2(speed_mps, 0.0))
    tick.s.stopping = stop_of(tick.now_s - elapsed_s, **more)
    return tick


@table(
    ("speed_mps", "before_s", "after_s", "failure"),
    [
        (0.5, 0.0, 0.01, None),
        (0.5, 0.14 - EPS_S, 0.15 - EPS_S, None),
        (0.5, 0.14, 0.15, "stop_too_slow"),
        (0.05, 0.15, 0.1475, None),  # drains four times as slowly
        (0.05, 0.0, 0.0, None),
    ],
)
def test_too_slow_counts_after_150_ms_and_is_not_forgotten_at_once(
    speed_mps: float, before_s: float, after_s: float, failure: str | None
) -> None:
    tick = rolling(speed_mps, 0.8, slow_s=before_s)
    assert tick.dt_s == 0.01
    assert mode_logic._failure(tick) == failure
    assert tick.s.stopping is not None
    assert tick.s.stopping.slow_s == pytest.approx(after_s, abs=EPS_S / 10)


def test_one_reading_in_two_that_is_slow_enough_hides_no_stop_that_is_not() -> None:
    """Wheels that read by turns 0.5 m/s and nothing, 8/3 of the time."""
    failures = []
    tick = rolling(0.5, 0.8)
    for index in range(41):
        tick.s.odometry = replace(tick.s.odometry, measured=Twist2(0.5 * (index % 2 == 0), 0.0))
        failures.append(mode_logic._failure(tick))
    assert [index for index, failure in enumerate(failures) if failure] == [38, 40]


@table(("start", "mode"), [("stopping_by_row", Mode.FAULT), ("estopped", None)])
def test_a_failure_cuts_the_torque(start: str, mode: Mode | None) -> None:
    tick = at(start)
    before = tick.s.mode
    tick.s.drive.still_since_s = None
    tick.s.stopping = stop_of(tick.now_s - 9.0)
    tick.s.odometry = replace(tick.s.odometry, measured=Twist2(0.05, 0.0))
    mode_logic.judge(tick)
    assert tick.s.stopping is None
    assert tick.s.mode is (mode or before)
    if mode is None:
        assert tick.events == [("stop_failed", "stop_too_long")]
    else:
        assert tick.s.fault == "stop_too_long"


def test_what_stands_is_never_too_long() -> None:
    tick = rolling(0.0, 9.0)
    tick.s.drive.still_since_s = tick.now_s
    assert mode_logic._failure(tick) is None
    tick.s.stopping = None
    assert mode_logic._failure(tick) is None
