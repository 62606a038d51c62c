"""What tests of ``pons map`` share: a kept drive, and a taught place."""

from __future__ import annotations

from datetime import UTC, datetime
from pathlib import Path

from bridge.core import BridgeState, CoreConfig, Decision, Inbox, step
from lockstep.bridge_process import Step
from planner.site.places import Names
from planner.site.taught_places import TaughtPlace
from tests.bridge.recorded import Taken
from wire import Pose2

Drive = tuple[Path, Pose2, Pose2, list[Taken]]
"""The recording, the first and the last true pose, and what the bridge was given."""


def keep_ticks(ticks: list[Taken]) -> Step:
    """Return the bridge's step, and keep what a recorder would have been given."""

    def kept(config: CoreConfig, state: BridgeState, inbox: Inbox, now_s: float) -> Decision:
        decision = step(config, state, inbox, now_s)
        ticks.append((state, inbox, now_s, decision))
        return decision

    return kept


def taught(place_id: str, x_m: float, y_m: float, on: str) -> TaughtPlace:
    return TaughtPlace(
        id=place_id,
        name=Names(en=place_id, zh=place_id),
        pose=Pose2(x_m, y_m, 0.5),
        map_id=on,
        by="ada",
        taught=datetime(2026, 11, 24, tzinfo=UTC),
    )
