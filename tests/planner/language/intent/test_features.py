"""Features say nothing of which place is named, and keep a slip near what was meant."""

from __future__ import annotations

from hypothesis import given
from hypothesis import strategies as st

from planner.language.intent.features import (
    BUCKETS,
    sentence_features,
    unit_features,
    units_of,
)

TEXT = st.text(alphabet="abz '去看厨,?\ue000\ue001\ue045", max_size=40)


@given(TEXT)
def test_every_feature_is_a_bucket(text: str) -> None:
    units = units_of(text)
    found = [
        *sentence_features(units),
        *(b for at in range(len(units)) for b in unit_features(units, at, "go")),
    ]
    assert all(0 <= bucket < BUCKETS for bucket in found)


@given(TEXT)
def test_which_places_are_named_changes_nothing(text: str) -> None:
    renamed = text.translate({0xE000: 0xE123, 0xE001: 0xE124, 0xE045: 0xE000})
    assert units_of(text) == units_of(renamed)


def test_places_are_numbered_in_their_order_and_words_kept_whole() -> None:
    assert units_of("go to \ue003, then \ue001 or \ue003?") == [
        "go", "to", "<0>", ",", "then", "<1>", "or", "<0>", "?",
    ]  # fmt: skip
    assert units_of("don't 去\ue000看") == ["don't", "去", "<0>", "看"]


def test_a_word_shares_features_with_a_slip_of_it() -> None:
    meant, slipped = (set(sentence_features([word])) for word in ("kitchen", "kitchne"))
    assert meant & slipped
