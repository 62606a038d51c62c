"""Time each core step of one drive in lockstep: ``python -m tools.bench.steps INDEX``; prints JSON.

The garbage collector is kept out, as in the bridge. Thread CPU time, so that other work on the
machine counts only by what it pushes out of the caches.
"""

from __future__ import annotations

import gc
import json
import sys
import time
from typing import TYPE_CHECKING, Any

from bridge.core import step
from tools.lockstep import LockstepWorld

if TYPE_CHECKING:
    from collections.abc import Callable

    from bridge.core import BridgeState, CoreConfig, Decision, Inbox

WARM_TICKS = 200
MOST_TICKS = 4_000


class TimedStep:
    """Be the core's step and note what each call costs while the robot drives."""

    def __init__(self, step: Callable[[CoreConfig, BridgeState, Inbox, float], Decision]) -> None:
        self._step = step
        self.scan_us: list[float] = []
        self.other_us: list[float] = []

    def __call__(
        self, config: CoreConfig, state: BridgeState, inbox: Inbox, now_s: float
    ) -> Decision:
        began_ns = time.thread_time_ns()
        decision = self._step(config, state, inbox, now_s)
        took_us = (time.thread_time_ns() - began_ns) / 1e3
        if state.mode == "ACTIVE" and state.tick > WARM_TICKS:
            (self.other_us if inbox.scan is None else self.scan_us).append(took_us)
        return decision


def main(index: int) -> int:
    """Drive between rooms and print what each step cost."""
    print(json.dumps(_drive(index)))
    return 0


def _drive(index: int) -> dict[str, Any]:
    timed = TimedStep(step)
    world = LockstepWorld(site="home", seed=index + 1, step=timed)
    gc.collect()
    gc.freeze()
    gc.disable()
    goal = world.say("go to the kitchen, then the bedroom" if index % 2 else "go to the sofa")
    while not goal.has_ended and world.tick_count < MOST_TICKS:
        world.tick()
    return {"scan_us": timed.scan_us, "other_us": timed.other_us}


if __name__ == "__main__":
    sys.exit(main(int(sys.argv[1])))
