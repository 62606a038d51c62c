"""Break a whole robot under ``pons up`` again and again, as ``tools.bench.chaos`` draws it.

One robot lives through many episodes; one that does not come back is started anew and counted.
Zeros stand beside 3/n: so rare it is with 95 % confidence (rule of three).
"""

from __future__ import annotations

import sqlite3
from collections import Counter
from contextlib import ExitStack, suppress
from typing import TYPE_CHECKING, Any

from bridge.recording.mcap_reader import BadRecording, McapReader
from pons.http import PlannerDown, PlannerProblem
from tools.bench.chaos.draw import Breakage, FaultKind, draw
from tools.bench.chaos.episode import Play
from tools.bench.chaos.house import House, private_mounts
from tools.bench.chaos.witness import Witness
from tools.bench.context import MeasurementFailure, line, until
from tools.bench.figures import none_in
from tools.bench.report import ReportRow, row_of

if TYPE_CHECKING:
    from pathlib import Path
    from types import TracebackType
    from typing import Self

    from tools.bench.context import BenchLab

NAME = "chaos"
TITLE = "a whole robot, broken at random moments of random missions"
LONG_ONLY = True
EPISODES = 500
HEARD_S = 20.0
LIFE = 40
"""Episodes of one robot: its simulated battery empties in three hours of driving."""
NO_CLOCK = "not tried: the wall clock is the machine's, and other programs live by it"


def measure(lab: BenchLab) -> list[ReportRow]:
    """Play what is not played yet."""
    shared = private_mounts()
    with RobotSeries(lab, mounts=not shared) as robot:
        played = list(lab.slices("episode", lab.count(10, EPISODES), robot.play))
        robot.end()
        lives = robot.lives
    return rows(played, lives, shared)


class RobotSeries:
    """Keep one robot through many episodes; begin another where it does not come back."""

    def __init__(self, lab: BenchLab, *, mounts: bool) -> None:
        self._lab, self._mounts = lab, mounts
        self._stack = ExitStack()
        self._house: House | None = None
        self._witness: Witness | None = None
        self._played: list[str] = []
        self._lived = 0
        self.lives: list[dict[str, Any]] = []

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
        """Play one episode. Raises Missed where there was no robot to play it on."""
        if self._lived >= LIFE:
            self.end()
        if self._house is None or self._witness is None:
            self._begin()
        if self._house is None or self._witness is None:
            raise MeasurementFailure("no robot")
        self._lived += 1
        play = Play(self._house, self._witness, draw(number))
        try:
            told = play.run()
        except (PlannerDown, PlannerProblem, OSError) as trouble:
            word = self._witness.describe()
            self.end()
            raise MeasurementFailure(f"episode {number}: {line(trouble)}; {word}") from None
        self._played += told["goals"]
        if told["unrecovered"]:
            self.end()
        return told

    def _begin(self) -> None:
        """Start a robot and have it at rest."""
        with ExitStack() as stack:
            beside = stack.enter_context(self._lab.folder())
            home = stack.enter_context(self._lab.folder())
            house = stack.enter_context(House(home, beside / "up.log", mounts=self._mounts))
            self._witness = witness = stack.enter_context(Witness(house.settings))
            until(witness.listening.is_set, HEARD_S, "the planner's events")
            self._house, self._lived, self._played = house, 0, []
            self._stack = stack.pop_all()

    def end(self) -> None:
        """End this robot, and look at what it leaves: journal and recordings."""
        if self._house is not None:
            self.lives.append(lost_records(self._house.home, self._played))
        self._house = self._witness = None
        self._stack.close()


def lost_records(home: Path, goals: list[str]) -> dict[str, Any]:
    """Tell which goals the journal lacks, and which recordings can't be read."""
    known: set[str] = set()
    with suppress(sqlite3.Error):
        journal = sqlite3.connect(home / "missions.db")
        known = {row[0] for row in journal.execute("SELECT id FROM missions")}
        journal.close()
    files, bad = sorted((home / "recordings").glob("*.mcap")), []
    for path in files[:-1]:  # the last one is being written
        try:
            with McapReader(path) as reader:
                for chunk in reader.chunks:
                    reader.read(chunk)
        except BadRecording as trouble:
            bad.append(line(trouble))
    return {
        "goals": len(goals), "lost": [g for g in goals if g not in known],
        "files": len(files), "unreadable": bad,
    }  # fmt: skip


# Rows -------------------------------------------------------------------------------------------


def rows(played: list[dict[str, Any]], lives: list[dict[str, Any]], shared: str) -> list[ReportRow]:
    """Count."""
    stops = [one for one in played if one["stop"]]
    confirmed = [one for one in stops if one.get("confirmed_s") is not None]
    moving = sum(one["stopped"]["moving"] for one in confirmed)
    speaking = [one for one in played if one["says"]]
    goals = sum(len(one["goals"]) for one in played)
    hurt = sum(one["contacts"] for one in played)
    lost = [word for one in played for word in one["lost"]]
    lost += [word for life in lives for word in life["lost"] if word not in " ".join(lost)]
    ready = [one["ready_s"] for one in played if one["ready_s"] is not None]
    files = sum(life["files"] for life in lives)
    unreadable = [word for life in lives for word in life["unreadable"]]
    slow = [one["number"] for one in played if one["contacts"]]
    return [
        _zero("contacts", hurt, len(played), f"episodes {slow}" if slow else ""),
        _zero(
            "motion after a confirmed stop",
            _count(confirmed, "stop_broken"),
            len(confirmed),
            f"moving when it was confirmed: {moving}; {_name_episodes(confirmed, 'stop_broken')}",
        ),
        ReportRow(
            "stops never confirmed",
            "",
            "",
            value=f"{len(stops) - len(confirmed)} of {len(stops)}",
            note=_unconfirmed_line(stops),
        ),
        row_of("stop said -> confirmed", "s", "", [one["confirmed_s"] for one in confirmed]),
        _zero("lost goals", len(lost), goals, "; ".join(lost)[:300]),
        _zero(
            "doubled speech",
            _count(played, "said_twice"),
            len(speaking),
            f"heard {sum(one['said'] for one in speaking)}; {_name_episodes(played, 'said_twice')}",
        ),
        _zero(
            "unrecovered",
            _count(played, "unrecovered"),
            len(played),
            _name_episodes(played, "unrecovered"),
        ),
        row_of("fault over -> ready", "s", "", ready),
        *_kinds(played),
        _zero("recordings that can't be read", len(unreadable), files, "; ".join(unreadable)[:200]),
        ReportRow("clock jump", "", "", value="skipped", note=NO_CLOCK),
        ReportRow(
            "full disk, read-only home", "", "", value="skipped" if shared else "tried", note=shared
        ),
    ]


def _zero(what: str, count: int, n: int, note: str) -> ReportRow:
    value = f"{count} of {n}" if count else none_in(n)
    return ReportRow(what, "", "0", value=value, note=note.rstrip("; "), valid=n > 0)


def _count(played: list[dict[str, Any]], name: str) -> int:
    return sum(bool(one[name]) for one in played)


def _name_episodes(played: list[dict[str, Any]], name: str) -> str:
    """Name the episodes with something to tell under a name, by their faults."""
    bad = [f"#{one['number']} {_faults(one)}" for one in played if one[name]]
    return "; ".join(bad)[:600]


def _unconfirmed_line(stops: list[dict[str, Any]]) -> str:
    return "; ".join(
        f"#{one['number']} {_faults(one)}: {one['stop_trouble']}"
        for one in stops
        if one.get("confirmed_s") is None
    )[:600]


def _faults(one: dict[str, Any]) -> str:
    names = [
        Breakage(**{**fault, "kind": FaultKind(fault["kind"])}).name for fault in one["faults"]
    ]
    return " + ".join(names)


def _kinds(played: list[dict[str, Any]]) -> list[ReportRow]:
    """Give the time to ready by kind of fault, where one alone was made."""
    seen: Counter[str] = Counter()
    found = []
    for kind in FaultKind:
        alone = [o for o in played if [f["kind"] for f in o["faults"]] == [kind.value]]
        seen[kind.value] = len(alone)
        samples = [one["ready_s"] for one in alone if one["ready_s"] is not None]
        note = f"{len(alone)} episodes, unrecovered {_count(alone, 'unrecovered')}"
        if alone:
            found.append(row_of(f"  {kind.value} -> ready", "s", "", samples, note))
    return found
