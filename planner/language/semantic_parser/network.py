"""Run the pointer network: an encoder over units, a decoder that writes one action after another.

Both are transformers (Vaswani et al. 2017, "Attention is all you need"), normed before each part,
with a learned bias by distance in place of positions. The decoder looks at the sentence by each
unit's distance from the one that it pointed at last, and knows which it has told already: plans go
through a sentence from left to right, and tell each part of it once. Numbers alone, in numpy; what
a number means is the business of ``decoding``. The weights are 8-bit whole numbers with a scale a
row; those of the units' buckets stay so in memory.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from numpy.typing import NDArray

    from planner.language.semantic_parser.features import UnitFeatures

    Floats = NDArray[np.float32]

HEADS = 4
FARTHEST = 16
"""Units or actions: what is farther away counts as so far."""
DISTANCES = 2 * FARTHEST + 3
"""Columns of the decoder's tables: a distance, then "nothing was pointed at", then "is told"."""


def as_floats(values: NDArray[Any]) -> Floats:
    """Return numbers in 32 bits; they mostly are, and are then not copied."""
    return values.astype(np.float32, copy=False)


@dataclass(frozen=True, slots=True)
class Int8Matrix:
    """Hold a matrix of weights as 8-bit whole numbers, and the scale of each row."""

    values: NDArray[np.int8]
    scales: Floats

    def rows(self, numbers: Sequence[int]) -> Floats:
        """Return some rows as they are meant."""
        picked = list(numbers)
        return as_floats(self.values[picked] * self.scales[picked][:, None])

    def whole(self) -> Floats:
        """Return all rows as they are meant."""
        return as_floats(self.values * self.scales[:, None])


@dataclass(frozen=True, slots=True)
class SentenceStates:
    """Hold what the encoder made of a sentence of so many units."""

    pointed: Floats
    """(units, width): the states as pointers compare them."""
    taken: Floats
    """(units, width): the states as the decoder takes them after it has pointed at one."""
    heard: tuple[tuple[Floats, Floats], ...]
    """By decoder layer: (heads, units, part) of keys and values."""


@dataclass(slots=True)
class DecoderMemory:
    """Hold, for several rows of actions, what each wrote before and pointed at."""

    is_told: NDArray[np.bool_]
    """(rows, units): whether it was pointed at, or stands in quoted words."""
    pointed: NDArray[np.intp]
    """(rows): the unit that was pointed at last; -1: none."""
    keys: list[Floats]
    """By decoder layer: (rows, heads, actions, part)."""
    values: list[Floats]

    def pick(self, rows: Sequence[int]) -> DecoderMemory:
        """Return the memory of some rows, each as often as it is named."""
        picked = list(rows)
        keys, values = ([each[picked] for each in kept] for kept in (self.keys, self.values))
        return DecoderMemory(self.is_told[picked], self.pointed[picked], keys, values)

    def point(self, row: int, unit: int, first: int) -> None:
        """Keep that a row pointed at a unit; ``first``: the first one that is told with it."""
        self.pointed[row] = unit
        self.is_told[row, first : unit + 1] = True

    def columns(self) -> NDArray[np.intp]:
        """Return (rows, units): the column of a unit's distance in a table of ``DISTANCES``."""
        apart = np.arange(self.is_told.shape[1]) - self.pointed[:, None]
        near = np.clip(apart, -FARTHEST, FARTHEST) + FARTHEST
        return np.where(self.pointed[:, None] < 0, 2 * FARTHEST + 1, near)


def _norm(values: Floats, gain: Floats, shift: Floats) -> Floats:
    centred = values - values.mean(axis=-1, keepdims=True)
    spread = np.sqrt((centred * centred).mean(axis=-1, keepdims=True) + 1e-5)
    return as_floats(centred / spread * gain + shift)


def _attend(query: Floats, key: Floats, value: Floats, bias: Floats | float) -> Floats:
    """Return (…, rows, part) of what queries of that shape hear."""
    scores = query @ key.swapaxes(-1, -2) / query.shape[-1] ** 0.5 + bias
    shifted = np.exp(scores - scores.max(axis=-1, keepdims=True))
    return as_floats((shifted / shifted.sum(axis=-1, keepdims=True)) @ value)


def _join_heads(heard: Floats) -> Floats:
    """Return (rows, width) of (heads, rows, part)."""
    return heard.transpose(1, 0, 2).reshape(heard.shape[1], -1)


def _heads(values: Floats) -> Floats:
    """Return (heads, rows, part) of (rows, width)."""
    count, width = values.shape
    return values.reshape(count, HEADS, width // HEADS).transpose(1, 0, 2)


class PointerNetwork:
    """Score actions for a sentence.

    Args:
        matrices: weights by name, as ``tools/train_reader`` writes them.
        vectors: shifts and gains by name.
    """

    def __init__(self, matrices: Mapping[str, Int8Matrix], vectors: Mapping[str, Floats]) -> None:
        self._words, self._pieces = matrices["words.weight"], matrices["pieces.weight"]
        self._m = {
            name: np.ascontiguousarray(matrix.whole().T)
            for name, matrix in matrices.items()
            if name not in ("words.weight", "pieces.weight")
        }
        self._v = dict(vectors)
        self._encoder = self._count("encoder")
        self._decoder = self._count("decoder")

    def _count(self, part: str) -> int:
        return len({name.split(".")[1] for name in self._m if name.startswith(f"{part}.")})

    def encode(self, features: Sequence[UnitFeatures]) -> SentenceStates:
        """Return the states of a sentence's units."""
        felt = self._words.rows([unit.word for unit in features])
        for at, unit in enumerate(features):
            if unit.pieces:
                felt[at] += self._pieces.rows(unit.pieces).mean(axis=0)
        states = self._linear("felt", felt)
        apart = np.arange(len(states))
        apart = np.clip(apart[None] - apart[:, None], -FARTHEST, FARTHEST) + FARTHEST
        for number in range(self._encoder):
            name = f"encoder.{number}"
            query, key, value = self._mix(name, states)
            bias = self._m[f"{name}.near.weight"].T[:, apart]
            heard = _join_heads(_attend(query, key, value, bias))
            states = as_floats(states + self._linear(f"{name}.join", heard))
            states = self._think(name, states)
        states = self._apply_norm("heard", states)
        told = tuple(self._hear(number, states) for number in range(self._decoder))
        return SentenceStates(states @ self._m["keys.weight"], self._linear("taken", states), told)

    def _linear(self, name: str, values: Floats) -> Floats:
        return as_floats(values @ self._m[f"{name}.weight"] + self._v[f"{name}.bias"])

    def _apply_norm(self, name: str, values: Floats) -> Floats:
        return _norm(values, self._v[f"{name}.weight"], self._v[f"{name}.bias"])

    def _mix(self, name: str, states: Floats) -> tuple[Floats, Floats, Floats]:
        mixed = self._linear(f"{name}.mix", self._apply_norm(f"{name}.norm1", states))
        query, key, value = np.split(mixed, 3, axis=1)
        return _heads(query), _heads(key), _heads(value)

    def _think(self, name: str, states: Floats) -> Floats:
        wide = np.maximum(
            self._linear(f"{name}.wide", self._apply_norm(f"{name}.norm2", states)), 0.0
        )
        return as_floats(states + self._linear(f"{name}.narrow", as_floats(wide)))

    def _hear(self, number: int, states: Floats) -> tuple[Floats, Floats]:
        key, value = np.split(self._linear(f"decoder.{number}.tell", states), 2, axis=1)
        return _heads(key), _heads(value)

    def token(self, number: int) -> Floats:
        """Return what the decoder takes in after it has written a token; 0: nothing was written."""
        return as_floats(self._m["tokens.weight"].T[number])

    def begin(self, units: int) -> DecoderMemory:
        """Return the memory of one row before its first action on a sentence of so many units."""
        width = self._v["norm.weight"].shape[0]
        empty = [np.zeros((1, HEADS, 0, width // HEADS), np.float32)] * self._decoder
        return DecoderMemory(np.zeros((1, units), bool), np.full(1, -1), empty, list(empty))

    def step(
        self,
        encoded: SentenceStates,
        memory: DecoderMemory,
        written: Sequence[Floats],
        parts: Sequence[int],
    ) -> tuple[Floats, Floats]:
        """Return (rows, tokens) and (rows, units): the scores of each row's next action.

        Args:
            encoded: the sentence.
            memory: of the actions before; these are added.
            written: by row the action before, as ``token`` or ``taken`` gives it.
            parts: by row which part of the plan comes next, by its number.
        """
        columns, is_told, rows = memory.columns(), memory.is_told, list(parts)
        state = as_floats(np.stack(written) + self._m["parts.weight"].T[rows])
        for number in range(self._decoder):
            name = f"decoder.{number}"
            query, key, value = (
                each.transpose(1, 0, 2)[:, :, None] for each in self._mix(name, state)
            )
            memory.keys[number] = np.concatenate((memory.keys[number], key), 2)
            memory.values[number] = np.concatenate((memory.values[number], value), 2)
            count = memory.keys[number].shape[2]
            apart = np.clip(np.arange(1 - count, 1), -FARTHEST, 0) + FARTHEST
            bias = self._m[f"{name}.near.weight"].T[:, apart][:, None]
            heard = _attend(query, memory.keys[number], memory.values[number], bias)
            state = as_floats(state + self._linear(f"{name}.join", heard.reshape(len(rows), -1)))
            asked = _heads(self._linear(f"{name}.ask", self._apply_norm(f"{name}.norm3", state)))
            table = self._m[f"{name}.far.weight"].T
            far = as_floats(table[:, columns] + table[:, -1, None, None] * is_told)
            answer = _join_heads(_attend(asked, *encoded.heard[number], far))
            state = as_floats(state + self._linear(f"{name}.answer", answer))
            state = self._think(name, state)
        out = as_floats(np.tanh(self._linear("out", self._apply_norm("norm", state))))
        units = out @ self._m["point.weight"] @ encoded.pointed.T / out.shape[1] ** 0.5
        table = self._m["apart.weight"].T[rows]
        units = units + np.take_along_axis(table, columns, 1) + table[:, -1:] * is_told
        return self._linear("scores", out), as_floats(units)
