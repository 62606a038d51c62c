"""Keep what people drew on the map: where to stay out and where to go slowly. One file a map.

The bridge has the same marks in a file of its own, put there by an operator's proof; these here are
what routes are searched by. The route process reads the file as it changes, so a process that is
started again has them, too.
"""

from __future__ import annotations

import asyncio
import logging
from dataclasses import replace
from typing import TYPE_CHECKING

from pydantic import ValidationError

from planner.site.fence_check import FenceRefusal
from wire.fence import MAX_MARKS_TEXT, MarksFile, fence_text, marks_flaw
from wire.fingerprint import fingerprint

if TYPE_CHECKING:
    from pathlib import Path

    from planner.site.fence import Fence
    from planner.site.site import Site
    from wire import Pose2

log = logging.getLogger(__name__)

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
        fence = self._unmarked.fence.with_marks(self.marks)
        return replace(self._unmarked, fence=fence)

    async def keep(self, marks: MarksFile) -> Site:
        """Keep marks in place of those before, and return the site with them.

        Raises:
            OSError: they can't be written; nothing changed.
        """
        if self._path is not None:
            await asyncio.to_thread(write_marks, self._path, marks)
        self.marks = marks
        return self.site


def check_marks(marks: MarksFile, fence: Fence, robot_in_map: Pose2 | None) -> None:
    """Accept marks for a map and for where the robot is now, as far as that is known.

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
    if robot_in_map is None or not fence.allows(robot_in_map.x_m, robot_in_map.y_m):
        return
    if not fence.with_marks(marks).allows(robot_in_map.x_m, robot_in_map.y_m):
        at = f"({robot_in_map.x_m:.2f}, {robot_in_map.y_m:.2f})"
        raise FenceRefusal("mark_holds_robot", f"the robot is at {at}, inside of one")
