"""Show the route search what the lidar sees, five times a second, from where the robot was then.

Owns when a scan is worth showing: fresh, new, and taken where odometry and a good localization say
where the robot was. A scan placed wrongly would mark walls that are not there. Runs beside the
missions and holds them up by nothing; while the search is busy, scans are passed over.
"""

from __future__ import annotations

import logging
from itertools import pairwise
from math import cos, dist, sin
from typing import TYPE_CHECKING, Protocol

from planner.mission.events import ClosingIn, Oncoming, RouteDoubted
from planner.navigation import RouteFailure, ScanObservation
from planner.navigation.oncoming import find_oncoming, is_closing_in
from planner.perception.pose_buffer import Poses
from wire import Pose2

if TYPE_CHECKING:
    from collections.abc import Callable

    from planner.bridge_client import Link
    from planner.mission.engine import WayAhead
    from planner.navigation import ObstacleReport
    from wire import RobotDescription, Scan

log = logging.getLogger(__name__)

Point = tuple[float, float]
"""x, y in ``map`` [m]."""

PERIOD_S = 0.2
FRESH_S = 0.3
DOUBTS_M = 3.0
"""Of the way, held against each scan: what closes it farther off may be gone until then."""


class ScanObserver(Protocol):
    """Keep an obstacle layer, in another process."""

    async def observe(self, seen: ScanObservation) -> ObstacleReport:
        """Take a scan in, or raise ``RouteFailure``."""


class ScanSender:
    """Show scans; keep the newest report."""

    def __init__(
        self,
        link: Link,
        robot: RobotDescription,
        map_id: str,
        observer: ScanObserver,
        ahead: Callable[[], WayAhead | None],
        clock: Callable[[], float],
    ) -> None:
        """Begin to follow where the robot is.

        Args:
            link: hears scans, odometry and localization.
            robot: where its lidar sits, and how wide it is.
            map_id: of the site; what is said on another map places nothing.
            observer: keeps the layer.
            ahead: returns the way that the robot is on; None: it is to stand.
            clock: our own.
        """
        self._link, self._observer, lidar = link, observer, robot.lidar
        self._ahead, self._clock = ahead, clock
        self._poses = Poses(map_id)
        self._radius_m = robot.base.radius_m
        self._lidar_in_base = Pose2(lidar.x_m, lidar.y_m, lidar.yaw_rad)
        self.shown: Scan | None = None
        """The newest scan that was shown."""
        self._shown_s = float("-inf")
        self._busy = False
        self._way: WayAhead | None = None
        self.report: ObstacleReport | None = None
        """What the layer held after the newest scan that was shown; None before the first."""
        link.tell(self._poses)

    def due(self) -> ScanObservation | None:
        """Return the scan to show now, if there is one; then call :meth:`show`."""
        aged, now_s = self._link.scan, self._clock()
        if self._busy or aged is None or not aged.age_s <= FRESH_S:
            return None
        scan = aged.value
        if self._was_shown(scan) or now_s - self._shown_s < PERIOD_S:
            return None
        stance = self._poses.at(_middle_s(scan))
        if stance is None:
            return None
        self.shown, self._shown_s, self._busy = scan, now_s, True
        self._way = self._ahead()
        return ScanObservation(
            base_in_map=stance.base_in_map,
            lidar_in_base=self._lidar_in_base,
            first_rad=scan.angle_min_rad,
            step_rad=scan.angle_increment_rad,
            range_min_m=scan.range_min_m,
            ranges_m=scan.ranges_m,
            at_s=now_s,
            ahead=_first_metres(self._way.points) if self._way is not None else (),
        )

    def _was_shown(self, scan: Scan) -> bool:
        newest = self.shown
        return newest is not None and (scan.boot_id, scan.seq) == (newest.boot_id, newest.seq)

    async def show(
        self, seen: ScanObservation, tell: Callable[[RouteDoubted | Oncoming | ClosingIn], None]
    ) -> None:
        """Bring a scan to the search and keep its report; a failure is told by its next route.

        Args:
            seen: as :meth:`due` returned it.
            tell: is told where the way that came with it is closed, and who comes on it.
        """
        way = self._way
        try:
            self.report = await self._observer.observe(seen)
        except RouteFailure as failure:
            log.debug("a scan was not taken in: %s", failure)
            return
        finally:
            self._busy = False
        far_m = self.report.blocked_ahead_m
        if way is None or not way.points:
            return
        if far_m is not None:
            tell(RouteDoubted(way.mission, way.leg, _point_along(way.points, far_m)))
        met = find_oncoming(way.points, self.report.movers)
        if met is not None:
            who = met.who
            seen_m = (who.x_m, who.y_m)
            tell(Oncoming(way.mission, way.leg, met.at_m, met.far_m, seen_m, who.radius_m))
        here, v_mps = seen.base_in_map, self._poses.speed_mps
        velocity_mps = (v_mps * cos(here.yaw_rad), v_mps * sin(here.yaw_rad))
        at = (here.x_m, here.y_m)
        if is_closing_in(at, velocity_mps, self._radius_m, self.report.movers):
            tell(ClosingIn(way.mission, way.leg))


def _point_along(way: tuple[Point, ...], far_m: float) -> Point:
    """Return the first point of a way that lies so far from its beginning, or the last one."""
    gone_m = 0.0
    for before, point in pairwise(way):
        if gone_m >= far_m - 1e-6:
            return before
        gone_m += dist(before, point)
    return way[-1]


def _first_metres(way: tuple[Point, ...]) -> tuple[Point, ...]:
    """Return the points of a way within the first three metres."""
    gone_m = 0.0
    for count, (before, point) in enumerate(pairwise(way), 1):
        gone_m += dist(before, point)
        if gone_m > DOUBTS_M:
            return way[:count]
    return way


def _middle_s(scan: Scan) -> float:
    """Return the instant that stands for a whole sweep."""
    return scan.stamp_s + 0.5 * scan.time_increment_s * max(0, len(scan.ranges_m) - 1)
