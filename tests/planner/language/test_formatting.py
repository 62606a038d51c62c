"""Figures are told as a person says them."""

from __future__ import annotations

import pytest

from planner.language.formatting import metres


@pytest.mark.parametrize(
    ("distance_m", "told"),
    [
        (2e-05, "0 m forward"),
        (-2e-05, "0 m backwards"),
        (-0.304, "0.3 m backwards"),
        (12.0, "12 m"),
    ],
)
def test_a_distance_is_told_to_the_centimetre(distance_m: float, told: str) -> None:
    assert metres(distance_m).en.startswith(told)
