"""Fit the labels of units: an averaged perceptron over whole chains (Collins 2002). By seed.

Each sentence is labelled with the weights so far; where a label is wrong, the features of the right
chain gain one and those of the wrong one lose one. What is kept is the mean over all sentences.
"""

from __future__ import annotations

from array import array
from dataclasses import replace
from random import Random
from typing import TYPE_CHECKING

from planner.language.intent.features import BUCKETS, unit_features
from planner.language.intent.intent_model import BEGIN, LABELS, IntentModel

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable

    from tools.train_intent.generator import Example

ROUNDS = 8
EMPTY = IntentModel(
    intents=(),
    embedding=array("b"),
    scale=1.0,
    hidden=(),
    output=(),
    slots=tuple(array("l", [0]) * BUCKETS for _ in range(LABELS)),
    slot_scale=1.0,
    transitions=((0.0,) * LABELS,) * (LABELS + 1),
)


def fit_slots(
    examples: Iterable[Example],
    seed: int,
    rounds: int = ROUNDS,
    tell: Callable[[str], None] = lambda _: None,
) -> IntentModel:
    """Return a model that labels and knows no intents.

    Args:
        examples: to learn from.
        seed: of the order in which they are shown.
        rounds: so often each is shown.
        tell: is told of each round.
    """
    random, left = Random(seed), list(examples)
    weights = [array("l", [0]) * BUCKETS for _ in range(LABELS)]
    sums = [array("l", [0]) * BUCKETS for _ in range(LABELS)]
    steps = [[0] * LABELS for _ in range(LABELS + 1)]
    step_sums = [[0] * LABELS for _ in range(LABELS + 1)]
    seen = 1
    for number in range(rounds):
        random.shuffle(left)
        wrong = 0
        for example in left:
            model = replace(
                EMPTY, slots=tuple(weights), transitions=tuple(tuple(row) for row in steps)
            )
            guessed = model.label(example.units, example.intent)
            if guessed != example.labels:
                wrong += 1
                chains = zip(example.labels, guessed, strict=True)
                before = (BEGIN, BEGIN)
                for at, (right, got) in enumerate(chains):
                    buckets = unit_features(example.units, at, example.intent)
                    for label, sign in ((right, 1), (got, -1)) if right != got else ():
                        for bucket in buckets:
                            weights[label][bucket] += sign
                            sums[label][bucket] += sign * seen
                    if (before[0], right) != (before[1], got):
                        for came, label, sign in (before[0], right, 1), (before[1], got, -1):
                            steps[came][label] += sign
                            step_sums[came][label] += sign * seen
                    before = (right, got)
            seen += 1
        tell(f"labels, round {number + 1} of {rounds}: {wrong} of {len(left)} wrong")
    mean = [
        array("d", (w - total / seen for w, total in zip(row, row_sums, strict=True)))
        for row, row_sums in zip(weights, sums, strict=True)
    ]
    transitions = tuple(
        tuple(step - total / seen for step, total in zip(row, row_sums, strict=True))
        for row, row_sums in zip(steps, step_sums, strict=True)
    )
    return replace(EMPTY, slots=tuple(mean), transitions=transitions)
