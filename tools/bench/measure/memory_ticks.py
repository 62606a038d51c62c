"""Let the core live for 10^6 ticks (2.8 h) and see what memory it keeps.

A scripted world drives it to and fro, with stops, resumes, lost and late planners on the way; the
collector is set as the bridge sets it: frozen, off, young objects collected in slack time. What the
world itself remembers is thrown away before each look.
"""

from __future__ import annotations

import gc
import sys
from typing import TYPE_CHECKING

import psutil

from tools.bench.report import ReportRow, row_of

if TYPE_CHECKING:
    from tests.bridge.core.scripted import World
    from tools.bench.context import BenchLab

NAME = "memory_ticks"
TITLE = "bridge core: memory kept over 10^6 ticks"
LONG_ONLY = True
TICKS, QUICK_TICKS = 1_000_000, 50_000
LOOKS = 20
WARM_LOOKS = 4
"""Rings, books and answers are full by then: 64 missions, 64 verdicts, 256 statuses."""
GOAL_TICKS = 700


def live(ticks: int, looks: int = LOOKS) -> dict[str, list[int]]:
    """Run so many ticks; return blocks and resident bytes at so many looks."""
    from tests.bridge.core.scripted import World  # benches run in a checkout; the door stays light

    world = World().driving()
    gc.collect()
    gc.freeze()
    gc.disable()
    told: dict[str, list[int]] = {"blocks": [], "rss": [], "driven_mm": []}
    process = psutil.Process()
    try:
        for tick in range(1, ticks + 1):
            _happens(world, tick)
            world.tick()
            if tick % 20 == 0:
                gc.collect(0)
            if tick % (ticks // looks) == 0:
                _forget(world)
                gc.collect()
                told["blocks"].append(sys.getallocatedblocks())
                told["rss"].append(process.memory_info().rss)
                told["driven_mm"].append(round(1000 * world.state.odometry.travelled_m))
    finally:
        gc.unfreeze()
        gc.enable()
    return told


def _happens(world: World, tick: int) -> None:
    """Give goals and resumes; at times a stop, a silence or a gap."""
    planner, phase = world.planner, tick % GOAL_TICKS
    if planner is None:
        return
    if phase == 0:
        planner.mission = f"m{tick}"
        planner.leg = 1
        planner.goal_m = (4.0, 0.0) if tick // GOAL_TICKS % 2 else (-3.0, 1.0)
        world.op("resume" if world.state.held is not None or tick % 7 == 0 else "arm")
    elif phase == 500 and tick // GOAL_TICKS % 3 == 0:
        world.stop()
    planner.silent = tick // GOAL_TICKS % 5 == 0 and 300 <= phase < 340
    if phase % 50 == 0:
        _forget(world)


def _forget(world: World) -> None:
    world.events.clear()
    world.statuses.clear()
    world.last = None


def measure(lab: BenchLab) -> list[ReportRow]:
    """Live once, long."""
    ticks = TICKS if lab.long else QUICK_TICKS
    (told,) = lab.slices(f"{ticks}", 1, lambda _: live(ticks))
    blocks, rss = told["blocks"][WARM_LOOKS:], told["rss"][WARM_LOOKS:]
    note = f"{ticks} ticks, {told['driven_mm'][-1] / 1000:.0f} m; from the fifth look of {LOOKS}"
    return [
        ReportRow("blocks kept more", "", "0", value=str(blocks[-1] - blocks[0]), note=note),
        row_of("blocks at each look", "", "flat", [float(one) for one in blocks], ""),
        ReportRow(
            "resident memory more", "KiB", "0", value=str((rss[-1] - rss[0]) // 1024), note=note
        ),
    ]
