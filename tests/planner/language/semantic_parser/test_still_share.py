"""The reader's first action alone tells how likely a sentence orders nothing."""

from __future__ import annotations

from pathlib import Path

import pytest

from planner.language.semantic_parser.decoding import decode_plans, first_forms
from planner.language.semantic_parser.linear_plan import GrammarWalk
from planner.language.semantic_parser.model_file import read_model, write_model
from planner.language.semantic_parser.parser import ORDERS_NOTHING, still_share
from planner.language.semantic_parser.plan_grammar import STEPS
from planner.language.semantic_parser.units import Gazetteer, cut_units
from tests.planner.brain.conftest import HOME
from tests.planner.language.semantic_parser.drawn_network import draw_weights

SAID = cut_units("go to the kitchen twice", Gazetteer({"kitchen": "kitchen"}))


@pytest.mark.parametrize("seed", range(5))
def test_the_forms_shares_are_whole_and_the_likeliest_is_what_a_plan_begins_with(
    seed: int, tmp_path: Path
) -> None:
    write_model(draw_weights(seed), tmp_path / "model.bin")
    network = read_model(tmp_path / "model.bin")
    shares = first_forms(network, SAID)
    assert set(shares) == GrammarWalk().next_actions().tokens
    assert sum(shares.values()) == pytest.approx(1.0, abs=1e-4)
    first = max(shares, key=lambda form: shares[form])
    assert all(each.plan[0].form == first for each in decode_plans(network, SAID, most=1))


@pytest.mark.parametrize(
    "said", ["go to the kitchen", "look in the study, then come back", "去厨房看看", "跟着我"]
)
def test_an_order_is_no_talk(said: str) -> None:
    assert still_share(said, HOME) < 0.1


@pytest.mark.parametrize(
    "said", ["the kitchen was always too small for us", "到头来还是厨房最暖和", "my leg hurts"]
)
def test_talk_orders_nothing(said: str) -> None:
    assert still_share(said, HOME) > 0.5


@pytest.mark.parametrize("said", ["", "  ", "kitchen " * 200])
def test_what_is_not_read_is_not_known(said: str) -> None:
    assert still_share(said, HOME) == 0.0


def test_without_its_file_nothing_is_known(tmp_path: Path) -> None:
    assert still_share("my leg hurts", HOME, tmp_path / "none.bin") == 0.0


def test_steps_are_orders() -> None:
    assert ORDERS_NOTHING.isdisjoint(STEPS)
