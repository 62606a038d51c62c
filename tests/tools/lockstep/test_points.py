"""A person points at the map: the robot stands there, or says why not; no brain may point."""

from __future__ import annotations

from collections.abc import Iterator
from math import atan2, degrees, hypot, pi

import pytest

from bridge.core.geometry.fence import contains
from lockstep.planner_process import Request
from planner.brain import ScriptedBrain
from planner.plan import Code, GoalState, GoToPose, PauseReason, StepPlan, Wait
from tests.known import known
from tests.tools.lockstep.conftest import Ready
from tools.lockstep import GoalHandle, LockstepWorld
from wire import Answer, Pose2, SlowMark, wrap

pytestmark = pytest.mark.nightly(keep=7)


IN_KITCHEN = Pose2(1.5, 2.0, 1.5)
REACHED_M, REACHED_DEG = 0.10, 5.0


def point(world: LockstepWorld, x_m: float, y_m: float, **more: float | bool) -> GoToPose:
    site = world.scene.site
    return GoToPose.model_validate({"map_id": site.map_id, "x_m": x_m, "y_m": y_m, **more})


def off(world: LockstepWorld, at: GoToPose) -> tuple[float, float]:
    """Return how far the robot stands from a point [m] and off its heading [degrees], in truth."""
    pose = world.truth
    turned = 0.0 if at.yaw_rad is None else wrap(pose.yaw_rad - at.yaw_rad)
    return hypot(pose.x_m - at.x_m, pose.y_m - at.y_m), abs(degrees(turned))


def ended(world: LockstepWorld, goal: GoalHandle, limit_s: float = 60.0) -> Code:
    world.run_until(lambda _: goal.has_ended, limit_s)
    assert world.contacts == 0
    outcome = known(goal.record.outcome)
    return outcome.code


@pytest.mark.parametrize("yaw_rad", [None, 0.0, pi, -1.2])
def test_the_robot_stands_on_the_point_at_its_heading(ready: Ready, yaw_rad: float | None) -> None:
    world = ready(seed=2, start=IN_KITCHEN)
    there = point(world, 1.6, 4.6, **({} if yaw_rad is None else {"yaw_rad": yaw_rad}))
    goal = world.go(there)
    assert ended(world, goal) is Code.ARRIVED
    away_m, turned_deg = off(world, there)
    assert away_m <= REACHED_M
    assert turned_deg <= REACHED_DEG
    record = goal.record
    assert record.text == "go to the point (1.60, 4.60)"
    assert record.brain is None, "no brain was asked"
    assert record.outcome is not None
    assert record.outcome.message.en == "Arrived: point (1.60, 4.60)."
    assert (known(record.outcome.asked).x_m, known(record.outcome.asked).y_m) == (1.6, 4.6)


def test_points_are_driven_to_in_their_row(ready: Ready) -> None:
    world = ready(seed=2, start=IN_KITCHEN)
    row = (point(world, 1.6, 4.6), point(world, 2.2, 3.9), point(world, 1.5, 2.0, yaw_rad=1.0))
    goal = world.go(*row)
    world.run_until(lambda _: goal.record.plan is not None, 5.0)
    assert [step.kind for step in known(goal.record.plan).steps] == ["go_to_pose"] * 3
    assert ended(world, goal, 120.0) is Code.ARRIVED
    steps = known(goal.record.plan).steps
    for there, step in zip(row, steps, strict=True):
        assert step.reached is not None
        assert (
            hypot(known(step.reached.x_m) - there.x_m, known(step.reached.y_m) - there.y_m)
            <= REACHED_M
        )
    assert off(world, row[-1])[1] <= REACHED_DEG


def test_a_look_ends_before_the_point_and_faces_it(ready: Ready) -> None:
    world = ready(seed=2, start=IN_KITCHEN)
    seen = point(world, 1.6, 4.6, look=True)
    assert ended(world, world.go(seen)) is Code.ARRIVED
    pose = world.truth
    assert 0.2 <= off(world, seen)[0] <= 0.7
    towards = atan2(seen.y_m - pose.y_m, seen.x_m - pose.x_m)
    assert abs(degrees(wrap(pose.yaw_rad - towards))) <= 10.0


@pytest.mark.parametrize(
    ("x_m", "y_m", "code"),
    [
        (0.0, 1.0, Code.POINT_IN_OBSTACLE),  # in a wall
        (900.0, 0.0, Code.POINT_OUTSIDE_MAP),
        (-0.30, 1.0, Code.POINT_UNMAPPED),
    ],
)
def test_a_point_that_nobody_can_stand_on_is_refused_with_its_reason(
    ready: Ready, x_m: float, y_m: float, code: Code
) -> None:
    world = ready(seed=2, start=IN_KITCHEN)
    goal = world.go(point(world, x_m, y_m))
    assert ended(world, goal) is code
    assert goal.state is GoalState.REFUSED
    assert goal.record.reason == code.value
    message = known(goal.record.outcome).message
    assert message.en
    assert message.zh
    assert message.en != message.zh


def test_a_point_of_another_map_is_refused(ready: Ready) -> None:
    world = ready(seed=2, start=IN_KITCHEN)
    goal = world.go(GoToPose(map_id="0" * 16, x_m=1.6, y_m=4.6))
    assert ended(world, goal) is Code.POINT_OF_OTHER_MAP


def test_no_brain_may_point_at_the_map(ready: Ready) -> None:
    world = ready(seed=2, start=IN_KITCHEN)
    written = StepPlan(steps=(Wait(seconds=1.0), point(world, 1.6, 4.6)))
    world.think_with(ScriptedBrain([written]))
    goal = world.say("go where you like")
    assert ended(world, goal) is Code.POINT_NOT_GIVEN
    assert goal.state is GoalState.REFUSED
    assert off(world, point(world, 1.5, 2.0))[0] < 0.05


def test_a_goal_of_points_is_taken_up_again_after_the_planner_died(ready: Ready) -> None:
    world = ready(seed=2, start=IN_KITCHEN)
    there = point(world, 1.6, 4.6, yaw_rad=0.0)
    goal = world.go(there)
    world.run_until(lambda w: w.truth.y_m > 2.3, 20.0)
    world.kill_planner()
    world.run(1.0)
    world.start_planner()
    world.run(1.0)
    assert goal.record.reason == PauseReason.PLANNER_RESTARTED.value
    world.resume(goal)
    assert ended(world, goal) is Code.ARRIVED
    assert off(world, there)[0] <= REACHED_M


SOUTH = Pose2(1.5, 1.2, 1.5)
Polygon = tuple[tuple[float, float], ...]


def box(x0: float, y0: float, x1: float, y1: float) -> Polygon:
    return ((x0, y0), (x1, y0), (x1, y1), (x0, y1))


def verdict(world: LockstepWorld, request: Request) -> str:
    world.run_until(lambda _: request.answer is not None, 5.0)
    assert isinstance(request.answer, Answer)
    return request.answer.code


def each_tick(world: LockstepWorld, goal: GoalHandle, limit_s: float) -> Iterator[Pose2]:
    """Give where the robot truly is after each tick, until the goal has ended."""
    until_s = world.now_s + limit_s
    while not goal.has_ended and world.now_s < until_s:
        world.tick()
        yield world.truth


def driving(ready: Ready, to_y_m: float, x_m: float = 1.5) -> tuple[LockstepWorld, GoalHandle]:
    """Return a world whose robot drives north at speed, from the kitchen to the living room."""
    world = ready(seed=2, start=SOUTH)
    goal = world.go(point(world, x_m, to_y_m))
    world.run_until(lambda w: w.twist.v_mps > 0.3, 20.0)
    return world, goal


def test_a_keep_out_drawn_across_the_way_is_not_entered(ready: Ready) -> None:
    world, goal = driving(ready, 4.6)
    across = box(0.2, 3.3, 2.8, 3.7)
    assert verdict(world, world.draw([across])) == "ok"
    assert world.status.marks_hash is not None
    assert max(at.y_m for at in each_tick(world, goal, 60.0)) < 3.3
    assert known(goal.record.outcome).code is Code.NO_ROUTE


def test_routes_lead_round_a_keep_out_and_a_point_inside_is_refused(ready: Ready) -> None:
    world = ready(seed=2, start=SOUTH)
    island = box(0.9, 3.6, 1.7, 4.2)
    assert verdict(world, world.draw([island])) == "ok"
    inside = world.go(point(world, 1.3, 3.9))
    world.run_until(lambda _: inside.has_ended, 20.0)
    assert known(inside.record.outcome).code is Code.POINT_IN_KEEP_OUT
    goal = world.go(point(world, 1.2, 4.7))
    assert not any(contains(island, at.x_m, at.y_m) for at in each_tick(world, goal, 90.0))
    assert goal.state is GoalState.SUCCEEDED


def test_a_deleted_keep_out_gives_back_what_the_fence_allows(ready: Ready) -> None:
    world = ready(seed=2, start=SOUTH)
    there = point(world, 1.3, 3.9)
    assert verdict(world, world.draw([box(0.9, 3.6, 1.7, 4.2)])) == "ok"
    assert verdict(world, world.draw()) == "ok"
    goal = world.go(there)
    world.run_until(lambda _: goal.has_ended, 60.0)
    assert goal.state is GoalState.SUCCEEDED


def test_within_a_slow_area_the_robot_is_never_faster(ready: Ready) -> None:
    world, goal = driving(ready, 4.6)
    slow = SlowMark(polygon=box(0.2, 3.2, 2.8, 5.8), max_speed_mps=0.15)
    assert verdict(world, world.draw(slow=[slow])) == "ok"
    inside = [
        abs(world.twist.v_mps)
        for at in each_tick(world, goal, 90.0)
        if contains(slow.polygon, at.x_m, at.y_m)
    ]
    assert goal.state is GoalState.SUCCEEDED
    assert inside
    assert max(inside) <= 0.15 + 0.02


@pytest.mark.parametrize(
    ("outline", "code"),
    [
        (box(1.0, 0.8, 2.0, 1.6), "mark_holds_robot"),
        (((0.5, 3.5), (2.5, 4.5), (2.5, 3.5), (0.5, 4.5)), "mark_crosses_itself"),
        (box(1.0, 4.0, 1.05, 4.05), "mark_too_small"),
    ],
)
def test_a_bad_outline_changes_nothing_and_says_why(
    ready: Ready, outline: Polygon, code: str
) -> None:
    world = ready(seed=2, start=SOUTH)
    assert verdict(world, world.draw([outline])) == code
    assert world.status.marks_hash is None


def test_one_that_the_robot_could_not_stop_before_is_refused(ready: Ready) -> None:
    world, _ = driving(ready, 4.6)
    ahead = box(0.2, world.truth.y_m + 0.12, 2.8, world.truth.y_m + 1.0)
    assert verdict(world, world.draw([ahead])) in ("mark_too_near", "mark_holds_robot")
    assert world.status.marks_hash is None
