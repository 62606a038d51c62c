"""Measure boxes and discs on the floor. Pure geometry: metres, frame ``map``."""

from __future__ import annotations

from dataclasses import dataclass
from math import hypot
from typing import TypeAlias

EPS_M = 1e-6
"""Shapes nearer than this touch; it swallows the rounding of decimal coordinates."""


@dataclass(frozen=True, slots=True)
class Rect:
    """Cover [x0, x1] x [y0, y1]."""

    x0: float
    y0: float
    x1: float
    y1: float

    def distance(self, x_m: float, y_m: float) -> float:
        """Return how far a point lies outside [m]; 0 inside."""
        return hypot(max(self.x0 - x_m, 0.0, x_m - self.x1), max(self.y0 - y_m, 0.0, y_m - self.y1))

    def depth(self, x_m: float, y_m: float) -> float:
        """Return how far a point lies inside [m]; negative outside."""
        return min(x_m - self.x0, self.x1 - x_m, y_m - self.y0, self.y1 - y_m)

    def overlaps(self, other: Rect) -> bool:
        """Return whether two rectangles share an area, not only an edge."""
        return (
            min(self.x1, other.x1) - max(self.x0, other.x0) > EPS_M
            and min(self.y1, other.y1) - max(self.y0, other.y0) > EPS_M
        )

    def expand(self, by_m: float) -> Rect:
        """Move every edge outwards (inwards when negative)."""
        return Rect(self.x0 - by_m, self.y0 - by_m, self.x1 + by_m, self.y1 + by_m)

    @property
    def bounds(self) -> Rect:
        """Return the smallest rectangle around it: itself."""
        return self


@dataclass(frozen=True, slots=True)
class Disc:
    """Cover a circle."""

    x: float
    y: float
    radius: float

    def distance(self, x_m: float, y_m: float) -> float:
        """Return how far a point lies outside [m]; 0 inside."""
        return max(0.0, hypot(x_m - self.x, y_m - self.y) - self.radius)

    def overlaps(self, other: Rect) -> bool:
        """Return whether disc and rectangle share an area, not only a point."""
        return other.distance(self.x, self.y) < self.radius - EPS_M

    @property
    def bounds(self) -> Rect:
        """Return the smallest rectangle around it."""
        r = self.radius
        return Rect(self.x - r, self.y - r, self.x + r, self.y + r)


Shape: TypeAlias = Rect | Disc


@dataclass(frozen=True, slots=True)
class Solid:
    """Hold a shape that stands on the floor, for physics, lidar and map alike."""

    id: str
    shape: Shape
    height_m: float
