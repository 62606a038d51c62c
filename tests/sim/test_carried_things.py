"""What people carry about: solid for the lidar where it is large, told to the camera always."""

from __future__ import annotations

from math import pi
from pathlib import Path

import pytest

from sim import SimRobot
from wire import ConfigError, Pose2, SimControl, SimThing

BEFORE_RESIDENT = Pose2(0.5, 6.5, pi / 2)


@pytest.fixture
def robot(repository: Path) -> SimRobot:
    """Return a robot that looks at the resident from 1.1 m."""
    return SimRobot(repository / "sites" / "home", start=BEFORE_RESIDENT)


def ahead(robot: SimRobot) -> float | None:
    """Return what the beam straight ahead measures [m]."""
    reports = robot.step_to(robot.time_s + 0.1)
    return next(report.scan.ranges_m[180] for report in reports if report.scan)


def test_the_lidar_meets_a_resident_wherever_they_are(robot: SimRobot) -> None:
    assert ahead(robot) == pytest.approx(1.1 - 0.25, abs=0.05)
    robot.place_thing("resident", Pose2(0.5, 8.1, 0.0))
    assert ahead(robot) == pytest.approx(1.6 - 0.25, abs=0.05)
    robot.place_thing("resident", None)
    assert ahead(robot) == pytest.approx(9.35 - 6.5, abs=0.1), "the plant behind"
    robot.place_thing("carton", Pose2(0.5, 7.5, pi / 2))
    assert ahead(robot) == pytest.approx(1.0 - 0.2, abs=0.05)
    robot.place_thing("red_cup", Pose2(0.5, 7.0, 0.0))
    assert ahead(robot) == pytest.approx(1.0 - 0.2, abs=0.05), "a cup is for the camera alone"


def test_the_scene_tells_where_things_are_that_somebody_moved(robot: SimRobot) -> None:
    first = robot.scene(3.0)
    assert (first.things, first.faults, first.stamp_s) == ((), (), 3.0)
    assert first.base_in_map == robot.base_in_map
    moved = Pose2(2.0, 7.7, 0.5)
    robot.control(SimControl(id="c1", place_thing=SimThing(name="red_cup", pose=moved)))
    robot.control(SimControl(id="c2", place_thing=SimThing(name="ball", pose=None)))
    robot.place_obstacle(1.0, 8.3)
    scene = robot.scene(3.1)
    assert {thing.name: thing.pose for thing in scene.things} == {
        "red_cup": moved,
        "ball": None,
        "person_0": Pose2(1.0, 8.3, 0.0),
    }
    assert scene.seq == first.seq + 1
    robot.place_thing("red_cup", robot.things.declared["red_cup"])
    robot.remove_obstacle()
    assert [thing.name for thing in robot.scene(3.2).things] == ["ball"]


@pytest.mark.parametrize("name", ["cat", "front_door", "sofa"])
def test_what_nobody_can_carry_is_refused_with_what_there_is(robot: SimRobot, name: str) -> None:
    with pytest.raises(ConfigError, match=rf"obstacle_unknown: .*'{name}'.*person_0.*red_cup"):
        robot.place_thing(name, None)
    with pytest.raises(ConfigError, match=f"obstacle_unknown: .*'{name}'"):
        robot.place_obstacle(1.0, 1.0, name=name)
    assert robot.scene(0.0).things == ()
