"""Every spot at a side of something is free floor near where it was asked for, and faces it."""

from __future__ import annotations

from functools import cache
from math import atan2, cos, hypot, sin

import pytest
from hypothesis import given
from hypothesis import strategies as st

from maps.grid import FREE
from planner.site import Site
from planner.site.site_view import facts_of
from planner.site.standing_spots import DOORWAY_M, REACH_M, StandingFloor, StandingSpot
from tests.conftest import ROOT
from wire import Pose2, wrap

SIDES = ("before", "beside", "behind")
FACTS = facts_of(Site.load(ROOT / "sites" / "home"))
PLACES = [target.id for target in FACTS.targets.values() if not target.room]


@cache
def floor() -> StandingFloor:
    assert FACTS.floor is not None
    return FACTS.floor


def assert_stands(spot: StandingSpot) -> None:
    grid, (x_m, y_m) = floor().site.grid, (spot.pose.x_m, spot.pose.y_m)
    for number in range(16):  # the whole disc of the robot is free
        angle = number / 16.0 * 6.2832
        for far_m in (0.0, 0.15, 0.3):
            assert grid.at(x_m + far_m * cos(angle), y_m + far_m * sin(angle)) == FREE
    assert floor().site.fence.allows(x_m, y_m)
    to = atan2(spot.face[1] - y_m, spot.face[0] - x_m)
    assert abs(wrap(to - spot.pose.yaw_rad)) < 1e-6, "it faces what it stands at"


@given(
    place=st.sampled_from(PLACES),
    side=st.sampled_from(SIDES),
    gap_m=st.one_of(st.none(), st.floats(0.0, 5.0)),
)
def test_a_spot_at_a_place_is_free_and_faces_it(place: str, side: str, gap_m: float | None) -> None:
    for spot in floor().spots(FACTS.targets[place].pose, side, gap_m):  # type: ignore[arg-type]
        assert_stands(spot)


def test_a_cell_whose_corner_alone_is_near_counts() -> None:
    """Found by chance: between the points of a lattice about the spot lay an occupied corner."""
    for spot in floor().spots(FACTS.targets["tv"].pose, "beside", 1.9453125):
        assert_stands(spot)


@given(
    x_m=st.floats(-5.0, 20.0), y_m=st.floats(-5.0, 20.0),
    yaw_rad=st.floats(-3.1, 3.1), side=st.sampled_from(SIDES),
    gap_m=st.floats(0.0, 5.0),
)  # fmt: skip
def test_whatever_is_asked_nothing_but_free_floor_is_given(
    x_m: float, y_m: float, yaw_rad: float, side: str, gap_m: float
) -> None:
    anchor = Pose2(x_m, y_m, yaw_rad)
    seen_from = Pose2(6.0, 4.75, 0.0)
    for spot in (
        *floor().spots(anchor, side, gap_m),  # type: ignore[arg-type]
        *floor().about((x_m, y_m), seen_from, side, gap_m),  # type: ignore[arg-type]
    ):
        assert_stands(spot)


@pytest.mark.parametrize(
    ("place", "side", "gap_m", "at"),
    [
        ("front_door", "before", 1.0, (10.1, 1.3)),
        ("desk", "before", None, (6.1, 8.65)),
        ("dining_table", "behind", None, (3.4, 3.45)),
    ],
)
def test_it_stands_where_a_person_means(
    place: str, side: str, gap_m: float | None, at: tuple[float, float]
) -> None:
    (spot, *_) = floor().spots(FACTS.targets[place].pose, side, gap_m)  # type: ignore[arg-type]
    assert hypot(spot.pose.x_m - at[0], spot.pose.y_m - at[1]) <= REACH_M


@pytest.mark.parametrize(
    ("place", "side", "gap_m"),
    [("sofa", "behind", None), ("front_door", "behind", None), ("sofa", "before", 1.0)],
)
def test_where_a_wall_or_furniture_is_there_is_none(
    place: str, side: str, gap_m: float | None
) -> None:
    assert floor().spots(FACTS.targets[place].pose, side, gap_m) == ()  # type: ignore[arg-type]


def test_beside_is_at_an_end_of_it() -> None:
    pose = FACTS.targets["sofa"].pose
    for spot in floor().spots(pose, "beside", None):
        assert not 0.8 <= spot.pose.x_m <= 3.0, "outside of the sofa's own width"


def test_beside_a_shut_door_is_before_its_wall_and_out_of_the_doorway() -> None:
    pose = FACTS.targets["front_door"].pose
    left, right = floor().spots(pose, "beside", None)
    assert left.pose.x_m > 10.1 + DOORWAY_M / 2.0 + floor().radius_m
    assert right.pose.x_m < 10.1 - DOORWAY_M / 2.0 - floor().radius_m
    for spot in (left, right):
        assert_stands(spot)
        assert spot.pose.y_m < 1.0, "at the door's wall, and not in the room's middle"
