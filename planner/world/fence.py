"""Read the fence: where the robot's centre may be, and how fast. Knows no map."""

from __future__ import annotations

from dataclasses import dataclass
from math import inf
from pathlib import Path
from typing import Annotated

from pydantic import Field

from planner.world.errors import SiteError
from planner.world.polygon import Polygon, area_m2, border_distance_m, contains
from planner.world.records import Record, parse_json, read_bytes
from wire.fingerprint import fingerprint

Ordinate = Annotated[float, Field(ge=-10_000.0, le=10_000.0)]
Outline = Annotated[tuple[tuple[Ordinate, Ordinate], ...], Field(min_length=3, max_length=1000)]


class SpeedZone(Record):
    """Bound the speed inside an outline."""

    polygon: Outline
    max_speed_mps: Annotated[float, Field(ge=0.05, le=10.0)]


class FenceRecord(Record):
    """Mirror fence.json. All outlines are in ``map`` [m] and speak of the robot's centre."""

    version: Annotated[int, Field(ge=1, le=1)]
    map_id: str
    allowed: Annotated[tuple[Outline, ...], Field(min_length=1, max_length=1000)]
    keep_outs: Annotated[tuple[Outline, ...], Field(max_length=1000)] = ()
    speed_zones: Annotated[tuple[SpeedZone, ...], Field(max_length=1000)] = ()


@dataclass(frozen=True, slots=True)
class Fence:
    """Bound the robot's centre: inside an allowed outline and inside no keep-out."""

    record: FenceRecord
    fence_hash: str

    @property
    def outlines(self) -> tuple[Polygon, ...]:
        """Return every outline that the robot's centre may not cross."""
        return self.record.allowed + self.record.keep_outs

    def allows(self, x_m: float, y_m: float) -> bool:
        """Tell whether the robot's centre may be at a point of ``map``."""
        inside = any(contains(outline, x_m, y_m) for outline in self.record.allowed)
        return inside and not any(contains(hole, x_m, y_m) for hole in self.record.keep_outs)

    def border_distance_m(self, x_m: float, y_m: float) -> float:
        """Return how far a point is from the nearest line of the fence [m]."""
        return min(border_distance_m(outline, x_m, y_m) for outline in self.outlines)

    def max_speed_mps(self, x_m: float, y_m: float) -> float:
        """Return the slowest zone's speed at a point; infinite where there is no zone."""
        zones = self.record.speed_zones
        return min(
            (zone.max_speed_mps for zone in zones if contains(zone.polygon, x_m, y_m)), default=inf
        )


def load_fence(path: Path) -> Fence:
    """Load fence.json.

    Raises:
        SiteError: ``polygon_degenerate`` and the codes of :mod:`planner.world.records`.
    """
    data = read_bytes(path)
    fence = Fence(parse_json(data, FenceRecord, path), fingerprint(data))
    zones = tuple(zone.polygon for zone in fence.record.speed_zones)
    for outline in fence.outlines + zones:
        if not area_m2(outline) > 0.0:
            raise SiteError("polygon_degenerate", f"{path}: the outline {outline} has no area")
    return fence
