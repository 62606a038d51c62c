"""The bench's floors are one piece, its searches agree, and a door that is shut is seen shut."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from tools.bench.measure.costmap import DoorPasses, made_floor, replan, search_times


def test_nearly_all_of_a_made_floor_is_joined_by_its_doors() -> None:
    costmap = made_floor(300)
    parts = np.bincount(costmap.labels[costmap.free])
    assert parts.max() >= 0.95 * costmap.free.sum()


def test_landmarks_change_no_cost() -> None:
    times = search_times(300, 6)
    assert times.landmarks == 8
    assert len(times.plain_s) == len(times.bounded_s) == 6
    assert times.worst_ratio == pytest.approx(1.0, abs=1e-4)


def test_a_crate_in_the_way_is_timed_from_its_standing_there_and_from_the_scan() -> None:
    taken = [one for seed in (1, 3) if (one := replan(seed)) is not None]
    assert taken, "else the bench would measure nothing"
    assert all(after_crate_s >= 0.5 for after_crate_s, _ in taken), "a doubt has to last"
    assert all(0.0 < after_scan_s < after_crate_s for after_crate_s, after_scan_s in taken)


def test_a_door_that_noise_passes_is_open_and_one_with_a_crate_in_it_closed(tmp_path: Path) -> None:
    passes = DoorPasses(tmp_path)
    assert not passes.is_closed(1)
    passes.put_crate()
    assert passes.is_closed(1)
