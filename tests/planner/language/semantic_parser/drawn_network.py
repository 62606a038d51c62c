"""Draw networks with any weights: what they decode must be a plan all the same."""

from __future__ import annotations

import numpy as np

from planner.language.semantic_parser.features import BUCKETS
from planner.language.semantic_parser.linear_plan import PARTS, TOKENS
from planner.language.semantic_parser.network import DISTANCES, FARTHEST, HEADS

WIDTH = 8
_LINEAR = {"mix": (3, 1), "join": (1, 1), "wide": (2, 1), "narrow": (1, 2)}
_HEARING = {"ask": (1, 1), "tell": (2, 1), "answer": (1, 1)}


def draw_weights(seed: int) -> dict[str, np.ndarray[tuple[int, ...], np.dtype[np.float32]]]:
    """Return weights of a small network by name."""
    shapes: dict[str, tuple[int, ...]] = {
        "words.weight": (BUCKETS, WIDTH),
        "pieces.weight": (BUCKETS, WIDTH),
        "tokens.weight": (len(TOKENS) + 1, WIDTH),
        "parts.weight": (len(PARTS), WIDTH),
        "apart.weight": (len(PARTS), DISTANCES),
        "decoder.0.far.weight": (HEADS, DISTANCES),
        "scores.weight": (len(TOKENS), WIDTH),
        "scores.bias": (len(TOKENS),),
        "keys.weight": (WIDTH, WIDTH),
        "point.weight": (WIDTH, WIDTH),
    }
    inner = {f"encoder.0.{name}": size for name, size in _LINEAR.items()}
    inner |= {f"decoder.0.{name}": size for name, size in (_LINEAR | _HEARING).items()}
    for name, (rows, columns) in (inner | {"felt": (1, 1), "taken": (1, 1), "out": (1, 1)}).items():
        shapes[f"{name}.weight"] = (rows * WIDTH, columns * WIDTH)
        shapes[f"{name}.bias"] = (rows * WIDTH,)
    for layer in ("encoder.0", "decoder.0"):
        shapes[f"{layer}.near.weight"] = (HEADS, 2 * FARTHEST + 1)
    norms = ("encoder.0.norm1", "encoder.0.norm2", "heard", "norm")
    for name in (*norms, *(f"decoder.0.norm{number}" for number in (1, 2, 3))):
        shapes |= {f"{name}.weight": (WIDTH,), f"{name}.bias": (WIDTH,)}
    random = np.random.default_rng(seed)
    return {name: random.normal(size=size).astype(np.float32) for name, size in shapes.items()}
