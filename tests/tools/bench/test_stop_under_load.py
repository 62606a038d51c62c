"""What the stop measurement makes of its notes."""

from __future__ import annotations

import pytest

from tools.bench.measure.stop_under_load import slower
from tools.bench.stop_requests import Note


def notes(*said: tuple[float, float, str]) -> list[Note]:
    return list(said)


def test_the_first_slower_command_of_the_stop_counts() -> None:
    driving = [(0.01 * n, 0.4, "ACTIVE") for n in range(10)]
    curve = [(0.10, 0.35, "ACTIVE")]  # slower by itself: no answer to the stop
    stopping = [(0.11, 0.35, "STOPPING"), (0.12, 0.34, "STOPPING"), (0.13, 0.33, "STOPPING")]
    assert slower(notes(*driving, *curve, *stopping), 0.085) == pytest.approx(35.0)


def test_a_robot_that_was_not_driving_proves_nothing() -> None:
    assert slower(notes((0.0, 0.0, "HOLD"), (0.1, 0.0, "HOLD")), 0.05) == "moot"
    assert slower(notes(), 0.05) == "moot"


def test_a_stop_that_never_slows_is_lost() -> None:
    assert slower([(0.01 * n, 0.4, "ACTIVE") for n in range(900)], 1.0) == "lost"
