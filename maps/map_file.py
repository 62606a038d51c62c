"""Load a map in Nav2's format: map.yaml and its image, in every mode. Knows no places or fences.

Source of the format: Nav2 map server (map_io.cpp). A pixel's occupancy is 1 - shade, or its shade
when negated; above ``occupied_thresh`` it is occupied, below ``free_thresh`` free, else unknown.
Mode ``raw`` takes the grey value itself as percent, and what is over 100 as unknown.

One thing is read otherwise: grey 205 is what every map saver writes for unknown, and the same
savers write ``free_thresh: 0.25``, which makes it free. Here it is unknown under any threshold,
and so are the greys beside it that JPEG makes of it.
What is not opaque is unknown in every mode; in mode ``trinary`` Nav2 takes it for lighter.
"""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Annotated, Literal

from pydantic import BeforeValidator, Field, StrictBool
from pydantic_core import PydanticCustomError

from maps.errors import SiteError
from maps.grid import FREE, OCCUPIED, UNKNOWN, GridMap
from maps.image import GreyImage, images_in, read_image
from maps.yaml_records import SiteRecord, parse_yaml, read_bytes, validate_record
from wire.fingerprint import map_id
from wire.site_map import MOST_MAP_BYTES, image_in, image_name

FARTHEST_M = 10_000.0
"""Of anything in ``map`` from its origin, as every message bounds it."""


def _no_truth(value: object) -> object:
    """Refuse yes and no where a number is due: pydantic would take them for 1 and 0."""
    if isinstance(value, bool):
        raise PydanticCustomError("float_type", "a number is due")
    return value


Number = Annotated[float, BeforeValidator(_no_truth)]
Share = Annotated[Number, Field(ge=0.0, le=1.0)]
Ordinate = Annotated[Number, Field(ge=-FARTHEST_M, le=FARTHEST_M)]

SAVED_UNKNOWN = 205
"""The grey that map savers of ROS 1 and Nav2 write for unknown: occupancy 50/255, 0.196."""
SMEARED = 3
"""Greys beside it that JPEG makes of it, by a quality of 10 or more (203 to 208 were measured)."""


NO_OCCUPANCY = 255
"""Unknown, beside an occupancy of 0 to 100 percent."""


class MapRecord(SiteRecord):
    """Mirror the keys of a Nav2 map.yaml."""

    image: Annotated[str, Field(min_length=1)]
    resolution: Annotated[Number, Field(ge=0.005, le=1.0)]  # [m] per pixel
    origin: tuple[Ordinate, Ordinate, Ordinate]  # x [m], y [m], yaw [rad] of the lower left corner
    negate: Literal[0, 1] | StrictBool = 0
    occupied_thresh: Share
    free_thresh: Share
    mode: Literal["trinary", "scale", "raw"] = "trinary"
    map_type: str = "occupancy"  # written by some map savers; means nothing to the map server


@dataclass(frozen=True, slots=True)
class LoadedMap:
    """Keep a map with the name by which all processes know it."""

    grid: GridMap
    kept_unknown: int
    """Pixels of about grey 205 that ``free_thresh`` makes free, and a careful reader not."""
    map_id: str
    record: MapRecord


def load_map(path: Path, *, frees_saved_unknown: bool = False) -> LoadedMap:
    """Load map.yaml at ``path`` and the image it points to.

    A yaw in the origin is carried out: the grid's rows always lie along x of ``map``.

    Args:
        path: the map.yaml.
        frees_saved_unknown: a person said that this map's greys of about 205 may be floor where
            the thresholds make them so.

    Raises:
        SiteError: ``map_image_outside``, ``map_image_ambiguous``, ``map_thresholds_crossed`` and
            the codes of :mod:`maps.yaml_records`, :mod:`maps.image` and :mod:`maps.rotation`.
    """
    text = read_bytes(path, MOST_MAP_BYTES)
    record = parse_yaml(text, MapRecord, path)
    data, image = read_image(_image_path(path, text, record))
    name = map_id(text, data)
    del data
    return LoadedMap(*_grid(record, image, path, frees_saved_unknown), name, record)


def load_picture(
    path: Path,
    resolution_m: float,
    origin: tuple[float, float, float],
    *,
    frees_saved_unknown: bool = False,
) -> LoadedMap:
    """Load a picture without a map.yaml, by Nav2's thresholds; its map_id is empty.

    Raises:
        SiteError: ``value_malformed`` and the codes of :mod:`maps.image` and
            :mod:`maps.rotation`.
    """
    given = {
        "image": path.name, "resolution": resolution_m, "origin": origin,
        "occupied_thresh": 0.65, "free_thresh": 0.25,
    }  # fmt: skip
    record = validate_record(given, MapRecord, path)
    _, image = read_image(path)
    return LoadedMap(*_grid(record, image, path, frees_saved_unknown), "", record)


def load_occupancy(path: Path) -> tuple[MapRecord, int, int, bytes]:
    """Load a mask as Nav2's occupancy: 0 to 100 percent a cell, NO_OCCUPANCY where unknown.

    Returns the yaml's record, width and height, and the cells, the lowest row first. The yaw of
    the origin is left to who asks.

    Raises:
        SiteError: as :func:`load_map` does.
    """
    text = read_bytes(path, MOST_MAP_BYTES)
    record = parse_yaml(text, MapRecord, path)
    _, image = read_image(_image_path(path, text, record))
    _check_thresholds(record, path)
    percents = bytes(_percent(grey, record) for grey in range(256))
    cells = _from_below(image.pixels.translate(percents), image.width, image.height)
    if image.opaque is not None:
        opaque = _from_below(image.opaque, image.width, image.height)
        cells = _with_transparent(cells, opaque, NO_OCCUPANCY)
    return record, image.width, image.height, cells


def _check_thresholds(record: MapRecord, path: Path) -> None:
    if not record.free_thresh < record.occupied_thresh:
        free, occupied = (
            f"free_thresh {record.free_thresh}",
            f"occupied_thresh {record.occupied_thresh}",
        )
        zh = f"{path}：{free} 应小于 {occupied}"
        raise SiteError("map_thresholds_crossed", f"{path}: {free} is not below {occupied}", zh)


def _grid(
    record: MapRecord, image: GreyImage, path: Path, frees_saved_unknown: bool
) -> tuple[GridMap, int]:
    _check_thresholds(record, path)
    kinds = bytearray(_kind(grey, record) for grey in range(256))
    doubted = [grey for grey in range(256) if _frees_the_unknown(grey, record)]
    kept = sum(image.pixels.count(grey) for grey in doubted)
    for grey in doubted:
        kinds[grey] = FREE if frees_saved_unknown else UNKNOWN
    cells = _from_below(image.pixels.translate(bytes(kinds)), image.width, image.height)
    if image.opaque is not None:
        opaque = _from_below(image.opaque, image.width, image.height)
        cells = _with_transparent(cells, opaque, UNKNOWN)
    x_m, y_m, yaw_rad = record.origin
    grid = GridMap(image.width, image.height, record.resolution, x_m, y_m, cells)
    if yaw_rad != 0.0:
        from maps.rotation import straighten  # numpy is not for those who need no turn

        grid = straighten(grid, yaw_rad, path)
    _check_extent(grid, path)
    return grid, kept


def _check_extent(grid: GridMap, path: Path) -> None:
    right_m = grid.origin_x_m + grid.width * grid.resolution_m
    top_m = grid.origin_y_m + grid.height * grid.resolution_m
    ends = (grid.origin_x_m, grid.origin_y_m, right_m, top_m)
    if not all(abs(end_m) <= FARTHEST_M for end_m in ends):
        span = f"x {ends[0]:.2f} to {right_m:.2f}, y {ends[1]:.2f} to {top_m:.2f} m"
        most = f"{-FARTHEST_M:.0f} to {FARTHEST_M:.0f}"
        text = f"{path}: the map spans {span}; expected within {most}: mend its origin"
        span = f"x {ends[0]:.2f} 到 {right_m:.2f}，y {ends[1]:.2f} 到 {top_m:.2f} 米"
        most = f"{-FARTHEST_M:.0f} 到 {FARTHEST_M:.0f}"
        zh = f"{path}：地图范围为 {span}，应在 {most} 之内：请修改 origin"
        raise SiteError("value_malformed", text, zh)


def _from_below(values: bytes, width: int, height: int) -> bytes:
    """Turn the rows over: a picture's first row is the map's top, a grid's is its lowest y."""
    rows = memoryview(values)
    return b"".join(rows[row * width : (row + 1) * width] for row in reversed(range(height)))


def _image_path(path: Path, text: bytes, record: MapRecord) -> Path:
    # The bridge reads this one key without YAML; a map that has two names must not be driven on.
    seen = image_name(text)
    if seen != record.image:
        detail = f"{path}: image is {record.image!r} to YAML and {seen!r} read plainly; write it so"
        zh = f"{path}：image 按 YAML 是 {record.image!r}，直接读是 {seen!r}；应写作'image: map.pgm'"
        raise SiteError("map_image_ambiguous", f"{detail}: 'image: map.pgm'", zh)
    try:
        return image_in(path.parent, record.image)
    except ValueError as error:
        beside, beside_zh = images_in(path.parent, record.image)
        detail = f"{path}: image {record.image!r}: {error}; {beside}"
        zh = f"{path}：图像 {record.image!r} 不在站点文件夹 {path.parent} 内，或文件名不可用"
        zh = f"{zh}；{beside_zh}"
        raise SiteError("map_image_outside", detail, zh) from error


def _occupancy(grey: int, record: MapRecord) -> float:
    return (grey if record.negate else 255 - grey) / 255


def _saved_unknown(record: MapRecord) -> int:
    return 255 - SAVED_UNKNOWN if record.negate else SAVED_UNKNOWN


def _frees_the_unknown(grey: int, record: MapRecord) -> bool:
    """Return whether a grey may be a map saver's unknown and would be floor by the thresholds."""
    if record.mode == "raw" or not abs(grey - _saved_unknown(record)) <= SMEARED:
        return False
    return _occupancy(grey, record) < record.free_thresh


def _kind(grey: int, record: MapRecord) -> int:
    """Return what a grey means: a share between the thresholds is not known to be free."""
    if record.mode == "raw":
        occupancy = grey / 100
        if grey > 100:
            return UNKNOWN
    else:
        occupancy = _occupancy(grey, record)
        if grey == _saved_unknown(record):
            return UNKNOWN
    if occupancy > record.occupied_thresh:
        return OCCUPIED
    return FREE if occupancy < record.free_thresh else UNKNOWN


def _percent(grey: int, record: MapRecord) -> int:
    """Return Nav2's occupancy of a grey: what is between the thresholds is shared out in scale."""
    if record.mode == "raw":
        return grey if grey <= 100 else NO_OCCUPANCY
    occupancy = _occupancy(grey, record)
    if occupancy > record.occupied_thresh:
        return 100
    if occupancy < record.free_thresh:
        return 0
    if record.mode == "trinary":
        return NO_OCCUPANCY
    span = record.occupied_thresh - record.free_thresh
    return round((occupancy - record.free_thresh) / span * 100.0)


def _with_transparent(cells: bytes, opaque: bytes, kind: int) -> bytes:
    """Return the cells with ``kind`` where the picture is not opaque."""
    import numpy as np  # there already: no picture but a PNG has an alpha

    values = np.frombuffer(cells, np.uint8)
    return np.where(np.frombuffer(opaque, np.uint8) != 0, values, np.uint8(kind)).tobytes()
