"""Load a map in Nav2's format (map.yaml and its image) in trinary mode. Knows no places or fences.

Source of the format: Nav2 map server. A pixel's occupancy is (255 - grey) / 255, or grey / 255
when negated; above ``occupied_thresh`` it is occupied, below ``free_thresh`` free, else unknown.
"""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Annotated, Literal

from pydantic import Field

from planner.site.errors import SiteError
from planner.site.grid import FREE, OCCUPIED, UNKNOWN, GridMap
from planner.site.image import GreyImage, read_image
from planner.site.yaml_records import Record, parse_yaml, read_bytes
from wire.fingerprint import map_id
from wire.site_map import image_in

Share = Annotated[float, Field(ge=0.0, le=1.0)]
Ordinate = Annotated[float, Field(ge=-10_000.0, le=10_000.0)]


class MapRecord(Record):
    """Mirror the keys of a Nav2 map.yaml."""

    image: Annotated[str, Field(min_length=1)]
    resolution: Annotated[float, Field(ge=0.005, le=1.0)]  # [m] per pixel
    origin: tuple[Ordinate, Ordinate, Ordinate]  # x [m], y [m], yaw [rad] of the lower left corner
    negate: Literal[0, 1] = 0
    occupied_thresh: Share
    free_thresh: Share
    mode: str = "trinary"
    map_type: str = "occupancy"  # written by some map savers; means nothing to the map server


@dataclass(frozen=True, slots=True)
class LoadedMap:
    """Keep a map with the name by which all processes know it."""

    grid: GridMap
    map_id: str


def load_map(path: Path) -> LoadedMap:
    """Load map.yaml at ``path`` and the image it points to.

    Raises:
        SiteError: ``map_image_outside``, ``map_rotated``, ``map_mode_unsupported`` and the codes
            of :mod:`planner.site.yaml_records` and :mod:`planner.site.image`.
    """
    text = read_bytes(path)
    record = parse_yaml(text, MapRecord, path)
    try:
        where = image_in(path.parent, record.image)
    except ValueError as error:
        raise SiteError("map_image_outside", f"{path}: image {record.image!r}: {error}") from error
    data, image = read_image(where)
    _check_supported(record, path)
    return LoadedMap(_grid(record, image), map_id(text, data))


def _check_supported(record: MapRecord, path: Path) -> None:
    if record.mode != "trinary":
        text = f"{path}: mode {record.mode!r}; only 'trinary' maps can be driven on"
        raise SiteError("map_mode_unsupported", text)
    if record.origin[2] != 0.0:
        text = f"{path}: origin yaw {record.origin[2]} rad; expected 0, rotate the image instead"
        raise SiteError("map_rotated", text)
    if not record.free_thresh < record.occupied_thresh:
        text = f"{path}: free_thresh {record.free_thresh} is not below {record.occupied_thresh}"
        raise SiteError("map_thresholds_crossed", text)


def _grid(record: MapRecord, image: GreyImage) -> GridMap:
    kinds = image.pixels.translate(bytes(_kind(grey, record) for grey in range(256)))
    # A picture's first row is the top of the map; ours is the bottom, so that rows grow with y.
    width, height = image.width, image.height
    rows = [kinds[row * width : (row + 1) * width] for row in reversed(range(height))]
    x_m, y_m, _ = record.origin
    return GridMap(width, height, record.resolution, x_m, y_m, b"".join(rows))


def _kind(grey: int, record: MapRecord) -> int:
    occupancy = (grey if record.negate else 255 - grey) / 255
    if occupancy > record.occupied_thresh:
        return OCCUPIED
    return FREE if occupancy < record.free_thresh else UNKNOWN
