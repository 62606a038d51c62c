"""Own the intent model: a table of small vectors and two layers, read and run without a library.

The planner's own process loads neither numpy nor onnxruntime, and a hundred vectors of 32 numbers
are added in a fifth of a millisecond. Made by ``python -m tools.train_intent``.
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
    from collections.abc import Sequence

MODEL = Path(__file__).with_name("intent_model.bin")
VERSION = 1


@dataclass(frozen=True, slots=True)
class Guess:
    """Hold what a sentence may ask for, how sure that is, and which units name a thing."""

    intent: str
    share: float
    """Of all intents, 0 to 1."""
    thing: tuple[bool, ...]


@dataclass(frozen=True, slots=True)
class IntentModel:
    """Hold the weights."""

    intents: tuple[str, ...]
    embedding: array[int]  # BUCKETS rows, int8
    scale: float  # of the embedding
    hidden: tuple[tuple[float, ...], ...]  # a row a hidden unit, its bias last
    output: tuple[tuple[float, ...], ...]  # a row an intent, its bias last
    tags: array[int]  # BUCKETS numbers, int8
    tag_scale: float
    tag_bias: float

    def guess(self, units: Sequence[str]) -> Guess:
        """Return what a sentence of at least one unit asks for, as the model has it."""
        width = len(self.hidden[0]) - 1
        buckets = sentence_features(units)
        total: Sequence[float] = (0,) * width
        for bucket in buckets:
            total = list(map(add, total, self.embedding[bucket * width : (bucket + 1) * width]))
        mean = [value * self.scale / len(buckets) for value in total]
        hidden = [max(0.0, _weigh(row, mean)) for row in self.hidden]
        scores = [_weigh(row, hidden) for row in self.output]
        top = max(scores)
        best = scores.index(top)
        share = 1.0 / sum(exp(score - top) for score in scores)
        things = tuple(self._names_thing(units, at) for at in range(len(units)))
        return Guess(self.intents[best], share, things)

    def _names_thing(self, units: Sequence[str], at: int) -> bool:
        total = sum(self.tags[bucket] for bucket in unit_features(units, at))
        return total * self.tag_scale + self.tag_bias > 0.0


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
            BUCKETS,
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
            tags=array("b", parts[1]),
            tag_scale=told["tag_scale"],
            tag_bias=told["tag_bias"],
        )
    except (OSError, ValueError, KeyError, TypeError):
        return None


def _rows(data: bytes, width: int) -> tuple[tuple[float, ...], ...]:
    numbers = array("f", data)
    if sys.byteorder == "big":
        numbers.byteswap()
    return tuple(tuple(numbers[at : at + width]) for at in range(0, len(numbers), width))
