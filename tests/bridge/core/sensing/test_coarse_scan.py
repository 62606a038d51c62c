"""Say once that a lidar's beams are so far apart that things slip between them."""

from __future__ import annotations

from bridge.core.sensing.blind_sector import COARSE_RAD, coarse_words
from tests.bridge.core.scripted import World


def test_a_scan_of_few_beams_is_told_once() -> None:
    world = World().ready()
    told = [event for event in world.events if event.code == "scan_coarse"]
    assert [event.detail for event in told] == [coarse_words(0.08726646259971647)]
    assert "5 degrees between beams" in told[0].detail
    assert "0.09 m slips" in told[0].detail


def test_no_lidar_that_is_read_by_pons_is_called_coarse() -> None:
    assert COARSE_RAD > 6.2832 / 180
