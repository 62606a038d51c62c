"""Score detections whose result is known by hand."""

from __future__ import annotations

from typing import Any

import pytest

from tools.train.score import (
    ScoredThing,
    TrueThing,
    average_precision,
    false_in_empty,
    mean_average_precision,
    overlap,
    scores,
)

CUP = TrueThing("cup", (0.0, 0.0, 10.0, 10.0))
BALL = TrueThing("ball", (50.0, 50.0, 70.0, 70.0))
HIDDEN = TrueThing("cup", (100.0, 0.0, 140.0, 40.0), asked=False)
HALF = {"cup": 0.5, "ball": 0.5}


def cup(score: float, x: float = 0.0, y: float = 0.0) -> ScoredThing:
    return ScoredThing("cup", score, (x, y, x + 10.0, y + 10.0))


@pytest.mark.parametrize(
    ("other", "share"),
    [
        ((0.0, 0.0, 10.0, 10.0), 1.0),
        ((0.0, 0.0, 10.0, 5.0), 0.5),
        ((5.0, 0.0, 15.0, 10.0), 1 / 3),
        ((10.0, 0.0, 20.0, 10.0), 0.0),
        ((4.0, 4.0, 4.0, 9.0), 0.0),
        ((8.0, 8.0, 2.0, 2.0), 0.0),
    ],
)
def test_overlap(other: tuple[float, float, float, float], share: float) -> None:
    assert overlap(CUP.box, other) == pytest.approx(share)


@pytest.mark.parametrize(
    ("told", "asked", "area"),
    [
        ([], 3, 0.0),
        ([(0.9, True)], 1, 1.0),
        ([(0.9, True)], 2, 0.5),
        ([(0.9, False), (0.8, True)], 1, 0.5),
        ([(0.9, True), (0.8, False), (0.7, True)], 2, 0.5 + 0.5 * 2 / 3),
        # Precision rises from 1/2 to 3/5 later on; what is before it counts as 3/5 too.
        ([(0.9, False), (0.8, True), (0.7, False), (0.6, True), (0.5, True)], 3, 0.6),
    ],
)
def test_area_under_precision_and_recall(
    told: list[tuple[float, bool]], asked: int, area: float
) -> None:
    assert average_precision(told, asked) == pytest.approx(area)


def test_a_thing_is_found_once_and_by_the_surest() -> None:
    found = scores([([CUP, BALL], [cup(0.6), cup(0.9, 1.0)])], HALF)
    assert found["cup"].average_precision == 1.0
    assert (found["cup"].recall, found["cup"].precision) == (1.0, 0.5)
    assert (found["ball"].average_precision, found["ball"].precision) == (0.0, 1.0)
    assert mean_average_precision(found) == 0.5


def test_the_wrong_class_and_the_wrong_place_are_false() -> None:
    elsewhere = [ScoredThing("ball", 0.9, CUP.box), cup(0.9, 4.0)]
    found = scores([([CUP, BALL], elsewhere)], HALF)
    assert mean_average_precision(found) == 0.0
    assert (found["cup"].precision, found["ball"].precision) == (0.0, 0.0)


def test_what_is_not_asked_for_is_neither_wanted_nor_held_against_anybody() -> None:
    around = ScoredThing("cup", 0.9, HIDDEN.box)
    part_of_it = cup(0.8, 110.0, 10.0)
    found = scores([([CUP, HIDDEN], [around, part_of_it, cup(0.7)])], HALF)
    assert found["cup"].asked == 1
    assert found["cup"].average_precision == found["cup"].precision == 1.0
    assert scores([([HIDDEN], [around])], HALF) == {}


def test_nothing_asked_for_is_no_score() -> None:
    assert mean_average_precision(scores([([], [cup(0.9)])], HALF)) == 0.0


def test_only_pictures_of_nothing_of_ours_are_empty() -> None:
    pictures = [([CUP], [cup(0.9, 60.0)]), ([], [cup(0.9), cup(0.4)]), ([], []), ([HIDDEN], [])]
    assert false_in_empty(pictures, {"cup": 0.4}) == (2, 2)
    two: Any = [([], [ScoredThing("ball", 0.5, CUP.box), cup(0.5)])]
    assert false_in_empty(two, HALF | {"cup": 0.6}) == (1, 1)
    assert false_in_empty(pictures, HALF) == (2, 1)
