"""Settle least scores on ghosts whose number is known."""

from __future__ import annotations

from tools.train.budget import CLASSES, GHOST_SHARE, MIN_SCORE, MOST_SCORE
from tools.train.score import ScoredThing
from tools.train.score_calibration import settle_scores

FRAMES = 3_000
ALLOWED = int(GHOST_SHARE * FRAMES)


def bare(**ghosts: list[float]) -> list[list[ScoredThing]]:
    seen = [
        [ScoredThing(label, score, (0.0, 0.0, 9.0, 9.0))]
        for label in ghosts
        for score in ghosts[label]
    ]
    return seen + [[]] * (FRAMES - len(seen))


def least(label: str, found: list[list[ScoredThing]]) -> float:
    return dict(zip(CLASSES, settle_scores(found), strict=True))[label]


def test_a_class_that_is_hardly_seen_in_nothing_is_believed_early() -> None:
    found = bare(cup=[0.95] * ALLOWED, ball=[0.39] * 50)
    assert settle_scores(found) == [MIN_SCORE] * len(CLASSES)


def test_a_class_is_believed_above_all_but_a_few_of_its_ghosts() -> None:
    found = bare(fridge=[0.9] * (ALLOWED - 1) + [0.7, 0.553, 0.5], door=[0.66] * (ALLOWED + 1))
    assert least("fridge", found) == 0.56
    assert least("door", found) == 0.67
    assert least("cup", found) == MIN_SCORE


def test_a_ghost_of_just_the_score_does_not_reach_it() -> None:
    assert least("box", bare(box=[0.6] * (ALLOWED + 1))) == 0.61


def test_no_class_is_silenced() -> None:
    assert least("box", bare(box=[0.99] * 100)) == MOST_SCORE
