"""A robot whose lidar hears nothing from a sector touches nothing that is hidden there."""

from __future__ import annotations

from math import pi, radians

import pytest

from planner.plan import GoalState
from sim import Domain
from sim.hardware import Hardware
from tests.known import known
from tools.lockstep import LockstepWorld
from wire import Mode, Pose2, SimFault

pytestmark = pytest.mark.nightly(keep=3)


DOCK = Pose2(11.2, 4.75, pi)
"""At the end of the default home's hallway, which the way to the kitchen leads along."""
CRATE_M = (8.6, 4.75)


def covered(width_deg: float, at_deg: float, beams: int) -> LockstepWorld:
    """Return a robot in the dock; the fault named LIDAR_SECTOR hides this much of its lidar."""
    hardware = Hardware(
        lidar_beams=beams,
        lidar_sector_rad=radians(width_deg),
        lidar_sector_at_rad=radians(at_deg),
    )
    return LockstepWorld(site="home", start=DOCK, hardware=hardware)


@pytest.mark.parametrize(("width_deg", "at_deg", "beams"), [(25, -5, 180), (90, 0, 360)])
def test_it_does_not_drive_off_into_a_sector_that_is_covered_from_the_start(
    width_deg: float, at_deg: float, beams: int
) -> None:
    world = covered(width_deg, at_deg, beams)
    world.sim.break_down(SimFault.LIDAR_SECTOR)
    world.sim.place_obstacle(*CRATE_M)
    world.say("go to the kitchen")
    world.run_until(lambda w: "LIDAR_SECTOR.0" in w.bridge.state.rows, 10.0)
    world.run(5.0)
    assert world.contacts == 0
    assert world.truth.x_m > DOCK.x_m - 0.3
    assert world.standing


@pytest.mark.parametrize(("width_deg", "at_deg", "beams"), [(45, 5, 720), (120, 20, 450)])
def test_it_stands_before_what_a_sector_that_goes_silent_hides(
    width_deg: float, at_deg: float, beams: int
) -> None:
    world = covered(width_deg, at_deg, beams)
    world.say("go to the kitchen")
    world.run_until(lambda w: w.truth.x_m < CRATE_M[0] + 1.2, 20.0)
    world.sim.place_obstacle(*CRATE_M)
    world.sim.break_down(SimFault.LIDAR_SECTOR)
    world.run_until(lambda w: "LIDAR_SECTOR.0" in w.bridge.state.rows, 0.5)
    world.run(5.0)
    assert world.contacts == 0
    assert world.status.mode in {Mode.HOLD, Mode.STOPPING}
    world.sim.break_down()
    world.sim.remove_obstacle()
    world.run_until(lambda w: w.status.mode is Mode.ACTIVE, 10.0)


def before_a_silent_wall(seed: int) -> LockstepWorld:
    """Return a robot that boots in the dock; a spot aside of its way returns nothing."""
    return LockstepWorld(site="home", start=DOCK, domain=Domain(seed=seed, lidar_null_patches=12))


def test_a_robot_that_boots_before_a_silent_wall_turns_by_itself_and_arrives() -> None:
    world = before_a_silent_wall(seed=4)
    goal = world.say("go to the kitchen")
    world.run_until(lambda w: "LIDAR_SECTOR.0" in w.bridge.state.rows, 5.0)
    world.run_until(lambda _: goal.has_ended, 90.0)
    assert goal.state is GoalState.SUCCEEDED
    plan = known(goal.record.plan)
    assert plan.steps[0].recoveries.count("turn_out") == 1
    assert world.contacts == 0


def test_a_hole_turns_along_and_holds_again_after_one_turn() -> None:
    world = covered(90, 0, 360)
    world.sim.break_down(SimFault.LIDAR_SECTOR)
    world.sim.place_obstacle(*CRATE_M)
    goal = world.say("go to the kitchen")
    world.run_until(lambda _: goal.state is GoalState.PAUSED, 90.0)
    plan = known(goal.record.plan)
    assert goal.record.reason == "fault(LIDAR_SECTOR)"
    assert plan.steps[0].recoveries == ("turn_out",)
    assert world.truth.x_m > DOCK.x_m - 0.3
    assert world.contacts == 0
