"""An answer that names one of the orders offered is that order; anything more is left alone."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from planner.language.offered_choice import choose

ROOMS = (
    ("go to the kitchen", "go to the kitchen", "去厨房"),
    ("go to the study", "go to the study", "去书房"),
)
PLACES = (("去书桌", "go to the desk", "去书桌"), ("去床", "go to the bed", "去床"))


@pytest.mark.parametrize(
    ("answer", "chosen"),
    [
        ("the study", 1), ("study", 1), ("The study, please.", 1), ("to the kitchen then", 0),
        ("the first one", 0), ("the latter", 1), ("书房吧", 1), ("那就厨房", 0), ("第二个", 1),
        ("the kitchen and the study", None), ("both", None), ("neither", None), ("the third", None),
        ("the studio", None), ("not the study", None), ("don't go to the study", None),
        ("the study, but slowly", None), ("别去书房", None), ("", None), ("?", None), ("房", None),
    ],
)  # fmt: skip
def test_an_offer_is_chosen_by_its_own_words_or_its_number(answer: str, chosen: int | None) -> None:
    assert choose(ROOMS, answer) == chosen


def test_the_words_of_either_language_choose() -> None:
    assert [choose(PLACES, each) for each in ("床", "床吧", "the bed", "后者")] == [1, 1, 1, 1]
    assert choose(PLACES[:1], "书桌") is None, "one offer is taken by a yes"


@given(st.text(max_size=90))
def test_no_text_chooses_two_or_raises(answer: str) -> None:
    assert choose(ROOMS, answer) in (None, 0, 1)
