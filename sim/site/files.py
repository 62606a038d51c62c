"""Derive a site's files from its declaration, byte for byte the same every time.

Owns the formats map.yaml + map.pgm (Nav2 map server), places.yaml and fence.json on their writing
side. Nobody edits these files: two of them can then never disagree.
"""

from __future__ import annotations

import json
from typing import TYPE_CHECKING

from sim.site.outline import Polygon, allowed_rects, area_m2, trace
from sim.site.plan import rect
from sim.site.raster import RESOLUTION_M, MapRaster, draw
from sim.site.shapes import Rect
from sim.site.spec import pose2
from wire import map_id

if TYPE_CHECKING:
    from sim.site.spec import Home, HomePlace, PoseDeg, Room

MAP_YAML, MAP_PGM, PLACES_YAML, FENCE_JSON = "map.yaml", "map.pgm", "places.yaml", "fence.json"
_HEADER = "# Made from home.yaml by `python -m sim.site`; edit that file instead.\n"

FREE_THRESH = 0.196
"""As in Nav2's own maps: unknown is grey 205, occupancy 0.1961, and must not count as free."""


def site_files(home: Home) -> dict[str, bytes]:
    """Return every generated file of a checked home, by name."""
    grid = draw(home)
    yaml_bytes, pgm_bytes = _map_yaml(grid), _map_pgm(grid)
    map_name = map_id(yaml_bytes, pgm_bytes)
    return {
        MAP_YAML: yaml_bytes,
        MAP_PGM: pgm_bytes,
        PLACES_YAML: _places_yaml(home),
        FENCE_JSON: _fence_json(home, map_name),
    }


def _map_yaml(grid: MapRaster) -> bytes:
    text = (
        f"{_HEADER}image: {MAP_PGM}\nmode: trinary\nresolution: {RESOLUTION_M}\n"
        f"origin: [{grid.x0_m}, {grid.y0_m}, 0.0]\nnegate: 0\n"
        f"occupied_thresh: 0.65\nfree_thresh: {FREE_THRESH}\n"
    )
    return text.encode()


def _map_pgm(grid: MapRaster) -> bytes:
    rows, columns = grid.cells.shape
    # A picture's first row is the northern one; the grid's is the southern one.
    return f"P5\n{columns} {rows}\n255\n".encode() + grid.cells[::-1].tobytes()


def _corners(area: Rect) -> Polygon:
    return [(area.x0, area.y0), (area.x1, area.y0), (area.x1, area.y1), (area.x0, area.y1)]


def _places_yaml(home: Home) -> bytes:
    lines = [f"{_HEADER}version: 1\nhome: {home.dock}\nplaces:"]
    for room_id, room in home.rooms.items():
        lines += _entry(room_id, "room", room, room.pose)
        lines.append(f"  polygon: {json.dumps([list(p) for p in _corners(rect(room.box))])}")
    for place_id, place in home.places.items():
        lines += _entry(place_id, "place", place, place.pose)
    return ("\n".join(lines) + "\n").encode()


def _entry(item_id: str, kind: str, item: Room | HomePlace, pose: PoseDeg) -> list[str]:
    """Write one entry. JSON strings and lists are YAML, and quote what needs quoting."""
    at = pose2(pose)
    pose_text = f"{{x_m: {at.x_m}, y_m: {at.y_m}, yaw_rad: {round(at.yaw_rad, 6)}}}"
    return [
        f"- id: {item_id}",
        f"  kind: {kind}",
        f"  name: {{en: {_quote(item.name.en)}, zh: {_quote(item.name.zh)}}}",
        "  aliases:",
        f"    en: [{', '.join(map(_quote, item.aliases.en))}]",
        f"    zh: [{', '.join(map(_quote, item.aliases.zh))}]",
        f"  pose: {pose_text}",
    ]


def _quote(text: str) -> str:
    return json.dumps(text, ensure_ascii=False)


def _fence_json(home: Home, map_name: str) -> bytes:
    loops = trace(allowed_rects(home))
    holes = [loop for loop in loops if area_m2(loop) < 0]
    fence = {
        "version": 1,
        "map_id": map_name,
        "allowed": [loop for loop in loops if area_m2(loop) > 0],
        # A ring of rooms encloses walls: a hole in the allowed area is a keep-out.
        "keep_outs": holes + [_corners(rect(area.box)) for area in home.fence.keep_outs],
        "speed_zones": [
            {"polygon": _corners(rect(zone.box)), "max_speed_mps": zone.max_speed_mps}
            for zone in home.fence.speed_zones
        ],
    }
    lines = (f"  {json.dumps(key)}: {json.dumps(value)}" for key, value in fence.items())
    return ("{\n" + ",\n".join(lines) + "\n}\n").encode()
