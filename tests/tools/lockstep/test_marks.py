"""What a person draws on the map holds while the robot drives: kept out of, and slow within."""

from __future__ import annotations

from collections.abc import Iterator

import pytest

from bridge.core.geometry.fence import contains
from lockstep.planner_process import Request
from planner.plan import Code, GoalState
from tests.known import known
from tests.tools.lockstep.conftest import Ready
from tests.tools.lockstep.test_points import point
from tools.lockstep import GoalHandle, LockstepWorld
from wire import Answer, Pose2, SlowMark

pytestmark = pytest.mark.nightly(keep=3)


IN_KITCHEN = Pose2(1.5, 1.2, 1.5)
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
    world = ready(seed=2, start=IN_KITCHEN)
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
    world = ready(seed=2, start=IN_KITCHEN)
    island = box(0.9, 3.6, 1.7, 4.2)
    assert verdict(world, world.draw([island])) == "ok"
    inside = world.go(point(world, 1.3, 3.9))
    world.run_until(lambda _: inside.has_ended, 20.0)
    assert known(inside.record.outcome).code is Code.POINT_IN_KEEP_OUT
    goal = world.go(point(world, 1.2, 4.7))
    assert not any(contains(island, at.x_m, at.y_m) for at in each_tick(world, goal, 90.0))
    assert goal.state is GoalState.SUCCEEDED


def test_a_deleted_keep_out_gives_back_what_the_fence_allows(ready: Ready) -> None:
    world = ready(seed=2, start=IN_KITCHEN)
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
    world = ready(seed=2, start=IN_KITCHEN)
    assert verdict(world, world.draw([outline])) == code
    assert world.status.marks_hash is None


def test_one_that_the_robot_could_not_stop_before_is_refused(ready: Ready) -> None:
    world, _ = driving(ready, 4.6)
    ahead = box(0.2, world.truth.y_m + 0.12, 2.8, world.truth.y_m + 1.0)
    assert verdict(world, world.draw([ahead])) in ("mark_too_near", "mark_holds_robot")
    assert world.status.marks_hash is None
