"""Hold what stops of late and weak robots teach."""

from __future__ import annotations

from collections import deque
from dataclasses import dataclass, field, replace

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from bridge.core import CoreConfig, initial
from bridge.core.geometry.stopping import stop_length_m
from bridge.core.motion.braking import after_cut, after_stop
from bridge.core.state_motion import LEAST_SHARE, MOST_LAG_S, UNLEARNT, Learnt, Ramp
from tests.bridge.core.fake_planner import PERIOD_S, FakeDrive
from tests.bridge.core.scripted import World, config
from wire import DriveState, Mode, RobotDescription, Twist2

_WHOLE = RobotDescription()
_PLAIN = {"kp": 0.0, "ki_per_s": 0.0, "response_s": 0.0, "dead_zone_radps": 0.0}
ROBOT = _WHOLE.model_copy(update={"drive": _WHOLE.drive.model_copy(update=_PLAIN)})
"""Without wheel control, which makes up for part of what is to be learnt."""
LAG_S, DECEL = ROBOT.drive.lag_s, ROBOT.limits.max_decel_mps2


@dataclass
class Metal(FakeDrive):
    """Brake no harder than it can, and hear everything late."""

    late_ticks: int = 0
    most_radps2: float = 1e9
    """At the wheel, away from the speed it has."""
    waiting: deque[tuple[float, float]] = field(default_factory=deque)

    def tick(self, now_s: float) -> DriveState:
        before, told = self.speeds, self.target
        self.waiting.append(told)
        while len(self.waiting) > self.late_ticks + 1:
            self.waiting.popleft()
        self.target = self.waiting[0]
        state = super().tick(now_s)
        self.target = told
        most = self.most_radps2 * PERIOD_S
        held = [max(was - most, now) for was, now in zip(before, self.speeds, strict=True)]
        self.speeds = (held[0], held[1])
        self.angles = (state.left_rad, state.right_rad)
        return state.model_copy(update={"left_radps": held[0], "right_radps": held[1]})


def stopped(metal: Metal, core: CoreConfig | None = None) -> World:
    """Drive at 0.5 m/s and be stopped."""
    world = World(core or config(ROBOT), drive=metal).driving()
    stop(world)
    return world


def stop(world: World) -> None:
    world.stop()
    for _ in range(300):
        world.tick()
        if world.state.ramp is None and world.mode is not Mode.STOPPING:
            return
    raise AssertionError(f"still {world.mode}, {world.state.ramp}")


def lag_s(world: World) -> float:
    return LAG_S + world.state.learnt.lag_more_s


def test_a_robot_as_configured_teaches_nothing() -> None:
    world = stopped(Metal())
    assert replace(world.state.learnt, stops=0) == UNLEARNT
    assert world.state.learnt.stops == 1
    assert "braking_learnt" not in {event.code for event in world.events}


@pytest.mark.parametrize("late_ticks", [10, 25])
def test_a_late_drive_is_learnt_from_its_first_stop(late_ticks: int) -> None:
    world = stopped(Metal(late_ticks=late_ticks))
    assert lag_s(world) == pytest.approx(0.04 + late_ticks * PERIOD_S, abs=0.02)
    assert world.state.learnt.decel_share == 1.0, "late is not weak"
    assert [event.code for event in world.events].count("braking_learnt") == 1


@pytest.mark.parametrize("share", [0.45, 0.6])
def test_weak_brakes_are_learnt_from_the_first_stop(share: float) -> None:
    world = stopped(Metal(most_radps2=share * DECEL / ROBOT.base.wheel_radius_m))
    assert world.state.learnt.decel_share == pytest.approx(share, rel=0.1)


@pytest.mark.parametrize(("late", "share"), [(0, 0.5), (15, 1.2), (8, 0.6), (25, 0.8)])
def test_the_law_with_what_was_learnt_covers_the_stop_that_taught_it(
    late: int, share: float
) -> None:
    world = World(config(ROBOT), drive=Metal(late_ticks=late, most_radps2=share * 10.0)).driving()
    moving, at_m = world.state.odometry.measured.v_mps, world.state.odometry.travelled_m
    stop(world)
    rolled_m = world.state.odometry.travelled_m - at_m
    learnt = world.state.learnt
    build_s = DECEL / (2 * ROBOT.limits.stop_jerk_mps3)
    reaction = LAG_S + learnt.lag_more_s + build_s + 2 * PERIOD_S  # the order's own ticks
    law_m = stop_length_m(
        Twist2(moving, 0.0), ROBOT.base, ROBOT.limits, reaction, learnt.decel_share
    )
    assert rolled_m <= law_m + 0.01


def test_a_stop_cut_for_being_too_slow_teaches_how_weakly_it_braked() -> None:
    world = World(config(ROBOT), drive=Metal(most_radps2=2.0)).driving()
    world.stop()
    world.until(Mode.FAULT)
    assert world.state.fault == "stop_too_slow"
    assert world.state.learnt.decel_share == pytest.approx(0.2, abs=0.05)
    assert world.state.ramp is None


def test_weak_brakes_cap_every_source_by_their_share_and_say_so() -> None:
    core = replace(config(ROBOT), learnt=Learnt(decel_share=0.4, share_at_mps=0.5, stops=1))
    world = World(core).driving()
    assert world.sent.v_mps == pytest.approx(0.4 * ROBOT.limits.max_speed_mps, abs=1e-6)
    status = world.shown
    assert (status.limits.by, status.limits.v_mps) == ("weak_brakes", 0.2)
    assert status.braking.learnt
    assert status.braking.decel_mps2 == pytest.approx(0.4)
    assert Learnt(decel_share=0.5).speed_share() == 1.0, "half is not under half"


def test_with_the_cap_a_stop_of_weak_brakes_is_not_too_slow() -> None:
    core = replace(config(ROBOT), learnt=Learnt(decel_share=0.3, share_at_mps=0.5, stops=1))
    world = stopped(Metal(most_radps2=3.0), core)
    assert world.mode is Mode.HOLD


def test_a_run_begins_with_what_others_learnt_and_says_what_it_could_not_read() -> None:
    kept = Learnt(lag_more_s=0.1, lag_at_mps=0.4, stops=9)
    core = replace(config(ROBOT), learnt=kept, braking_trouble="braking_file_unreadable")
    state = initial(core, 1.0)
    assert state.learnt == kept
    world = World(core)
    world.run(0.5)
    told = world.shown.braking
    assert told.lag_s == pytest.approx(0.16)
    assert told.stops == 9
    assert told.trouble == "braking_file_unreadable"


def test_a_ramp_that_nothing_measures_for_a_while_is_let_go() -> None:
    world = World(config(ROBOT), drive=Metal(late_ticks=20)).driving()
    world.stop()
    world.run(0.1)
    assert world.state.ramp is not None
    world.drive_silent = True
    world.run(0.07)
    assert world.state.ramp is None


def ramp(lag_s: float, share: float = 1.0, speed: float = 0.5) -> Ramp:
    """Return an ordinary stop of a robot that is so late and brakes so weakly, in closed form."""
    sent_m = speed * speed / (2 * DECEL) + speed * 0.05
    real_m = speed * lag_s + max(sent_m, speed * speed / (2 * DECEL * share))
    sent_s = 0.5 * speed / DECEL
    late, real_s = lag_s + 0.25 * speed / DECEL * (1 / share - 1), sent_s / share
    marks = (1.0, 1.0 + sent_s, 1.0 + late, 1.0 + late + real_s)
    return Ramp(0.9, speed, speed, 0.0, 0.0, sent_m, real_m, 0.0, *marks)


@settings(max_examples=60, deadline=None)
@given(
    st.lists(st.tuples(st.floats(0.0, 2.0), st.floats(0.01, 3.0), st.floats(0.0, 2.0)), max_size=80)
)
def test_nothing_makes_it_better_than_configured_or_worse_than_believable(
    stops: list[tuple[float, float, float]],
) -> None:
    known = UNLEARNT
    for lag, share, speed in stops:
        one = ramp(lag, share, speed)
        known = after_stop(known, one, ROBOT)
        known = after_cut(known, replace(one, real_low_s=None), ROBOT, 2.0)
        assert 0.0 <= known.lag_more_s <= MOST_LAG_S
        assert LEAST_SHARE <= known.decel_share <= 1.0


def test_a_wheel_that_runs_away_while_it_should_stop_teaches_nothing() -> None:
    world = World(config(ROBOT), drive=Metal()).driving()
    world.stop()
    world.run(0.1)
    world.drive.runs_on, world.drive.speeds = True, (9.0, 9.0)
    world.run(0.06)
    assert world.state.ramp is None
    assert world.state.learnt == UNLEARNT
