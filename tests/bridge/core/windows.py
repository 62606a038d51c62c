"""Bring a row to the edge of its window, and ask what a tick showed or dropped."""

from __future__ import annotations

from dataclasses import replace

from bridge.core import RejectedAt
from tests.bridge.core.fake_planner import PERIOD_S
from tests.bridge.core.scripted import World
from wire import DecodeFailure


def silent_for(world: World, ticks: int) -> None:
    """Run exactly so many ticks."""
    for _ in range(ticks):
        world.tick()


def age_ticks(world: World, since_s: float | None) -> int:
    """Return how many ticks ago something was."""
    assert since_s is not None
    return round((world.now_s - since_s) / PERIOD_S)


def until_age(world: World, since_s: float | None, ticks: int) -> None:
    """Run until something is exactly so many ticks old."""
    silent_for(world, ticks - age_ticks(world, since_s))


def raised(world: World, stage: str) -> bool:
    return stage in world.rows()


def bad_bytes(world: World, count: int, key: str = "cmd/waypoints") -> None:
    rejected = (RejectedAt(key, DecodeFailure("invalid", "points.0.x_m: input is not finite")),)
    world.extra = replace(world.extra, rejected=rejected * count)


def dropped(world: World, code: str) -> bool:
    """Take a tick and tell whether it dropped something for this reason."""
    return code in world.tick().reasons
