"""Measure how much faster than real time a whole robot with its lidar runs in one process."""

from __future__ import annotations

import time
from typing import TYPE_CHECKING

from bench.report import Row, row_of
from lockstep import Together

if TYPE_CHECKING:
    from bench.lab import Lab

NAME = "lockstep_speed"
TITLE = "lockstep: simulated seconds per second"
LONG_ONLY = False
GOAL = ">= 10"
ORDERS = {
    "two_room": "go to the living room, then come back",
    "home": "go to the kitchen, then the bedroom",
}
LIMIT_S = 60.0


def measure(lab: Lab) -> list[Row]:
    """Drive on both sites in turn."""
    factors: dict[str, list[float]] = {site: [] for site in ORDERS}
    for data in lab.slices("pair", lab.count(3, 10), _pair):
        for site, factor in data.items():
            factors[site].append(factor)
    return [
        row_of(f"lockstep with lidar, {site}", "x", GOAL, factors[site], "wall clock, one core")
        for site in ORDERS
    ]


def _pair(index: int) -> dict[str, float]:
    return {site: _factor(site, text, index) for site, text in ORDERS.items()}


def _factor(site: str, text: str, index: int) -> float:
    world = Together(site=site, seed=index + 1)
    goal = world.say(text)
    began_s, began_tick = time.perf_counter(), world.tick_count
    end_tick = began_tick + round(LIMIT_S / world.bridge.config.period_s)
    while not goal.ended and world.tick_count < end_tick:
        world.tick()
    simulated_s = (world.tick_count - began_tick) * world.bridge.config.period_s
    return simulated_s / (time.perf_counter() - began_s)
