"""openapi.json tells every status that a route answers with."""

from __future__ import annotations

import json
import re
from itertools import product
from pathlib import Path
from typing import Any

import pytest
from starlette.testclient import TestClient

from planner.api import Access, build
from planner.api.access import SAFE_METHODS, TYPED_METHODS
from planner.api.error_schema import OWN_PROBLEMS
from tests.planner.api.fakes import FakeServices
from tests.planner.api.served import client_of

JSON = {"content-type": "application/json"}
HERE, LARGE = "127.0.0.1:8420", b" " * 300_000


@pytest.fixture(scope="module")
def operations(repository: Path) -> dict[tuple[str, str], dict[str, Any]]:
    paths = json.loads((repository / "openapi.json").read_text("utf-8"))["paths"]
    return {(verb, path): told for path, verbs in paths.items() for verb, told in verbs.items()}


def test_the_table_of_own_problems_names_real_routes(
    operations: dict[tuple[str, str], dict[str, Any]],
) -> None:
    assert set(OWN_PROBLEMS) <= {told["operationId"] for told in operations.values()}


def test_each_reference_leads_somewhere(repository: Path) -> None:
    text = (repository / "openapi.json").read_text("utf-8")
    known = json.loads(text)["components"]["schemas"]
    assert set(re.findall(r'"#/components/schemas/([^"]+)"', text)) <= set(known)


def test_no_route_takes_a_method_that_access_does_not_know() -> None:
    app = build(FakeServices(), Access("127.0.0.1"))
    taken = {method.upper() for verbs in app.openapi()["paths"].values() for method in verbs}
    assert taken <= TYPED_METHODS | SAFE_METHODS


@pytest.mark.nightly(keep=4)
@pytest.mark.parametrize(
    ("host", "headers", "content"),
    [
        *product((HERE,), ({}, JSON, {"content-type": "text/plain"}), (b"", b"{", b"{}", LARGE)),
        ("evil.example", JSON, b"{}"),
        ("evil.example", {}, LARGE),
    ],
)
def test_whatever_a_route_answers_is_told(
    operations: dict[tuple[str, str], dict[str, Any]],
    host: str,
    headers: dict[str, str],
    content: bytes,
) -> None:
    client: TestClient = client_of(FakeServices())
    for (verb, path), told in operations.items():
        named = path.replace("{", "no-").replace("}", "")
        answer = client.request(verb, named, headers={"host": host, **headers}, content=content)
        assert str(answer.status_code) in told["responses"], (verb, path, answer.text[:300])
