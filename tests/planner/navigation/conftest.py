"""Give the route tests the real sites, loaded once."""

from __future__ import annotations

from pathlib import Path

import pytest

from planner.navigation import RouteLimits
from planner.navigation.costmap import Costmap, static_costmap
from planner.navigation.router import Router
from planner.site import Site

SITES = Path(__file__).resolve().parents[3] / "sites"


@pytest.fixture(scope="session")
def home() -> Site:
    return Site.load(SITES / "home")


@pytest.fixture(scope="session")
def home_router(home: Site) -> Router:
    return Router(home, RouteLimits())


@pytest.fixture(scope="session")
def home_costmap(home: Site) -> Costmap:
    """Return the map's costs, which no route changes: what is seen is put on a copy."""
    return static_costmap(home, RouteLimits().radius_m)


@pytest.fixture(scope="session")
def two_room() -> Site:
    return Site.load(SITES / "two_room")


@pytest.fixture(scope="session")
def two_room_router(two_room: Site) -> Router:
    return Router(two_room, RouteLimits())


@pytest.fixture(scope="session")
def two_room_costmap(two_room: Site) -> Costmap:
    return static_costmap(two_room, RouteLimits().radius_m)
