"""Laws of placing a robot anew: by a person's word, or where it was lost without having driven."""

from __future__ import annotations

import numpy as np
import pytest

from localization.global_search import Candidate, GlobalSearch
from localization.localizer import DOUBT_SEARCH_PAUSE_S, Localizer, LocalizerState
from localization.quality import ENOUGH_SCORE, KEPT_SCORE
from localization.relocation import PlacedBase, SearchRequest, is_elsewhere, known_place
from tests.localization.rooms import MAP_ID, TWINS, Boxes, field_of
from tests.localization.test_localizer import (
    ELSEWHERE,
    START,
    Drive,
    drive,
    hint,
    settled_drive,
)
from wire import IDENTITY, Pose2
from wire.lidar_config import LidarConfig

__all__ = ["drive", "settled_drive"]
UNDER_A_COAT = tuple(
    (START.x_m + x0, START.y_m + y0, START.x_m + x1, START.y_m + y1)
    for x0, y0, x1, y1 in (
        (-0.4, -0.4, 0.5, -0.3), (-0.4, 0.3, 0.5, 0.4),
        (-0.4, -0.4, -0.3, 0.4), (0.4, -0.4, 0.5, 0.4),
    )
)  # fmt: skip


def test_a_place_is_carried_on_by_odometry() -> None:
    placed = PlacedBase(Pose2(1.0, 2.0, 0.0), Pose2(5.0, 5.0, 0.0))
    assert placed.at(Pose2(5.5, 5.0, 0.0)) == Pose2(1.5, 2.0, 0.0)
    assert placed.at(Pose2(5.0, 5.0, 0.0)) == placed.in_map


def test_a_question_without_a_hint_is_about_the_whole_map() -> None:
    points_m = np.zeros((2, 2))
    assert SearchRequest.of_hint(3, points_m, None).around is None
    asked = SearchRequest.of_hint(3, points_m, hint("a", START, 0.7, any_heading=True))
    assert (asked.around, asked.radius_m, asked.any_heading) == (START, 0.7, True)


@pytest.mark.parametrize("carried_to", [None, Pose2(6.9, 1.9, 2.0)])
def test_of_rooms_that_look_alike_a_robot_that_drove_nowhere_is_in_the_one_it_was_in(
    carried_to: Pose2 | None,
) -> None:
    """Lost under a coat that lay on it; and where it was carried away meanwhile, it stays lost."""
    field = field_of(TWINS, 8.0, 3.0)
    drive = Drive()
    drive.search, drive.localizer = GlobalSearch(field), Localizer(field, LidarConfig(), MAP_ID)
    drive.boxes = TWINS
    drive.localizer.hear_hint(hint("here", START, 1.0))
    drive.run(0.3)
    drive.localizer.hear_hint(hint("here-1", START, 1.0))
    drive.run(1.0)
    assert drive.error_m() < 0.03
    drive.boxes = UNDER_A_COAT
    drive.run(1.0)
    assert drive.localizer.state is LocalizerState.LOST
    drive.boxes, drive.true = TWINS, carried_to or START
    drive.run(2.0)
    found = LocalizerState.TRACKING if carried_to is None else LocalizerState.LOST
    assert drive.localizer.state is found
    assert carried_to is not None or drive.error_m() < 0.03


def test_a_persons_word_counts_where_scans_agree(drive: Drive) -> None:
    drive.searching = False
    drive.true = ELSEWHERE
    drive.run(1.0)
    assert drive.localizer.state is LocalizerState.LOST
    drive.searching = True
    drive.localizer.hear_hint(hint("here-1", Pose2(4.6, 3.3, -1.7), 1.0))
    drive.run(0.5)
    answer = drive.localizer.hint_answer
    assert answer is not None
    assert (answer.id, answer.code) == ("here-1", "accepted")
    assert drive.error_m() < 0.03
    drive.localizer.hear_hint(hint("here-2", Pose2(1.0, 1.0, 0.0), 0.3))
    drive.run(0.5)
    assert drive.localizer.hint_answer is not None
    assert drive.localizer.hint_answer.code == "does_not_fit"
    assert drive.error_m() < 0.03, "the pose stays"


def test_who_says_where_need_not_say_which_way_it_looks(drive: Drive) -> None:
    drive.searching = False
    drive.true = ELSEWHERE
    drive.run(1.0)
    drive.searching = True
    drive.localizer.hear_hint(hint("here-1", Pose2(4.4, 3.0, 0.0), 1.2, any_heading=True))
    drive.run(0.5)
    assert drive.localizer.hint_answer is not None
    assert drive.localizer.hint_answer.code == "accepted"
    assert drive.error_m() < 0.03


HALL: Boxes = (
    (0.0, 0.0, 5.4, 0.1), (0.0, 4.3, 5.4, 4.4), (0.0, 0.0, 0.1, 4.4), (5.3, 0.0, 5.4, 4.4),
)  # fmt: skip
"""A bare room, which looks the same when it is turned by half."""
IN_HALL = Pose2(1.7, 1.5, 0.4)


def hall() -> Drive:
    field, robot = field_of(HALL, 5.4, 4.4), Drive()
    robot.search, robot.localizer = GlobalSearch(field), Localizer(field, LidarConfig(), MAP_ID)
    robot.boxes, robot.true = HALL, IN_HALL
    robot.run(1.0)
    return robot


def answer_code(drive: Drive) -> str:
    assert drive.localizer.hint_answer is not None
    return drive.localizer.hint_answer.code


def test_a_word_that_fits_two_places_alike_is_taken_for_neither() -> None:
    """The robot would be sure of a pose half a turn and a metre off, and drive by it."""
    drive = hall()
    assert drive.localizer.state is LocalizerState.SEARCHING
    drive.localizer.hear_hint(hint("hall", Pose2(2.7, 2.2, 0.0), 3.0, any_heading=True))
    drive.run(1.0)
    assert answer_code(drive) == "ambiguous"
    assert drive.localizer.state is LocalizerState.SEARCHING
    drive.localizer.hear_hint(hint("here", IN_HALL, 0.5, any_heading=True))
    drive.run(1.0)
    assert answer_code(drive) == "accepted"
    assert drive.error_m() < 0.03
    drive.localizer.hear_hint(hint("hall-2", Pose2(2.7, 2.2, 0.0), 3.0, any_heading=True))
    drive.run(1.0)
    assert answer_code(drive) == "accepted", "who knows where it is stays there"
    assert drive.error_m() < 0.03


def test_a_pose_that_scans_confirm_yields_to_none_that_they_confirm_less(drive: Drive) -> None:
    """The person says the other end of a room that looks much alike: the scan decides."""
    drive.localizer.hear_hint(hint("here-1", Pose2(4.4, 2.0, 0.0), 1.5, any_heading=True))
    drive.run(0.5)
    assert drive.localizer.hint_answer is not None
    assert drive.localizer.hint_answer.code == "does_not_fit"
    assert drive.error_m() < 0.03
    assert min(one.quality for one in drive.said) >= 0.0


def test_the_same_hint_said_again_is_answered_once(drive: Drive) -> None:
    word = hint("here-1", START, 1.0)
    for _ in range(5):
        drive.localizer.hear_hint(word)
        drive.run(0.1)
    answered = drive.localizer.hint_answer
    drive.localizer.hear_hint(word)
    drive.run(0.5)
    assert drive.localizer.hint_answer is answered


def test_a_thousand_hints_a_second_move_the_pose_nowhere_and_cost_one_answer_each(
    drive: Drive,
) -> None:
    for number in range(1000):
        drive.localizer.hear_hint(hint(f"here-{number}", Pose2(4.4, 2.0, 0.0), 0.3))
        if number % 100 == 0:
            drive.run(0.1)
    drive.run(0.5)
    assert drive.localizer.hint_answer is not None
    assert drive.localizer.hint_answer.code == "does_not_fit"
    assert drive.error_m() < 0.03


def test_a_persons_word_is_refused_in_motion_and_before_a_scan(drive: Drive) -> None:
    Drive().localizer.hear_hint(hint("a", START, 1.0))
    early = Drive().localizer
    early.hear_hint(hint("here-1", START, 1.0))
    assert early.hint_answer is not None
    assert early.hint_answer.code == "no_scan"
    drive.turn(Pose2(0.02, 0.0, 0.0))
    drive.localizer.hear_hint(hint("here-2", START, 1.0))
    assert drive.localizer.hint_answer is not None
    assert drive.localizer.hint_answer.code == "moving"


def test_a_word_that_no_scan_comes_to_judge_is_answered_so(drive: Drive) -> None:
    drive.blind = True
    drive.run(1.2)
    drive.localizer.hear_hint(hint("here-1", START, 1.0))
    drive.run(0.05)
    assert answer_code(drive) == "no_scan"
    drive.blind = False
    drive.run(0.5)
    drive.localizer.hear_hint(hint("here-2", START, 1.0))
    drive.blind = True
    drive.run(1.2)
    assert answer_code(drive) == "no_scan", "the lidar fell silent after the word"
    drive.blind = False
    drive.run(0.3)
    drive.localizer.hear_hint(hint("here-3", START, 1.0))
    drive.run(1.0)
    assert answer_code(drive) == "accepted"


def test_answers_that_nobody_waits_for_change_nothing(drive: Drive) -> None:
    drive.localizer.hear_candidates(999, (Candidate((1.0, 1.0, 0.0), 1.0),))
    drive.run(0.3)
    assert drive.error_m() < 0.03


TRACKED = PlacedBase(Pose2(2.0, 2.0, 0.0), IDENTITY)
NEAR, FAR = (2.3, 1.9, 0.2), (6.0, 2.0, 0.0)


@pytest.mark.parametrize(
    ("candidates", "known"),
    [
        (((NEAR, 0.7), (FAR, 0.69)), 0),
        (((FAR, 0.72), (NEAR, 0.7)), 1),
        (((FAR, 0.8), (NEAR, 0.7)), None),
        (((NEAR, 0.55),), None),
        ((), None),
    ],
)
def test_the_place_where_it_was_counts_where_none_fits_better(
    candidates: tuple[tuple[tuple[float, float, float], float], ...], known: int | None
) -> None:
    found = tuple(Candidate(*one) for one in candidates)
    expected = None if known is None else found[known]
    assert known_place(TRACKED, found, IDENTITY) is expected


def test_only_a_sure_and_far_place_says_that_a_tracked_robot_was_carried() -> None:
    sure = (Candidate(FAR, 0.95), Candidate(NEAR, 0.5))
    assert is_elsewhere(TRACKED, sure, IDENTITY, 0.65)
    assert not is_elsewhere(TRACKED, sure, IDENTITY, 0.96), "it fits no better"
    assert not is_elsewhere(TRACKED, (Candidate(FAR, 0.7), Candidate(NEAR, 0.6)), IDENTITY, 0.65)
    assert not is_elsewhere(TRACKED, (Candidate(NEAR, 0.95),), IDENTITY, 0.65)
    assert not is_elsewhere(TRACKED, (), IDENTITY, 0.65)
    assert not is_elsewhere(TRACKED, sure, Pose2(4.0, 0.0, 0.0), 0.65), "odometry went there"


def test_a_robot_carried_to_where_the_map_half_agrees_is_soon_found(drive: Drive) -> None:
    """Half of the view agrees with where it is thought to be: tracked, and the map is asked."""
    drive.run(DOUBT_SEARCH_PAUSE_S)  # since the search that placed it
    drive.true = Pose2(3.5, 0.8, -2.5)
    while drive.localizer.score > ENOUGH_SCORE:
        drive.turn()
    assert drive.localizer.score >= KEPT_SCORE, "it is tracked on, at a wrong place"
    drive.run(1.0)
    assert drive.localizer.state is LocalizerState.TRACKING
    assert drive.error_m() < 0.05
    assert min(word.quality for word in drive.said[-25:]) == 0.0, "the bridge holds first"
