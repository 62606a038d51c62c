"""The intent model reads its file or none, and tells a share of one intent for any sentence."""

from __future__ import annotations

from typing import TYPE_CHECKING

import pytest
from hypothesis import given
from hypothesis import strategies as st

from planner.language.intent.intent_model import MODEL, THING, IntentModel, load_intent_model

if TYPE_CHECKING:
    from pathlib import Path


@pytest.fixture(scope="module")
def model() -> IntentModel:
    found = load_intent_model()
    assert found is not None
    return found


@given(st.lists(st.sampled_from(["<0>", "<1>", "go", "to", "去", "看", "?", "zzz"]), min_size=1))
def test_any_units_come_to_one_intent_and_a_share(units: list[str]) -> None:
    found = load_intent_model()
    assert found is not None
    guess = found.guess(units)
    assert guess.intent in found.intents
    assert 0.0 < guess.share <= 1.0
    assert len(guess.labels) == len(units)
    assert found.guess(units) == guess


def test_an_order_of_everyday_speech_and_its_thing_are_guessed(model: IntentModel) -> None:
    guess = model.guess(["i", "can't", "find", "my", "old", "umbrella", "anywhere"])
    assert guess.intent == "find"
    assert guess.labels[-2] == THING
    assert THING not in guess.labels[:3]


@pytest.mark.parametrize("kept", [0, 10, -1])
def test_a_file_that_is_cut_off_is_no_model(tmp_path: Path, kept: int) -> None:
    spoilt = tmp_path / "model.bin"
    spoilt.write_bytes(MODEL.read_bytes()[:kept])
    assert load_intent_model(spoilt) is None


def test_a_missing_file_another_version_and_no_json_are_no_model(tmp_path: Path) -> None:
    other = tmp_path / "other.bin"
    other.write_bytes(MODEL.read_bytes().replace(b'"version": 2', b'"version": 1', 1))
    noise = tmp_path / "noise.bin"
    noise.write_bytes(bytes(range(256)) * 40)
    assert load_intent_model(tmp_path / "none.bin") is None
    assert load_intent_model(other) is None
    assert load_intent_model(noise) is None


@given(st.sets(st.sampled_from(["go", "find", "none", "home"]), min_size=1))
def test_only_what_may_be_meant_is_guessed(meant: set[str]) -> None:
    found = load_intent_model()
    assert found is not None
    guess = found.guess(["go", "to", "<0>"], meant)
    assert guess.intent in meant
    assert len(meant) > 1 or guess.share == 1.0
