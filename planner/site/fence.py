"""Read the fence: where the robot's centre may be, and how fast. Knows no map."""

from __future__ import annotations

from dataclasses import dataclass
from math import inf
from pathlib import Path

from maps.errors import SiteError
from maps.yaml_records import parse_json, read_bytes
from planner.site.polygon import Polygon, border_distance_m, contains
from wire.fence import (
    MIN_AREA_M2,
    FenceFile,
    MarksFile,
    Outline,
    SpeedZone,
    area_m2,
    crosses_itself,
    flaw,
)
from wire.fingerprint import fingerprint

__all__ = ["Fence", "Outline", "SpeedZone", "load_fence"]

_FLAWS = {
    "fence_degenerate": "polygon_degenerate",
    "fence_crosses_itself": "polygon_crosses_itself",
}


@dataclass(frozen=True, slots=True)
class Fence:
    """Bound the robot's centre: inside an allowed outline and inside no keep-out."""

    record: FenceFile
    fence_hash: str

    @property
    def outlines(self) -> tuple[Polygon, ...]:
        """Return every outline that the robot's centre may not cross."""
        return self.record.allowed + self.record.keep_outs

    def with_marks(self, marks: MarksFile | None) -> Fence:
        """Return this fence less what people drew on the map; its hash stays the file's."""
        if marks is None:
            return self
        drawn = tuple(SpeedZone(**zone.model_dump()) for zone in marks.speed_zones)
        keep_outs = (*self.record.keep_outs, *marks.keep_outs)
        zones = (*self.record.speed_zones, *drawn)
        changes = {"keep_outs": keep_outs, "speed_zones": zones}
        return Fence(self.record.model_copy(update=changes), self.fence_hash)

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
        SiteError: ``polygon_degenerate``, ``polygon_crosses_itself`` and the codes of
            :mod:`maps.yaml_records`.
    """
    data = read_bytes(path)
    record = parse_json(data, FenceFile, path)
    wrong = flaw(record)
    if wrong is not None:
        code, text = wrong
        zh = f"{path}：{_flaw_zh(code, record)}"
        raise SiteError(_FLAWS[code], f"{path}: {text}", zh)
    return Fence(record, fingerprint(data))


def _flaw_zh(code: str, record: FenceFile) -> str:
    """Return in Chinese what :func:`flaw` found, by its code."""
    if code == "fence_degenerate":
        outline = next(line for line in record.outlines if not area_m2(line) > MIN_AREA_M2)
        corners = "、".join(f"({x}, {y})" for x, y in outline[:4])
        return f"有一条边界没有面积，其角为 {corners}{' 等' if len(outline) > 4 else ''}"
    (ax, ay), (bx, by) = next(filter(None, map(crosses_itself, record.outlines)))
    return f"边界自相交或自相接触：始于 ({ax}, {ay}) 与 ({bx}, {by}) 的两条边相遇"
