"""Spoil a clean picture as a cheap colour-and-depth camera does. Seeded; knows no home.

Colour: exposure and white balance that wander, noise that grows with light. Depth: an error that
grows with the square of the distance, as stereo's does, steps of a millimetre, and holes where the
surface is grazed, at edges in front of something farther, and here and there.
"""

from __future__ import annotations

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
    noise = rng.standard_normal(lit.shape, dtype=np.float32)
    lit += noise * (np.float32(level) * (READ + SHOT * lit))
    levels: NDArray[np.uint8] = np.clip(lit + 0.5, 0.0, 255.0).astype(np.uint8)
    return levels


def _depths(frame: Frame, rng: np.random.Generator, level: float) -> NDArray[np.float32]:
    depth = frame.depth_m
    sigma = np.float32(level) * (DEPTH_M + DEPTH_PER_M * depth * depth)
    noisy = depth + sigma * rng.standard_normal(depth.shape, dtype=np.float32)
    noisy = np.round(noisy * 1000.0) / np.float32(1000.0)
    lost = rng.random(depth.shape, dtype=np.float32) < LOST * level
    lost |= (depth == 0.0) | (frame.facing < GRAZING) | _edges(depth)
    noisy[lost] = 0.0
    return np.maximum(noisy, 0.0)


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
