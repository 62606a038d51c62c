"""Keep what a drive says against a site's map, until a person takes it or drops it.

A proposal is a folder of ``$PONS_HOME/mending``: the mended map, the list and picture of what it
changes, the drive's keyframes in the map's frame. It is named by the map_id that the site would
have, so that a yes is a yes to one map. Nothing of the site is touched here.
"""

from __future__ import annotations

import json
import os
import shutil
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import cv2
import numpy as np

from localization.mapping.map_changes import MapChange, apply_changes, find_changes, frame_around
from localization.mapping.occupancy import MapTooLarge
from maps import FREE, OCCUPIED, SiteError
from maps.cell_array import cell_array
from maps.file_errors import unwritable
from maps.new_site import map_picture, map_yaml
from wire.fingerprint import map_id

if TYPE_CHECKING:
    from collections.abc import Sequence
    from pathlib import Path

    from numpy.typing import NDArray

    from localization.mapping.keyframes import Keyframe
    from maps import GridMap

LIST_FILE, PICTURE, DRIVE_FILE = "changes.json", "changes.png", "drive.npz"
_COLOURS = {"gone": (60, 60, 230), "new": (220, 120, 30), "floor": (140, 210, 140)}
"""Blue, green, red: gone is red, new is blue, floor seen for the first time is green."""
_GREYS = {FREE: 255, OCCUPIED: 0}
_UNKNOWN_GREY = 200
_LEAST_SIDE = 900
"""Pixels, so that a number can be read."""


@dataclass(frozen=True, slots=True)
class MendProposal:
    """Hold a mended map beside the one that it would replace."""

    base: str
    """map_id of the site as it was when this was worked out."""
    frame: GridMap
    """The site's map, wide enough for what was seen."""
    changes: tuple[MapChange, ...]
    """All that differ, in the order of their numbers."""
    left_out: frozenset[int]
    """Numbers of changes that a person does not want."""
    keyframes: tuple[Keyframe, ...]

    @property
    def accepted_changes(self) -> tuple[MapChange, ...]:
        """Return the changes that are carried out."""
        numbered = enumerate(self.changes, 1)
        return tuple(change for number, change in numbered if number not in self.left_out)

    @property
    def grid(self) -> GridMap:
        """Return the mended map."""
        return apply_changes(self.frame, self.accepted_changes)

    def map_files(self) -> dict[str, bytes]:
        """Return the mended map as a site's files."""
        grid = self.grid
        return {"map.yaml": map_yaml(grid), "map.pgm": map_picture(grid)}

    @property
    def id(self) -> str:
        """Return the map_id that the site would have."""
        files = self.map_files()
        return map_id(files["map.yaml"], files["map.pgm"])


def propose(
    base: str,
    grid: GridMap,
    keyframes: Sequence[Keyframe],
    lidar_m: tuple[float, float],
    left_out: frozenset[int] = frozenset(),
) -> MendProposal:
    """Compare a map with what a drive saw.

    Args:
        base: its map_id.
        grid: the map.
        keyframes: of the drive, in the map's frame.
        lidar_m: where the lidar is in ``base``.
        left_out: numbers of changes that a person does not want.

    Raises:
        SiteError: ``map_too_large`` or ``mend_change_unknown``.
    """
    try:
        frame = frame_around(grid, keyframes)
    except MapTooLarge as error:
        raise SiteError("map_too_large", str(error), error.zh) from error
    changes = find_changes(frame, keyframes, lidar_m)
    unknown = sorted(left_out - set(range(1, len(changes) + 1)))
    if unknown:
        text = f"{', '.join(map(str, unknown))}; there are changes 1 to {len(changes)}"
        zh = f"没有 {'、'.join(map(str, unknown))} 号变化；变化编号为 1 到 {len(changes)}"
        raise SiteError("mend_change_unknown", text, zh)
    return MendProposal(base, frame, changes, left_out, tuple(keyframes))


def keep(proposal: MendProposal, folder: Path, drive: bytes) -> None:
    """Write a proposal in the place of the last one.

    Raises:
        SiteError: ``site_unwritable``.
    """
    told = {
        "version": 1,
        "id": proposal.id,
        "base": proposal.base,
        "left_out": sorted(proposal.left_out),
        "changes": [_record(number, one) for number, one in enumerate(proposal.changes, 1)],
    }
    files = {
        **proposal.map_files(),
        DRIVE_FILE: drive,
        PICTURE: draw_picture(proposal),
        LIST_FILE: json.dumps(told, indent=1).encode(),
    }
    beside = folder.with_name(f".{folder.name}.new")
    try:
        shutil.rmtree(beside, ignore_errors=True)
        beside.mkdir(parents=True)
        for name, data in files.items():
            (beside / name).write_bytes(data)
        shutil.rmtree(folder, ignore_errors=True)
        os.replace(beside, folder)  # noqa: PTH105  # a kill before it loses a proposal, no map
    except OSError as error:
        shutil.rmtree(beside, ignore_errors=True)
        raise unwritable(folder, error) from error


def _record(number: int, change: MapChange) -> dict[str, Any]:
    return {
        "number": number,
        "kind": change.kind,
        "area_m2": round(change.area_m2, 3),
        "x_m": round(change.x_m, 3),
        "y_m": round(change.y_m, 3),
        "width_m": round(change.width_m, 3),
        "depth_m": round(change.depth_m, 3),
    }


def draw_picture(proposal: MendProposal) -> bytes:
    """Return a PNG of the map, y up: gone red, new blue, floor green, each with its number."""
    cells = cell_array(proposal.frame)
    greys = np.full(cells.shape, _UNKNOWN_GREY, np.uint8)
    for kind, grey in _GREYS.items():
        greys[cells == kind] = grey
    picture = np.repeat(greys[:, :, None], 3, axis=2)
    for change in proposal.changes:
        picture.reshape(-1, 3)[change.cells] = _COLOURS[change.kind]
    zoom = max(1, -(-_LEAST_SIDE // max(cells.shape)))
    large = np.ascontiguousarray(np.kron(picture[::-1], np.ones((zoom, zoom, 1), np.uint8)))
    for number, change in enumerate(proposal.changes, 1):
        left_out = number in proposal.left_out
        _write_number(large, proposal.frame, zoom, change, f"{number}{' x' if left_out else ''}")
    done, data = cv2.imencode(".png", large)
    if not done:
        raise OSError("OpenCV could not write a PNG")
    return data.tobytes()


def _write_number(
    picture: NDArray[np.uint8], frame: GridMap, zoom: int, change: MapChange, text: str
) -> None:
    column = (change.x_m - frame.origin_x_m) / frame.resolution_m
    row = frame.height - (change.y_m - frame.origin_y_m) / frame.resolution_m
    at = (int(column * zoom), int(row * zoom))
    for colour, width in (((255, 255, 255), 4), ((0, 0, 0), 1)):
        cv2.putText(picture, text, at, cv2.FONT_HERSHEY_SIMPLEX, 0.6, colour, width, cv2.LINE_AA)
