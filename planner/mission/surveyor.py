"""Ask the lidar now and then what stands in the way of the running leg. Reads, decides nothing."""

from __future__ import annotations

import time
from math import hypot
from typing import TYPE_CHECKING

from planner.mission.activity import Driving
from planner.mission.events import Surveyed
from planner.navigation.obstruction import ROUND_M, find_narrow, find_obstruction, is_seen_open

if TYPE_CHECKING:
    from collections.abc import Sequence

    from maps.grid import GridMap
    from planner.bridge_client import Link
    from planner.mission.engine import Leg
    from planner.mission.state import MissionState
    from planner.navigation import Mover
    from wire import RobotDescription

EVERY_S = 0.5
WALKED_S = 10.0
BESIDE_M = 0.8
"""What stands so near to where something moved is what moved."""
MAX_WALKED = 200
FRESH_S = 0.5
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
        mission, status = book.missions.get(book.running or ""), book.status
        if mission is None or status is None or not isinstance(book.activity, Driving):
            return None
        wanted = status.blocked or bool(mission.recovery.shut)
        scan, here = self._link.scan, status.base_in_map
        if not wanted or now_s < self._next_s or scan is None or here is None:
            return None
        if not scan.age_s <= FRESH_S:
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
