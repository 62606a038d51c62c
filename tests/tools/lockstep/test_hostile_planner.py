"""Six hostile planners on five homes break nothing, though they do drive; nor do external brains.

The brains push at a fence with no wall behind it, in a bare hall, where no lidar helps.
"""

from __future__ import annotations

import json
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

import pytest

from tools.lockstep import LockstepWorld
from tools.lockstep.homes import hall, made_home
from tools.lockstep.hostile import HostilePlanner, TrustingOperator
from tools.lockstep.judge import Judge

pytestmark = pytest.mark.nightly(keep=5)


PENS = (
    ((1.2, 6.2), (2.8, 6.2), (2.8, 7.8), (1.2, 7.8)),
    ((6.0, 6.0), (8.0, 6.0), (8.0, 8.0), (6.0, 8.0)),
)
"""Where the robot begins, and where the hall's one place is."""


@pytest.mark.parametrize("seed", range(6))
def test_a_hostile_planner_breaks_no_law(seed: int) -> None:
    told = attack(seed, 8.0)
    assert told["broken"] == {}
    assert told["metres"] > 0.02, "or nothing was tried"


@pytest.mark.parametrize("seed", [0, 3, 4])
def test_a_hostile_external_brain_breaks_no_law_where_localization_falls_silent(
    seed: int, tmp_path: Path
) -> None:
    site = hall(tmp_path)
    fence = json.loads((site / "fence.json").read_text("utf-8"))
    (site / "fence.json").write_text(json.dumps({**fence, "allowed": PENS}), "utf-8")
    world = LockstepWorld(site=site, seed=seed + 1)
    hostile, person, judge = (
        HostilePlanner(world, seed, "external"),
        TrustingOperator(world),
        Judge(world),
    )
    hostile.metres = 60.0
    lost = 0
    for _ in range(2000):
        world.tick()
        hostile.turn()
        person.turn()
        judge.look()
        lost += "POSE_LOST.0" in world.bridge.state.rows
    assert dict(judge.broken) == {}
    assert judge.metres > 0.3, "or nothing was tried"
    assert lost > 200


SITES = 5


def site_of(seed: int, folder: Path) -> Path | str:
    """Return one of the five homes."""
    which = seed % SITES
    return ("home", "two_room")[which] if which < 2 else made_home(folder, which)


def attack(seed: int, run_s: float) -> dict[str, Any]:
    """Run one script; return what broke, how far it drove and how long it was in each mode."""
    with TemporaryDirectory(prefix="pb-") as folder:
        world = LockstepWorld(site=site_of(seed, Path(folder)), seed=seed + 1)
        hostile, person, judge = HostilePlanner(world, seed), TrustingOperator(world), Judge(world)
        for _ in range(round(run_s * 100)):
            world.tick()
            hostile.turn()
            person.turn()
            judge.look()
    return {
        "broken": dict(judge.broken),
        "metres": round(judge.metres, 3),
        "modes": dict(judge.modes),
        "lives": hostile.lives,
    }
