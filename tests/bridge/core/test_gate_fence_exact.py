"""Hold what the fence's gate lets through: of whom, with which pose, and what is said of it."""

from __future__ import annotations

from dataclasses import replace
from math import pi

import pytest

from bridge.core.geometry.fence import build_fence
from bridge.core.geometry.kinematics import scale_twist
from bridge.core.motion.braking import reaction_s
from bridge.core.motion.fence_gate import fence_scale
from bridge.core.motion.motion_gates import _inside_fence
from bridge.core.state_motion import Learnt
from tests.bridge.core.fake_planner import MAP_ID
from tests.bridge.core.reached import reached
from tests.bridge.core.table import table
from tests.bridge.core.test_quick_core import ROBOT, tick_of
from wire import STILL, Pose2, Twist2

AHEAD = Twist2(0.5, 0.0)


@table("learnt", [Learnt(), Learnt(lag_more_s=0.2, decel_share=0.5)])
@table("start", ["active", "teleop"])
@table("v_mps", [0.4, 0.1, -0.4])
def test_the_fence_counts_what_was_learnt_of_the_brakes(
    learnt: Learnt, start: str, v_mps: float
) -> None:
    tick = tick_of(reached(start))
    edge_m = reached(start).here.x_m + 0.16
    square = ((-5.0, -5.0), (edge_m, -5.0), (edge_m, 5.0), (-5.0, 5.0))
    fence = build_fence(MAP_ID, (square,))
    tick.config, tick.robot_in_map = replace(tick.config, fence=fence), reached(start).here
    tick.s.learnt, tick.s.motion.bound_by = learnt, "robot"
    twist = Twist2(v_mps, 0.0)
    reaction = reaction_s(0.0, 0.1, ROBOT.drive.lag_s + learnt.lag_more_s, ROBOT.limits)
    scale = fence_scale(
        fence, reached(start).here, twist, ROBOT.base, ROBOT.limits, reaction, learnt.decel_share
    )
    if scale < 1.0 and start == "teleop":
        scale = max(scale, min(1.0, 0.2 / abs(v_mps)))
    assert _inside_fence(tick, twist) == scale_twist(twist, scale)
    assert tick.s.motion.bound_by == ("robot" if v_mps < 0.0 else "fence")
    tick.config = replace(tick.config, fence=None)
    assert _inside_fence(tick, twist) is twist


@table("start", ["active", "active_external", "teleop"])
def test_where_the_fence_is_cannot_be_told_without_a_pose_so_a_hand_alone_passes(
    start: str,
) -> None:
    """No row is up here: the gate asks none."""
    tick = tick_of(reached(start))
    tick.robot_in_map, tick.s.motion.bound_by = None, "robot"
    passes = start == "teleop"
    assert _inside_fence(tick, AHEAD) == (AHEAD if passes else STILL)
    assert tick.s.motion.bound_by == ("robot" if passes else "pose_lost")
    tick.config = replace(tick.config, fence=None)
    assert _inside_fence(tick, AHEAD) is AHEAD


@table("start", ["active", "active_external", "teleop"])
@table("v_mps", [0.4, -0.4])
def test_further_outside_than_the_fence_is_known_a_hand_alone_moves_it(
    start: str, v_mps: float
) -> None:
    """Inward or not: how far it is to the fence is told up to 1 m, so no gain can be shown."""
    tick, far = tick_of(reached(start)), Pose2(3.0, 0.0, pi)
    fence = build_fence(MAP_ID, (((-5.0, -5.0), (1.5, -5.0), (1.5, 5.0), (-5.0, 5.0)),))
    tick.config, tick.robot_in_map = replace(tick.config, fence=fence), far
    passed = 0.2 if start == "teleop" else 0.0
    assert abs(_inside_fence(tick, Twist2(v_mps, 0.0)).v_mps) == pytest.approx(passed)
    tick.robot_in_map = Pose2(2.4, 0.0, pi)
    inward = passed if passed or v_mps < 0.0 else 0.15
    assert abs(_inside_fence(tick, Twist2(v_mps, 0.0)).v_mps) == pytest.approx(inward)


@table(
    ("start", "margins_m", "said"),
    [
        ("teleop", (0.3, 0.05, 1e-9), 0),
        ("teleop", (0.3, 0.05, -1e-3), 1),
        ("teleop", (-1e-3, 0.02, -0.02, 0.14, -0.3, -1.0), 1),  # noise, and a hand to and fro
        ("teleop", (-1e-3, 0.16, -1e-3, 0.0, -1e-3), 2),
        ("active", (-1e-3, -0.02), 0),
    ],
)
def test_a_hand_that_crosses_the_fence_is_told_of_once_a_crossing(
    start: str, margins_m: tuple[float, ...], said: int
) -> None:
    tick = tick_of(reached(start))
    fence = build_fence(MAP_ID, (((-5.0, -5.0), (1.5, -5.0), (1.5, 5.0), (-5.0, 5.0)),))
    tick.config = replace(tick.config, fence=fence)
    for margin_m in margins_m:
        tick.robot_in_map = Pose2(1.5 - margin_m, 0.0, 0.0)
        _inside_fence(tick, AHEAD)
    assert [code for code, _ in tick.events] == ["outside_fence"] * said


def test_what_a_hand_took_out_and_a_planner_brought_in_may_be_taken_out_anew() -> None:
    tick = tick_of(reached("active"))
    tick.s.watch.outside = True
    tick.robot_in_map = Pose2(0.0, 0.0, 0.0)
    _inside_fence(tick, AHEAD)
    assert not tick.s.watch.outside
