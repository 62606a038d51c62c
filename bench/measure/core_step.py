"""Measure what one core step costs its thread, with scans coming in, while really driving.

Lockstep feeds the step exactly what the bridge process would get; the garbage collector is kept out
as there. Thread CPU time, so that other work on the machine does not count.
"""

from __future__ import annotations

import gc
import time
from typing import TYPE_CHECKING

from bench.report import Row, row_of
from bridge.core import step
from lockstep import Together
from wire import Mode

if TYPE_CHECKING:
    from bench.lab import Lab
    from bridge.core import BridgeState, CoreConfig, Decision, Inbox

NAME = "core_step"
TITLE = "bridge core: CPU time of one step"
LONG_ONLY = False
GOAL = "p50 <= 100, p99 <= 250"
WARM_TICKS = 200
ROUNDS = 5


class Timed:
    """Be the core's step and note what each call costs while the robot drives."""

    def __init__(self) -> None:
        self.scan_us: list[float] = []
        self.other_us: list[float] = []

    def __call__(
        self, config: CoreConfig, state: BridgeState, inbox: Inbox, now_s: float
    ) -> Decision:
        began_ns = time.thread_time_ns()
        decision = step(config, state, inbox, now_s)
        took_us = (time.thread_time_ns() - began_ns) / 1e3
        if state.mode is Mode.ACTIVE and state.tick > WARM_TICKS:
            (self.other_us if inbox.scan is None else self.scan_us).append(took_us)
        return decision


def measure(lab: Lab) -> list[Row]:
    """Drive between rooms and time each step."""
    scan_us: list[float] = []
    other_us: list[float] = []
    for data in lab.slices("drive", lab.count(ROUNDS, 4 * ROUNDS), _drive):
        scan_us += data["scan_us"]
        other_us += data["other_us"]
    driving = "driving in sites/home, lockstep"
    return [
        row_of("core step, all ticks", "us", GOAL, scan_us + other_us, driving),
        row_of("core step, ticks that bring a scan", "us", "", scan_us, driving),
    ]


def _drive(index: int) -> dict[str, list[float]]:
    timed = Timed()
    world = Together(site="home", seed=index + 1, step=timed)
    gc.collect()
    gc.freeze()
    gc.disable()
    try:
        goal = world.say("go to the kitchen, then the bedroom" if index % 2 else "go to the sofa")
        while not goal.ended and world.tick_count < 4_000:
            world.tick()
    finally:
        gc.unfreeze()
        gc.enable()
    return {"scan_us": timed.scan_us, "other_us": timed.other_us}
