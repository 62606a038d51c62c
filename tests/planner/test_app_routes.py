"""The routes of a planner are built before it serves, not on its loop at the first requests."""

from __future__ import annotations

from typing import Any, cast

import pytest
from fastapi.dependencies.utils import get_dependant
from starlette.testclient import TestClient

from planner.api import Access
from planner.app import Planner, application
from tests.planner.api.fakes import FakeServices


def test_no_request_has_a_route_built(monkeypatch: pytest.MonkeyPatch) -> None:
    built: list[str] = []

    def noted(**given: Any) -> Any:
        built.append(given["path"])
        return get_dependant(**given)

    monkeypatch.setattr("fastapi.routing.get_dependant", noted)
    app = application(cast("Planner", FakeServices()), Access("127.0.0.1"))
    assert "/v1/goals" in built
    before = len(built)
    client = TestClient(app, base_url="http://127.0.0.1:8420")  # not entered: nothing is started
    assert client.get("/v1/robot").status_code == 200
    assert client.get("/nowhere").status_code == 404
    assert len(built) == before
