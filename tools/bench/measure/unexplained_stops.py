"""Drive the whole home for hours with page and eyes open; count stops that nobody asked for.

An unexplained stop is a STOPPING from ACTIVE with no injected fault, obstacle, fence, order or
arrival. One that began within a second of the host's taking a processor away for over 100 ms is
counted apart: a gap between two wake-ups of a watcher, as LOOP_LATE counts those of the bridge.
Driven time is time in ACTIVE. The page shows the camera's picture, the detector looks at every one,
and cyclictest turns beside the bridge: same processor, rank and period.
"""

from __future__ import annotations

import os
import re
import time
import urllib.request
from collections import Counter
from contextlib import ExitStack, contextmanager, suppress
from itertools import cycle
from typing import TYPE_CHECKING, Any

from pons.http import PlannerProblem, call
from tools.bench.figures import NONE_SEEN_95, poisson_upper_95
from tools.bench.lateness import count_missed, cyclictest
from tools.bench.measure import page
from tools.bench.report import ReportRow, row_of
from tools.bench.robot import CAMERA, EVERYTHING, SLOW, BenchRobot
from tools.bench.stalls import PERIOD_S, Stalls
from wire import Event, Mode, Status, decode, load_robot
from wire.keys import EVENT, STATUS, Party
from wire.session import Subscriber, open_session

if TYPE_CHECKING:
    from collections.abc import Iterator

    from playwright.sync_api import Page

    from tools.bench.context import BenchLab

NAME = "unexplained_stops"
TITLE = "stops that nobody asked for and missed ticks, page and picture open"
LONG_ONLY = True
SLICES = 20
SLICE_S = 600.0
TOURS = (
    "go to the kitchen, then the bedroom, then the living room, then the study",
    "去卫生间，然后去客厅，再去厨房，最后去卧室",
)
EXPLAINED = frozenset(
    {"obstacle", "fence", "contact", "stop", "pause", "cancel", "disarm", "teleop"}
)
GAP_S = 0.1
"""Of wake-ups; a watcher tells how late one was, and it was to come a period after the last."""
WITHIN_S = 1.0
"""Rows that a stall raises come within their windows of it; none is longer than this."""
ENDED = frozenset({"succeeded", "failed", "cancelled", "refused", "needs_clarification"})
LOOK_S = 0.02
PERIOD_US = 10_000
FULL_RATE = "10"
"""Looks a second: as many as the camera gives pictures."""
_LOOKS = re.compile(r'^pons_eyes_looks\{what="looks"\} (\S+)', re.MULTILINE)
LEAST_LOOKS_PER_S = 8.0
"""A run whose detector looked less often tells nothing of one at full rate."""
SILENT_S = 0.2
"""Statuses further apart than this say nothing of the time between them."""


def measure(lab: BenchLab) -> list[ReportRow]:
    """Drive slice after slice until three hours have been driven."""
    runs = list(lab.slices("drive", SLICES, lambda _: _drive(lab)))
    hours = sum(run["driven_s"] for run in runs) / 3600
    stops: Counter[str] = Counter()
    stalled: Counter[str] = Counter()
    for run in runs:
        for stop in run["stops"]:
            (stalled if stop["stall_s"] + PERIOD_S > GAP_S else stops)[stop["why"]] += 1
    unexplained = {why: n for why, n in stops.items() if why not in EXPLAINED}
    count = sum(unexplained.values())
    slowest = min((run["speed"] for run in runs), default=0.0)
    rate = f"{count / hours:.2f}" if hours else "none"
    bound = f", < {NONE_SEEN_95 / hours:.2f} with 95 % confidence" if hours and not count else ""
    ends = sum((Counter(run["goals"]) for run in runs), Counter[str]())
    pages = all(run["page"] for run in runs)
    looked = min((run["looks_per_s"] for run in runs), default=0.0)
    valid = slowest >= SLOW and pages and looked >= LEAST_LOOKS_PER_S
    note = (
        f"{count} in {hours:.2f} h driven{bound}; {dict(unexplained)}; page "
        f"{'open' if pages else 'not open'}; slowest simulator {slowest:.2f} x"
    )
    late_s = [late_s for run in runs for _, late_s in run["stalls"]]
    told = (
        f"{dict(stops)}; goals {dict(ends)}; host stalls over 20 ms {len(late_s)}, longest "
        f"{max(late_s, default=0.0) * 1e3:.0f} ms"
    )
    before = [f"{stop['why']} {stop['stall_s'] * 1e3:.0f} ms" for r in runs for stop in r["stops"]]
    return [
        ReportRow("unexplained stops", "1/h", "<= 1", value=rate, note=note, valid=valid),
        ReportRow(
            "stops after a host's stall over 100 ms",
            "",
            "",
            value=str(sum(stalled.values())),
            note=f"{dict(stalled)}",
        ),
        ReportRow(
            "wake-ups late in the second before", "", "", value=", ".join(before[:8]) or "none"
        ),
        ReportRow("all stops from ACTIVE", "", "", value=str(sum(stops.values())), note=told),
        _ticks(runs),
        row_of("looks of the detector", "1/s", "", [run["looks_per_s"] for run in runs]),
    ]


def _ticks(runs: list[dict[str, Any]]) -> ReportRow:
    """Compare the bridge's missed ticks with cyclictest's in the same minutes."""
    runs = [run for run in runs if run["cyclictest"]["ticks"]]
    if not runs:
        return ReportRow("ticks missed", "", "", value="not compared", note="no cyclictest here")
    ours, its = (
        [sum(run[who][what] for run in runs) for what in ("missed", "ticks")]
        for who in ("bridge", "cyclictest")
    )
    goal = f"<= {max(1.5 * its[0], poisson_upper_95(its[0])):.1f}"
    note = f"of {ours[1]}; cyclictest {its[0]} of {its[1]}, in the same minutes"
    return ReportRow("ticks missed", "", goal, value=str(ours[0]), note=note)


def _drive(lab: BenchLab) -> dict[str, Any]:
    """Drive one slice; every stop from ACTIVE is kept with its reason and its time."""
    with ExitStack() as stack:
        home = stack.enter_context(lab.folder())
        stack.enter_context(_full_rate())
        robot = stack.enter_context(BenchRobot(home, "home", only=(*EVERYTHING, CAMERA)))
        robot.make_ready()
        robot.forget()
        opened = not page.missing()
        if opened:
            _open(stack.enter_context(page.browser(home)).new_page(), robot)
        ears = open_session(Party.JUDGE, load_robot(robot.settings.robot).id, home)
        stack.callback(ears.close)
        watch = StopWatcher(ears.subscriber(STATUS), ears.subscriber(EVENT))
        stalls = Stalls()
        with stalls, cyclictest(SLICE_S, PERIOD_US) as ended:
            looks, began_s, ticks = _looks(robot), time.monotonic(), _tick_counts(robot)
            goals = _tour(lab, robot, watch)
            late_us = ended()
            looks_per_s = (_looks(robot) - looks) / (time.monotonic() - began_s)
            turned = [now - then for now, then in zip(_tick_counts(robot), ticks, strict=True)]
        for stop in watch.stops:
            stop["stall_s"] = stalls.longest_before_s(stop["at_s"], WITHIN_S)
        return {
            "driven_s": watch.driven_s,
            "stops": watch.stops,
            "goals": goals,
            "stalls": stalls.seen,
            "speed": robot.speed,
            "page": opened,
            "looks_per_s": looks_per_s,
            "bridge": {"ticks": turned[0], "missed": turned[1]},
            "cyclictest": {"ticks": len(late_us), "missed": count_missed(late_us, PERIOD_US)},
        }


@contextmanager
def _full_rate() -> Iterator[None]:
    """Have planners that start meanwhile think upon every picture."""
    os.environ["PONS_VISION_RATE_HZ"] = FULL_RATE
    try:
        yield
    finally:
        del os.environ["PONS_VISION_RATE_HZ"]


def _open(shown: Page, robot: BenchRobot) -> None:
    """Open page and picture as a person does."""
    shown.goto(f"http://{robot.settings.host}:{robot.settings.port}/")
    shown.wait_for_selector("#link[data-state=good]")
    shown.locator("#camera summary").click()
    shown.wait_for_selector("#camera canvas")


def _looks(robot: BenchRobot) -> float:
    """Return how many looks the planner's eyes have made."""
    url = f"http://{robot.settings.host}:{robot.settings.port}/metrics"
    with urllib.request.urlopen(url, timeout=5.0) as reply:
        found = _LOOKS.search(reply.read().decode())
    return float(found[1]) if found else 0.0


def _tick_counts(robot: BenchRobot) -> tuple[int, int]:
    """Return the bridge's ticks since its start, and how many of them it missed."""
    status = robot.status
    return (status.ticks.ticks, status.ticks.missed) if status else (0, 0)


class StopWatcher:
    """Hear statuses and events of one robot as a judge."""

    def __init__(self, statuses: Subscriber[Status], events: Subscriber[Event]) -> None:
        self._statuses, self._events = statuses, events
        self._last: Status | None = None
        self.driven_s = 0.0
        self.stops: list[dict[str, Any]] = []

    def look(self) -> Status | None:
        """Take in what came; return the newest status."""
        for status in self._statuses.drain().items:
            if not isinstance(status, Status):
                continue
            if self._last is not None and self._last.mode is Mode.ACTIVE:
                self.driven_s += max(0.0, min(SILENT_S, status.at_s - self._last.at_s))
            self._last = status
        for raw in self._events.drain_bytes():  # all of them: a stop brings several at once
            event = decode(EVENT, raw)
            if isinstance(event, Event) and event.code == "mode":
                self._mode_changed(event)
        return self._last

    def _mode_changed(self, event: Event) -> None:
        before, after, *why = event.detail.split()
        if before == Mode.ACTIVE.value and after in (Mode.STOPPING.value, Mode.FAULT.value):
            self.stops.append({"at_s": event.at_s, "why": why[0] if why else ""})


def _tour(lab: BenchLab, robot: BenchRobot, watch: StopWatcher) -> dict[str, int]:
    """Give tour after tour; return how their goals ended."""
    ends: Counter[str] = Counter()
    end_s = time.monotonic() + SLICE_S
    for tour in cycle(TOURS):
        goal_id = robot.say(tour)
        while (state := robot.goal(goal_id)["state"]) not in ENDED:
            if time.monotonic() >= end_s:
                return dict(ends)
            lab.say(f"{watch.driven_s:.0f} s driven, {len(watch.stops)} stops, {dict(ends)}")
            _look_for_a_second(watch)
            _go_on(robot, goal_id)
        ends[state] += 1
    return dict(ends)


def _look_for_a_second(watch: StopWatcher) -> None:
    end_s = time.monotonic() + 1.0
    while time.monotonic() < end_s:
        watch.look()
        time.sleep(LOOK_S)


def _go_on(robot: BenchRobot, goal_id: str) -> None:
    """Be the person who lets it go on after a stop."""
    status = robot.status
    if status is not None and status.mode is Mode.DISARMED:
        robot.operate("arm")
    if status is not None and status.held is not None:
        with suppress(PlannerProblem):  # the goal may have ended meanwhile
            call(robot.settings, "POST", f"/v1/goals/{goal_id}/resume", {})
