"""The core keeps no memory: four thousand ticks, looked at by blocks."""

from __future__ import annotations

import gc

from tools.bench.measure.memory_ticks import live


def test_blocks_stay_flat_while_it_drives_and_stops() -> None:
    told = live(4_200, 6)
    gc.freeze()  # as the whole run has it, so that no later collection looks at what stays
    blocks = told["blocks"]
    assert told["driven_mm"][-1] > 5_000, "it must have driven"
    assert blocks[-1] - blocks[2] < 1_400, "rings fill: statuses, answers, missions; nothing else"
