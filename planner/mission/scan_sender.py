"""Show the route search what the lidar sees, five times a second, from where the robot was then.

Owns when a scan is worth showing: fresh, new, and taken where odometry and a good localization say
where the robot was. A scan placed wrongly would mark walls that are not there. Runs beside the
missions and holds them up by nothing; while the search is busy, scans are passed over. Now and then
the lidar is also asked what stands in the way of the running leg: that reads, and decides nothing.
"""

from __future__ import annotations

import logging
import time
from itertools import pairwise
from math import cos, dist, hypot, sin
from typing import TYPE_CHECKING, Protocol

from planner.mission.activity import Driving
from planner.mission.events import ClosingIn, Oncoming, RouteDoubted, Surveyed
from planner.navigation import Mover, ObstacleReport, RouteFailure, ScanObservation
from planner.navigation.obstruction import ROUND_M, find_narrow, find_obstruction, is_seen_open
from planner.navigation.oncoming import find_oncoming, is_closing_in
from planner.perception.pose_buffer import Poses
from wire import Pose2, RobotDescription, Scan

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from maps.grid import GridMap
    from planner.bridge_client import Link
    from planner.mission.engine import Leg, WayAhead
    from planner.mission.state import MissionState


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
        newest, taken = self.shown, (scan.boot_id, scan.seq)
        was_shown = newest is not None and taken == (newest.boot_id, newest.seq)
        if was_shown or now_s - self._shown_s < PERIOD_S:
            return None
        # The middle of the sweep stands for the whole of it.
        sweep_s = scan.time_increment_s * max(0, len(scan.ranges_m) - 1)
        stance = self._poses.at(scan.stamp_s + 0.5 * sweep_s)
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


EVERY_S = 0.5
WALKED_S = 10.0
BESIDE_M = 0.8
"""What stands so near to where something moved is what moved."""
MAX_WALKED = 200
SIGHT_S = 0.5
"""An older scan is no sight of now."""


class Surveyor:
    """Turn the newest scan into what a blocked mission wants to know."""

    def __init__(self, link: Link, robot: RobotDescription, grid: GridMap) -> None:
        self._link, self._robot, self._grid = link, robot, grid
        self._next_s = float("-inf")
        self._walked: tuple[tuple[float, float, float, float], ...] = ()
        """Where something moved in the last seconds: x, y [m] in ``map``, when, and its radius."""

    def note_movers(self, movers: Sequence[Mover], now_s: float) -> None:
        """Remember for some seconds where something moves: who has stopped may walk on."""
        kept = tuple(at for at in self._walked if now_s - at[2] <= WALKED_S)
        self._walked = (*kept, *((m.x_m, m.y_m, now_s, m.radius_m) for m in movers))[-MAX_WALKED:]

    def survey(self, book: MissionState, leg: Leg | None, now_s: float) -> Surveyed | None:
        """Return what stands in the way of a leg that is blocked, and which shut ways are open.

        None: nobody needs to know, or nothing new is known. Twice a second at most, since this runs
        on the mission's loop (a scan of 360 beams takes about a millisecond).
        """
        mission, status = book.running_goal, book.status
        if mission is None or status is None or not isinstance(book.activity, Driving):
            return None
        wanted = status.blocked or bool(mission.recovery.shut)
        scan, here = self._link.scan, status.base_in_map
        if not wanted or now_s < self._next_s or scan is None or here is None:
            return None
        if not scan.age_s <= SIGHT_S:
            return None
        self._next_s = now_s + EVERY_S
        # Beams pass a gap that is too narrow: it is never seen open.
        ways = (way.obstruction for way in mission.recovery.shut if not way.gap)
        lidar = self._robot.lidar
        opened = tuple(way for way in ways if is_seen_open(way, scan.value, lidar, here))
        seen = None
        if status.blocked and leg is not None and book.activity.manoeuvre is None:
            path = [(point.x_m, point.y_m) for point in leg.points]
            seen = find_obstruction(
                *(self._link.obstacles(), path, (here.x_m, here.y_m)),
                *(self._robot.base.radius_m, self._grid),
            ) or find_narrow(path, (here.x_m, here.y_m), self._robot.base.radius_m, self._grid)
        if seen is None and not opened:
            return None
        walked = [
            radius_m
            for x_m, y_m, at_s, radius_m in self._walked
            if now_s - at_s <= WALKED_S
            and seen is not None
            and hypot(x_m - seen.middle[0], y_m - seen.middle[1]) <= BESIDE_M
        ]
        offset_s = float(time.localtime().tm_gmtoff)
        is_round = seen is not None and seen.is_round
        round_m = self._robot.base.radius_m + ROUND_M if is_round else 0.0
        return Surveyed(seen, bool(walked), opened, offset_s, max(walked, default=round_m))
