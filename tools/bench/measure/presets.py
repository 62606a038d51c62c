"""Measure whether each preset of robots/ drives three goals of the default home, by its twins.

In lockstep: model of the base, line, shipped drive, bridge, planner; told where it is, for this is
about the drive. A base of ROS 2 has no line in lockstep and is not among them.
"""

from __future__ import annotations

from dataclasses import asdict, dataclass
from functools import partial
from typing import TYPE_CHECKING, Any

from bridge.drive.serial_drive import SERIAL_PROTOCOLS
from planner.plan import GoalState
from pons.settings import CHECKOUT
from tools.bench.report import ReportRow, row_of
from tools.lockstep import LockstepWorld
from tools.lockstep.world import TooLong
from wire import load_robot
from wire.robot import LocalizationConfig

if TYPE_CHECKING:
    from tools.bench.context import BenchLab
    from tools.lockstep.goal_handle import GoalHandle

NAME = "presets"
TITLE = "presets: three goals of the default home each"
LONG_ONLY = True
GOALS = ("go to the kitchen", "go to the bedroom", "go home")
LIMIT_S = 300.0


def measure(lab: BenchLab) -> list[ReportRow]:
    """Drive each preset whose base has a line."""
    rows = []
    for name in preset_names():
        take = partial(_trial_slice, name)
        found = [PresetTrial(**one) for one in lab.slices(name, lab.count(1, 3), take)]
        rows.append(_row(name, found))
    return rows


@dataclass(frozen=True, slots=True)
class PresetTrial:
    """Tell how one tour ended."""

    seconds: tuple[float, ...]
    """Of each goal that was reached."""
    contacts: int


def preset_names() -> list[str]:
    """Return the presets whose bases have a line."""
    paths = sorted((CHECKOUT / "robots").glob("*.toml"))
    return [path.stem for path in paths if load_robot(path).drive.kind in SERIAL_PROTOCOLS]


def _trial_slice(name: str, index: int) -> dict[str, Any]:
    return asdict(tour(name, index))


def tour(name: str, seed: int) -> PresetTrial:
    """Give the three goals one after the other."""
    told = {"localization": LocalizationConfig(kind="stand_in")}
    robot = load_robot(CHECKOUT / "robots" / f"{name}.toml").model_copy(update=told)
    world = LockstepWorld(site="home", seed=seed, robot=robot)
    seconds: list[float] = []
    for words in GOALS:
        goal = world.say(words)
        began_s = world.now_s
        try:
            world.run_until(partial(_has_ended, goal), LIMIT_S)
        except TooLong:
            break
        if goal.state is GoalState.SUCCEEDED:
            seconds.append(world.now_s - began_s)
    return PresetTrial(tuple(seconds), world.contacts)


def _has_ended(goal: GoalHandle, _world: LockstepWorld) -> bool:
    return goal.has_ended


def _row(name: str, trials: list[PresetTrial]) -> ReportRow:
    reached = sum(len(one.seconds) for one in trials)
    note = (
        f"reached {reached} of {len(GOALS) * len(trials)}; "
        f"contacts {sum(one.contacts for one in trials)}"
    )
    return row_of(name, "s", "all, contacts 0", [s for one in trials for s in one.seconds], note)
