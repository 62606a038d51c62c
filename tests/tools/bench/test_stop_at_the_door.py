"""The table of stops names each way under each condition, and says what was lost."""

from __future__ import annotations

from typing import Any

from tools.bench.confirmation import CLI, HTTP, PAGE
from tools.bench.measure.stop_at_the_door import CONDITIONS, HUNG, NOBODY, _rows, ways_of


def run(**more: Any) -> dict[str, Any]:
    ways = {way: {"took_ms": [20.0, 30.0], "lost": 0} for way in (HTTP, CLI, PAGE)}
    return {**ways, "start_ms": 200.0, "beside": {"load": 1.0}, **more}


def test_a_hung_planner_is_asked_by_the_direct_way_alone() -> None:
    assert {name: ways_of(name) for name in CONDITIONS if len(ways_of(name)) != 3} == {HUNG: (CLI,)}
    [row] = _rows(HUNG, run())
    assert row.what == "hung planner: CLI"
    assert row.goal == "p99 <= 1500"
    assert "200 ms until it is loaded" in row.note


def test_a_lost_stop_makes_its_row_invalid_and_no_other() -> None:
    rows = _rows(NOBODY, run(**{PAGE: {"took_ms": [20.0], "lost": 1}}))
    assert [row.valid for row in rows] == [True, True, False]
    assert rows[2].note.startswith("1 of 2 not confirmed")
    assert "'load': 1.0" in rows[2].note
