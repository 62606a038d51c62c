"""Hold how fast a window fills and drains."""

from __future__ import annotations

import pytest

from bridge.core.geometry.debounce import fill
from tests.bridge.core.table import table


@table(
    ("level_s", "dt_s", "top_s", "dirty", "after_s"),
    [
        (0.0, 0.01, 1.0, True, 0.01),
        (0.5, 0.04, 1.0, False, 0.49),
        (0.005, 0.04, 1.0, False, 0.0),
        (0.0, 9.0, 1.0, True, 0.05),
        (0.5, 9.0, 1.0, False, 0.4875),
        (0.5, -1.0, 1.0, True, 0.5),
        (0.99, 0.04, 1.0, True, 1.0),
    ],
)
def test_a_window_fills_four_times_as_fast_as_it_drains(
    level_s: float, dt_s: float, top_s: float, dirty: bool, after_s: float
) -> None:
    assert fill(level_s, dt_s, top_s, dirty=dirty) == pytest.approx(after_s)
