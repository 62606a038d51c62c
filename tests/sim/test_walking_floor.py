"""A person walks round a robot wherever there is room for both, and nowhere else."""

from __future__ import annotations

from itertools import pairwise
from math import hypot

import pytest

from pons.settings import CHECKOUT
from sim.site.load import load_home
from sim.walking_floor import WalkingFloor

ROOM_M = 0.65
"""Of a walker round a robot of 0.30 m: both radii and a hand's width."""


@pytest.fixture(scope="module")
def floor() -> WalkingFloor:
    return WalkingFloor(load_home(CHECKOUT / "sites" / "home"))


@pytest.mark.parametrize("robot_y_m", [4.40, 4.44, 4.47, 5.03, 5.08])
def test_beside_a_robot_at_a_wall_of_the_hallway_there_is_a_way(
    floor: WalkingFloor, robot_y_m: float
) -> None:
    start, disc = (5.36, 4.80), (4.83, robot_y_m, ROOM_M)
    way = floor.way_round(start, (1.6, 4.7), disc, 3.0)
    assert way
    assert hypot(way[-1][0] - 1.6, way[-1][1] - 4.7) <= 0.15
    for (ax, ay), (bx, by) in pairwise(way):
        for step in range(21):
            x_m, y_m = ax + (bx - ax) * step / 20, ay + (by - ay) * step / 20
            assert hypot(x_m - disc[0], y_m - disc[1]) >= ROOM_M - 0.03


def test_past_a_robot_in_the_middle_there_is_none(floor: WalkingFloor) -> None:
    assert not floor.way_round((5.6, 4.80), (1.6, 4.7), (4.83, 4.75, ROOM_M), 3.0)
