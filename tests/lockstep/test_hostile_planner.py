"""Six hostile planners on five homes break nothing, though they do drive."""

from __future__ import annotations

import pytest

from bench.measure.hostile_planner import attack


@pytest.mark.parametrize("seed", range(6))
def test_a_hostile_planner_breaks_no_law(seed: int) -> None:
    told = attack(seed, 8.0)
    assert told["broken"] == {}
    assert told["metres"] > 0.02, "or nothing was tried"
