"""Let a hostile planner drive robots by seed over five homes in lockstep; count broken laws.

Home, two_room and three homes made by seed; judged on the simulator's truth and at the wheels.
"""

from __future__ import annotations

from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

from tools.lockstep import LockstepWorld
from tools.lockstep.homes import made_home
from tools.lockstep.hostile import HostilePlanner, TrustingOperator
from tools.lockstep.judge import Judge

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
