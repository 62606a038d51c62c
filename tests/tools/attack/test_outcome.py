"""A goal is met by what was tried and held, and by nothing else."""

from __future__ import annotations

import json

import pytest

from tools.attack.outcome import AttackOutcome, table


@pytest.mark.parametrize(("after_mb", "met"), [(50.0, True), (60.0, True), (60.1, False)])
def test_memory_may_grow_by_its_bound_and_no_more(after_mb: float, met: bool) -> None:
    assert AttackOutcome("a", 1, 0, "0", 50.0, after_mb).is_met is met


def test_a_missing_tool_is_said_and_is_no_failure() -> None:
    skipped = AttackOutcome("a", 0, 0, "0", skipped=True)
    assert skipped.is_met
    assert "skipped" in table([skipped])


def test_zero_of_n_comes_with_what_it_means() -> None:
    assert "3.0e-06" in table([AttackOutcome("a", 1_000_000, 0, "0")])
    assert "3.0e-06" not in table([AttackOutcome("a", 1_000_000, 1, "0")])


def test_a_record_is_json_and_says_whether_the_goal_was_met() -> None:
    record = json.loads(json.dumps(AttackOutcome("a", 1, 1, "0").record()))
    assert record["met"] is False
