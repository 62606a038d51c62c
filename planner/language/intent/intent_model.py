"""Own the intent model: what a sentence asks for, and which words are a thing, words, a person.

A table of small vectors and two layers tell the intent; a chain of labels over the units, each
scored by the units around it, tells the slots. Read and run without a library: the planner's own
process loads neither numpy nor onnxruntime. Made by ``python -m tools.train_intent``.
"""

from __future__ import annotations

import json
import sys
from array import array
from dataclasses import dataclass
from functools import lru_cache
from math import exp
from operator import add, mul
from pathlib import Path
from typing import TYPE_CHECKING

from planner.language.intent.features import BUCKETS, sentence_features, unit_features

if TYPE_CHECKING:
    from collections.abc import Container, Sequence

MODEL = Path(__file__).with_name("intent_model.bin")
VERSION = 2
OTHER, THING, WORDS, NAME = range(4)
"""What a unit belongs to: nothing, what is sought, what is to be said or asked, who is meant."""
LABELS = 4
BEGIN = LABELS
"""Row of the transitions into a sentence's first unit."""


@dataclass(frozen=True, slots=True)
class Guess:
    """Hold what a sentence may ask for, how sure that is, and what its units belong to."""

    intent: str
    share: float
    """Of those intents that may be meant, 0 to 1."""
    labels: tuple[int, ...]
    """A label a unit."""


@dataclass(frozen=True, slots=True)
class IntentModel:
    """Hold the weights."""

    intents: tuple[str, ...]
    embedding: array[int]  # BUCKETS rows, int8
    scale: float  # of the embedding
    hidden: tuple[tuple[float, ...], ...]  # a row a hidden unit, its bias last
    output: tuple[tuple[float, ...], ...]  # a row an intent, its bias last
    slots: tuple[Sequence[float], ...]  # a row a label of BUCKETS numbers, int8
    slot_scale: float
    transitions: tuple[tuple[float, ...], ...]  # from a label, or BEGIN, to a label

    def guess(self, units: Sequence[str], meant: Container[str] | None = None) -> Guess:
        """Return what a sentence of at least one unit asks for, as the model has it.

        Args:
            units: of the sentence.
            meant: the intents that may be; left out, all.
        """
        width = len(self.hidden[0]) - 1
        buckets = sentence_features(units)
        total: Sequence[float] = (0,) * width
        for bucket in buckets:
            total = list(map(add, total, self.embedding[bucket * width : (bucket + 1) * width]))
        mean = [value * self.scale / len(buckets) for value in total]
        hidden = [max(0.0, _weigh(row, mean)) for row in self.hidden]
        scores = [_weigh(row, hidden) for row in self.output]
        likely = [
            (score, intent)
            for score, intent in zip(scores, self.intents, strict=True)
            if meant is None or intent in meant
        ]
        top, intent = max(likely)
        share = 1.0 / sum(exp(score - top) for score, _ in likely)
        return Guess(intent, share, self.label(units, intent))

    def label(self, units: Sequence[str], intent: str) -> tuple[int, ...]:
        """Return the likeliest chain of labels (Viterbi 1967) of a sentence with this intent."""
        totals: Sequence[float] = self.transitions[BEGIN]
        came: list[list[int]] = []
        for at in range(len(units)):
            buckets = unit_features(units, at, intent)
            own = [sum(map(row.__getitem__, buckets)) * self.slot_scale for row in self.slots]
            if at == 0:
                totals = list(map(add, totals, own))
                continue
            ways = [
                max((totals[label] + self.transitions[label][to], -label) for label in _LABELS)
                for to in _LABELS
            ]
            came.append([-label for _, label in ways])
            totals = [score + own[to] for to, (score, _) in enumerate(ways)]
        chain = [totals.index(max(totals))]
        for step in reversed(came):
            chain.append(step[chain[-1]])
        return tuple(reversed(chain))


_LABELS = range(LABELS)


def _weigh(row: Sequence[float], values: Sequence[float]) -> float:
    return float(sum(map(mul, row, values)) + row[-1])


@lru_cache(maxsize=4)
def load_intent_model(path: Path = MODEL) -> IntentModel | None:
    """Return the model of a file; None where it is missing, cut off or of another version."""
    try:
        head, rest = path.read_bytes().split(b"\n", 1)
        told = json.loads(head)
        width, hidden, intents = told["embedded"], told["hidden"], tuple(told["intents"])
        sizes = (
            BUCKETS * width,
            BUCKETS * LABELS,
            4 * hidden * (width + 1),
            4 * len(intents) * (hidden + 1),
        )
        if told["version"] != VERSION or len(rest) != sum(sizes):
            return None
        parts, at = [], 0
        for size in sizes:
            parts.append(rest[at : at + size])
            at += size
        return IntentModel(
            intents=intents,
            embedding=array("b", parts[0]),
            scale=told["scale"],
            hidden=_rows(parts[2], width + 1),
            output=_rows(parts[3], hidden + 1),
            slots=tuple(
                array("b", parts[1][row * BUCKETS : (row + 1) * BUCKETS]) for row in _LABELS
            ),
            slot_scale=told["slot_scale"],
            transitions=tuple(tuple(row) for row in told["transitions"]),
        )
    except (OSError, ValueError, KeyError, TypeError):
        return None


def _rows(data: bytes, width: int) -> tuple[tuple[float, ...], ...]:
    numbers = array("f", data)
    if sys.byteorder == "big":
        numbers.byteswap()
    return tuple(tuple(numbers[at : at + width]) for at in range(0, len(numbers), width))
