"""Only under the wanted leg does Nav2 reach the bridge, and its word alone is no arrival."""

from __future__ import annotations

from itertools import pairwise
from math import hypot, pi
from typing import Any, get_args

import pytest
from hypothesis import given
from hypothesis import strategies as st

from planner.bridge_client.nav2_pilot import ACCEPT_S, OLD_S, PERIOD_S, SILENT_S, Nav2Pilot
from planner.bridge_client.ownership import STAND, MotionRequest
from tests.planner.mission.fakes import status
from wire import GrantLeft, LegReport, Mode, Nav2Goal, Nav2Phase, Nav2State, Owner, Pose2, Velocity
from wire.ros2_config import Nav2Config

ME, MISSION = "p1", "m1"
CONFIG = Nav2Config()
WANTED = MotionRequest(MISSION, 3)
GOAL, START = Pose2(2.0, 1.0, 0.5), Pose2(0.0, 0.0, 0.0)
NOW_S = 100.0
PHASES = get_args(Nav2Phase)


def pilot(*, heading: bool = False) -> Nav2Pilot:
    made = Nav2Pilot(CONFIG, ME)
    made.aim((MISSION, 3), START, GOAL, NOW_S, heading=heading)
    return made


def nav2(**changes: Any) -> Nav2State:
    fields: dict[str, Any] = {
        "boot_id": "ros2-1", "seq": 1, "mission": MISSION, "leg": 3, "phase": "driving",
        "phase_s": 0.5, "twist": 1, "twist_age_s": 0.0, "v_mps": 0.3, "w_radps": 0.1,
        "code": None, "detail": "", **changes,
    }  # fmt: skip
    return Nav2State(**fields)


def seen(**changes: Any) -> Any:
    grant = GrantLeft(mission=MISSION, metres=9.0, seconds=9.0)
    owner = Owner(planner_id=ME, kind="external")
    return status(**{"owner": owner, "grant": grant, "mode": Mode.ACTIVE, **changes})


def velocities(said: tuple[Any, ...]) -> list[Velocity]:
    return [one for one in said if isinstance(one, Velocity)]


OWNERS = st.sampled_from([None, Owner(planner_id=ME, kind="external"),
                          Owner(planner_id="other", kind="planner")])  # fmt: skip
GRANTS = st.sampled_from([None, GrantLeft(mission=MISSION, metres=1.0, seconds=1.0),
                          GrantLeft(mission="else", metres=1.0, seconds=1.0)])  # fmt: skip


@given(
    wanted=st.sampled_from([STAND, WANTED, MotionRequest(MISSION, 2), MotionRequest(MISSION)]),
    owner=OWNERS,
    grant=GRANTS,
    mode=st.sampled_from(list(Mode)),
    phase=st.sampled_from(PHASES),
    leg=st.sampled_from([2, 3]),
    twist=st.sampled_from([0, 1]),
    age_s=st.floats(0.0, 1.0),
    waited_s=st.floats(0.0, 3.0),
    speed=st.floats(-5.0, 5.0),
)
def test_a_velocity_that_moves_is_said_only_where_all_of_it_fits(  # all that counts
    wanted: MotionRequest,
    owner: Owner | None,
    grant: GrantLeft | None,
    mode: Mode,
    phase: Nav2Phase,
    leg: int,
    twist: int,
    age_s: float,
    waited_s: float,
    speed: float,
) -> None:
    made = pilot()
    made.hear(nav2(phase=phase, leg=leg, twist=twist, twist_age_s=age_s, v_mps=speed), NOW_S)
    now = seen(owner=owner, grant=grant, mode=mode)
    said = velocities(made.speak(now, wanted, 1.0, NOW_S + waited_s))
    assert len(said) <= 1
    for one in said:
        assert owner is not None
        assert owner.planner_id == ME
        assert grant is not None
        assert (one.epoch, one.seen) == (now.epoch, now.seq)
        if one.dead_man:
            assert (wanted, grant.mission, phase, leg) == (WANTED, MISSION, "driving", 3)
            assert twist > 0
            assert age_s + waited_s <= OLD_S + 1e-9
            assert one.v_mps == pytest.approx(speed)
        else:
            assert one.v_mps == 0.0 or phase == "driving"


@given(st.lists(st.tuples(st.floats(0.001, 0.2), st.booleans()), max_size=60))
def test_each_twist_is_said_once_and_never_faster_than_the_bridge_takes_them(
    steps: list[tuple[float, bool]],
) -> None:
    made, now_s, number = pilot(), NOW_S, 0
    at: list[float] = []
    twists = 0
    for gap_s, is_new in steps:
        now_s += gap_s
        number += is_new
        made.hear(nav2(twist=number), now_s)
        said = velocities(made.drive(seen(), WANTED, 1.0, now_s))
        at += [now_s] * len(said)
        twists += len(said)
    assert twists <= number
    assert all(after - before >= PERIOD_S - 1e-9 for before, after in pairwise(at))


@given(
    x_m=st.floats(-5.0, 5.0), y_m=st.floats(-5.0, 5.0), yaw=st.floats(-pi, pi),
    phase=st.sampled_from(PHASES), heading=st.booleans(), placed=st.booleans(),
)  # fmt: skip
def test_reached_takes_nav2s_word_and_the_pose(  # all that counts
    x_m: float, y_m: float, yaw: float, phase: Nav2Phase, heading: bool, placed: bool
) -> None:
    made = pilot(heading=heading)
    made.hear(nav2(phase=phase), NOW_S)
    pose = Pose2(x_m, y_m, yaw)
    report = made.report(seen(base_in_map=pose if placed else None), WANTED, NOW_S + 0.1)
    assert isinstance(report, LegReport)
    far_m = hypot(GOAL.x_m - x_m, GOAL.y_m - y_m)
    turned = abs((yaw - GOAL.yaw_rad + pi) % (2 * pi) - pi) if heading else 0.0
    if report.reached:
        assert placed
        assert phase == "succeeded"
        assert far_m <= CONFIG.within_m
        assert turned <= CONFIG.within_rad + 1e-9
    elif placed and phase == "succeeded":
        assert far_m > CONFIG.within_m or turned > CONFIG.within_rad - 1e-9


def test_what_is_wanted_is_nav2s_goal_and_nothing_wanted_is_none() -> None:
    made = pilot(heading=True)
    now = seen(base_in_map=Pose2(0.5, 0.0, 0.1))
    (order,) = (one for one in made.speak(now, WANTED, 1.0, NOW_S) if isinstance(one, Nav2Goal))
    assert (order.mission, order.leg, order.goal) == (MISSION, 3, GOAL)
    (order,) = (one for one in made.speak(now, STAND, 1.0, NOW_S) if isinstance(one, Nav2Goal))
    assert (order.mission, order.goal, order.here) == (None, None, Pose2(0.5, 0.0, 0.1))


def test_a_goal_without_a_heading_ends_as_the_robot_came() -> None:
    made = pilot()
    (order,) = (one for one in made.speak(seen(), WANTED, 1.0, NOW_S) if isinstance(one, Nav2Goal))
    assert order.goal is not None
    assert order.goal.yaw_rad == pytest.approx(0.4636, abs=1e-3)


@pytest.mark.parametrize(
    ("state", "after_s", "refusal"),
    [
        (None, SILENT_S + 0.1, "nav2_not_heard"),
        (nav2(leg=2), ACCEPT_S + 0.1, "nav2_no_answer"),
        (nav2(phase="sent", phase_s=ACCEPT_S + 0.1), 0.1, "nav2_no_answer"),
        (nav2(phase="aborted"), 0.1, "nav2_aborted"),
        (nav2(phase="cancelled"), 0.1, "nav2_cancelled"),
        (nav2(phase="succeeded", phase_s=2.0), 0.1, "nav2_not_there"),
        (nav2(code="ros2_topic_missing", phase_s=ACCEPT_S + 0.1), 0.1, "nav2_no_velocity"),
        (nav2(), 0.1, None),
        (nav2(phase="succeeded", phase_s=0.2), 0.1, None),
    ],
)
def test_each_end_has_its_code(
    state: Nav2State | None, after_s: float, refusal: str | None
) -> None:
    made = pilot()
    now_s = NOW_S + after_s
    if state is not None:
        made.hear(state, now_s)
    report = made.report(seen(), WANTED, now_s)
    assert report is not None
    assert report.refusal == refusal


def test_a_slower_goal_is_driven_slower() -> None:
    made = pilot()
    made.hear(nav2(), NOW_S)
    (one,) = velocities(made.drive(seen(), WANTED, 0.5, NOW_S))
    assert (one.v_mps, one.w_radps) == pytest.approx((0.15, 0.05))
