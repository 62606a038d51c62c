"""Let the network write a plan greedily, each action held to the grammar and to the sentence."""

from __future__ import annotations

from dataclasses import dataclass
from math import exp
from typing import TYPE_CHECKING

import numpy as np

from planner.language.semantic_parser.features import sentence_features
from planner.language.semantic_parser.linear_plan import (
    MAX_ACTIONS,
    MAX_SPAN,
    QUOTED,
    TOKEN_NUMBERS,
    TOKENS,
    Action,
    GrammarWalk,
    NextActions,
    read_actions,
)
from planner.language.semantic_parser.plan_grammar import LabelledPlan, SlotKind

if TYPE_CHECKING:
    from planner.language.semantic_parser.network import PointerNetwork
    from planner.language.semantic_parser.units import SentenceUnits


@dataclass(frozen=True, slots=True)
class ParsedPlan:
    """Hold the plan that the network reads, and how sure it is."""

    plan: LabelledPlan
    confidence: float
    """The probability that it gives all actions together."""


def allowed_units(expected: NextActions, said: SentenceUnits) -> list[int]:
    """Return which units may be pointed at: each place and amount where it is named first."""
    kind, units = expected.points_at, said.units
    if kind is None:
        return []
    if kind in QUOTED:
        after = min(expected.first + MAX_SPAN, len(units)) if expected.is_last else len(units)
        return [at for at in range(expected.first, after) if units[at].key[-1].isalnum()]
    seen: set[object] = set()
    found = []
    for at, unit in enumerate(units):
        fits = (
            kind is SlotKind.PLACE if unit.place else bool(unit.amount and unit.amount[0] is kind)
        )
        named = unit.place or unit.amount
        if fits and named not in seen:
            seen.add(named)
            found.append(at)
    return found


def allowed_actions(expected: NextActions, said: SentenceUnits) -> tuple[list[int], list[int]]:
    """Return the numbers of the tokens and of the units that may come next."""
    units = allowed_units(expected, said)
    tokens = sorted(TOKEN_NUMBERS[token] for token in expected.tokens)
    return tokens, units


def decode_plan(
    network: PointerNetwork, said: SentenceUnits, least_confidence: float = 0.0
) -> ParsedPlan | None:
    """Return the plan that the network reads in a sentence; None where it finds no end.

    None, too, as soon as it is less sure than asked: each action only lowers the confidence.
    """
    encoded = network.encode(sentence_features(said.units))
    memory, written = network.begin(len(said.units)), network.token(0)
    walk, actions, log_probability = GrammarWalk(), list[Action](), 0.0
    while not walk.is_done:
        if len(actions) >= MAX_ACTIONS:
            return None
        scores, unit_scores = network.step(encoded, memory, written, walk.part_number)
        expected = walk.next_actions()
        tokens, units = allowed_actions(expected, said)
        if not tokens and not units:
            return None
        joint = np.concatenate((scores[tokens], unit_scores[units]))
        best = int(joint.argmax())
        log_probability -= float(np.log(np.exp(joint - joint[best]).sum()))
        if exp(log_probability) < least_confidence:
            return None
        is_token = best < len(tokens)
        number = tokens[best] if is_token else units[best - len(tokens)]
        action: Action = TOKENS[number] if is_token else number
        written = network.token(number + 1) if is_token else encoded.taken[number]
        if not is_token:
            memory.point(number, expected.first if expected.is_last else number)
        walk.take(action)
        actions.append(action)
    return ParsedPlan(read_actions(actions, said), exp(log_probability))


def first_forms(network: PointerNetwork, said: SentenceUnits) -> dict[str, float]:
    """Return how likely it is, by form, that the plan of a sentence begins with it."""
    encoded, walk = network.encode(sentence_features(said.units)), GrammarWalk()
    memory, nothing = network.begin(len(said.units)), network.token(0)
    scores, _ = network.step(encoded, memory, nothing, walk.part_number)
    forms = sorted(walk.next_actions().tokens)
    joint = scores[[TOKEN_NUMBERS[form] for form in forms]]
    shares = np.exp(joint - joint.max())
    return dict(zip(forms, (shares / shares.sum()).tolist(), strict=True))
