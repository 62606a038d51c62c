"""Draw networks with any weights: what they decode must be a plan all the same."""

from __future__ import annotations

import numpy as np

from planner.language.semantic_parser.features import BUCKETS
from planner.language.semantic_parser.linear_plan import TOKENS
from planner.language.semantic_parser.units import MAX_UNITS

WIDTH = 8


def draw_weights(seed: int) -> dict[str, np.ndarray[tuple[int, ...], np.dtype[np.float32]]]:
    """Return weights of a small network by name."""
    shapes: dict[str, tuple[int, ...]] = {
        "embedding.weight": (BUCKETS, WIDTH),
        "positions.weight": (MAX_UNITS, WIDTH),
        "tokens.weight": (len(TOKENS) + 1, WIDTH),
        "norm.weight": (WIDTH,),
        "norm.bias": (WIDTH,),
        "scores.weight": (len(TOKENS), WIDTH),
        "scores.bias": (len(TOKENS),),
    }
    layer = {"mix": (3, 1), "join": (1, 1), "wide": (2, 1), "narrow": (1, 2)}
    inner = {f"layers.0.{name}": size for name, size in layer.items()}
    for name, (rows, columns) in (
        inner | {"begin": (1, 1), "gates_in": (3, 2), "gates_hidden": (3, 1), "out": (1, 2)}
    ).items():
        shapes[f"{name}.weight"] = (rows * WIDTH, columns * WIDTH)
        shapes[f"{name}.bias"] = (rows * WIDTH,)
    for name in ("keys", "taken", "look", "point"):
        shapes[f"{name}.weight"] = (WIDTH, WIDTH)
    for name in ("layers.0.norm1", "layers.0.norm2"):
        shapes |= {f"{name}.weight": (WIDTH,), f"{name}.bias": (WIDTH,)}
    random = np.random.default_rng(seed)
    return {name: random.normal(size=size).astype(np.float32) for name, size in shapes.items()}
