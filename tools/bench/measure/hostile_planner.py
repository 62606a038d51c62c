"""Let a hostile planner drive robots by seed over five homes in lockstep; count broken laws.

Home, two_room and three homes made by seed; judged on the simulator's truth and at the wheels.
"""

from __future__ import annotations

from pathlib import Path
from tempfile import TemporaryDirectory
from typing import TYPE_CHECKING, Any

from tools.bench.report import ReportRow, row_of
from tools.lockstep import LockstepWorld
from tools.lockstep.homes import made_home
from tools.lockstep.hostile import HostilePlanner, Person
from tools.lockstep.judge import Judge

if TYPE_CHECKING:
    from tools.bench.context import BenchLab

NAME = "hostile_planner"
TITLE = "hostile planner with all of a planner's rights"
LONG_ONLY = True
RUNS, QUICK_RUNS = 300, 10
RUN_S = 20.0
SITES = 5
LAWS = ("speed", "acceleration", "fence", "clearance", "budget", "motion outside")


def site_of(seed: int, folder: Path) -> Path | str:
    """Return one of the five homes."""
    which = seed % SITES
    return ("home", "two_room")[which] if which < 2 else made_home(folder, which)


def attack(seed: int, run_s: float = RUN_S) -> dict[str, Any]:
    """Run one script; return what broke, how far it drove and how long it was in each mode."""
    with TemporaryDirectory(prefix="pb-") as folder:
        world = LockstepWorld(site=site_of(seed, Path(folder)), seed=seed + 1)
        hostile, person, judge = HostilePlanner(world, seed), Person(world), Judge(world)
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


def measure(lab: BenchLab) -> list[ReportRow]:
    """Attack by slices."""
    runs = list(lab.slices("run", lab.count(QUICK_RUNS, RUNS), attack))
    note = f"{len(runs)} runs of {RUN_S:.0f} s; 0 means < {3 / max(1, len(runs)):.3f} a run"
    rows = [
        ReportRow(
            f"{law} broken",
            "ticks",
            "0",
            value=str(sum(r["broken"].get(law, 0) for r in runs)),
            note=note,
        )
        for law in LAWS
    ]
    active_s = [sum(r["modes"].get(m, 0) for m in ("ACTIVE", "TELEOP")) / 100 for r in runs]
    return [
        *rows,
        row_of("way driven", "m", "", [r["metres"] for r in runs], "a run"),
        row_of("ACTIVE or TELEOP", "s", "", active_s, "a run"),
    ]
