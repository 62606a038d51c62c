"""Make map files of a nav_msgs/OccupancyGrid, for the one reader of maps to load. Pure.

In mode ``raw``, where the grey value is the percentage: so that nothing of what ROS said is lost
between its thresholds and ours.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import atan2
from typing import TYPE_CHECKING, Any

from ros2.robot_words import Unreadable

if TYPE_CHECKING:
    from ros2.operations import Message

UNKNOWN = 255
"""A grey that mode ``raw`` reads as not known; ROS says -1."""
MOST_CELLS = 64_000_000
_TILT = 1e-3
_YAML = """\
image: map.pgm
mode: raw
resolution: {resolution_m!r}
origin: [{x_m!r}, {y_m!r}, {yaw_rad!r}]
negate: 0
occupied_thresh: 0.65
free_thresh: 0.25
"""


@dataclass(frozen=True, slots=True)
class MapFiles:
    """Hold a Nav2 map: the text of map.yaml, and its picture."""

    yaml: str
    pgm: bytes
    frame: str
    """Of the map, as ROS names it."""


def map_files(message: Message) -> MapFiles:
    """Return the files of a map.

    Raises:
        Unreadable: it is none: cells that do not fill it, or values that are none.
    """
    info, data = message.get("info"), message.get("data")
    if not isinstance(info, dict):
        raise Unreadable("info is missing")
    width, height = _count(info, "width"), _count(info, "height")
    if data is None or isinstance(data, str) or not hasattr(data, "__len__"):
        raise Unreadable(f"data holds {repr(data)[:40]}, expected a list of percentages")
    if not 0 < width * height <= MOST_CELLS or len(data) != width * height:
        raise Unreadable(f"{width} x {height} cells, and data holds {len(data)}")
    try:
        cells = bytes(UNKNOWN if one == -1 else one for one in data)
    except (TypeError, ValueError):
        raise Unreadable("data holds what is no whole number from -1 to 100") from None
    strange = set(cells) - {*range(101), UNKNOWN}
    if strange:
        raise Unreadable(f"data holds {min(strange)}, expected -1 to 100")
    header = message.get("header")
    frame = header.get("frame_id") if isinstance(header, dict) else None
    return MapFiles(_yaml(info), _picture(cells, width, height), str(frame or ""))


def _yaml(info: dict[str, Any]) -> str:
    origin = info.get("origin")
    position, turned = (_part(origin, name) for name in ("position", "orientation"))
    x, y, z, w = (_number(turned, axis) for axis in "xyzw")
    if abs(x) > _TILT or abs(y) > _TILT:
        raise Unreadable("info.origin.orientation is tilted, expected a turn about z")
    yaw_rad = 2.0 * atan2(z, w) if z or w else 0.0
    return _YAML.format(
        resolution_m=round(_number(info, "resolution"), 6),  # a float32: 0.05 came as 0.0500000007
        x_m=_number(position, "x"),
        y_m=_number(position, "y"),
        yaw_rad=yaw_rad,
    )


def _picture(cells: bytes, width: int, height: int) -> bytes:
    """Return a PGM: its first row is the map's top, ROS's the lowest y."""
    rows = (cells[row * width : (row + 1) * width] for row in reversed(range(height)))
    return b"P5\n%d %d\n255\n" % (width, height) + b"".join(rows)


def _part(parent: object, name: str) -> dict[str, Any]:
    value = parent.get(name) if isinstance(parent, dict) else None
    if not isinstance(value, dict):
        raise Unreadable(f"{name} is missing")
    return value


def _count(parent: dict[str, Any], name: str) -> int:
    value = parent.get(name)
    if not isinstance(value, int) or isinstance(value, bool) or not 0 <= value <= MOST_CELLS:
        raise Unreadable(f"{name} holds {repr(value)[:40]}, expected a whole number")
    return value


def _number(parent: dict[str, Any], name: str) -> float:
    value = parent.get(name)
    if not isinstance(value, int | float) or isinstance(value, bool) or not abs(value) < 1e9:
        raise Unreadable(f"{name} holds {repr(value)[:40]}, expected a finite number")
    return float(value)
