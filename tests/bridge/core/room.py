"""Be the room of the scripted world as a lidar sees it: four walls, and one round thing at most."""

from __future__ import annotations

from functools import lru_cache
from math import cos, pi, sin, tau

from wire import Pose2

ROOM_M = 6.0
"""From its middle to each wall."""
BEAMS = 72


@lru_cache(maxsize=16)
def ranges_m(here: Pose2, obstacle_m: tuple[float, float, float] | None) -> tuple[float, ...]:
    """Return what all beams measure; most worlds stand for many scans, and many stand there."""
    return tuple(
        max(0.0, _range(here, here.yaw_rad - pi + index * tau / BEAMS, obstacle_m))
        for index in range(BEAMS)
    )


def _range(here: Pose2, angle: float, obstacle_m: tuple[float, float, float] | None) -> float:
    c, s = cos(angle), sin(angle)
    best = 100.0
    if abs(c) > 1e-9:
        best = ((ROOM_M if c > 0 else -ROOM_M) - here.x_m) / c
    if abs(s) > 1e-9:
        best = min(best, ((ROOM_M if s > 0 else -ROOM_M) - here.y_m) / s)
    if obstacle_m is not None:
        x, y, radius = obstacle_m
        dx, dy = x - here.x_m, y - here.y_m
        along, aside = dx * c + dy * s, dy * c - dx * s
        if along > 0 and abs(aside) < radius:
            best = min(best, along - (radius * radius - aside * aside) ** 0.5)
    return best
