"""A person points at the map: the robot stands there, or says why not; no brain may point."""

from __future__ import annotations

from math import atan2, degrees, hypot, pi

import pytest

from planner.brain import ScriptedBrain
from planner.plan import Code, GoalState, GoToPose, PauseReason, StepPlan, Wait
from tests.known import known
from tests.tools.lockstep.conftest import Ready
from tools.lockstep import GoalHandle, LockstepWorld
from wire import Pose2, wrap

pytestmark = pytest.mark.nightly(keep=4)


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
