"""The bench of exploring judges by the true floor, and the small site ends explored."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from tools.bench.measure.exploration import SITES, explore, true_floor
from wire import Pose2


def test_the_floor_is_what_is_joined_to_the_robot() -> None:
    floor = true_floor(SITES["two rooms"], Pose2(0.9, 0.8, 0.0))
    assert len(floor) * 0.05**2 == pytest.approx(15.1, abs=0.1)
    assert np.hypot(*(floor - (0.9, 0.8)).T).min() < 0.05


def test_one_sentence_explores_two_rooms(tmp_path: Path) -> None:
    found = explore(SITES["two rooms"], tmp_path / "canvas", seed=1)
    assert (found.code, found.orders, found.contacts) == ("explored", 1, 0)
    assert found.share > 0.97
    assert found.metres < 1.2 * found.floor_m2
