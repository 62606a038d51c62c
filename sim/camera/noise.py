"""Spoil a clean picture as a cheap colour-and-depth camera does. Seeded; knows no home.

Colour: exposure and white balance that wander, noise that grows with light. Depth: an error that
grows with the square of the distance, as stereo's does, steps of a millimetre, and holes where the
surface is grazed, at edges in front of something farther, and here and there.
"""

from __future__ import annotations

from functools import lru_cache
from math import prod
from typing import TYPE_CHECKING, Final

import numpy as np

from sim.camera.frame import Frame

if TYPE_CHECKING:
    from numpy.typing import NDArray

EXPOSURE, BALANCE = 0.05, 0.015
"""One standard deviation of the whole picture's brightness, and of each channel's."""
READ, SHOT = 1.5, 0.012
"""Noise of a pixel: levels, and share of its own value."""
DEPTH_M, DEPTH_PER_M = 0.001, 0.0018
"""Standard deviation at 0 m, and what the square of each metre adds: 9 mm at 2 m, 4 cm at 5 m."""
FILM: Final = 1 << 20
"""Length of the grain that pictures are spoilt with."""
LOST: Final = 0.003
"""Share of pixels without depth for no reason."""
GRAZING: Final = 0.12
"""Cosine below which nothing comes back: within 7 degrees of the surface."""
STEP: Final = 0.06
"""A neighbour farther by this share of the distance makes an edge."""


def spoil(frame: Frame, rng: np.random.Generator, level: float = 1.0) -> Frame:
    """Return the picture as the camera would give it; ``level`` multiplies all noise."""
    return Frame(
        color=_colors(frame, rng, level),
        depth_m=_depths(frame, rng, level),
        ids=frame.ids,
        facing=frame.facing,
    )


def _colors(frame: Frame, rng: np.random.Generator, level: float) -> NDArray[np.uint8]:
    gain = np.exp(level * EXPOSURE * rng.standard_normal())
    gains = (gain * (1.0 + level * BALANCE * rng.standard_normal(3))).astype(np.float32)
    lit = frame.color * gains
    sigma = np.float32(level) * (np.float32(READ) + np.float32(SHOT) * lit)
    sigma *= _grain(rng, lit.shape)
    lit += sigma
    lit += np.float32(0.5)
    levels: NDArray[np.uint8] = np.clip(lit, 0.0, 255.0, out=lit).astype(np.uint8)
    return levels


def _depths(frame: Frame, rng: np.random.Generator, level: float) -> NDArray[np.float32]:
    depth = frame.depth_m
    sigma = np.float32(level) * (DEPTH_M + DEPTH_PER_M * depth * depth)
    noisy: NDArray[np.float32] = depth + sigma * _grain(rng, depth.shape)
    noisy = np.round(noisy * np.float32(1000.0)) * np.float32(0.001)
    noisy *= (depth > 0.0) & (frame.facing >= GRAZING) & ~_edges(depth)
    noisy.reshape(-1)[rng.integers(0, depth.size, rng.poisson(LOST * level * depth.size))] = 0.0
    np.maximum(noisy, 0.0, out=noisy)
    return noisy


@lru_cache(maxsize=1)
def _film() -> NDArray[np.float32]:
    return np.random.default_rng(1).standard_normal(FILM, dtype=np.float32)


def _grain(rng: np.random.Generator, shape: tuple[int, ...]) -> NDArray[np.float32]:
    """Return normal noise: a stretch of one long film, begun anywhere; drawing it costs 3 ms."""
    count = prod(shape)
    if 2 * count > FILM:
        return rng.standard_normal(shape, dtype=np.float32)
    begin = int(rng.integers(0, FILM - count))
    return _film()[begin : begin + count].reshape(shape)


def _edges(depth: NDArray[np.float32]) -> NDArray[np.bool_]:
    """Mark the farther side of every step, where one eye of a stereo camera sees nothing."""
    edge = np.zeros(depth.shape, dtype=np.bool_)
    near = 1.0 - STEP
    left, right, upper, lower = depth[:, :-1], depth[:, 1:], depth[:-1], depth[1:]
    edge[:, 1:] |= left < near * right
    edge[:, :-1] |= right < near * left
    edge[1:] |= upper < near * lower
    edge[:-1] |= lower < near * upper
    return edge
