"""Lend services that remember what they were asked, and a client of their routes."""

from __future__ import annotations

from collections.abc import Iterator

import pytest
from starlette.testclient import TestClient

from tests.planner.api.fakes import FakeServices
from tests.planner.api.served import client_of
from tests.planner.api.serving import Served, served


@pytest.fixture
def services() -> FakeServices:
    return FakeServices()


@pytest.fixture
def client(services: FakeServices) -> Iterator[TestClient]:
    """Return a client of the services; a file may have services of its own."""
    with client_of(services) as made:
        yield made


@pytest.fixture
def server() -> Iterator[Served]:
    with served() as running:
        yield running


@pytest.fixture(scope="module")
def shared_server() -> Iterator[Served]:
    """Serve those tests of a file that count nothing on it."""
    with served() as running:
        yield running
