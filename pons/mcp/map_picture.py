"""Draw the map as a picture: floor, walls, the names of rooms, and the robot."""

from __future__ import annotations

import base64
from typing import Any

import cv2
import numpy as np

LARGEST_PX = 1_000
SHADES = np.array([255, 40, 190], np.uint8)
"""Free, occupied, unknown: as the map route numbers them."""
INK, ROBOT = (150, 60, 20), (40, 40, 230)


def draw_map(grid: dict[str, Any], places: list[dict[str, Any]], robot: dict[str, Any]) -> bytes:
    """Return a PNG, north up."""
    shape = (int(grid["height"]), int(grid["width"]))
    cells = np.frombuffer(base64.b64decode(grid["cells"]), np.uint8).reshape(shape)
    shown = SHADES[np.minimum(cells, 2)][::-1]
    scale = max(1, LARGEST_PX // max(shape))
    picture = cv2.cvtColor(np.kron(shown, np.ones((scale, scale), np.uint8)), cv2.COLOR_GRAY2BGR)

    def at(x_m: float, y_m: float) -> tuple[int, int]:
        across = (x_m - grid["origin"]["x_m"]) / grid["resolution_m"]
        up = (y_m - grid["origin"]["y_m"]) / grid["resolution_m"]
        return int(across * scale), int((shape[0] - up) * scale)

    for place in places:
        pose = place.get("pose") or {}
        if "x_m" in pose:
            x, y = at(pose["x_m"], pose["y_m"])
            cv2.circle(picture, (x, y), 3, INK, -1)
            cv2.putText(picture, place["id"], (x + 5, y), cv2.FONT_HERSHEY_SIMPLEX, 0.45, INK, 1)
    base = (robot["status"] or {}).get("base_in_map")
    if base is not None:
        cv2.circle(picture, at(base["x_m"], base["y_m"]), 7, ROBOT, -1)
    done, png = cv2.imencode(".png", picture)
    if not done:
        raise ValueError("the map could not be drawn")
    return png.tobytes()
