"""Run the pointer network: an encoder over units, a decoder that writes one action after another.

Numbers alone, in numpy; what a number means is the business of ``decoding``. The weights are 8-bit
whole numbers with a scale a row; those of the units' buckets stay so in memory.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from numpy.typing import NDArray

    Floats = NDArray[np.float32]

HEADS = 4


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
    """Hold what the encoder made of a sentence."""

    states: Floats
    """(units, width)."""
    pointed: Floats
    """The states as pointers compare them."""
    taken: Floats
    """The states as the decoder takes them after it has pointed at one."""


@dataclass(frozen=True, slots=True)
class DecoderState:
    """Hold what the decoder remembers between two actions."""

    hidden: Floats
    context: Floats


def _norm(values: Floats, gain: Floats, shift: Floats) -> Floats:
    centred = values - values.mean(axis=-1, keepdims=True)
    spread = np.sqrt((centred * centred).mean(axis=-1, keepdims=True) + 1e-5)
    return as_floats(centred / spread * gain + shift)


def _softmax(scores: Floats) -> Floats:
    shifted = np.exp(scores - scores.max(axis=-1, keepdims=True))
    return as_floats(shifted / shifted.sum(axis=-1, keepdims=True))


def _sigmoid(values: Floats) -> Floats:
    return as_floats(1.0 / (1.0 + np.exp(-values)))


class PointerNetwork:
    """Score actions for a sentence.

    Args:
        matrices: weights by name, as ``tools/train_reader`` writes them.
        vectors: shifts and gains by name.
    """

    def __init__(self, matrices: Mapping[str, Int8Matrix], vectors: Mapping[str, Floats]) -> None:
        self._buckets = matrices["embedding.weight"]
        self._m = {
            name: np.ascontiguousarray(matrix.whole().T)
            for name, matrix in matrices.items()
            if name != "embedding.weight"
        }
        self._v = dict(vectors)
        names = {name.split(".")[1] for name in self._m if name.startswith("layers.")}
        self._layers = len(names)

    def encode(self, features: Sequence[Sequence[int]]) -> SentenceStates:
        """Return the states of a sentence's units."""
        flat = [bucket for unit in features for bucket in unit]
        starts = np.cumsum([0, *map(len, features[:-1])])
        sums = np.add.reduceat(self._buckets.rows(flat), starts, axis=0)
        lengths = np.array([[len(unit)] for unit in features], np.float32)
        states = as_floats(sums / lengths + self._m["positions.weight"].T[: len(features)])
        for number in range(self._layers):
            states = self._layer(f"layers.{number}", states)
        states = _norm(states, self._v["norm.weight"], self._v["norm.bias"])
        return SentenceStates(
            states, states @ self._m["keys.weight"], states @ self._m["taken.weight"]
        )

    def _linear(self, name: str, values: Floats) -> Floats:
        return as_floats(values @ self._m[f"{name}.weight"] + self._v[f"{name}.bias"])

    def _layer(self, name: str, states: Floats) -> Floats:
        count, width = states.shape
        normed = _norm(states, self._v[f"{name}.norm1.weight"], self._v[f"{name}.norm1.bias"])
        mixed = self._linear(f"{name}.mix", normed).reshape(count, 3, HEADS, width // HEADS)
        query, key, value = mixed.transpose(1, 2, 0, 3)
        weights = _softmax(as_floats(query @ key.transpose(0, 2, 1) / (width // HEADS) ** 0.5))
        joined = (weights @ value).transpose(1, 0, 2).reshape(count, width)
        states = as_floats(states + self._linear(f"{name}.join", joined))
        normed = _norm(states, self._v[f"{name}.norm2.weight"], self._v[f"{name}.norm2.bias"])
        wide = np.maximum(self._linear(f"{name}.wide", normed), 0.0)
        return as_floats(states + self._linear(f"{name}.narrow", as_floats(wide)))

    def begin(self, encoded: SentenceStates) -> DecoderState:
        """Return the decoder's state before its first action."""
        mean = encoded.states.mean(axis=0)
        return DecoderState(np.tanh(self._linear("begin", mean)), np.zeros_like(mean))

    def token(self, number: int) -> Floats:
        """Return what the decoder takes in after it has written a token; 0: nothing was written."""
        return as_floats(self._m["tokens.weight"].T[number])

    def step(
        self, encoded: SentenceStates, state: DecoderState, written: Floats
    ) -> tuple[DecoderState, Floats, Floats]:
        """Return the next state, the tokens' scores and the units' scores."""
        hidden = state.hidden
        gates_in = self._linear("gates_in", np.concatenate((written, state.context)))
        gates = self._linear("gates_hidden", hidden)
        width = len(hidden)
        reset, update = np.split(_sigmoid(gates_in[: 2 * width] + gates[: 2 * width]), 2)
        fresh = np.tanh(gates_in[2 * width :] + reset * gates[2 * width :])
        hidden = as_floats((1.0 - update) * fresh + update * hidden)
        looked = encoded.states @ (hidden @ self._m["look.weight"])
        context = as_floats(_softmax(looked) @ encoded.states)
        out = as_floats(np.tanh(self._linear("out", np.concatenate((hidden, context)))))
        scores = self._linear("scores", out)
        units = as_floats(encoded.pointed @ (out @ self._m["point.weight"]) / width**0.5)
        return DecoderState(hidden, context), scores, units
