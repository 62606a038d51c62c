"""Run the search process: ``localization.search_process SITE``.

Started by :class:`localization.search_client.SearchClient` alone. A search takes 0.1 s of processor
in a home and seconds in a hospital: under the tracker's real-time priority it would starve others.
"""

from __future__ import annotations

from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from localization.distance_field import DistanceField
from localization.global_search import GlobalSearch, SearchArea
from maps import SiteError, load_map
from processes.worker_main import ParentPipes, run_worker

if TYPE_CHECKING:
    from processes.worker_protocol import Frame


def main(parent: ParentPipes, site: str) -> int:
    """Load the map, say ready, and answer until the input ends."""
    try:
        loaded = load_map(Path(site) / "map.yaml")
    except SiteError as error:
        return parent.refuse("search_unavailable", str(error))
    search = GlobalSearch(DistanceField.of_map(loaded.grid))
    parent.write({"ready": loaded.map_id})
    return parent.serve(partial(answer, search))


def answer(search: GlobalSearch, asked: Frame) -> Frame:
    """Return a frame of candidates for a frame with a scan's points."""
    head, body = asked
    points_m = np.frombuffer(body, np.float64).reshape(-1, 2)
    lidar_m = (float(head["lidar_m"][0]), float(head["lidar_m"][1]))
    near = None
    if head["around"] is not None:
        x_m, y_m, yaw_rad = map(float, head["around"])
        near = SearchArea(
            (x_m, y_m, yaw_rad),
            float(head["radius_m"]),
            bool(head["any_heading"]),
            tuple((float(x), float(y)) for x, y in head["outline"]),
        )
    found = search.find(points_m, lidar_m, near)
    return {"candidates": [[*one.pose, one.score] for one in found]}, b""


if __name__ == "__main__":
    run_worker(main)
