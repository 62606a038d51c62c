"""Straight moves wait for who stands in them, then give up; a skill's budget ends what drags on."""

from __future__ import annotations

import pytest

from planner.mission.api_view import goal_of, progress_of
from planner.mission.events import Pause, Resume
from planner.plan import Code, MoveStraight, StepPlan, Wait
from tests.planner.mission.driving import FAILED, PAUSED, SUCCEEDED, standing_still
from tests.planner.mission.lockstep import Together, go
from wire import HeldReason, Mode, Pose2


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
def test_what_is_left_of_a_move_is_left_from_where_others_drove_the_robot(crash: bool) -> None:
    world = Together()
    world.run(0.2)
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
    assert mission.outcome is not None
    assert mission.outcome.code is Code.NOT_REACHED
    after.act()
    assert standing_still(after)
