"""Each answer carries the security headers, and what nothing takes is told what is taken."""

from __future__ import annotations

import pytest
from starlette.testclient import TestClient

from tests.planner.api.fakes import FakeServices
from tests.planner.api.served import client_of


@pytest.fixture
def client() -> TestClient:
    return client_of(FakeServices())


@pytest.mark.parametrize("asked", [("GET", "/v1/robot"), ("GET", "/none"), ("POST", "/v1/goals"),
                                   ("GET", "/v1/camera.jpg"), ("TRACE", "/v1/robot")])  # fmt: skip
@pytest.mark.parametrize("host", ["127.0.0.1:8420", "evil.example"])
def test_every_answer_carries_the_security_headers_and_is_not_stored(
    client: TestClient, asked: tuple[str, str], host: str
) -> None:
    answer = client.request(*asked, headers={"host": host})
    for name in ("content-security-policy", "x-content-type-options", "referrer-policy",
                 "x-frame-options", "cross-origin-resource-policy"):  # fmt: skip
        assert name in answer.headers, (name, answer.status_code)
    assert answer.headers["cache-control"] == "no-store"
    policy = answer.headers["permissions-policy"]
    assert "microphone=(self)" in policy
    assert "camera=()" in policy


def test_methods_that_nothing_takes_are_told_what_is_taken(client: TestClient) -> None:
    for method in ("TRACE", "FROB"):
        answer = client.request(method, "/v1/goals")
        assert (answer.status_code, answer.json()["code"]) == (405, "method_not_allowed")
        assert answer.headers["allow"] == "GET, POST"
