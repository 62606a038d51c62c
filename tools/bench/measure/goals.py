"""Measure drives to rooms of the default home, from one to the next, as described and with people.

In lockstep with the simulator's physics and the real bridge core; localization is by scans.
"""

from __future__ import annotations

from dataclasses import asdict, replace
from typing import TYPE_CHECKING, Any

from sim import Domain
from tools.bench.drive_record import RecordedDrive, TourRecord
from tools.bench.measure.domain import row_of_drives
from tools.lockstep import LockstepWorld
from wire import RobotDescription
from wire.robot import LocalizationConfig

if TYPE_CHECKING:
    from tools.bench.context import BenchLab
    from tools.bench.report import ReportRow

NAME = "goals"
TITLE = "goals from room to room at home"
LONG_ONLY = True
EACH = 10
"""Goals of one drive; its seed is its number."""
CASES: dict[str, tuple[Domain, str]] = {
    "as described": (Domain(), "reached >= 99 %, contacts 0, SPL >= 0.93, time x1.25"),
    "3 polite walkers": (Domain(polite_walkers=3), "reached >= 98 %, robot into person 0"),
    "4 blind walkers": (Domain(blind_walkers=4), "reached >= 93 %, robot into person 0"),
}


def measure(lab: BenchLab) -> list[ReportRow]:
    """Drive 200 goals of each case in a long run, 10 in a quick one; one processor a drive."""
    names, count = tuple(CASES), lab.count(1, 20)
    drives: dict[str, list[TourRecord]] = {name: [] for name in names}
    for taken in lab.side_by_side("drive", count * len(names), take_drive):
        drives[taken["case"]].append(TourRecord(**taken["record"]))
    each = f"seeds of {EACH} goals"
    return [row_of_drives(name, drives[name], each, CASES[name][1]) for name in names]


def take_drive(index: int) -> dict[str, Any]:
    """Drive ten goals; the index says which case with which seed."""
    case, seed = tuple(CASES)[index % len(CASES)], index // len(CASES) + 1
    robot = RobotDescription(localization=LocalizationConfig(kind="scans"))
    domain = replace(CASES[case][0], seed=seed)
    world = LockstepWorld(site="home", seed=seed, robot=robot, domain=domain)
    record = RecordedDrive(world, f"goals {case} {seed}").run(goals=EACH)
    return {"case": case, "record": asdict(record)}
