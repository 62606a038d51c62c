"""A plan that is driven in the simulator tells what it met: figures, contacts, where it stuck."""

from __future__ import annotations

from pathlib import Path

import pytest

from lockstep.rehearsal_world import virtual_robot
from planner.driven_rehearsal import LONGEST_WAIT_S
from planner.plan import GoToPose, StepRecord, plan_record
from planner.plan.responses import StepPlan
from pons_assets import ROBOTS
from tests.known import known
from tests.lockstep.requests import cells_of, drive, request_of
from tests.planner.api.fakes import two_room
from wire import MarksFile, load_robot

pytestmark = pytest.mark.nightly(keep=5)


DOOR = (1.05, 2.85, 2.0, 3.0)
"""Where the wall between the two rooms is open."""


def test_each_step_has_its_figures_and_the_trail_leads_along_them() -> None:
    told = drive(request_of("go to the living room, wait 30 seconds, then go home"))
    first, waits, home = told.steps
    assert [step.outcome for step in told.steps] == ["succeeded"] * 3
    assert (first.contacts, told.contacts) == (0, 0)
    assert first.length_m == pytest.approx(3.5, abs=0.2)
    assert waits.seconds == pytest.approx(30.0, abs=0.5), "counted, and not waited for"
    dock = two_room().home.pose
    end = known(home.end)
    assert (end.x_m, end.y_m) == pytest.approx((dock.x_m, dock.y_m), abs=0.15)
    assert first.nearest_m == pytest.approx(0.2, abs=0.06), "the door, less the robot's radius"
    assert told.length_m == pytest.approx(first.length_m + home.length_m, abs=0.05)
    assert len(told.trail) > told.length_m / 0.1


def test_a_door_that_was_seen_shut_shuts_the_way() -> None:
    told = drive(request_of("go to the living room", limit_s=40.0), cells_of(*DOOR))
    assert told.steps[0].outcome in ("failed", "stuck")
    assert told.steps[0].code
    assert told.contacts == 0


def test_what_was_seen_long_ago_still_stands_there() -> None:
    asked = request_of("go to the living room", limit_s=40.0)
    told = drive(asked.model_copy(update={"cells_bytes": 0}), cells_of(*DOOR))
    assert told.steps[0].outcome != "succeeded"


def test_a_person_in_the_way_is_passed_or_waited_for_and_not_touched() -> None:
    told = drive(request_of("go to the living room", discs=((1.9, 2.2, 0.25),)))
    assert told.contacts == 0
    assert told.steps[0].outcome == "succeeded"


def test_what_is_drawn_on_the_map_is_kept_out_of() -> None:
    drawn = MarksFile(
        version=1,
        map_id=two_room().map_id,
        keep_outs=(((0.2, 2.2), (3.6, 2.2), (3.6, 2.6), (0.2, 2.6)),),
    )
    told = drive(request_of("go to the living room", marks=drawn, limit_s=40.0))
    assert told.steps[0].outcome != "succeeded"
    assert all(y_m < 2.25 for _, y_m in told.trail)


def test_a_point_of_the_map_is_driven_to() -> None:
    point = GoToPose(map_id=two_room().map_id, x_m=1.0, y_m=4.2)
    rows = plan_record(StepPlan(steps=(point,))).steps
    told = drive(request_of("go home").model_copy(update={"rows": tuple(enumerate(rows))}))
    assert told.steps[0].outcome == "succeeded"
    assert known(told.steps[0].end).y_m == pytest.approx(4.2, abs=0.1)


def test_a_drive_that_takes_too_long_is_ended_and_told() -> None:
    told = drive(request_of("go to the living room", limit_s=2.0))
    assert (told.steps[0].outcome, told.steps[0].code) == ("stuck", "time_limit")


@pytest.mark.parametrize("robot", sorted(ROBOTS.glob("*.toml")), ids=lambda path: path.stem)
def test_every_robot_of_metal_has_a_virtual_twin_of_its_size_and_speed(robot: Path) -> None:
    metal = load_robot(robot)
    virtual = virtual_robot(metal)
    assert virtual.drive.virtual
    assert not virtual.lidar.has_line
    assert (virtual.base, virtual.limits) == (metal.base, metal.limits)
    assert virtual.ros2 is None


def test_a_wait_is_cut_in_the_simulator_alone() -> None:
    row = StepRecord(kind="wait", seconds=600.0)
    asked = request_of("go home").model_copy(update={"rows": ((0, row),)})
    told = drive(asked)
    assert told.steps[0].seconds == pytest.approx(600.0, abs=1.0)
    assert LONGEST_WAIT_S < 10.0
