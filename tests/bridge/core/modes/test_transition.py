"""Hold how stops begin, grow harder and end, and what each transition leaves."""

from __future__ import annotations

from dataclasses import replace

from bridge.core.modes import selftest
from bridge.core.modes.mode_table import Cause, Fact, RequestCause
from bridge.core.modes.transition import escalate, go, plan_stop
from bridge.core.motion.wheel_command import requested_twist
from bridge.core.state_motion import NO_STOP, LimiterState, Profile, Stopping, profile_of
from bridge.core.tick_context import TickContext
from tests.bridge.core.reached import reached, tick_of
from tests.bridge.core.scripted import ROBOT
from tests.bridge.core.table import table
from wire import STILL, Action, HeldReason, Mode, StandingHold, Twist2

LATER_S = 0.5


def later(start: str) -> TickContext:
    """Return a tick half a second after the mode was reached."""
    tick = tick_of(reached(start))
    tick.now_s += LATER_S
    return tick


@table(
    ("start", "cause", "action", "resumes"),
    [
        ("active", Action.HOLD2, Action.HOLD2, True),
        ("active", Action.STOP1, Action.STOP1, False),
        ("active", Action.FAST1, Action.FAST1, False),
        ("active", RequestCause.STOP, Action.HOLD2, False),
        ("active", RequestCause.DISARM, Action.STOP1, False),
        ("teleop", Action.HOLD2, Action.HOLD2, False),
        ("teleop", RequestCause.STOP, Action.HOLD2, False),
        ("hold", Action.STOP1, Action.STOP1, False),
    ],
)
@table("reset_needed", [False, True])
def test_a_stop_begins_as_its_cause_says(
    start: str, cause: Cause, action: Action, resumes: bool, reset_needed: bool
) -> None:
    tick = later(start)
    before, source = tick.s.mode, tick.s.source
    assert go(tick, cause, "why", reset_needed=reset_needed)
    plan = plan_stop(tick.s.motion.limiter, ROBOT.base, ROBOT.limits, profile_of(action))
    assert tick.s.stopping == Stopping(
        action, "why", tick.now_s, plan, source, resumes, reset_needed
    )
    assert (tick.s.mode, tick.s.mode_since_s) == (Mode.STOPPING, tick.now_s)
    assert tick.events == [("mode", f"{before.value} STOPPING why")]


def test_only_the_hardest_stop_has_the_hardest_ramp() -> None:
    assert {action: profile_of(action) for action in Action} == {
        action: Profile.FASTEST if action is Action.FAST1 else Profile.STOP for action in Action
    }


def stopping(action: Action, *, reset_needed: bool = False) -> TickContext:
    tick = later("stopping_by_row")
    assert tick.s.stopping is not None
    tick.s.stopping = replace(tick.s.stopping, action=action, slow_s=0.1, reset_needed=reset_needed)
    return tick


@table(
    ("had", "came", "faster"),
    [
        (Action.HOLD2, Action.STOP1, False),
        (Action.HOLD2, Action.FAST1, True),
        (Action.STOP1, Action.FAST1, True),
    ],
)
@table("needed", [(False, False), (False, True), (True, False)])
def test_a_stop_grows_harder_and_only_a_harder_ramp_is_planned_anew(
    had: Action, came: Action, faster: bool, needed: tuple[bool, bool]
) -> None:
    tick = stopping(had, reset_needed=needed[0])
    before = tick.s.stopping
    assert before is not None
    escalate(tick, came, "worse", reset_needed=needed[1])
    harder = plan_stop(tick.s.motion.limiter, ROBOT.base, ROBOT.limits, Profile.FASTEST)
    assert tick.s.stopping == Stopping(
        action=came,
        cause="worse",
        since_s=tick.now_s if faster else before.since_s,
        plan=harder if faster else before.plan,
        source=before.source,
        resumes=False,
        reset_needed=any(needed),
        slow_s=0.0 if faster else 0.1,
    )
    assert tick.events == [("stop_escalated", f"{came.value} worse")]


@table("came", [Action.HOLD2, Action.STOP1])
@table("needed", [(False, False), (False, True), (True, True), (True, False)])
def test_a_stop_never_grows_milder_but_learns_that_a_reset_is_needed(
    came: Action, needed: tuple[bool, bool]
) -> None:
    tick = stopping(Action.STOP1, reset_needed=needed[0])
    before = tick.s.stopping
    assert before is not None
    escalate(tick, came, "other", reset_needed=needed[1])
    if needed == (False, True):
        before = replace(before, reset_needed=True, cause="other")
    assert tick.s.stopping == before
    assert tick.events == []
    tick.s.stopping = None
    escalate(tick, Action.FAST1, "none", reset_needed=True)
    assert tick.s.stopping is None


def test_a_person_who_stops_a_stop_ends_its_going_on() -> None:
    tick = stopping(Action.HOLD2)
    assert go(tick, RequestCause.DISARM, "disarm")
    assert tick.s.stopping is not None
    assert (tick.s.stopping.action, tick.s.stopping.resumes) == (Action.STOP1, False)
    assert tick.s.mode_since_s < tick.now_s, "the mode is the same"
    assert ("mode", "STOPPING STOPPING disarm") not in tick.events


HELD = StandingHold(reason=HeldReason.STOP, id="s1")


@table("held", [None, HELD])
@table("start", ["active", "disarmed", "stopping_by_row", "selftest"])
def test_a_protective_stop_ramps_where_there_is_torque(
    start: str, held: StandingHold | None
) -> None:
    tick = later(start)
    tick.s.held = held
    powered = tick.is_powered
    if not powered:  # nothing of a motion is left in these modes, and nothing may come back
        tick.s.motion.limiter = LimiterState(Twist2(0.1, 0.0))
        tick.s.stopping = Stopping(Action.HOLD2, "old", 0.0, NO_STOP, "W", resumes=True)
    source, had = tick.s.source, tick.s.motion.limiter
    go(tick, RequestCause.ESTOP, "estop")
    plan = plan_stop(had, ROBOT.base, ROBOT.limits, Profile.FASTEST)
    if powered:
        assert tick.s.stopping == Stopping(
            Action.FAST1, "estop", tick.now_s, plan, source, resumes=False
        )
        assert tick.s.motion.limiter == had
    else:
        assert tick.s.stopping is None
        assert tick.s.motion.limiter == LimiterState()
    assert tick.s.source == ""
    assert tick.s.held == (held or StandingHold(reason=HeldReason.FAULT, id="estop"))


def test_after_a_hand_on_the_stick_the_ramp_is_judged_like_a_stop() -> None:
    tick = later("teleop")
    plan = plan_stop(tick.s.motion.limiter, ROBOT.base, ROBOT.limits, Profile.STOP)
    assert go(tick, Fact.RELEASED, "released")
    assert tick.s.stopping == Stopping(
        Action.HOLD2, "released", tick.now_s, plan, "T", resumes=False
    )
    assert tick.s.source == ""
    assert requested_twist(tick) == (STILL, False)


@table("held", [None, HELD])
@table(
    ("start", "cause", "stop_cause", "mode", "fault", "holds"),
    [
        ("stopping_by_row", Fact.TOO_SLOW, "x", Mode.FAULT, "why", "why"),
        ("stopping_by_row", Fact.STOOD_DISARM, "stuck", Mode.DISARMED, None, "stuck"),
        ("stopping_by_row", Fact.STOOD_DISARM, "disarm", Mode.DISARMED, None, None),
        ("fault", RequestCause.RESET, None, Mode.DISARMED, None, None),
        ("fault", Fact.UNPROVEN_RESET, None, Mode.SELFTEST, None, None),
        ("active", Action.CUT0, None, Mode.FAULT, "why", "why"),
    ],
)
def test_without_torque_nothing_of_the_motion_is_left(
    start: str,
    cause: Cause,
    stop_cause: str | None,
    mode: Mode,
    fault: str | None,
    holds: str | None,
    held: StandingHold | None,
) -> None:
    tick = later(start)
    tick.s.held = held
    if stop_cause is not None:
        assert tick.s.stopping is not None
        tick.s.stopping = replace(tick.s.stopping, cause=stop_cause)
    before = tick.s.selftest
    if mode is Mode.SELFTEST:
        selftest.enter(tick, cause, "why")
    else:
        assert go(tick, cause, "why")
    assert (tick.s.mode, tick.s.fault) == (mode, fault)
    expected = None if holds is None else StandingHold(reason=HeldReason.FAULT, id=holds)
    assert tick.s.held == (held or expected)
    assert (tick.s.stopping, tick.s.source) == (None, "")
    assert requested_twist(tick) == (STILL, False)
    assert tick.s.motion.limiter == LimiterState()
    if mode is Mode.SELFTEST:
        assert (tick.s.selftest.since_s, tick.s.selftest.passed) == (tick.now_s, False)
        assert tick.s.selftest.phase == "echo"
    else:
        assert tick.s.selftest == before


def test_a_new_order_to_stop_ends_the_going_on_of_a_stop_in_progress() -> None:
    world = reached("stopping_by_row")
    assert world.state.stopping is not None
    assert world.state.stopping.resumes
    world.op("disarm")
    world.tick()
    assert world.state.stopping is not None
    assert not world.state.stopping.resumes
    assert world.state.stopping.action.value == "STOP1"
    world.op("disarm")
    world.tick()
    assert world.is_in(Mode.STOPPING)


def test_motion_goes_on_from_what_was_sent_last() -> None:
    tick = later("stopping_by_row")
    had = tick.s.motion.limiter
    tick.s.odometry = replace(tick.s.odometry, measured=Twist2(-0.5, 1.0))
    assert had.sent.v_mps > 0.1
    assert go(tick, Fact.CLEARED, "m1", source="W")
    assert tick.s.stopping is None
    assert tick.s.motion.limiter == had, "whatever is measured"
    assert tick.s.source == "W", "whoever calls sets it"
