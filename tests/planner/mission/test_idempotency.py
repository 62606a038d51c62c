"""Check that a key stands for one request, and that what is remembered is bounded."""

from __future__ import annotations

import pytest

from planner.mission import idempotency
from planner.mission.errors import IdempotencyConflict
from planner.mission.idempotency import Repeats, body_of
from planner.mission.journal import GoalKey
from planner.plan import Language


def test_a_key_stands_for_one_request_until_it_is_forgotten() -> None:
    known = Repeats([GoalKey("old", "body", "g0")])
    assert known.goal_of("old", "body") == "g0"
    assert known.remember("new", "other", "g1") == GoalKey("new", "other", "g1")
    assert known.goal_of("new", "other") == "g1"
    with pytest.raises(IdempotencyConflict):
        known.goal_of("new", "body")
    known.forget("new")
    assert known.goal_of("new", "body") is None


def test_without_a_key_every_request_is_another() -> None:
    known = Repeats()
    assert known.remember(None, "body", "g1") is None
    known.forget(None)
    assert known.goal_of(None, "body") is None


def test_the_oldest_are_forgotten_first(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(idempotency, "MAX_KEYS", 2)
    known = Repeats([GoalKey("a", "body", "g0")])
    for key in ("b", "c"):
        known.remember(key, "body", key)
    assert [known.goal_of(key, "body") for key in "abc"] == [None, "b", "c"]


def test_every_part_of_a_request_tells_it_from_another() -> None:
    bodies = {
        body_of(text, language, confirm, replace)
        for text in ("go", "go ")
        for language in Language
        for confirm in (False, True)
        for replace in (False, True)
    }
    assert len(bodies) == 2 * len(Language) * 4
