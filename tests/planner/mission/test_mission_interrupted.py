"""Modes, rows, silence and budgets of the bridge interrupt a mission."""

from __future__ import annotations

import pytest

from planner.mission.events import (
    Resume,
    Tick,
)
from planner.plan import Code, MoveStraight, StepPlan, Turn
from tests.planner.mission.driving import (
    FAILED,
    PAUSED,
    RUNNING,
    SUCCEEDED,
    driving,
    standing_still,
)
from tests.planner.mission.fakes import row
from tests.planner.mission.lockstep import Together, go
from wire import Action, Mode


@pytest.mark.parametrize(
    ("mode", "reason"),
    [
        (Mode.DISARMED, "disarmed"),
        (Mode.ESTOPPED, "estop"),
        (Mode.TELEOP, "teleop"),
        (Mode.FAULT, "fault(RUNAWAY)"),
    ],
)
def test_modes_that_end_driving_pause(world: Together, mode: Mode, reason: str) -> None:
    goal = driving(world)
    world.bridge.mode = mode
    world.bridge.rows = (row("RUNAWAY", Action.FAST1),)
    world.run()
    assert (world.goal(goal).state, world.goal(goal).reason) == (PAUSED, reason)


def test_bridge_restart_pauses_disarmed_and_arm_then_resume_goes_on(world: Together) -> None:
    goal = driving(world)
    world.bridge.reboot()
    world.run(1.0)
    mission = world.goal(goal)
    assert (mission.state, mission.reason) == (PAUSED, "disarmed")
    assert mission.outcome is not None
    assert mission.outcome.code is Code.NOT_ARMED
    world.bridge.mode = Mode.HOLD
    assert standing_still(world)
    world.event(Resume(goal))
    world.run_until(goal, SUCCEEDED)


def test_goal_without_a_bridge_pauses_disarmed() -> None:
    world = Together()
    goal = world.give(go("kitchen"))
    assert (world.goal(goal).state, world.goal(goal).reason) == (PAUSED, "disarmed")


def test_short_loss_of_the_owner_goes_on_with_hello_and_grant(world: Together) -> None:
    goal = driving(world)
    world.bridge.lose_owner()
    world.bridge.mode = Mode.HOLD
    world.run_until(goal, SUCCEEDED)
    assert world.goal(goal).leg == 1


def test_silence_of_the_bridge_pauses(world: Together) -> None:
    goal = driving(world)
    world.now_s += 6.0
    world.event(Tick())
    assert (world.goal(goal).state, world.goal(goal).reason) == (PAUSED, "fault(BRAIN_GONE)")


def test_our_own_long_freeze_pauses(world: Together) -> None:
    goal = driving(world)
    world.now_s += 6.0
    world.run()
    assert world.goal(goal).state is PAUSED


def test_a_row_that_stays_revokes_the_mission_and_nothing_recovers_meanwhile(
    world: Together,
) -> None:
    goal = driving(world)
    world.bridge.rows = (row("LIDAR_STALE"),)
    world.bridge.blocked = True
    world.run(29.0, every_s=0.5)
    assert world.goal(goal).state is RUNNING
    assert world.goal(goal).steps[0].recoveries == ()
    world.run(2.0)
    assert (world.goal(goal).state, world.goal(goal).reason) == (PAUSED, "fault(LIDAR_STALE)")


@pytest.mark.parametrize("step", [Turn(angle_rad=1.0), MoveStraight(distance_m=1.0)])
def test_a_measured_step_without_a_pose_is_given_up_like_any_other(
    world: Together, step: Turn | MoveStraight
) -> None:
    world.bridge.localized, world.bridge.rows = False, (row("LOC_LOST"),)
    world.run(0.2)
    goal = world.give(StepPlan(steps=(step,)))
    entries = len(world.disk_entries)
    world.run(29.0, every_s=0.25)
    assert (world.goal(goal).state, len(world.disk_entries)) == (RUNNING, entries)
    world.run(2.0)
    assert (world.goal(goal).state, world.goal(goal).reason) == (PAUSED, "fault(LOC_LOST)")


def test_budget_row_fails_the_mission_and_only_its_own(world: Together) -> None:
    goal = driving(world)
    world.bridge.rows = (row("BUDGET"),)
    world.run()
    mission = world.goal(goal)
    assert (mission.state, mission.reason) == (FAILED, "budget")
    assert mission.outcome is not None
    assert mission.outcome.code is Code.OUT_OF_BUDGET
    world.run_until(world.give(go("kitchen")), SUCCEEDED)


def test_stuck_row_fails_the_mission(world: Together) -> None:
    goal = driving(world)
    world.bridge.rows = (row("STUCK"),)
    world.run()
    mission = world.goal(goal)
    assert (mission.state, mission.reason) == (FAILED, "stuck")
    assert mission.outcome is not None
    assert mission.outcome.code is Code.FAULT


def test_rows_that_only_cap_or_do_not_bind_change_nothing(world: Together) -> None:
    goal = driving(world)
    world.bridge.rows = (row("BRAIN_LATE", Action.CAP), row("LIDAR_STALE", binding=False))
    world.run_until(goal, SUCCEEDED)
