"""Refuse a spot where no robot can stand, and say on what it lies. Light: no numpy, no files."""

from __future__ import annotations

from typing import TYPE_CHECKING

from maps.errors import SiteError
from maps.grid import FREE, OCCUPIED, UNKNOWN

if TYPE_CHECKING:
    from maps.grid import GridMap
    from wire.geometry import Pose2

_GROUNDS = {OCCUPIED: ("an obstacle", "障碍物上"), UNKNOWN: ("floor that is unknown", "未知区域")}


def check_on_floor(grid: GridMap, name: str, name_zh: str, pose: Pose2) -> None:
    """Refuse a spot that is not on free floor.

    Args:
        grid: the map.
        name: of the spot, in English, as the refusal begins.
        name_zh: the same in Chinese.
        pose: in ``map``.

    Raises:
        SiteError: ``place_outside_map`` or ``place_in_obstacle``.
    """
    at = f"({pose.x_m:.2f}, {pose.y_m:.2f})"
    if not grid.contains(pose.x_m, pose.y_m):
        right_m = grid.origin_x_m + grid.width * grid.resolution_m
        top_m = grid.origin_y_m + grid.height * grid.resolution_m
        span = f"x {grid.origin_x_m:.2f} to {right_m:.2f}, y {grid.origin_y_m:.2f} to {top_m:.2f}"
        text, zh = (
            f"{name} at {at} is off the map, which spans {span}",
            f"{name_zh} {at} 在地图之外",
        )
        raise SiteError(
            "place_outside_map", text, f"{zh}，地图范围为 {span.replace(' to ', ' 到 ')}"
        )
    kind = grid.at(pose.x_m, pose.y_m)
    if kind != FREE:
        en, zh = _GROUNDS[kind]
        text = f"{name} at {at} is not on free floor of the map but on {en}"
        raise SiteError("place_in_obstacle", text, f"{name_zh} {at} 不在空地上，而在{zh}")
