"""The whole map is searched; what is ambiguous is found and never sure."""

from __future__ import annotations

from math import hypot

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from localization.global_search import (
    Candidate,
    GlobalSearch,
    SearchArea,
    is_inside,
    is_sure,
    keep_separate,
)
from planner.site.polygon import contains
from tests.localization.rooms import ROOM, TWINS, cast, field_of, points_of
from wire import Pose2, wrap

LIDAR = (0.0, 0.0)
SEARCH = GlobalSearch(field_of(ROOM, 6.0, 4.0))


@pytest.mark.parametrize(
    "true", [Pose2(2.6, 1.7, 0.4), Pose2(5.0, 3.1, -2.0), Pose2(0.7, 0.6, 3.0)]
)
def test_it_finds_the_robot_anywhere_and_is_sure(true: Pose2) -> None:
    found = SEARCH.everywhere(points_of(cast(ROOM, true)), LIDAR)
    x_m, y_m, yaw = found[0].pose
    assert hypot(x_m - true.x_m, y_m - true.y_m) < 0.06
    assert abs(wrap(yaw - true.yaw_rad)) < 0.03
    assert is_sure(found)


def test_of_two_equal_rooms_both_are_found_and_neither_is_sure() -> None:
    search = GlobalSearch(field_of(TWINS, 8.0, 3.0))
    found = search.everywhere(points_of(cast(TWINS, Pose2(1.8, 1.6, 0.3))), LIDAR)
    assert {round(one.pose[0]) for one in found[:2]} == {2, 6}
    assert not is_sure(found)


def test_a_persons_word_settles_it_and_a_wrong_word_does_not() -> None:
    search = GlobalSearch(field_of(TWINS, 8.0, 3.0))
    points = points_of(cast(TWINS, Pose2(1.8, 1.6, 0.3)))
    (near,) = search.around(points, LIDAR, np.array((2.1, 1.4, 0.5)), 1.0)
    assert near.pose[:2] == pytest.approx((1.8, 1.6), abs=0.06)
    assert near.score > 0.95
    wrong = search.around(points, LIDAR, np.array((3.2, 2.3, -1.6)), 0.3)
    assert not wrong or wrong[0].score < 0.6
    assert search.around(np.empty((0, 2)), LIDAR, np.zeros(3), 1.0) == ()


def test_without_returns_or_floor_there_is_no_place() -> None:
    assert SEARCH.everywhere(np.empty((0, 2)), LIDAR) == ()
    walled = GlobalSearch(field_of(((0.0, 0.0, 1.0, 1.0),), 1.0, 1.0))
    assert walled.everywhere(np.ones((40, 2)), LIDAR) == ()


def test_sure_is_a_lead_and_a_good_score() -> None:
    def made(*scores: float) -> tuple[Candidate, ...]:
        return tuple(Candidate((0.0, 0.0, 0.0), score) for score in scores)

    assert not is_sure(())
    assert not is_sure(made(0.59))
    assert is_sure(made(0.65))
    for best, lead in ((0.65, 0.20), (0.79, 0.20), (0.85, 0.12), (0.95, 0.06), (1.0, 0.06)):
        assert is_sure(made(best, best - lead - 0.001))
        assert not is_sure(made(best, best - lead + 0.001))


def test_poses_of_one_place_count_once() -> None:
    poses = np.array([(0.0, 0.0, 3.1), (0.1, 0.0, -3.1), (0.1, 0.0, 1.0), (2.0, 0.0, 3.1)])
    assert keep_separate(poses, 0.5, 0.3, 9)[:, 0].tolist() == [0.0, 0.1, 2.0]
    assert len(keep_separate(poses, 0.5, 0.3, 2)) == 2


def test_a_search_in_a_room_finds_nothing_beside_it() -> None:
    """Two rooms the same to the centimetre: the outline decides which of them is meant."""
    search = GlobalSearch(field_of(TWINS, 8.0, 3.0))
    points = points_of(cast(TWINS, Pose2(1.8, 1.6, 0.3)))
    left = ((0.1, 0.1), (3.9, 0.1), (3.9, 2.9), (0.1, 2.9))
    right = ((4.1, 0.1), (7.9, 0.1), (7.9, 2.9), (4.1, 2.9))
    for outline, x_m in ((left, 1.8), (right, 5.8)):
        found, *_ = search.find(points, LIDAR, SearchArea((4.0, 1.5, 0.0), 5.0, True, outline))
        assert found.pose[:2] == pytest.approx((x_m, 1.6), abs=0.05)
    assert search.find(points, LIDAR, SearchArea((4.0, 1.5, 0.0), 0.2, True, left)) == ()


@given(st.lists(st.tuples(st.floats(-3, 3), st.floats(-3, 3)), min_size=1, max_size=20))
def test_inside_means_the_same_as_elsewhere(points: list[tuple[float, float]]) -> None:
    outline = ((-2.0, -2.0), (2.0, -2.0), (2.0, 0.0), (0.0, 0.0), (0.0, 2.0), (-2.0, 2.0))
    told = is_inside(np.array(points), outline)
    assert told.tolist() == [contains(outline, x, y) for x, y in points]
