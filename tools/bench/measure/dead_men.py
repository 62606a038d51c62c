"""Measure how long each base of metal drives on by itself when its bridge dies in mid-drive.

In lockstep, with each preset's model on its line: from one tick to the next no byte comes any more.
What counts is when the base takes the speed from its wheels, by its own dead-man, and when the body
stands.
"""

from __future__ import annotations

from dataclasses import asdict, dataclass
from functools import lru_cache, partial
from math import hypot
from random import Random
from typing import TYPE_CHECKING, Any

from bridge.drive.serial_drive import SERIAL_PROTOCOLS
from pons.settings import CHECKOUT
from tools.bench.report import ReportRow, row_of
from tools.lockstep import TICK_S, LockstepWorld
from tools.lockstep.world_fork import fork_world
from wire import RobotDescription, load_robot
from wire.robot import LocalizationConfig

if TYPE_CHECKING:
    from tools.bench.context import BenchLab

NAME = "dead_men"
TITLE = "dead-men: the bridge dies in mid-drive"
LONG_ONLY = True
ALLOWED_MS = 20.0
WATCH_S = 5.0


def measure(lab: BenchLab) -> list[ReportRow]:
    """Measure each kind of drive that has a line."""
    rows = []
    for kind in sorted(SERIAL_PROTOCOLS):
        take = partial(_trial_slice, kind)
        found = [DeathTrial(**one) for one in lab.slices(kind, lab.count(3, 20), take)]
        rows.append(_row(kind, found))
    return rows


@dataclass(frozen=True, slots=True)
class DeathTrial:
    """Tell what a base did after its bridge had died."""

    silence_ms: float
    """Until the wheels were asked for nothing."""
    stood_ms: float
    """Until the body stood."""
    way_m: float
    contacts: int


def _trial_slice(kind: str, index: int) -> dict[str, Any]:
    return asdict(die(kind, index))


def die(kind: str, seed: int) -> DeathTrial:
    """Let the bridge die at a moment of a drive."""
    world = fork_world(_cruising(kind))
    world.run(Random(f"{kind} {seed}").uniform(0.0, 4.0))
    base = world.base
    if base is None:
        raise ValueError(f"{kind} has no line in lockstep")
    last = world.truth
    world.kill_bridge()
    silence_ms: float | None = None
    stood_ms, way_m = 1000.0 * WATCH_S, 0.0
    for tick in range(1, round(WATCH_S / TICK_S) + 1):
        world.tick()
        left_radps, right_radps, _ = base.twin.firmware.motors(world.now_s)
        way_m += hypot(world.truth.x_m - last.x_m, world.truth.y_m - last.y_m)
        last = world.truth
        if silence_ms is None and left_radps == right_radps == 0.0:
            silence_ms = 1000.0 * tick * TICK_S
        if world.standing:
            stood_ms = 1000.0 * tick * TICK_S
            break
    silence_ms = 1000.0 * WATCH_S if silence_ms is None else silence_ms
    return DeathTrial(silence_ms, stood_ms, way_m, world.contacts)


@lru_cache(maxsize=8)
def _cruising(kind: str) -> LockstepWorld:
    """Drive off; each death ends the same drive at another moment."""
    told = {"localization": LocalizationConfig(kind="stand_in")}  # it is not about the pose
    world = LockstepWorld(site="home", seed=1, robot=robot_of(kind).model_copy(update=told))
    world.say("go to the kitchen")
    world.run_until(lambda w: w.twist.v_mps > 0.08, 60.0)
    world.run(1.0)
    world.run_until(lambda w: not w.waits, 10.0)
    return world


def robot_of(kind: str) -> RobotDescription:
    """Return the first preset of a kind, with the simulated lidar."""
    robots = map(load_robot, sorted((CHECKOUT / "robots").glob("*.toml")))
    return next(one for one in robots if one.drive.kind == kind and one.lidar.is_simulated)


def _row(kind: str, trials: list[DeathTrial]) -> ReportRow:
    claimed_ms = 1000.0 * robot_of(kind).drive.dead_man_s
    note = (
        f"stood after at most {max(one.stood_ms for one in trials):.0f} ms and "
        f"{max(one.way_m for one in trials):.2f} m; contacts {sum(one.contacts for one in trials)}"
    )
    goal = f"<= {claimed_ms:.0f} + {ALLOWED_MS:.0f}"
    return row_of(f"{kind}: wheels at zero", "ms", goal, [one.silence_ms for one in trials], note)
