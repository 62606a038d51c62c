"""Hold when a stop is over, when it has failed, and what follows."""

from __future__ import annotations

from dataclasses import replace

import pytest

from bridge.core.modes import mode_logic
from bridge.core.state_motion import LimiterState, Stopping, StopPlan
from bridge.core.tick_context import TickContext
from tests.bridge.core.reached import reached, tick_of
from tests.bridge.core.scripted import ROBOT
from tests.bridge.core.table import table
from wire import STILL, Action, Mode, Twist2

EPS = 1e-6

LAG_S = ROBOT.drive.lag_s


PLAN = StopPlan(Twist2(0.5, 0.0), 0.5, 0.2, 1.0, 0.08, 0.4, 0.1)
"""Rises in 0.08 s, brakes flat for 0.4 s, fades in 0.1 s."""


def stop_of(since_s: float, **more: object) -> Stopping:
    stop = Stopping(Action.HOLD2, "row", since_s, PLAN, "W", resumes=True)
    return replace(stop, **more)  # type: ignore[arg-type]  # names of its fields


def standing(start: str = "stopping_by_row", /, **more: object) -> TickContext:
    """Return a tick in which the robot has stood for 0.2 s and is told to stand."""
    tick = tick_of(reached(start))
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


@table(("silent_s", "ends"), [(0.25 - EPS, False), (0.25 + EPS, True)])
def test_a_stop_that_nobody_measures_ends_when_its_time_is_over(
    silent_s: float, ends: bool
) -> None:
    for elapsed_s, over in ((0.5, False), (1.5 * (0.58 + LAG_S) + 0.3 + EPS, True)):
        tick = standing()
        tick.s.drive.still_since_s = None
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
    tick = tick_of(reached("stopping_by_row"))
    tick.s.drive.still_since_s = None
    tick.s.odometry = replace(tick.s.odometry, measured=Twist2(speed_mps, 0.0))
    tick.s.stopping = stop_of(tick.now_s - elapsed_s, **more)
    return tick


@table(
    ("speed_mps", "before_s", "after_s", "failure"),
    [
        (0.5, 0.0, 0.01, None),
        (0.5, 0.14 - EPS, 0.15 - EPS, None),
        (0.5, 0.14 + EPS, 0.15, "stop_too_slow"),
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
    assert tick.s.stopping.slow_s == pytest.approx(after_s, abs=EPS / 10)


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
    tick = tick_of(reached(start))
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
