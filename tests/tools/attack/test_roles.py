"""The table of who may do what, written twice, and the routes that it is tried on."""

from __future__ import annotations

import pytest

from planner.api.access import Access, AccessError
from tools.attack.roles import ASKERS, METHODS, all_requests, expected_status, fits

TOKENS = {"operator": "o" * 20, "viewer": "v" * 20, "wrong token": "w" * 20, "nobody": ""}
ACCESS = Access("127.0.0.1", operator_token=TOKENS["operator"], viewer_token=TOKENS["viewer"])


@pytest.mark.parametrize("asker", ASKERS)
def test_the_planners_own_rules_say_the_same(asker: str) -> None:
    for method, path in all_requests():
        kind = "audio/wav" if path == "/v1/voice" else "application/json"
        headers = {"host": "127.0.0.1", "content-type": kind}
        if TOKENS[asker]:
            headers["authorization"] = f"Bearer {TOKENS[asker]}"
        try:
            ACCESS.judge(method, path, headers)
            refused = None
        except AccessError as refusal:
            refused = refusal.status
        assert expected_status(asker, method, path) == refused


def test_every_route_of_the_contract_is_asked_with_every_method() -> None:
    found = list(all_requests())
    assert ("POST", "/v1/goals/x/confirm") in found
    assert len(found) == len(METHODS) * len({path for _, path in found})


def test_only_the_one_refusal_fits_and_no_crash_does() -> None:
    assert fits(401, 401)
    assert not fits(401, 200)
    assert not fits(401, 0)
    assert fits(None, 404)
    assert fits(None, 503)
    assert not fits(None, 403)
    assert not fits(None, 500)
    assert not fits(None, 0)
