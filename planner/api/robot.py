"""Serve the robot as the bridge reports it, and the map. Read only."""

from __future__ import annotations

import base64
import logging
import sys
from array import array
from dataclasses import asdict
from functools import cache
from typing import Any

from fastapi import APIRouter

from maps.growing_map import GROWING_MAP, GrowingMap, GrowingMapError, read_growing_map
from planner.api.interfaces import Services
from planner.api.localization import trouble_view
from planner.api.setup import setup_view
from planner.brain import mind_of
from planner.mission import Leg, tell_doubt
from planner.site import GridMap

log = logging.getLogger(__name__)

MAX_CELLS = 1_500
"""Of a layer, in one answer: 4 m2 of obstacles at 0.05 m."""


def routes(services: Services) -> APIRouter:
    """Return the reading routes."""
    router = APIRouter(prefix="/v1", tags=["robot"])
    maps = MapSource(services)

    @router.get("/robot", operation_id="get_robot")
    async def robot() -> dict[str, Any]:
        """Show the bridge's newest status, the robot's pose, all ages, and the brain in charge."""
        return robot_view(services)

    @router.get("/map", operation_id="get_map")
    def grid() -> dict[str, Any]:
        """Give the map's cells (0 free, 1 occupied, 2 unknown; row 0 lowest y) and the fence.

        While a home is mapped they are what is known so far, cropped, and ``growing`` counts.
        """
        return maps.body()

    @router.get("/obstacles", operation_id="get_obstacles")
    async def obstacles() -> dict[str, Any]:
        """Give what the route search remembers that the map does not know, and what moves."""
        return obstacle_view(services)

    return router


def robot_view(services: Services) -> dict[str, Any]:
    """Return the robot as people see it."""
    status = services.robot.status
    pose = status.base_in_map if status else None
    room = services.memory.room_at(pose.x_m, pose.y_m) if pose else None
    return {
        "status": status.model_dump(mode="json") if status else None,
        "room": room.id if room else None,
        "ages_s": services.robot.ages_s(),
        "site": services.site.folder.name,
        "map_id": services.site.map_id,
        "localization": _localization_kind(services),
        "localized_map": services.robot.localized_map,
        "localizer": services.robot.localizer.state if services.robot.localizer else None,
        "localizer_trouble": trouble_view(services),
        "match": match_view(services),
        "driver": services.robot.driver,
        "setup": setup_view(services),
        "brain": mind_of(services.brain).model_dump(mode="json"),
    }


def match_view(services: Services) -> dict[str, Any] | None:
    """Return how well the newest scan fits the map, and where else it would while it searches."""
    said = services.robot.localizer
    return None if said is None else said.model_dump(mode="json", include={"score", "candidates"})


def _localization_kind(services: Services) -> str:
    status = services.robot.status
    if services.robot.description.localization.kind == "scans":
        return "scans: the lidar against the map"
    if status and status.drive.virtual:
        return "stand-in: the simulator's truth plus noise"
    return "external"


def about(services: Services) -> dict[str, Any]:
    """Return the constants of a planner's run: its version, the robot's body and its limits."""
    robot = services.robot.description
    return {
        "version": _version(),
        "base": robot.base.model_dump(mode="json"),
        "limits": robot.limits.model_dump(mode="json"),
    }


@cache
def _version() -> str:
    from pons_assets.version import version_number

    return version_number()


def scan_view(services: Services) -> list[int]:
    """Return the lidar's points as x, y, x, y, … in ``map`` [cm]: half the bytes of metres."""
    return [round(100.0 * value) for point in services.robot.obstacles() for value in point]


def obstacle_view(services: Services) -> dict[str, Any]:
    """Return what the route search knows beyond the map: cells as x, y, … [cm], and what moves."""
    source = services.goals.obstacles
    report = source.report if source is not None else None
    if report is None:
        return {"cells": [], "suspicions": [], "movers": []}
    movers = [
        {name: round(value, 2) for name, value in asdict(mover).items()} for mover in report.movers
    ]
    grid = services.site.grid
    return {
        "cells": _centres_cm(grid, report.cells),
        "suspicions": _centres_cm(grid, report.suspicions),
        "movers": movers,
    }


def _centres_cm(grid: GridMap, cells: bytes) -> list[int]:
    """Return the middles of packed cells in ``map`` [cm], MAX_CELLS at most."""
    flat = array("H", cells)
    if sys.byteorder == "big":
        flat.byteswap()
    pairs = list(zip(flat[::2], flat[1::2], strict=True))[:MAX_CELLS]
    return [round(100.0 * value) for pair in pairs for value in grid.centre_of(*pair)]


def path_view(services: Services) -> dict[str, Any] | None:
    """Return the running leg's whole path in ``map`` [m]; none while nothing is driven."""
    leg = services.goals.path()
    if leg is None:
        return None
    points = [[round(point.x_m, 3), round(point.y_m, 3)] for point in leg.points]
    return {"goal": leg.mission, "leg": leg.leg, "points": points, "doubt": _doubt(services, leg)}


def _doubt(services: Services, leg: Leg) -> dict[str, Any] | None:
    """Return why the way bends, or goes on towards something; None: nothing stands in it."""
    doubt = leg.doubt
    if doubt is None:
        return None
    said = tell_doubt(services.memory.facts, doubt)
    x_m, y_m = doubt.at_m
    return {
        "code": doubt.code,
        "message": said.model_dump(mode="json"),
        "x_m": round(x_m, 2),
        "y_m": round(y_m, 2),
    }


class MapSource:
    """Give the site's map, or what is known so far where one grows in its folder."""

    def __init__(self, services: Services) -> None:
        self._services = services
        self._fixed = _map_body(services, services.site.grid, None)
        self._newest = self._fixed
        self._read_ns = 0

    def body(self) -> dict[str, Any]:
        """Return the map as JSON values. Reads a file: not for the event loop."""
        folder = self._services.site.folder
        try:
            written_ns = (folder / GROWING_MAP).stat().st_mtime_ns
            if written_ns != self._read_ns and (grown := read_growing_map(folder)) is not None:
                self._newest = _map_body(self._services, grown.grid, grown)
                self._read_ns = written_ns
        except FileNotFoundError:
            return self._fixed
        except (OSError, GrowingMapError) as unreadable:
            log.warning("%s", unreadable)
        return self._newest


def _map_body(services: Services, grid: GridMap, grown: GrowingMap | None) -> dict[str, Any]:
    counts = None
    if grown is not None:
        counts = {name: getattr(grown, name) for name in ("revision", "keyframes", "loops")}
    return {
        "map_id": services.site.map_id,
        "width": grid.width,
        "height": grid.height,
        "resolution_m": grid.resolution_m,
        "origin": {"x_m": grid.origin_x_m, "y_m": grid.origin_y_m},
        "cells": base64.b64encode(grid.cells).decode("ascii"),
        "fence": services.site.fence.record.model_dump(mode="json"),
        "growing": counts,
    }
