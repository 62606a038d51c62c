"""A run of the bench in which a slow lidar has a hole tells of it and touches nothing."""

from __future__ import annotations

import pytest

from tools.bench.measure.blind_sector import contact_run

pytestmark = pytest.mark.nightly


def test_a_hole_in_a_lidar_whose_scans_begin_elsewhere_each_time_is_told() -> None:
    run = contact_run(25)
    assert (run["robot"], run["way"]) == ("pons_mcu_rplidar_a1", "backwards")
    assert (run["contacts"], run["told"]) == (0, True)
