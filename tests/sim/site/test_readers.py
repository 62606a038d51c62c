"""Every process that reads a site's files accepts them and means the same by them."""

from __future__ import annotations

from pathlib import Path

import pytest

from bridge.fence_file import load_fence
from planner.site import FREE, Site
from sim.site import load_home
from sim.site.check import spots
from wire.site_map import read_map_id


@pytest.fixture(params=["home", "two_room"])
def site_dir(request: pytest.FixtureRequest, repository: Path) -> Path:
    return repository / "sites" / str(request.param)


def test_planner_bridge_and_localization_agree_on_map_and_fence(site_dir: Path) -> None:
    site = Site.load(site_dir)
    fence, fence_hash = load_fence(site_dir / "fence.json")
    assert site.map_id == fence.map_id == read_map_id(site_dir)
    assert site.fence.fence_hash == fence_hash


def test_every_pose_is_free_and_well_inside_the_fence(site_dir: Path) -> None:
    site = Site.load(site_dir)
    for name, (x_m, y_m, _) in spots(load_home(site_dir)).items():
        assert site.grid.at(x_m, y_m) == FREE, name
        assert site.fence.allows(x_m, y_m), name
        assert site.fence.border_distance_m(x_m, y_m) >= 0.25 - 1e-9, name


def test_a_doorway_leaves_the_fence_open_in_its_middle(site_dir: Path) -> None:
    site = Site.load(site_dir)
    for door in load_home(site_dir).doors:
        # The narrowest door, 0.90 m, leaves a band of 0.60 m to the robot's centre: driving down
        # its middle stays clear of the 0.15 m at which the fence's gate closes.
        assert site.fence.allows(*door.at)
        assert site.fence.border_distance_m(*door.at) >= 0.30 - 1e-9
