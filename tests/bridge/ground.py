"""Give the bridge's tests a clock, a configuration, and the wait for what another thread does."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

from bridge.core import BridgeState, CoreConfig, Decision, Inbox, initial, step
from bridge.fence_file import load_fence
from wire import RobotDescription

ROOT = Path(__file__).parents[2]
SITE = ROOT / "sites" / "two_room"


class FakeClock:
    """Be a clock that only sleeping moves, and that a test may push."""

    def __init__(self, now_s: float = 100.0) -> None:
        self.time_s = now_s
        self.oversleep_s = 0.0

    def now_s(self) -> float:
        return self.time_s

    def sleep_until(self, at_s: float) -> None:
        self.time_s = max(self.time_s, at_s) + self.oversleep_s
        self.oversleep_s = 0.0


def core_config(boot: str = "boot1", robot: RobotDescription | None = None) -> CoreConfig:
    fence, fence_hash = load_fence(SITE / "fence.json")
    chosen = robot or RobotDescription()
    return CoreConfig(
        robot=chosen,
        robot_hash=chosen.hash,
        fence=fence,
        fence_hash=fence_hash,
        map_id=fence.map_id,
        boot=boot,
    )


def run_core(
    config: CoreConfig,
    inboxes: list[Inbox],
    take: Callable[[BridgeState, Inbox, float, Decision], None],
) -> BridgeState:
    """Run the core over inboxes at its period and hand every tick to ``take``."""
    now_s = 100.0
    state = initial(config, now_s)
    for inbox in inboxes:
        now_s += config.period_s
        decision = step(config, state, inbox, now_s)
        take(state, inbox, now_s, decision)
        state = decision.state
    return state
