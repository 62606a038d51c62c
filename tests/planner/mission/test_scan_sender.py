"""Scans are shown five times a second from where the robot was; what closes its way is told."""

from __future__ import annotations

import asyncio
from dataclasses import dataclass, field, replace
from math import cos, pi, sin
from typing import TYPE_CHECKING, cast

import pytest

from planner.bridge_client import Aged, Link
from planner.mission.engine import Leg, WayAhead
from planner.mission.events import ClosingIn, Oncoming, RouteDoubted, Surveyed
from planner.mission.scan_sender import EVERY_S, FRESH_S, PERIOD_S, SIGHT_S, ScanSender, Surveyor
from planner.navigation import Mover, ObstacleReport, RouteFailure, ScanObservation
from planner.navigation.obstruction import Obstruction
from planner.navigation.route import is_wide
from tests.planner.mission.fakes import straight
from tests.planner.mission.lockstep import Together, driving
from tests.planner.navigation.floors import drawn
from tests.planner.perception.test_pose_buffer import moved, placed
from wire import Pose2, RobotDescription, Scan

if TYPE_CHECKING:
    from maps.grid import GridMap
    from planner.perception.pose_buffer import Poses


MAP = "0" * 16
WAY = WayAhead("g1", 3, tuple((0.2 * k, 0.0) for k in range(11)))


@dataclass
class FakeLink:
    """Hold the newest scan, and tell poses to who listens."""

    scan: Aged[Scan] | None = None
    listeners: list[Poses] = field(default_factory=list)

    def tell(self, poses: Poses) -> None:
        self.listeners.append(poses)

    def turn(
        self,
        seq: int,
        stamp_s: float,
        *,
        age_s: float = 0.05,
        posed: bool = True,
    ) -> None:
        """Let a scan come in, and the poses around it."""
        scan = Scan(
            boot_id="l", seq=seq, stamp_s=stamp_s, angle_min_rad=-pi, angle_increment_rad=pi / 4,
            range_min_m=0.1, range_max_m=8.0, ranges_m=(2.0,) * 8,
        )  # fmt: skip
        self.scan = Aged(scan, age_s)
        for poses in self.listeners if posed else ():
            for at_s in (stamp_s - 0.05, stamp_s + 0.05):
                poses.odometry(moved(at_s, 0.0))
                poses.localization(placed(at_s))


@dataclass
class Observer:
    """Answer with a report, or break."""

    blocked_m: float | None = None
    broken: bool = False
    movers: tuple[Mover, ...] = ()
    shown: list[ScanObservation] = field(default_factory=list)

    async def observe(self, seen: ScanObservation) -> ObstacleReport:
        await asyncio.sleep(0)
        if self.broken:
            raise RouteFailure("route_worker_died")
        self.shown.append(seen)
        return ObstacleReport(len(self.shown), self.blocked_m, self.movers, b"", b"")


@dataclass
class Showing:
    """Turn a sender as the mission's loop does."""

    observer: Observer = field(default_factory=Observer)
    way: WayAhead | None = WAY
    now_s: float = 50.0
    link: FakeLink = field(default_factory=FakeLink)
    doubts: list[RouteDoubted | Oncoming | ClosingIn] = field(default_factory=list)

    def __post_init__(self) -> None:
        self.sender = ScanSender(
            cast("Link", self.link), RobotDescription(), MAP, self.observer,
            lambda: self.way, lambda: self.now_s,
        )  # fmt: skip

    def show(self) -> bool:
        """Show the scan that is due; tell whether one was."""
        seen = self.sender.due()
        if seen is not None:
            asyncio.run(self.sender.show(seen, self.doubts.append))
        return seen is not None


def test_a_scan_is_shown_once_and_five_times_a_second_at_most() -> None:
    showing, shown = Showing(), 0
    for turn in range(20):
        showing.link.turn(turn, 1.0 + 0.1 * turn)
        shown += showing.show()
        assert not showing.show(), "the same scan tells nothing new"
        showing.now_s += 0.1
    assert shown == 10
    assert showing.sender.report is not None
    (first, *_) = showing.observer.shown
    assert first.base_in_map.x_m == pytest.approx(moved(1.0, 0.0).base_in_odom.x_m + 10.0)
    assert first.ahead == WAY.points


@pytest.mark.parametrize(("age_s", "posed"), [(FRESH_S + 0.1, True), (0.05, False)])
def test_a_scan_that_is_old_or_cannot_be_placed_is_passed_over(age_s: float, posed: bool) -> None:
    showing = Showing()
    showing.link.turn(1, 1.0, age_s=age_s, posed=posed)
    assert not showing.show()


def test_where_the_way_is_closed_is_told_with_the_leg_it_was_told_of() -> None:
    showing = Showing(Observer(blocked_m=1.0))
    showing.link.turn(1, 1.0)
    assert showing.show()
    assert [(one.id, one.leg) for one in showing.doubts] == [("g1", 3)]
    (doubt,) = showing.doubts
    assert isinstance(doubt, RouteDoubted)
    assert doubt.at_m == pytest.approx((1.0, 0.0))


@pytest.mark.parametrize("blocked_m", [0.0, 2.0, 9.0])
def test_the_spot_lies_on_the_way_wherever_it_is_closed(blocked_m: float) -> None:
    showing = Showing(Observer(blocked_m=blocked_m))
    showing.link.turn(1, 1.0)
    showing.show()
    (doubt,) = showing.doubts
    assert isinstance(doubt, RouteDoubted)
    assert doubt.at_m == pytest.approx((min(blocked_m, 2.0), 0.0))


@pytest.mark.parametrize(("ahead_m", "told"), [(0.9, [ClosingIn("g1", 3)]), (-0.9, [])])
def test_another_robot_that_the_robot_drives_at_is_told(ahead_m: float, told: list[object]) -> None:
    """Odometry says that it drives on at 1 m/s; the other one hardly moves."""
    showing = Showing(Observer(movers=(Mover(1, 10.0 + ahead_m, 0.0, 0.01, 0.0, 0.35),)))
    for seq in (1, 2):
        showing.link.turn(seq, float(seq))
        assert showing.show()
        assert showing.doubts == told, "and none is while it is to stand"
        showing.way, showing.now_s = None, showing.now_s + PERIOD_S


def test_a_robot_that_stands_has_no_way_to_doubt() -> None:
    showing = Showing(Observer(blocked_m=1.0), way=None)
    showing.link.turn(1, 1.0)
    assert showing.show()
    assert not showing.doubts
    assert showing.observer.shown[0].ahead == ()


def test_a_search_that_broke_is_shown_the_next_scan() -> None:
    showing = Showing(Observer(broken=True))
    showing.link.turn(1, 1.0)
    assert showing.show()
    assert showing.sender.report is None
    showing.observer.broken = False
    showing.now_s += PERIOD_S
    showing.link.turn(2, 1.2)
    assert showing.show()
    assert showing.sender.report is not None


GRID = drawn(*("." * 40 for _ in range(40))).grid


@dataclass
class SurveyLink:
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


def surveyor(link: SurveyLink, grid: GridMap = GRID) -> Surveyor:
    return Surveyor(cast("Link", link), RobotDescription(), grid)


def blocked(world: Together) -> Leg:
    """Drive a mission and have it blocked, 1 m before what the link's points show."""
    goal = driving(world)
    world.bridge.pose, world.bridge.blocked = Pose2(3.0, 3.0, 0.0), True
    world.run(0.1)
    return Leg(goal, 1, straight(Pose2(3.0, 3.0, 0.0), Pose2(6.0, 3.0, 0.0)))


def test_a_blocked_drive_is_told_what_stands_in_its_way_twice_a_second(world: Together) -> None:
    leg, seen = blocked(world), surveyor(SurveyLink())
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
    assert surveyor(SurveyLink()).survey(idle, None, 10.0) is None
    assert surveyor(SurveyLink(age_s=SIGHT_S + 0.1)).survey(world.book, leg, 10.0) is None
    assert surveyor(SurveyLink(age_s=float("nan"))).survey(world.book, leg, 10.0) is None
    world.bridge.blocked = False
    world.run(0.1)
    assert surveyor(SurveyLink()).survey(world.book, leg, 10.0) is None


def test_what_is_as_round_as_the_robot_is_told_with_its_radius(world: Together) -> None:
    leg, radius_m = blocked(world), RobotDescription().base.radius_m
    around = [pi / 2 + pi * i / 40 for i in range(41)]
    body = tuple((4.0 + radius_m * cos(a), 3.0 + radius_m * sin(a)) for a in around)
    told = surveyor(SurveyLink(points=body)).survey(world.book, leg, 10.0)
    flat = surveyor(SurveyLink()).survey(world.book, leg, 10.0)
    assert told is not None
    assert flat is not None
    assert is_wide(told.radius_m)
    assert (told.moves, flat.moves, flat.radius_m) == (False, False, 0.0)


def test_a_shut_way_through_which_the_lidar_sees_is_told_open(world: Together) -> None:
    leg = blocked(world)
    crate = Obstruction((4.0, 2.8), (4.0, 3.2))
    world.event(Surveyed(crate))
    told = surveyor(SurveyLink(points=())).survey(world.book, leg, 10.0)
    assert told is not None
    assert told.opened == (crate,)
    assert told.obstruction is None


def test_a_gap_of_the_map_that_holds_the_robot_is_told_and_never_seen_open(world: Together) -> None:
    # Pillars at x from 3.25 to 3.5 m leave 0.75 m around y = 2.875 m.
    rows = ["." * 40 if index in (27, 28, 29) else "." * 13 + "#" + "." * 26 for index in range(40)]
    grid = drawn(*rows).grid
    leg = blocked(world)
    leg = replace(leg, points=straight(Pose2(3.0, 2.875, 0.0), Pose2(6.0, 2.875, 0.0)))
    told = surveyor(SurveyLink(points=()), grid).survey(world.book, leg, 10.0)
    assert told is not None
    assert told.obstruction is not None
    assert told.obstruction.gap
    assert told.obstruction.width_m == pytest.approx(0.75, abs=0.06)
    world.event(told)
    again = surveyor(SurveyLink(points=()), grid).survey(world.book, leg, 20.0)
    assert again is not None
    assert again.opened == ()
