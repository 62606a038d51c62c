"""What is in a leg's way is waited for or routed round, a few times; a budget ends the rest."""

from __future__ import annotations

import pytest

from planner.mission.activity import Retrying
from planner.mission.api_view import goal_of, progress_of
from planner.mission.events import Pause, Resume
from planner.mission.legs import RETRY_S
from planner.plan import Code, MoveStraight, StepPlan, StepState, Wait
from tests.planner.mission.fakes import outcome_of, row
from tests.planner.mission.lockstep import (
    FAILED,
    PAUSED,
    RUNNING,
    SUCCEEDED,
    Together,
    driving,
    go,
    standing_still,
)
from wire import HeldReason, LegReport, Mode, Pose2


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
    assert outcome_of(mission).code is Code.BLOCKED
    assert outcome_of(mission).asked is not None
    assert len(world.routes) == 4


def test_no_route_fails_and_the_next_goal_runs(world: Together) -> None:
    world.way = lambda ask: "no_route" if ask.request.goal.x_m > 3 else None
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


def moving(world: Together, distance_m: float = 2.0) -> str:
    goal = world.give(StepPlan(steps=(MoveStraight(distance_m=distance_m),)))
    world.plans[goal] = None  # whoever thinks again finds nothing better
    world.run(1.0)
    assert world.bridge.pose.x_m > 0.2
    return goal


def failed(world: Together, goal: str, limit_s: float = 120.0) -> str | None:
    """Return why the step failed; the brain is still thinking about it."""
    end_s = world.now_s + limit_s
    while world.goal(goal).failure is None:
        assert world.now_s < end_s
        world.run()
    assert standing_still(world)
    return world.goal(goal).steps[0].reason


def test_who_stands_in_the_line_is_waited_for_and_then_it_gives_up(world: Together) -> None:
    goal = moving(world)
    world.bridge.blocked = True
    assert failed(world, goal) == "blocked"
    assert all(ask.obstacles for ask in world.routes), "a line counts what the lidar sees"


def test_who_leaves_again_lets_it_go_on(world: Together) -> None:
    goal = moving(world)
    world.bridge.blocked = True
    world.run(5.0)
    world.bridge.blocked = False
    done = world.run_until(goal, SUCCEEDED)
    assert done.steps[0].moved_m == pytest.approx(2.0, abs=0.06)


def test_a_leg_that_is_followed_and_never_ends_spends_its_budget(world: Together) -> None:
    goal = moving(world)
    world.bridge.deaf, world.bridge.horizon = True, None  # it says that it follows, and stands
    assert failed(world, goal, 90.0) == "too_slow"


def test_a_leg_that_leads_elsewhere_spends_its_budget(world: Together) -> None:
    goal = moving(world)
    world.bridge.odom_m += 0.4
    for _ in range(8):
        world.run()
        world.bridge.odom_m += 0.4
    assert failed(world, goal) == "too_far"


def test_a_line_that_ends_early_moves_nothing(world: Together) -> None:
    world.ends = Pose2(0.2, 0.0, 0.0)
    goal = world.give(StepPlan(steps=(MoveStraight(distance_m=2.0),)))
    world.run(1.0)
    assert len(world.routes) == 1
    step = world.goal(goal).steps[0]
    assert (step.reason, world.bridge.waypoints) == ("no_room", [])


def test_what_is_left_is_shown_while_it_runs_and_gone_after(world: Together) -> None:
    goal = moving(world)
    plan = goal_of(world.book, world.goal(goal)).plan
    assert plan is not None
    assert plan.steps[0].left_m == pytest.approx(2.0 - world.bridge.pose.x_m, abs=0.1)
    progress = progress_of(world.book)
    assert progress is not None
    assert (progress["goal"], progress["step"]) == (goal, 0)
    done = world.run_until(goal, SUCCEEDED)
    assert done.steps[0].left_m is None
    assert progress_of(world.book) is None
    world.give(StepPlan(steps=(Wait(seconds=9.0),)))
    world.run(2.0)
    progress = progress_of(world.book)
    assert progress is not None
    assert progress["left_s"] == pytest.approx(7.0, abs=1.0)
    assert world.goal(goal).state is not FAILED


@pytest.mark.parametrize("crash", [False, True])
def test_what_is_left_of_a_move_is_left_from_where_others_drove_the_robot(
    world: Together, crash: bool
) -> None:
    goal = moving(world)
    gone_m = world.bridge.pose.x_m
    if crash:
        world.bridge.horizon = None
        world = world.restart()
        world.run(0.5)
        world.act()
    else:
        world.event(Pause(goal))
    world.run(0.5)
    other = world.give(go("hall"))
    world.run_until(other, SUCCEEDED)
    here_m = world.bridge.pose.x_m
    assert abs(here_m - gone_m) > 0.2
    world.event(Resume(goal))
    done = world.run_until(goal, SUCCEEDED)
    assert world.bridge.pose.x_m - here_m == pytest.approx(2.0 - gone_m, abs=0.06)
    assert done.steps[0].moved_m == pytest.approx(2.0, abs=0.06)


@pytest.mark.parametrize("seen", [True, False])
def test_what_a_hand_steers_while_the_pose_is_lost_is_no_part_of_the_move(
    world: Together, seen: bool
) -> None:
    goal = moving(world)
    world.bridge.localized = False
    world.bridge.hold(HeldReason.FAULT)
    world.run(0.5)
    assert world.goal(goal).state is PAUSED
    gone_m = world.bridge.pose.x_m
    if seen:
        world.bridge.mode = Mode.TELEOP
        world.run(0.2)
    world.bridge.pose, world.bridge.localized = Pose2(2.0, 0.0, 0.0), True
    world.bridge.hold(HeldReason.TELEOP, "h2")
    world.run(0.5)
    world.event(Resume(goal))
    world.act()
    world.run_until(goal, SUCCEEDED)
    assert world.bridge.pose.x_m == pytest.approx(2.0 + 2.0 - gone_m, abs=0.1)


def test_what_a_hand_steers_while_no_planner_lives_leaves_the_move_unknown(world: Together) -> None:
    goal = moving(world)
    world.bridge.pose = Pose2(2.0, 0.0, 0.0)
    world.bridge.hold(HeldReason.TELEOP)
    after = world.restart()
    after.run(0.5)
    mission = after.goal(goal)
    assert (mission.state, mission.reason) == (FAILED, "steered_meanwhile")
    assert outcome_of(mission).code is Code.NOT_REACHED
    after.act()
    assert standing_still(after)
