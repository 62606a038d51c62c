"""Make the picture of a scan beam by beam: 360 of them, one a degree, beam 0 ahead."""

from __future__ import annotations

from math import radians

from bridge.core.geometry.lidar_scan import ScanPicture
from wire import IDENTITY, Scan
from wire.lidar_config import LidarConfig


def picture(
    seen: dict[int, float | None],
    lidar: LidarConfig | None = None,
    *,
    first: int = 0,
    count: int = 360,
    others: float | None = 7.0,
    sight_m: float | None = None,
) -> ScanPicture:
    """Return a scan's picture; ``seen`` tells the beams by degree that differ from the others."""
    ranges = tuple(seen.get((first + i) % 360, others) for i in range(count))
    scan = Scan(
        boot_id="a",
        seq=1,
        stamp_s=0.0,
        angle_min_rad=radians(first),
        angle_increment_rad=radians(1),
        range_min_m=0.12,
        range_max_m=8.0,
        ranges_m=ranges,
    )
    return ScanPicture.from_scan(scan, IDENTITY, lidar or LidarConfig(), sight_m)
