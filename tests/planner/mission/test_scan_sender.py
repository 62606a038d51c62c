"""Scans are shown five times a second from where the robot was; what closes its way is told."""

from __future__ import annotations

import asyncio
from dataclasses import dataclass, field
from math import pi
from typing import TYPE_CHECKING, cast

import pytest

from planner.bridge_client import Aged
from planner.mission.engine import WayAhead
from planner.mission.events import ClosingIn, Oncoming, RouteDoubted
from planner.mission.scan_sender import FRESH_S, PERIOD_S, ScanSender
from planner.navigation import Mover, ObstacleReport, RouteFailure, ScanObservation
from tests.planner.perception.test_pose_buffer import moved, placed
from wire import RobotDescription, Scan

if TYPE_CHECKING:
    from planner.bridge_client import Link
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
