"""Describe a straight line on the floor. Pure."""

from __future__ import annotations

from dataclasses import dataclass
from math import atan2, cos, hypot, sin

from wire import Pose2


@dataclass(frozen=True, slots=True)
class TestTrack:
    """Give a line in ``map`` by its ends."""

    start: tuple[float, float]
    end: tuple[float, float]

    @property
    def length_m(self) -> float:
        """Return how long it is."""
        return hypot(self.end[0] - self.start[0], self.end[1] - self.start[1])

    @property
    def heading_rad(self) -> float:
        """Return the direction from start to end."""
        return atan2(self.end[1] - self.start[1], self.end[0] - self.start[0])

    @property
    def middle(self) -> Pose2:
        """Return where a robot starts."""
        x = (self.start[0] + self.end[0]) / 2
        y = (self.start[1] + self.end[1]) / 2
        return Pose2(x, y, self.heading_rad)

    def along(self, pose: Pose2) -> tuple[float, float]:
        """Return how far along a pose is, and how far to the left of the line [m]."""
        dx, dy = pose.x_m - self.start[0], pose.y_m - self.start[1]
        c, s = cos(self.heading_rad), sin(self.heading_rad)
        return c * dx + s * dy, c * dy - s * dx

    def at(self, along_m: float) -> tuple[float, float]:
        """Return a point of the line."""
        c, s = cos(self.heading_rad), sin(self.heading_rad)
        return self.start[0] + c * along_m, self.start[1] + s * along_m
