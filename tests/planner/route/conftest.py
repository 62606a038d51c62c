"""Give the route tests the real sites, loaded once."""

from __future__ import annotations

from pathlib import Path

import pytest

from planner.route import RouteLimits
from planner.route.router import Router
from planner.world import Site

SITES = Path(__file__).resolve().parents[3] / "sites"


@pytest.fixture(scope="session")
def home() -> Site:
    return Site.load(SITES / "home")


@pytest.fixture(scope="session")
def home_router(home: Site) -> Router:
    return Router(home, RouteLimits())


@pytest.fixture(scope="session")
def two_room() -> Site:
    return Site.load(SITES / "two_room")
