"""What is in the way, off the path or not followed is routed anew, a few times."""

from __future__ import annotations

import pytest

from planner.mission.activity import Retrying
from planner.mission.events import (
    Pause,
    Resume,
)
from planner.mission.legs import RETRY_S
from planner.plan import Code, MoveStraight, StepPlan, StepState
from tests.planner.mission.driving import FAILED, PAUSED, RUNNING, SUCCEEDED, driving
from tests.planner.mission.fakes import row
from tests.planner.mission.lockstep import Together, go
from wire import LegReport, Mode, Pose2


def test_blocked_for_three_seconds_routes_around_and_streams_on(world: Together) -> None:
    goal = driving(world)
    world.bridge.blocked = True
    world.run(2.5)
    assert len(world.routes) == 1
    streamed = len(world.bridge.waypoints)
    world.run(1.0)
    assert len(world.routes) == 2
    assert world.routes[1].obstacles
    assert len(world.bridge.waypoints) > streamed
    assert world.bridge.waypoints[-1].leg == 2
    world.bridge.blocked = False
    world.run_until(goal, SUCCEEDED)


def test_no_way_round_fails_after_some_tries(world: Together) -> None:
    goal = driving(world)
    world.way = lambda ask: "no_route" if ask.obstacles else None
    world.bridge.blocked = True
    mission = world.run_until(goal, FAILED, limit_s=120.0)
    assert mission.reason == "blocked"
    assert mission.outcome is not None
    assert mission.outcome.code is Code.BLOCKED
    assert mission.outcome.asked is not None
    assert len(world.routes) == 4


def test_no_route_fails_and_the_next_goal_runs(world: Together) -> None:
    world.way = lambda ask: "no_route" if ask.goal.x_m > 3 else None
    first, second = world.give(go("kitchen", "hall")), world.give(go("dock"))
    mission = world.goal(first)
    assert (mission.state, mission.reason) == (FAILED, "no_route")
    assert [s.state for s in mission.steps] == [StepState.FAILED, StepState.SKIPPED]
    world.run_until(second, SUCCEEDED)


def test_a_search_that_dies_is_tried_again(world: Together) -> None:
    deaths = iter(("route_worker_died", "route_timed_out"))
    world.way = lambda ask: next(deaths, None)
    goal = world.give(go("kitchen"))
    world.run_until(goal, SUCCEEDED)
    assert len(world.routes) == 3


def test_off_the_path_stands_then_routes_anew(world: Together) -> None:
    goal = driving(world)
    x_m = world.bridge.pose.x_m
    world.bridge.pose = Pose2(x_m, 0.6, 0.0)
    world.run()
    assert world.bridge.waypoints[-1].points == ()
    world.run_until(goal, SUCCEEDED)
    assert len(world.routes) == 2
    assert world.goal(goal).leg == 2


def test_thrown_off_again_and_again_fails(world: Together) -> None:
    goal = driving(world)
    for _ in range(40):
        world.bridge.pose = Pose2(world.bridge.pose.x_m, world.bridge.pose.y_m + 0.6, 0.0)
        world.run(0.5)
    assert (world.goal(goal).state, world.goal(goal).reason) == (FAILED, "no_route")


def test_a_horizon_the_bridge_refuses_is_routed_anew(world: Together) -> None:
    goal = driving(world)
    assert world.bridge.leg is not None
    world.bridge.horizon = None
    world.bridge.blocked = True  # so that the fake does not move
    world.bridge.leg = world.bridge.leg.model_copy(
        update={"refusal": "fence_crossed", "following": False}
    )
    world.bridge.deaf = True
    world.run(1.0)
    assert len(world.routes) == 2
    world.bridge.deaf, world.bridge.blocked = False, False
    world.run_until(goal, SUCCEEDED)


def test_a_pose_jump_routes_anew_standing(world: Together) -> None:
    goal = driving(world)
    world.bridge.rows = (row("POSE_JUMP"),)
    world.bridge.turn()
    world.bridge.mode = Mode.HOLD
    world.run(0.5)
    assert len(world.routes) == 1
    world.bridge.rows = ()
    world.run_until(goal, SUCCEEDED)
    assert len(world.routes) == 2


def test_a_step_that_waits_to_try_again_waits_while_the_pose_jumps_and_then_tries(
    world: Together,
) -> None:
    world.bridge.localized = False
    world.run(0.2)
    goal = world.give(StepPlan(steps=(MoveStraight(distance_m=1.0),)))
    world.run(0.2)
    assert isinstance(world.book.activity, Retrying), "a move needs to know where it begins"
    world.bridge.localized, world.bridge.rows = True, (row("POSE_JUMP"),)
    world.run(3 * RETRY_S)
    assert isinstance(world.book.activity, Retrying)
    assert not world.routes
    world.bridge.rows = ()
    world.run_until(goal, SUCCEEDED)
    assert len(world.routes) == 1


def test_without_a_pose_nothing_is_streamed(world: Together) -> None:
    goal = driving(world)
    world.bridge.localized = False
    world.run()
    assert world.bridge.waypoints[-1].points == ()
    world.bridge.localized = True
    world.run_until(goal, SUCCEEDED)


def test_a_leg_that_nobody_follows_is_given_up(world: Together) -> None:
    goal = driving(world)
    world.bridge.owner, world.bridge.horizon = "p9", None
    world.bridge.turn()
    world.run(40.0, every_s=0.5)
    assert (world.goal(goal).state, world.goal(goal).reason) == (PAUSED, "blocked")


@pytest.mark.parametrize("change", [{"leg": 7}, {"mission": "other"}, {"reached": False}])
def test_only_our_own_leg_counts_as_reached(world: Together, change: dict[str, object]) -> None:
    goal = driving(world)
    told = LegReport(mission=goal, leg=1, following=False, reached=True, residual_m=0.0,
                     residual_rad=0.0, refusal=None).model_copy(update=change)  # fmt: skip
    world.bridge.pose = Pose2(4.0, 0.0, 0.0)
    world.bridge.horizon, world.bridge.leg, world.bridge.deaf = None, told, True
    world.run(0.2)
    assert world.goal(goal).state is RUNNING


def test_reached_outside_the_room_is_not_arrival(world: Together) -> None:
    goal = driving(world)
    assert world.bridge.leg is not None
    world.bridge.leg = world.bridge.leg.model_copy(update={"reached": True})
    world.bridge.horizon, world.bridge.mode = None, Mode.HOLD
    world.run()
    assert world.goal(goal).state is RUNNING
    done = world.run_until(goal, SUCCEEDED)
    assert done.leg == 2


def test_a_new_leg_is_above_every_one_the_bridge_knows(world: Together) -> None:
    goal = driving(world)
    world.event(Pause(goal))
    assert world.bridge.leg is not None
    world.bridge.leg = world.bridge.leg.model_copy(update={"leg": 9, "reached": True})
    world.run()
    world.event(Resume(goal))
    world.run()
    assert world.goal(goal).leg == 10
    assert world.goal(goal).state is RUNNING
