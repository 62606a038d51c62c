"""Share the world of a mission and the site it drives in."""

from __future__ import annotations

from functools import partial
from pathlib import Path

import pytest

from planner.site import Site
from tests.planner.mission.live import Starter, planner
from tests.planner.mission.lockstep import Together


@pytest.fixture
def world() -> Together:
    world = Together()
    world.run(0.2)
    assert world.bridge.owner == "p1"
    return world


@pytest.fixture(scope="module")
def site(repository: Path) -> Site:
    return Site.load(repository / "sites" / "two_room")


@pytest.fixture
def start(tmp_path: Path, site: Site) -> Starter:
    return partial(planner, tmp_path, site)
