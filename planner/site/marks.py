"""Keep what people drew on the map: where to stay out and where to go slowly. One file a map.

The bridge has the same marks in a file of its own, put there by an operator's proof; these here are
what routes are searched by. The route process reads the file as it changes, so a process that is
started again has them, too.
"""

from __future__ import annotations

import asyncio
import logging
from contextlib import suppress
from dataclasses import dataclass, replace
from itertools import islice
from math import cos, pi, sin
from typing import TYPE_CHECKING

from pydantic import ValidationError

from planner.site.fence_check import FenceRefusal
from planner.site.taught_place_check import PlaceSurvey, check_spot
from planner.site.taught_place_errors import PlaceRefusal
from wire.fence import MAX_MARKS_TEXT, MarksFile, fence_text, marks_flaw
from wire.fingerprint import fingerprint
from wire.geometry import Pose2

if TYPE_CHECKING:
    from pathlib import Path

    from planner.site.fence import Fence
    from planner.site.site import Site

log = logging.getLogger(__name__)

EXIT_M = 8.0
EXIT_STEP_M = 0.1
EXIT_WAYS = 16
EXIT_ROOM_M = 0.3
"""From every line: routes keep 0.15 m off one, and a robot stands a little beside its goal."""
DIGITS = 3
"""Corners are kept to a millimetre: a finger is no finer, and the text stays short."""


def marks_path(home: Path, map_id: str) -> Path:
    """Return where the planner keeps the marks of a map."""
    return home / "marks" / f"{map_id}.json"


def read_marks(path: Path, map_id: str) -> MarksFile | None:
    """Return the marks of a map; None where nothing is drawn, or the file is none of ours."""
    try:
        data = path.read_bytes()
        marks = MarksFile.model_validate_json(data) if len(data) <= MAX_MARKS_TEXT else None
    except FileNotFoundError:
        return None
    except (OSError, ValidationError) as error:
        log.warning("marks_unreadable: %s: %s", path, error)
        return None
    return marks if marks is not None and marks.map_id == map_id else None


def write_marks(path: Path, marks: MarksFile) -> None:
    """Keep marks: a reader sees the old or the new ones, whole.

    Raises:
        OSError: the disk refuses; what was there stays.
    """
    path.parent.mkdir(parents=True, exist_ok=True)
    beside = path.with_name(f".{path.name}.new")
    beside.write_text(fence_text(marks), encoding="utf-8")
    beside.replace(path)


def round_marks(marks: MarksFile) -> MarksFile:
    """Return marks with their corners to a millimetre."""

    def near(outline: tuple[tuple[float, float], ...]) -> tuple[tuple[float, float], ...]:
        return tuple((round(x, DIGITS), round(y, DIGITS)) for x, y in outline)

    zones = tuple(z.model_copy(update={"polygon": near(z.polygon)}) for z in marks.speed_zones)
    keep_outs = tuple(map(near, marks.keep_outs))
    return marks.model_copy(update={"keep_outs": keep_outs, "speed_zones": zones})


def marks_hash(marks: MarksFile | None) -> str | None:
    """Return the hash by which the bridge names these marks; None where nothing is drawn."""
    return None if marks is None else fingerprint(fence_text(marks).encode())


@dataclass(frozen=True, slots=True)
class MarkExit:
    """Point out where the robot leaves marks that are drawn round it, and by how long a way."""

    x_m: float
    y_m: float
    metres: float


class SiteMarks:
    """Hold the marks of a site's map, and the site with its fence less them."""

    def __init__(self, site: Site, path: Path | None) -> None:
        """Read what is kept; without a path nothing is, and nothing will be."""
        self._unmarked, self._path = site, path
        self.marks = read_marks(path, site.map_id) if path is not None else None
        """None: nothing was ever drawn."""

    @property
    def site(self) -> Site:
        """Return the site with its fence less the marks."""
        return self.site_with(self.marks)

    def site_with(self, marks: MarksFile | None) -> Site:
        """Return the site as it would be with these marks in place of those in force."""
        return replace(self._unmarked, fence=self._unmarked.fence.with_marks(marks))

    async def keep(self, marks: MarksFile) -> Site:
        """Keep marks in place of those before, and return the site with them.

        Raises:
            OSError: they can't be written; nothing changed.
        """
        if self._path is not None:
            await asyncio.to_thread(write_marks, self._path, marks)
        self.marks = marks
        return self.site


def check_outlines(marks: MarksFile, fence: Fence) -> None:
    """Accept marks for a map, wherever the robot is.

    Raises:
        FenceRefusal: the first thing that speaks against them.
    """
    if marks.map_id != fence.record.map_id:
        text = f"they are for map {marks.map_id}, this site's is {fence.record.map_id}"
        raise FenceRefusal("marks_of_another_map", text)
    wrong = marks_flaw(marks)
    if wrong is not None:
        raise FenceRefusal(*wrong)
    length = len(fence_text(marks))
    if not length <= MAX_MARKS_TEXT:
        raise FenceRefusal("marks_too_many", f"{length} characters, at most {MAX_MARKS_TEXT}")


def check_marks(marks: MarksFile, fence: Fence, robot_in_map: Pose2 | None) -> None:
    """Accept marks for a map and for where the robot is now, as far as that is known.

    Raises:
        FenceRefusal: the first thing that speaks against them.
    """
    check_outlines(marks, fence)
    if robot_in_map is None or not fence.allows(robot_in_map.x_m, robot_in_map.y_m):
        return
    if not fence.with_marks(marks).allows(robot_in_map.x_m, robot_in_map.y_m):
        at = f"({robot_in_map.x_m:.2f}, {robot_in_map.y_m:.2f})"
        raise FenceRefusal("mark_holds_robot", f"the robot is at {at}, inside of one")


async def find_exit(marked: Site, survey: PlaceSurvey | None, radius_m: float) -> MarkExit:
    """Return where the robot leaves marks that hold it, by the shortest way.

    Of the nearest spot outside in each direction it is the one with the shortest route.

    Args:
        marked: the site less the marks.
        survey: knows the robot, and the ways on the site as it is now; None before one is heard.
        radius_m: of the robot.

    Raises:
        PlaceRefusal: no pose is known, or no spot within ``EXIT_M`` can be driven to.
    """
    if survey is None:
        raise PlaceRefusal("pose_unknown")
    here = survey.robot_pose(marked.map_id, must_stand=False)
    spots = await asyncio.to_thread(_spots_outside, marked, here, radius_m)
    best: MarkExit | None = None
    for away_m, spot in spots:
        if best is not None and not away_m < best.metres:
            break
        with suppress(PlaceRefusal):
            metres = await survey.check_way(here, spot)
            if best is None or metres < best.metres:
                best = MarkExit(spot.x_m, spot.y_m, metres)
    if best is None:
        raise PlaceRefusal("place_unreachable", f"{len(spots)} spots outside, no way to any")
    return best


def _spots_outside(marked: Site, here: Pose2, radius_m: float) -> list[tuple[float, Pose2]]:
    """Return the nearest spot in each direction, and how far it is [m], the nearest first."""
    found: list[tuple[float, Pose2]] = []
    for turn in range(EXIT_WAYS):
        way_rad = here.yaw_rad + 2.0 * pi * turn / EXIT_WAYS
        steps = (step * EXIT_STEP_M for step in range(int(EXIT_M / EXIT_STEP_M)))
        spots = ((away_m, _ahead(here, way_rad, away_m)) for away_m in steps)
        found += islice((each for each in spots if _is_outside(marked, each[1], radius_m)), 1)
    return sorted(found, key=lambda each: each[0])


def _ahead(here: Pose2, way_rad: float, away_m: float) -> Pose2:
    return Pose2(here.x_m + away_m * cos(way_rad), here.y_m + away_m * sin(way_rad), way_rad)


def _is_outside(marked: Site, spot: Pose2, radius_m: float) -> bool:
    fence = marked.fence
    if not fence.allows(spot.x_m, spot.y_m):
        return False
    try:
        check_spot(marked, spot, radius_m)
    except PlaceRefusal:
        return False
    return fence.border_distance_m(spot.x_m, spot.y_m) >= EXIT_ROOM_M
