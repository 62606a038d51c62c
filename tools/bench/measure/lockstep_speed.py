"""Measure how much faster than real time a whole robot with its lidar runs in one process."""

from __future__ import annotations

import time
from typing import TYPE_CHECKING

from tools.bench.report import ReportRow, row_of
from tools.lockstep import LockstepWorld

if TYPE_CHECKING:
    from tools.bench.context import BenchLab

NAME = "lockstep_speed"
TITLE = "lockstep: simulated seconds per second"
LONG_ONLY = False
GOAL = ">= 10"
ORDERS = {
    "two_room": "go to the living room, then come back",
    "home": "go to the kitchen, then the bedroom",
}
LIMIT_S = 60.0


def measure(lab: BenchLab) -> list[ReportRow]:
    """Drive on both sites in turn."""
    pairs = list(lab.slices("pair", lab.count(3, 10), _pair))
    rows = []
    for site in ORDERS:
        name = f"lockstep with lidar, {site}"
        wall, own = ([pair[site][which] for pair in pairs] for which in (0, 1))
        rows.append(row_of(name, "x", GOAL, wall, "per second of wall clock, one core"))
        rows.append(row_of(name, "x", "", own, "per second of its own CPU time"))
    return rows


def _pair(index: int) -> dict[str, tuple[float, float]]:
    return {site: _factors(site, text, index) for site, text in ORDERS.items()}


def _factors(site: str, text: str, index: int) -> tuple[float, float]:
    """Return simulated seconds per second of wall clock and of this process's CPU time."""
    world = LockstepWorld(site=site, seed=index + 1)
    goal = world.say(text)
    began_s, began_cpu_s = time.perf_counter(), time.process_time()
    began_tick = world.tick_count
    end_tick = began_tick + round(LIMIT_S / world.bridge.config.period_s)
    while not goal.has_ended and world.tick_count < end_tick:
        world.tick()
    simulated_s = (world.tick_count - began_tick) * world.bridge.config.period_s
    wall_s, cpu_s = time.perf_counter() - began_s, time.process_time() - began_cpu_s
    return simulated_s / wall_s, simulated_s / cpu_s
