"""Make a site's folder of a map that was made elsewhere: map, fence, a home, rooms as a proposal.

The map is written anew, in trinary mode with the axes of ``map`` and Nav2's greys, so that what a
person said about unknown cells stands in the pixels. The files are whole or not there at all.
"""

from __future__ import annotations

import json
import shutil
from dataclasses import dataclass
from secrets import token_hex
from typing import TYPE_CHECKING

import cv2
import numpy as np

from maps.cell_array import cell_array
from maps.errors import SiteError
from maps.file_errors import unwritable
from maps.grid import FREE, OCCUPIED, UNKNOWN, GridMap
from maps.map_file import SAVED_UNKNOWN, LoadedMap
from maps.room_proposals import ROOMS_JSON, RoomProposal, RoomProposals
from maps.rooms import propose_rooms
from maps.site_fence import draw_fence, floor_around
from maps.spots import check_on_floor
from wire.fence import fence_text
from wire.fingerprint import map_id
from wire.geometry import Pose2

if TYPE_CHECKING:
    from collections.abc import Sequence
    from pathlib import Path

    from maps.map_file import LoadedMap
    from maps.masks import MaskAreas

ASK_FROM_SHARE = 0.01
"""From so many pixels of grey 205 that free_thresh frees on, a person says what they are."""
_GREYS = {FREE: 254, OCCUPIED: 0, UNKNOWN: SAVED_UNKNOWN}
_STAND_M = 0.15
"""Beside the robot's radius: room to turn where a run starts."""


@dataclass(frozen=True, slots=True)
class NewSite:
    """Hold the files of a site that is not written yet, and where its home is."""

    files: dict[str, bytes]
    home: Pose2
    rooms: tuple[RoomProposal, ...]

    def write(self, folder: Path) -> None:
        """Write the site; on a failure nothing is left.

        Raises:
            SiteError: ``site_exists`` or ``site_unwritable``.
        """
        if folder.exists():
            text = f"{folder} is there; remove it or choose another name"
            zh = f"{folder} 已存在：请删除它或换一个名称"
            raise SiteError("site_exists", text, zh)
        # A name of its own: one that was killed here before left its folder behind.
        beside = folder.with_name(f".{folder.name}.{token_hex(4)}.new")
        try:
            beside.mkdir(parents=True)
            for name, data in self.files.items():
                (beside / name).write_bytes(data)
            beside.rename(folder)
        except OSError as error:
            shutil.rmtree(beside, ignore_errors=True)
            raise unwritable(folder, error) from error


def new_site(
    loaded: LoadedMap,
    radius_m: float,
    start: Pose2 | None = None,
    masks: Sequence[MaskAreas] = (),
) -> NewSite:
    """Make a site of a map.

    Args:
        loaded: the map as read; what is free in it is free in the site.
        radius_m: of the robot's disc.
        start: where the robot's home is; left out, the map's origin, where a robot that makes a
            map begins, or else the widest spot.
        masks: areas that keep-out and speed masks give.

    Raises:
        SiteError: ``map_no_floor``, ``place_in_obstacle``, ``place_outside_map`` or
            ``map_too_ragged``.
    """
    grid = loaded.grid
    home = _home(loaded, radius_m, start)
    floor = floor_around(grid, home.x_m, home.y_m)
    picture = map_picture(grid)
    text = map_yaml(grid)
    fence = draw_fence(grid, map_id(text, picture), floor, radius_m, masks)
    rooms = tuple(
        RoomProposal(
            id=f"room_{number}",
            polygon=room.polygon,
            pose=Pose2(room.x_m, room.y_m, 0.0),
            area_m2=room.area_m2,
            clearance_m=room.clearance_m,
        )
        for number, room in enumerate(propose_rooms(grid, floor), 1)
    )
    files = {
        "map.yaml": text,
        "map.pgm": picture,
        "places.yaml": places_of_home(home),
        "fence.json": fence_text(fence).encode(),
        ROOMS_JSON: RoomProposals(rooms=rooms).model_dump_json(indent=1).encode(),
    }
    return NewSite(files, home, rooms)


def _home(loaded: LoadedMap, radius_m: float, start: Pose2 | None) -> Pose2:
    grid = loaded.grid
    padded = np.pad((cell_array(grid) == FREE).astype(np.uint8), 1)
    room = cv2.distanceTransform(padded, cv2.DIST_L2, cv2.DIST_MASK_PRECISE)[1:-1, 1:-1]
    clearance_m = (np.asarray(room, np.float64) - 0.5) * grid.resolution_m
    if start is not None:
        check_on_floor(grid, "the start", "起点", start)
        return start
    if grid.contains(0.0, 0.0):
        column, row = grid.cell_of(0.0, 0.0)
        if clearance_m[row, column] >= radius_m + _STAND_M:
            return Pose2(0.0, 0.0, 0.0)
    row, column = divmod(int(clearance_m.argmax()), grid.width)
    if not clearance_m[row, column] >= radius_m:
        raise _no_floor(loaded, radius_m)
    x_m, y_m = grid.centre_of(column, row)
    return Pose2(round(x_m, 3), round(y_m, 3), 0.0)


def _no_floor(loaded: LoadedMap, radius_m: float) -> SiteError:
    grid = loaded.grid
    counts = np.bincount(cell_array(grid).reshape(-1), minlength=3)
    free, occupied, unknown = (100.0 * float(counts[k]) / counts.sum() for k in _GREYS)
    size = f"{grid.width} x {grid.height}"
    text = (
        f"of {size} cells {free:.0f} % are free, {occupied:.0f} % occupied, {unknown:.0f} % unknown"
    )
    text = f"nowhere a circle of {radius_m} m is free: {text}"
    zh = (
        f"地图上没有半径 {radius_m} 米的空地：{size} 个栅格中空地 {free:.0f}%，障碍 {occupied:.0f}%"
    )
    cure = "are resolution, negate and thresholds right? Transparent pixels are unknown"
    cure_zh = "请检查 resolution、negate 和阈值；透明像素算作未知"
    if loaded.record.mode == "raw":
        cure = "by mode: raw greys are percents and over 100 unknown; a picture is mode: trinary"
        cure_zh = "mode: raw 把灰度当作百分数，大于 100 为未知；一般图片应写 mode: trinary"
    return SiteError("map_no_floor", f"{text}; {cure}", f"{zh}，未知 {unknown:.0f}%；{cure_zh}")


def map_picture(grid: GridMap) -> bytes:
    """Return a map's cells as the PGM that its yaml names."""
    table = np.zeros(256, np.uint8)
    for kind, grey in _GREYS.items():
        table[kind] = grey
    greys = table[cell_array(grid)]
    return f"P5\n{grid.width} {grid.height}\n255\n".encode() + greys[::-1].tobytes()


def map_yaml(grid: GridMap) -> bytes:
    """Return the yaml of a map whose cells :func:`map_picture` gives."""
    return (
        "# Made by `pons site import` or `pons map`; what is free here was taken for free then.\n"
        f"image: map.pgm\nmode: trinary\nresolution: {grid.resolution_m!r}\n"
        f"origin: [{grid.origin_x_m!r}, {grid.origin_y_m!r}, 0.0]\nnegate: 0\n"
        "occupied_thresh: 0.65\nfree_thresh: 0.196\n"
    ).encode()


def places_of_home(home: Pose2) -> bytes:
    """Return a places.yaml that knows nothing but where home is."""
    return (
        "# Rooms join when they are named: pons site name SITE room_1 NAME.\n"
        "version: 1\nhome: home\nplaces:\n" + place_text("home", "place", ("home", "家"), home)
    ).encode()


def place_text(
    place_id: str,
    kind: str,
    names: tuple[str, str],
    pose: Pose2,
    polygon: Sequence[tuple[float, float]] | None = None,
) -> str:
    """Return one entry of places.yaml. JSON strings and lists are YAML, and quote what needs it."""
    en, zh = (json.dumps(name, ensure_ascii=False) for name in names)
    lines = [
        f"- id: {place_id}",
        f"  kind: {kind}",
        f"  name: {{en: {en}, zh: {zh}}}",
        f"  pose: {{x_m: {pose.x_m!r}, y_m: {pose.y_m!r}, yaw_rad: {pose.yaw_rad!r}}}",
    ]
    if polygon is not None:
        lines.append(f"  polygon: {json.dumps([list(corner) for corner in polygon])}")
    return "\n".join(lines) + "\n"
