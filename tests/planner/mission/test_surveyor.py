"""The surveyor speaks only to a blocked drive, or of ways that are remembered as shut."""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from math import cos, pi, sin
from typing import TYPE_CHECKING, cast

import pytest

from planner.bridge_client import Aged
from planner.mission.engine import Leg
from planner.mission.events import Surveyed
from planner.mission.scan_sender import EVERY_S, SIGHT_S, Surveyor
from planner.navigation.obstruction import Obstruction
from planner.navigation.route import is_wide
from tests.planner.mission.driving import driving
from tests.planner.mission.fakes import straight
from tests.planner.mission.lockstep import Together
from tests.planner.navigation.floors import drawn
from wire import Pose2, RobotDescription, Scan

if TYPE_CHECKING:
    from maps.grid import GridMap
    from planner.bridge_client import Link

GRID = drawn(*("." * 40 for _ in range(40))).grid


@dataclass
class FakeLink:
    """Hold a scan and its points."""

    age_s: float = 0.1
    points: tuple[tuple[float, float], ...] = field(
        default_factory=lambda: tuple((4.0, 2.8 + 0.02 * i) for i in range(21))
    )

    @property
    def scan(self) -> Aged[Scan]:
        scan = Scan(
            boot_id="l", seq=1, stamp_s=1.0, angle_min_rad=-pi, angle_increment_rad=pi / 180,
            range_min_m=0.1, range_max_m=8.0, ranges_m=(8.0,) * 360,
        )  # fmt: skip
        return Aged(scan, self.age_s)

    def obstacles(self) -> tuple[tuple[float, float], ...]:
        return self.points


def surveyor(link: FakeLink, grid: GridMap = GRID) -> Surveyor:
    return Surveyor(cast("Link", link), RobotDescription(), grid)


def blocked(world: Together) -> Leg:
    """Drive a mission and have it blocked, 1 m before what the link's points show."""
    goal = driving(world)
    world.bridge.pose, world.bridge.blocked = Pose2(3.0, 3.0, 0.0), True
    world.run(0.1)
    return Leg(goal, 1, straight(Pose2(3.0, 3.0, 0.0), Pose2(6.0, 3.0, 0.0)))


def test_a_blocked_drive_is_told_what_stands_in_its_way_twice_a_second(world: Together) -> None:
    leg, seen = blocked(world), surveyor(FakeLink())
    told = seen.survey(world.book, leg, 10.0)
    assert told is not None
    assert told.obstruction is not None
    assert told.obstruction.middle == pytest.approx((4.0, 3.0))
    assert seen.survey(world.book, leg, 10.0 + EVERY_S / 2) is None
    assert seen.survey(world.book, leg, 10.0 + EVERY_S) is not None


def test_a_drive_that_is_not_blocked_an_old_scan_and_an_idle_robot_are_told_nothing(
    world: Together,
) -> None:
    idle = world.book
    leg = blocked(world)
    assert surveyor(FakeLink()).survey(idle, None, 10.0) is None
    assert surveyor(FakeLink(age_s=SIGHT_S + 0.1)).survey(world.book, leg, 10.0) is None
    assert surveyor(FakeLink(age_s=float("nan"))).survey(world.book, leg, 10.0) is None
    world.bridge.blocked = False
    world.run(0.1)
    assert surveyor(FakeLink()).survey(world.book, leg, 10.0) is None


def test_what_is_as_round_as_the_robot_is_told_with_its_radius(world: Together) -> None:
    leg, radius_m = blocked(world), RobotDescription().base.radius_m
    around = [pi / 2 + pi * i / 40 for i in range(41)]
    body = tuple((4.0 + radius_m * cos(a), 3.0 + radius_m * sin(a)) for a in around)
    told = surveyor(FakeLink(points=body)).survey(world.book, leg, 10.0)
    flat = surveyor(FakeLink()).survey(world.book, leg, 10.0)
    assert told is not None
    assert flat is not None
    assert is_wide(told.radius_m)
    assert (told.moves, flat.moves, flat.radius_m) == (False, False, 0.0)


def test_a_shut_way_through_which_the_lidar_sees_is_told_open(world: Together) -> None:
    leg = blocked(world)
    crate = Obstruction((4.0, 2.8), (4.0, 3.2))
    world.event(Surveyed(crate))
    told = surveyor(FakeLink(points=())).survey(world.book, leg, 10.0)
    assert told is not None
    assert told.opened == (crate,)
    assert told.obstruction is None


def test_a_gap_of_the_map_that_holds_the_robot_is_told_and_never_seen_open(world: Together) -> None:
    # Pillars at x from 3.25 to 3.5 m leave 0.75 m around y = 2.875 m.
    rows = ["." * 40 if index in (27, 28, 29) else "." * 13 + "#" + "." * 26 for index in range(40)]
    grid = drawn(*rows).grid
    leg = blocked(world)
    leg = replace(leg, points=straight(Pose2(3.0, 2.875, 0.0), Pose2(6.0, 2.875, 0.0)))
    told = surveyor(FakeLink(points=()), grid).survey(world.book, leg, 10.0)
    assert told is not None
    assert told.obstruction is not None
    assert told.obstruction.gap
    assert told.obstruction.width_m == pytest.approx(0.75, abs=0.06)
    world.event(told)
    again = surveyor(FakeLink(points=()), grid).survey(world.book, leg, 20.0)
    assert again is not None
    assert again.opened == ()
