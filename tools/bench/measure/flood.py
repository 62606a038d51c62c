"""Flood the real bridge and count its gaps beside cyclictest's; see whether a stop still works.

10 000 messages a second that each look like the owner's newest horizon and 1000 that are no message
at all, for as long as it is measured. A gap is a time of over 3.5 periods between two commands.
Slices of the bridge and of cyclictest alternate under the same flood, on the same processor.
"""

from __future__ import annotations

import json
import os
import time
from contextlib import contextmanager
from itertools import pairwise
from typing import TYPE_CHECKING, Any

from pons.conformance.worker_processes import FLOODER, Helper
from processes.parent_death import child_command
from tools.bench.context import until
from tools.bench.figures import poisson_upper_95
from tools.bench.lateness import cyclictest_late_us
from tools.bench.report import ReportRow, row_of
from tools.bench.stop_requests import STANDING_WAYS, notes_of, noting
from wire import Event
from wire.keys import EVENT, Party
from wire.session import open_session

if TYPE_CHECKING:
    from collections.abc import Iterator

    from tools.bench.context import BenchLab
    from tools.bench.robot import BenchRobot
    from wire import Status

NAME = "flood"
TITLE = "a flood of 10 000/s and 1000/s malformed"
LONG_ONLY = True
VALID_HZ, JUNK_HZ = 10_000, 1_000
PAIRS = 12
SLICE_S = 4.0
PERIOD_US = 10_000
GAP_PERIODS = 3.5
STOPS = 10
STOP_S = 5.0


def measure(lab: BenchLab) -> list[ReportRow]:
    """Take pairs on one flooded robot, then stops on the same."""
    runs = list(lab.slices("robot", lab.count(1, 3), lambda _: _run(lab)))
    rows = []
    pairs = [pair for run in runs for pair in run["pairs"]]
    theirs = sum(pair["cyclictest"] for pair in pairs)
    seconds = SLICE_S * len(pairs)
    for name in ("bridge", "cyclictest"):
        counts = [float(pair[name]) for pair in pairs]
        goal = f"all <= {theirs} or {poisson_upper_95(theirs):.0f}" if name == "bridge" else ""
        note = f"{sum(counts):.0f} in {len(pairs)} slices, {seconds:.0f} s"
        rows.append(row_of(f"{name}: gaps over 3.5 periods a slice", "", goal, counts, note))
    for way in STANDING_WAYS:
        took_ms = [value for run in runs for value in run["stops"][way]]
        lost = sum(run["lost"][way] for run in runs)
        note = f"{lost} of {len(took_ms) + lost} not held; load {_loads(runs)}"
        rows.append(
            row_of(f"{way}: handed over -> held", "ms", "works", took_ms, note, valid=not lost)
        )
    rates = [run["rates"] for run in runs]
    rows.append(ReportRow("really sent", "messages/s", "", value="; ".join(map(str, rates))))
    return rows


def _loads(runs: list[dict[str, Any]]) -> str:
    return ", ".join(f"{run['load']:.1f}" for run in runs)


def _run(lab: BenchLab) -> dict[str, Any]:
    with lab.folder() as home, noting(home) as robot:
        robot.make_ready()
        spans: list[tuple[float, float]] = []
        theirs: list[int] = []
        with _flood_robot(robot) as rates:
            for number in range(PAIRS):
                lab.say(f"flooded pair {number + 1}/{PAIRS}")
                began_s = time.monotonic()
                time.sleep(SLICE_S)
                spans.append((began_s, time.monotonic()))
                late_us = cyclictest_late_us(SLICE_S, PERIOD_US)
                theirs.append(sum(late > (GAP_PERIODS - 1) * PERIOD_US for late in late_us))
            stops, lost = _stops(lab, robot)
        at_s = [note[0] for note in notes_of(robot)]
        ours = [gaps([at for at in at_s if first <= at <= last]) for first, last in spans]
        pairs = [{"bridge": a, "cyclictest": b} for a, b in zip(ours, theirs, strict=True)]
        return {"pairs": pairs, "stops": stops, "lost": lost, "rates": rates,
                "load": os.getloadavg()[0]}  # fmt: skip


def gaps(at_s: list[float]) -> int:
    """Count the times of over 3.5 periods between two commands."""
    return sum(b - a > GAP_PERIODS * PERIOD_US * 1e-6 for a, b in pairwise(at_s))


@contextmanager
def _flood_robot(robot: BenchRobot) -> Iterator[list[float]]:
    """Flood while the context lasts; afterwards the list holds messages sent per second."""
    status = _await_status(robot)
    tasks = (
        {"key": "cmd/waypoints", "template": _horizon(status), "hertz": VALID_HZ},
        {"key": "cmd/waypoints", "text": '{"points": NaN, "seq": [[[', "hertz": JUNK_HZ},
    )
    rates: list[float] = []
    helpers: list[Helper] = []
    words = ["pons.conformance.worker_process", str(robot.settings.home), status.robot]
    try:
        for task in tasks:
            helper = Helper(child_command(*words))
            helpers.append(helper)
            helper.ready()
            helper.go({"be": FLOODER, **task})
        yield rates
    finally:
        rates += [_rate(helper.end()) for helper in helpers]


def _rate(said: str) -> float:
    told = json.loads(said.splitlines()[-1]) if said else {"sent": 0, "seconds": 1.0}
    return round(told["sent"] / told["seconds"])


def _horizon(status: Status) -> dict[str, Any]:
    owner = status.owner.planner_id if status.owner is not None else "nobody"
    return {
        "planner_id": owner, "epoch": status.epoch, "seq": 0, "seen": status.seq,
        "mission": "flood", "leg": 0, "map_id": status.map_id, "ttl_s": 0.5, "points": [],
        "final": False,
    }  # fmt: skip


def _await_status(robot: BenchRobot) -> Status:
    until(lambda: robot.status is not None, 5.0, "a status")
    status = robot.status
    if status is None:
        raise OSError("the bridge fell silent")
    return status


def _stops(lab: BenchLab, robot: BenchRobot) -> tuple[dict[str, list[float]], dict[str, int]]:
    """Stop over and over under the flood; return what each took [ms] and how many were lost."""
    took: dict[str, list[float]] = {way: [] for way in STANDING_WAYS}
    lost = dict.fromkeys(STANDING_WAYS, 0)
    with open_session(Party.JUDGE, _await_status(robot).robot, robot.settings.home) as session:
        events = session.subscriber(EVENT)
        for number in range(lab.count(STOPS, 2 * STOPS)):
            for way, way_of in STANDING_WAYS.items():
                lab.say(f"stop {number + 1} by {way}")
                robot.operate("resume")
                events.drain()
                with way_of(robot) as stop:
                    sent_s = stop()
                held_s = _held_at(events, time.monotonic() + STOP_S)
                if held_s is None:  # an event is said once and may vanish in a flood; held stays
                    lost[way] += _await_status(robot).held is None
                else:
                    took[way].append((held_s - sent_s) * 1e3)
    robot.operate("resume")
    return took, lost


def _held_at(events: Any, end_s: float) -> float | None:
    """Return when the bridge held, by its own clock, which is this machine's."""
    while time.monotonic() < end_s:
        for event in events.drain().items:
            if isinstance(event, Event) and event.code == "held":
                return event.at_s
        time.sleep(0.005)
    return None
