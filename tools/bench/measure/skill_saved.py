"""Measure how long after its file is saved a skill can be called; routines and functions."""

from __future__ import annotations

import time
from typing import TYPE_CHECKING

from pons.http import call
from tools.bench.context import until
from tools.bench.report import ReportRow, row_of
from tools.bench.robot import BenchRobot

if TYPE_CHECKING:
    from pathlib import Path

    from tools.bench.context import BenchLab

NAME = "skill_saved"
TITLE = "a skill's file saved -> the skill is usable"
LONG_ONLY = False
SLICE = 15
_NUMBERS = ("one", "two", "three", "four", "five", "six", "seven", "eight", "nine", "ten",
            "eleven", "twelve", "thirteen", "fourteen", "fifteen")  # fmt: skip
ROUTINE = 'en = "do the round of the {0}"\nsteps = [{{kind = "say", text = "done"}}]\n'
FUNCTION = '''def {0}() -> str:
    """Count.

    en: do the count of the {0}
    """
    return "done"
'''


def measure(lab: BenchLab) -> list[ReportRow]:
    """Save files one after the other beside one planner, and look for each in its list."""
    slices = list(lab.slices("files", lab.count(2, 6), lambda i: _take(lab, i)))
    return [row_of("saved -> usable", "s", "max <= 2", [each for one in slices for each in one])]


def _take(lab: BenchLab, index: int) -> list[float]:
    with lab.folder() as home, BenchRobot(home, "two_room") as robot:
        robot.await_planner()
        (home / "skills").mkdir(exist_ok=True)
        return [_save(robot, home / "skills", number, index) for number in range(SLICE)]


def _save(robot: BenchRobot, folder: Path, number: int, index: int) -> float:
    is_routine = (number + index) % 2 == 0
    file = folder / f"{_NUMBERS[number]}.{'toml' if is_routine else 'py'}"

    def is_usable() -> bool:
        listed = call(robot.settings, "GET", "/v1/skills")["skills"]
        return any(skill["file"] == file.name for skill in listed)

    file.write_text((ROUTINE if is_routine else FUNCTION).format(_NUMBERS[number]), "utf-8")
    began_s = time.monotonic()
    until(is_usable, 20.0, f"{file.name} in the list", 0.01)
    return time.monotonic() - began_s
