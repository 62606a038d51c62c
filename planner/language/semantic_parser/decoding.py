"""Let the network write the likeliest plans, held to the grammar and to the sentence."""

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
    from collections.abc import Iterator, Sequence

    from numpy.typing import NDArray

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


@dataclass(frozen=True, slots=True)
class _Draft:
    """Hold a row of actions that is being written."""

    walk: GrammarWalk
    actions: tuple[Action, ...] = ()
    log_probability: float = 0.0


@dataclass(frozen=True, slots=True)
class _NextStep:
    """Hold one action that may come next, of the draft in a row of the decoder's memory."""

    row: int
    action: Action
    log_probability: float
    """Of the whole draft with it."""
    first: int
    """Of a unit: the first one that is told with it."""


def decode_plans(
    network: PointerNetwork, said: SentenceUnits, most: int = 1, least_confidence: float = 0.0
) -> tuple[ParsedPlan, ...]:
    """Return the likeliest plans of a sentence, the surest first; none where no draft finds an end.

    Drafts are written side by side, each action taken by the likeliest of all (beam search), and
    one is left as soon as it is less sure than asked: each action only lowers the confidence.

    Args:
        network: that scores the actions.
        said: the sentence.
        most: so many plans at most, and so many drafts beside each other.
        least_confidence: of a plan, from 0 to 1.
    """
    encoded, memory = network.encode(sentence_features(said.units)), network.begin(len(said.units))
    drafts, written = [_Draft(GrammarWalk())], [network.token(0)]
    found: dict[LabelledPlan, float] = {}
    for _ in range(MAX_ACTIONS):
        parts = [draft.walk.part_number for draft in drafts]
        scores = network.step(encoded, memory, written, parts)
        steps = sorted(
            _likeliest_steps(drafts, scores, said, most), key=lambda step: -step.log_probability
        )
        nth = sorted(found.values(), reverse=True)[most - 1 : most] or [0.0]
        least = max(least_confidence, *nth)
        kept = [step for step in steps[:most] if exp(step.log_probability) >= least]
        memory = memory.pick([step.row for step in kept])
        before, drafts, written, rows = drafts, [], [], []
        for row, step in enumerate(kept):
            walk = before[step.row].walk.fork()
            walk.take(step.action)
            actions = (*before[step.row].actions, step.action)
            if walk.is_done:
                found.setdefault(read_actions(actions, said), exp(step.log_probability))
                continue
            if isinstance(step.action, int):
                memory.point(row, step.action, step.first)
                written.append(encoded.taken[step.action])
            else:
                written.append(network.token(TOKEN_NUMBERS[step.action] + 1))
            drafts.append(_Draft(walk, actions, step.log_probability))
            rows.append(row)
        if not drafts:
            break
        memory = memory.pick(rows)
    surest = sorted(found.items(), key=lambda item: -item[1])
    return tuple(ParsedPlan(plan, confidence) for plan, confidence in surest[:most])


def _likeliest_steps(
    drafts: Sequence[_Draft],
    scores: tuple[NDArray[np.float32], NDArray[np.float32]],
    said: SentenceUnits,
    most: int,
) -> Iterator[_NextStep]:
    """Yield the likeliest next actions of each draft."""
    for row, draft in enumerate(drafts):
        expected = draft.walk.next_actions()
        tokens, units = allowed_actions(expected, said)
        joint = np.concatenate((scores[0][row, tokens], scores[1][row, units]))
        if not len(joint):
            continue
        shifted = joint - joint.max()
        logs = draft.log_probability + shifted - np.log(np.exp(shifted).sum())
        for at in np.argsort(-logs, kind="stable")[:most]:
            is_token = at < len(tokens)
            unit = None if is_token else units[at - len(tokens)]
            action: Action = TOKENS[tokens[at]] if unit is None else unit
            first = expected.first if expected.is_last else unit or 0
            yield _NextStep(row, action, float(logs[at]), first)


def first_forms(network: PointerNetwork, said: SentenceUnits) -> dict[str, float]:
    """Return how likely it is, by form, that the plan of a sentence begins with it."""
    encoded, walk = network.encode(sentence_features(said.units)), GrammarWalk()
    memory, nothing = network.begin(len(said.units)), network.token(0)
    scores, _ = network.step(encoded, memory, [nothing], [walk.part_number])
    forms = sorted(walk.next_actions().tokens)
    joint = scores[0, [TOKEN_NUMBERS[form] for form in forms]]
    shares = np.exp(joint - joint.max())
    return dict(zip(forms, (shares / shares.sum()).tolist(), strict=True))
