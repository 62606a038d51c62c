"""Make map files of a robot's map, for the one reader of maps to load. Pure.

In mode ``raw``, where the grey value is the percentage: so that nothing of what ROS said is lost
between its thresholds and ours.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from ros2.robot_words import Unreadable

if TYPE_CHECKING:
    from ros2.robot_words import MapHead

UNKNOWN = 255
"""A grey that mode ``raw`` reads as not known; ROS says -1, which is this byte."""
MOST_CELLS = 64_000_000
_YAML = """\
image: map.pgm
mode: raw
resolution: {head.resolution_m!r}
origin: [{head.x_m!r}, {head.y_m!r}, {head.yaw_rad!r}]
negate: 0
occupied_thresh: 0.65
free_thresh: 0.25
"""


def map_files(head: MapHead, cells: bytes) -> tuple[str, bytes]:
    """Return the text of map.yaml, and map.pgm, whose first row is the map's top.

    Raises:
        Unreadable: it is none: cells that do not fill it, or values that are none.
    """
    width, height = head.width, head.height
    if not 0 < width * height <= MOST_CELLS or len(cells) != width * height:
        raise Unreadable(f"{width} x {height} cells, and data holds {len(cells)}")
    strange = set(cells) - {*range(101), UNKNOWN}
    if strange:
        raise Unreadable(f"data holds {min(strange)}, expected -1 to 100")
    rows = (cells[row * width : (row + 1) * width] for row in reversed(range(height)))
    return _YAML.format(head=head), b"P5\n%d %d\n255\n" % (width, height) + b"".join(rows)
