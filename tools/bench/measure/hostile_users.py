"""Attack a driving robot as each user of docs/deploy.md, and let a person say stop meanwhile.

Processes run under users of their own, in folders as tmpfiles.d makes them. What moves is judged by
the simulator's truth. The user of the simulator is the drive itself, which nothing here guards
against (docs/security.md): its runs are counted apart. Needs root.
"""

from __future__ import annotations

import os
import sys
from collections import Counter
from contextlib import ExitStack
from pathlib import Path
from typing import TYPE_CHECKING, Any

from pons.settings import CHECKOUT
from tools.bench.as_program import show
from tools.bench.confirmation import CLI, HTTP
from tools.bench.context import TROUBLE, line
from tools.bench.figures import none_in
from tools.bench.hostile.draw import OF_THE_DRIVE, ORDER, draw
from tools.bench.hostile.siege import Siege
from tools.bench.hostile.verdict import DIRECT_S, unsafe
from tools.bench.report import ReportRow, row_of
from tools.bench.users import LOCALIZATION, SIM, STRANGER

if TYPE_CHECKING:
    from types import TracebackType
    from typing import Self

    from tools.bench.context import BenchLab

NAME = "hostile_users"
TITLE = "a hostile local client as each user, while a person says stop"
LONG_ONLY = False
QUICK, LONG = 12, 300
QUICK_OF_DRIVE, LONG_OF_DRIVE = 2, 20
LIFE = 60
"""Runs of one robot: its simulated battery empties."""
PROMISES = {
    LOCALIZATION: "may lie about the pose within what odometry allows (POSE_JUMP, POSE_LOST); "
    "lidar, cap and stop are not its to move",
    SIM: "is the wheels and the lidar: nothing is promised, and all is counted apart",
}


def measure(lab: BenchLab) -> list[ReportRow]:
    """Play what is not played yet."""
    if os.geteuid() != 0:
        return [
            ReportRow(NAME, "", "0", value="skipped", note="only root may become a robot's users")
        ]
    show(Path(sys.base_prefix), Path(sys.prefix), CHECKOUT)
    with SiegeSeries(lab) as series:
        played = list(lab.slices("run", lab.count(QUICK, LONG), series.play))
        of_drive = lab.count(QUICK_OF_DRIVE, LONG_OF_DRIVE)
        played += lab.slices("drive", of_drive, lambda n: series.play(OF_THE_DRIVE + n))
    return rows(played)


class SiegeSeries:
    """Keep one robot through many runs; begin another where it does not come to rest."""

    def __init__(self, lab: BenchLab) -> None:
        self._lab = lab
        self._stack = ExitStack()
        self._siege: Siege | None = None
        self._lived = 0

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        self._stack.close()

    def play(self, number: int) -> dict[str, Any]:
        """Play one run, on a new robot where the old one does not come to rest."""
        try:
            return self._play(number)
        except TROUBLE as trouble:
            self._lab.say(f"run {number}: a new robot, for {line(trouble)}")
            return {**self._play(number), "anew": line(trouble)}

    def _play(self, number: int) -> dict[str, Any]:
        if self._lived >= LIFE or number > OF_THE_DRIVE:  # what a drive did to itself stays
            self._end()
        if self._siege is None:
            self._siege = self._stack.enter_context(Siege())
        self._lived += 1
        try:
            told = self._siege.run(draw(number))
        except TROUBLE:
            self._end()
            raise
        said = {"unsafe": unsafe(told), "hidden": told["hidden"], "m": told["metres"]}
        self._lab.say(f"{told['user']}, {told['way']}, {told['took_s']} s: {said}")
        return told

    def _end(self) -> None:
        self._siege, self._lived = None, 0
        self._stack.close()


def rows(played: list[dict[str, Any]]) -> list[ReportRow]:
    """Count: the users that something is promised of, then each user."""
    counted = [one for one in played if one["user"] != SIM]
    http = [one for one in counted if one["way"] == HTTP and not one["http_lost"]]
    shell = [one for one in counted if one["way"] == CLI]
    lost = sum(one["http_lost"] for one in counted)
    moving = sum(one["moving"] for one in counted)
    moved = sum(one["metres"] for one in counted)
    late = [one for one in counted if one["took_s"] is None or one["took_s"] > DIRECT_S]
    by_hand = max((one["by_hand_m"] for one in counted), default=0.0)
    return [
        _zero("unsafe motion", [unsafe(one) for one in counted], counted,
              f"{moved:.0f} m driven; by a hand on the stick at most {by_hand:.2f} m outside"),
        _zero("stop hidden from a person", [one["hidden"] for one in counted], counted,
              f"{moving} moved as it was said; HTTP not confirmed, shell asked: {lost}"),
        _zero("moved after it by a stick gripped anew", [one["gripped"] for one in counted],
              counted, "a hand may drive after a stop, and a stick needs no proof"),
        ReportRow("stop later than 1.5 s", "", "0", value=f"{len(late)} of {len(counted)}",
            note=f"of the stranger's, who reaches no door: {_of_stranger(late)}; load "
            f"{max((one['load'] for one in late), default=0.0)} at most"),
        row_of("stop by HTTP -> confirmed", "ms", "p99 <= 150", _ms(http)),
        row_of("stop by CLI -> confirmed", "ms", f"<= {DIRECT_S * 1e3:.0f}", _ms(shell),
               "from its process's start, as a member of the group pons"),
        *(_user(user, [one for one in played if one["user"] == user])
          for user in dict.fromkeys((*ORDER, SIM))),
    ]  # fmt: skip


def _of_stranger(runs: list[dict[str, Any]]) -> int:
    return sum(one["user"] == STRANGER for one in runs)


def _ms(runs: list[dict[str, Any]]) -> list[float]:
    return [one["took_s"] * 1e3 for one in runs if one["took_s"] is not None]


def _zero(what: str, bad: list[Any], runs: list[dict[str, Any]], note: str) -> ReportRow:
    pairs = [(one, word) for one, word in zip(runs, bad, strict=True) if word]
    found = [f"#{one['number']} {one['user']}: {word}" for one, word in pairs]
    value = f"{len(found)} of {len(runs)}" if found else none_in(len(runs))
    return ReportRow(
        what,
        "",
        "0",
        value=value,
        note=f"{note}; {'; '.join(found)[:500]}".rstrip("; "),
        valid=bool(runs),
    )


def _user(user: str, runs: list[dict[str, Any]]) -> ReportRow:
    """Tell of one user what its runs did, and what kept them from more."""
    bad: Counter[str] = Counter(name for one in runs for name in unsafe(one))
    bad["stop hidden"] += sum(bool(one["hidden"]) for one in runs)
    stopped = Counter(row for one in runs for row in one["rows"])
    said = sum(one["did"].get("said", 0) for one in runs)
    doors = sorted({door for one in runs for door in one["doors"]})
    outside = max((one["outside_m"] for one in runs), default=0.0)
    note = (
        f"doors {', '.join(doors) or 'none'}; {said} messages; at most {outside:.3f} m outside; "
        f"rows before the stop: {', '.join(f'{row} {n}' for row, n in stopped.most_common(8))}"
    )
    promise = f"; {PROMISES[user]}" if user in PROMISES else ""
    broken = ", ".join(f"{name} {n}" for name, n in bad.items() if n)
    goal = "" if user == SIM else "0"
    return ReportRow(f"  {user}", "", goal, value=broken or none_in(len(runs)), note=note + promise,
               valid=bool(runs))  # fmt: skip
