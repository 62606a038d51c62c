"""A drive that reports seldom is held later, and pays for it in every stopping distance."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import pytest

from bridge.core.faults import detect_motion, detectors
from bridge.core.motion import braking, motion_gates
from bridge.core.motion.obstacle_gate import obstacle_gate
from bridge.core.reporting import report
from bridge.core.sensing.sensor_update import look_m
from bridge.core.state_motion import Braking, LimiterState
from bridge.core.tick_context import TickContext
from tests.bridge.core.motion.test_obstacle_gate import picture
from tests.bridge.core.reached import at
from tests.bridge.core.scripted import ROBOT
from tests.bridge.core.table import table
from wire import IDENTITY, Twist2
from wire.drive_config import DRIVE_KINDS, DriveKind

REPORT_S, WINDOW_S, UNSEEN_S = 0.06, 0.15, 0.07
NOW_S = 100.0
EPS = 1e-6
AHEAD = Twist2(0.4, 0.0)


def slow(patch: pytest.MonkeyPatch) -> None:
    """Let the simulated drive report as seldom as a base of metal does."""
    assert isinstance(DRIVE_KINDS, dict)
    patch.setitem(DRIVE_KINDS, "sim", DriveKind((), (), REPORT_S))


def driving(age_s: float = 0.0, behind: int = 0) -> TickContext:
    tick = at()
    tick.now_s = NOW_S
    state = tick.s.drive.newest
    assert state is not None
    tick.s.drive.newest = state.model_copy(update={"stamp_s": NOW_S})
    tick.s.drive.received_s, tick.s.drive.behind = NOW_S - age_s, behind
    tick.s.drive.reborn_s = None
    return tick


@table(
    ("age_s", "behind", "rows"),
    [
        (WINDOW_S - EPS, 15, []),
        (WINDOW_S + EPS, 0, ["ENC_STALE.0"]),
        (0.0, 16, ["DRIVER_NACK.0"]),
        (0.25 + EPS, 51, ["ENC_STALE.0", "ENC_STALE.1", "DRIVER_NACK.0", "DRIVER_NACK.1"]),
    ],
)
def test_its_rows_wait_for_two_reports_and_a_half(
    age_s: float, behind: int, rows: list[str]
) -> None:
    with pytest.MonkeyPatch.context() as patch:
        slow(patch)
        dirty: list[tuple[str, str]] = []
        detectors.drive(driving(age_s, behind), dirty)
    assert [name for name, _ in dirty] == rows


def test_a_wheel_that_runs_away_is_seen_between_its_reports() -> None:
    def seen(age_s: float) -> float:
        tick = driving(age_s)
        tick.dt_s = 0.01
        tick.s.odometry = replace(tick.s.odometry, measured=Twist2(2.0, 0.0))
        detect_motion.runaway(tick, [])
        return tick.s.watch.runaway_s

    assert seen(0.1) == 0.0
    with pytest.MonkeyPatch.context() as patch:
        slow(patch)
        assert seen(0.1) > 0.0
        assert seen(WINDOW_S + EPS) == 0.0


def test_its_ramps_are_measured_between_its_reports() -> None:
    tick = driving(0.1)
    assert not braking._measures(tick)
    with pytest.MonkeyPatch.context() as patch:
        slow(patch)
        assert braking._measures(tick)
        assert not braking._measures(driving(0.05 + UNSEEN_S + EPS))


def look() -> float:
    return -look_m(ROBOT)


def passes() -> float:
    return obstacle_gate(
        picture({0: 0.5}), IDENTITY, AHEAD, AHEAD, 0.1, ROBOT, Braking()
    ).twist.v_mps


def room() -> float:
    return obstacle_gate(picture({0: 0.65}), IDENTITY, AHEAD, AHEAD, 0.1, ROBOT, Braking()).room_m


def margin() -> float:
    tick = driving()
    tick.s.motion.limiter, tick.s.motion.free_m = LimiterState(AHEAD), 1.5
    told = report.build(tick).limits.margin_m
    assert told is not None
    return told


def fence() -> float:
    tick = driving()
    tick.robot_in_map = replace(IDENTITY, x_m=5.15)  # 0.2 m before the fence's margin
    return motion_gates._inside_fence(tick, Twist2(0.5, 0.0)).v_mps


def shown_lag() -> float:
    return -report.build(driving()).braking.lag_s


@table("figure", [look, passes, room, margin, fence, shown_lag])
def test_every_stopping_distance_counts_what_nobody_sees(figure: Callable[[], float]) -> None:
    often = figure()
    with pytest.MonkeyPatch.context() as patch:
        slow(patch)
        seldom = figure()
    assert seldom < often
    if figure in {room, margin}:
        assert often - seldom == pytest.approx(AHEAD.v_mps * UNSEEN_S)
