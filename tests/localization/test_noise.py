"""The stand-in's error has the stated size and memory, and never jumps."""

from __future__ import annotations

from math import exp, hypot, radians

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.typing import NDArray

from localization import NoiseParams, PoseNoise
from wire import IDENTITY, wrap

STEP_S = 0.05


def errors(seed: int, steps: int, step_s: float = STEP_S) -> NDArray[np.float64]:
    noise = PoseNoise(seed)
    rows = []
    for _ in range(steps):
        noise.advance(step_s)
        at = noise.disturb(IDENTITY)
        rows.append((at.x_m, at.y_m, at.yaw_rad))
    return np.array(rows)


def test_its_size_and_its_memory_are_as_stated() -> None:
    # 20 runs of 200 s: about 400 independent draws per axis, so 3 sigma of the estimate is 11 %.
    drawn = [errors(seed, 4000) for seed in range(20)]
    size = np.sqrt(np.mean([np.mean(one**2, axis=0) for one in drawn], 0))
    assert size == pytest.approx([0.02, 0.02, radians(0.5)], rel=0.12)
    runs = np.concatenate([one[:, :2].T for one in drawn])
    for lag_s in (1.0, 5.0):
        lag = round(lag_s / STEP_S)
        correlation = np.sum(runs[:, lag:] * runs[:, :-lag]) / np.sum(runs[:, :-lag] ** 2)
        assert correlation == pytest.approx(exp(-lag_s / 5.0), abs=0.1)


def test_it_begins_with_the_spread_that_it_keeps() -> None:
    first = np.array([PoseNoise(seed).disturb(IDENTITY).x_m for seed in range(400)])
    assert np.std(first) == pytest.approx(0.02, rel=0.15)


def test_it_is_the_seeds() -> None:
    assert np.array_equal(errors(3, 50), errors(3, 50))
    assert not np.array_equal(errors(3, 50), errors(4, 50))


@given(st.integers(0, 2**32 - 1), st.lists(st.floats(-1e3, 1e6), min_size=1, max_size=100))
def test_no_gap_makes_it_jump(seed: int, gaps_s: list[float]) -> None:
    noise = PoseNoise(seed)
    before = noise.disturb(IDENTITY)
    for gap_s in gaps_s:
        noise.advance(gap_s)
        after = noise.disturb(IDENTITY)
        # A quarter of what the bridge calls a jump (0.1 m, 5 degrees).
        assert hypot(after.x_m - before.x_m, after.y_m - before.y_m) < 0.05
        assert abs(wrap(after.yaw_rad - before.yaw_rad)) < radians(1.25)
        before = after


def test_other_sizes_may_be_asked_for() -> None:
    still = PoseNoise(1, NoiseParams(position_m=0.0, yaw_rad=0.0))
    still.advance(1.0)
    assert still.disturb(IDENTITY) == IDENTITY
