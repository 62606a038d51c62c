"""Maps that others made load, or are refused for what they are."""

from __future__ import annotations

import json
from pathlib import Path

import cv2
import pytest

from maps import FREE, OCCUPIED, SiteError, load_map
from maps.cell_array import cell_array

SHARED = Path(__file__).resolve().parents[3] / "shared" / "data" / "maps"
FOREIGN = {
    "aws_small_house/map.yaml": (500, 500),
    "nav2_depot/depot.yaml": (604, 307),
    "nav2_depot_keepout/depot_keepout.yaml": (604, 307),
    "nav2_depot_speed/depot_speed.yaml": (604, 307),
    "nav2_map_server_test/invalid_image.yaml": "map_image_missing",
    "nav2_map_server_test/testmap.yaml": (15, 14),
    "nav2_systests/empty_room.yaml": "map_image_missing",
    "nav2_systests/keepout_mask.yaml": (384, 384),
    "nav2_systests/map_circular.yaml": (384, 384),
    "nav2_systests/speed_mask.yaml": (384, 384),
    "nav2_tb3_sandbox/tb3_sandbox.yaml": (384, 384),
    "turtlebot3_world/map.yaml": (384, 384),
}


@pytest.mark.parametrize("name", FOREIGN)
def test_maps_made_by_others_load_or_are_refused(name: str) -> None:
    if not SHARED.is_dir():
        pytest.skip("no foreign maps beside this checkout (../shared/data/maps)")
    wanted = FOREIGN[name]
    if isinstance(wanted, str):
        with pytest.raises(SiteError) as refused:
            load_map(SHARED / name)
        assert refused.value.code == wanted
        return
    loaded = load_map(SHARED / name)
    grid = loaded.grid
    assert (grid.width, grid.height) == wanted
    if loaded.record.mode == "trinary":  # a mask's shades are no ground that is known
        assert FREE in grid.cells
        assert OCCUPIED in grid.cells
    image = SHARED / name
    greys = cv2.imread(str(image.parent / loaded.record.image), cv2.IMREAD_GRAYSCALE)
    assert greys is not None
    if loaded.record.origin[2] == 0.0:
        assert not (greys[::-1][cell_array(grid) == FREE] == 205).any()


def test_every_foreign_map_is_listed_here() -> None:
    if not SHARED.is_dir():
        pytest.skip("no foreign maps beside this checkout (../shared/data/maps)")
    found = {path.relative_to(SHARED).as_posix() for path in SHARED.rglob("*.yaml")}
    assert found == set(FOREIGN), json.dumps(sorted(found))
