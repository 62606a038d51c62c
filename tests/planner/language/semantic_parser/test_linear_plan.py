"""Actions write plans one to one, and a walk allows each action of a plan and no other's."""

from __future__ import annotations

from collections.abc import Sequence
from functools import cache
from random import Random
from typing import TypeVar

import numpy as np
import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st
from numpy.typing import NDArray

from planner.language.semantic_parser.decoding import allowed_actions, decode_plans
from planner.language.semantic_parser.linear_plan import (
    TOKENS,
    Action,
    GrammarWalk,
    UnknownWords,
    read_actions,
    write_actions,
)
from planner.language.semantic_parser.model_file import quantise
from planner.language.semantic_parser.network import (
    DecoderMemory,
    PointerNetwork,
    SentenceStates,
)
from planner.language.semantic_parser.plan_grammar import parse_plan, render_plan
from planner.language.semantic_parser.units import MAX_UNITS, Gazetteer, cut_units
from tests.planner.language.semantic_parser.drawn_network import draw_weights

Values = NDArray[np.float32]
N = TypeVar("N", bound=PointerNetwork)
NAMES = Gazetteer({"kitchen": "kitchen", "hall": "hall", "厨房": "kitchen"})
SENTENCE = "go to the hall, wait five minutes, then tell Dad it's late in the kitchen"


@pytest.mark.parametrize(
    "label",
    [
        'go(hall); wait(5 min); say("it\'s late", to "Dad")',
        'if not check("Dad", in kitchen) { back } else { home }',
        'if later("late") { go(there) }',
        "patrol(hall + kitchen, except hall)",
        'at("late") { inspect(all) }',
        "none",
        "repeat(for 5 min) { find(it) }",
        'try { go(hall) } else { say("late") }',
    ],
)
def test_a_plan_comes_back_from_its_actions(label: str) -> None:
    said = cut_units(SENTENCE, NAMES)
    actions = write_actions(parse_plan(label), said)
    walk = GrammarWalk()
    for action in actions:
        tokens, units = allowed_actions(walk.next_actions(), said)
        if isinstance(action, str):
            assert TOKENS.index(action) in tokens
        else:
            assert action in units
        walk.take(action)
    assert walk.is_done
    assert render_plan(read_actions(actions, said)) == label


@pytest.mark.parametrize("label", ["go(attic)", 'find("cup")', "wait(6 min)", "turn(left, 5 deg)"])
def test_a_plan_of_what_the_sentence_lacks_is_refused(label: str) -> None:
    with pytest.raises(UnknownWords):
        write_actions(parse_plan(label), cut_units(SENTENCE, NAMES))


@cache
def drawn(kind: type[N], seed: int) -> N:
    """Draw a network once: its weights take longer than what they read."""
    weights = draw_weights(seed)
    return kind(
        {name: quantise(each) for name, each in weights.items() if each.ndim > 1},
        {name: each for name, each in weights.items() if each.ndim == 1},
    )


ROUNDED = 1e-5
"""By so much a confidence may differ with the number of drafts that are scored together."""
_WORDS = ("kitchen", "the hall", "厨房", "five minutes", "90 degrees", "twice", "“now”", '"', "2 m")


@settings(max_examples=60, deadline=None)
@given(st.integers(0, 9), st.lists(st.sampled_from(_WORDS), min_size=1, max_size=12))
@example(9, ['"'])  # the sentence holds nothing of what the grammar wants next
def test_any_weights_write_a_plan_of_what_the_sentence_holds(seed: int, words: list[str]) -> None:
    network = drawn(PointerNetwork, seed)
    said = cut_units(" ".join(words), NAMES)
    found = decode_plans(network, said, most=3)
    sureness = [each.confidence for each in found]
    assert sureness == sorted(sureness, reverse=True)
    assert len({each.plan for each in found}) == len(found) <= 3
    for parsed in found:
        assert 0.0 <= parsed.confidence <= 1.0
        assert parse_plan(render_plan(parsed.plan)) == parsed.plan
        write_actions(parsed.plan, said)


@settings(max_examples=40, deadline=None)
@given(
    st.integers(0, 9),
    st.lists(st.sampled_from(_WORDS), min_size=1),
    st.floats(0.0, 1.0),
    st.integers(1, 4),
)
def test_a_reading_that_is_less_sure_than_asked_is_none_and_ends_early(
    seed: int, words: list[str], least: float, most: int
) -> None:
    network = drawn(_CountingNetwork, seed)
    network.steps = 0
    said = cut_units(" ".join(words[:12]), NAMES)
    whole = decode_plans(network, said, most)
    in_full, network.steps = network.steps, 0
    found = decode_plans(network, said, most, least)
    sure = [each.plan for each in whole if each.confidence > least + ROUNDED]
    assert [each.plan for each in found][: len(sure)] == sure
    assert all(each.confidence >= least for each in found)
    assert network.steps <= in_full
    assert decode_plans(network, said, most, 1.5) == ()
    assert network.steps <= in_full + 1, "the first action ends what can't be sure enough"


class _CountingNetwork(PointerNetwork):
    """Count the actions that are scored: what a reading costs."""

    steps = 0

    def step(
        self,
        encoded: SentenceStates,
        memory: DecoderMemory,
        written: Sequence[Values],
        parts: Sequence[int],
    ) -> tuple[Values, Values]:
        self.steps += 1
        return super().step(encoded, memory, written, parts)


def test_random_walks_through_the_grammar_end_in_plans() -> None:
    said, random = cut_units(SENTENCE, NAMES), Random(3)
    assert len(said.units) <= MAX_UNITS
    for _ in range(300):
        walk, actions = GrammarWalk(), list[Action]()
        while not walk.is_done:
            tokens, units = allowed_actions(walk.next_actions(), said)
            written: list[Action] = [TOKENS[token] for token in tokens]
            choice = random.choice(written + list[Action](units))
            # Rows end early often enough that the walk is short.
            if "}" in written and random.random() < 0.5:
                choice = "}"
            walk.take(choice)
            actions.append(choice)
        plan = read_actions(actions, said)
        assert parse_plan(render_plan(plan)) == plan
