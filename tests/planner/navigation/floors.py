"""Draw small sites in characters."""

from __future__ import annotations

from pathlib import Path

from planner.site import FREE, OCCUPIED, GridMap, Site
from planner.site.fence import Fence
from planner.site.places import Names, Place
from wire import FenceFile, Pose2
from wire.fence import SpeedZone

CELL_M = 0.05
FAR = ((-100.0, -100.0), (100.0, -100.0), (100.0, 100.0), (-100.0, 100.0))

Outline = tuple[tuple[float, float], ...]


def drawn(
    *rows: str,
    square_m: float = 0.25,
    allowed: tuple[Outline, ...] = (FAR,),
    keep_outs: tuple[Outline, ...] = (),
    zones: tuple[tuple[Outline, float], ...] = (),
    rooms: dict[str, Outline] | None = None,
) -> Site:
    """Make a site from rows of '#' and '.', the first row at the top, the corner at (0, 0)."""
    per = round(square_m / CELL_M)
    cells = b"".join(
        bytes(OCCUPIED if mark == "#" else FREE for mark in row for _ in range(per)) * per
        for row in reversed(rows)
    )
    grid = GridMap(len(rows[0]) * per, len(rows) * per, CELL_M, 0.0, 0.0, cells)
    record = FenceFile(
        version=1,
        map_id="0" * 16,
        allowed=allowed,
        keep_outs=keep_outs,
        speed_zones=tuple(SpeedZone(polygon=p, max_speed_mps=v) for p, v in zones),
    )
    home = Place(id="home", kind="place", name=Names(en="home", zh="家"), pose=Pose2(1, 1, 0))
    places = [
        Place(id=name, kind="room", name=Names(en=name, zh=name), polygon=outline, pose=home.pose)
        for name, outline in (rooms or {}).items()
    ]
    fence = Fence(record, "0" * 16)
    return Site(Path("/nowhere"), grid, "0" * 16, fence, (home, *places), home)
