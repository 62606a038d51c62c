"""Drive the whole home for hours with the page open and count the stops that nobody asked for.

An unexplained stop is a STOPPING from ACTIVE with no injected fault, obstacle, fence, order or
arrival. One that began within a second of the host's taking a processor away for over 100 ms is
counted apart. Driven time is time in ACTIVE.
"""

from __future__ import annotations

import time
from collections import Counter
from contextlib import ExitStack, suppress
from itertools import cycle
from typing import TYPE_CHECKING, Any

from bench.figures import NONE_SEEN_95
from bench.measure import page
from bench.report import Row
from bench.robot import SLOW, Robot
from bench.stalls import Stalls
from pons.http import Refused, call
from wire import Event, Mode, Status, decode, load_robot
from wire.keys import EVENT, STATUS, Party
from wire.session import Subscriber, open_session

if TYPE_CHECKING:
    from bench.lab import Lab

NAME = "unexplained_stops"
TITLE = "stops that nobody asked for, the page open"
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
STALL_S = 0.1
WITHIN_S = 1.0
"""Rows that a stall raises come within their windows of it; none is longer than this."""
ENDED = frozenset({"succeeded", "failed", "cancelled", "refused", "needs_clarification"})
LOOK_S = 0.02
GAP_S = 0.2
"""Statuses further apart than this say nothing of the time between them."""


def measure(lab: Lab) -> list[Row]:
    """Drive slice after slice until three hours have been driven."""
    runs = list(lab.slices("drive", SLICES, lambda _: _drive(lab)))
    hours = sum(run["driven_s"] for run in runs) / 3600
    stops: Counter[str] = Counter()
    stalled: Counter[str] = Counter()
    for run in runs:
        for stop in run["stops"]:
            (stalled if stop["stall_s"] > STALL_S else stops)[stop["why"]] += 1
    unexplained = {why: n for why, n in stops.items() if why not in EXPLAINED}
    count = sum(unexplained.values())
    slowest = min((run["speed"] for run in runs), default=0.0)
    rate = f"{count / hours:.2f}" if hours else "none"
    bound = f", < {NONE_SEEN_95 / hours:.2f} with 95 % confidence" if hours and not count else ""
    ends = sum((Counter(run["goals"]) for run in runs), Counter[str]())
    pages = all(run["page"] for run in runs)
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
        Row("unexplained stops", "1/h", "<= 1", value=rate, note=note, valid=slowest >= SLOW),
        Row("stops after a host's stall over 100 ms", "", "", value=str(sum(stalled.values()))),
        Row("longest stall in the second before", "", "", value=", ".join(before[:8]) or "none"),
        Row("all stops from ACTIVE", "", "", value=str(sum(stops.values())), note=told),
    ]  # fmt: skip


def _drive(lab: Lab) -> dict[str, Any]:
    """Drive one slice; every stop from ACTIVE is kept with its reason and its time."""
    with ExitStack() as stack:
        home = stack.enter_context(lab.folder())
        robot = stack.enter_context(Robot(home, "home"))
        robot.make_ready()
        robot.forget()
        opened = not page.missing()
        if opened:
            shown = stack.enter_context(page.browser(home)).new_page()
            shown.goto(f"http://{robot.settings.host}:{robot.settings.port}/")
            shown.wait_for_selector("#link[data-state=good]")
        ears = open_session(Party.JUDGE, load_robot(robot.settings.robot).id, home)
        stack.callback(ears.close)
        watch = Watch(ears.subscriber(STATUS), ears.subscriber(EVENT))
        stalls = Stalls()
        with stalls:
            goals = _tour(lab, robot, watch)
        for stop in watch.stops:
            stop["stall_s"] = stalls.longest_before_s(stop["at_s"], WITHIN_S)
        return {
            "driven_s": watch.driven_s,
            "stops": watch.stops,
            "goals": goals,
            "stalls": stalls.seen,
            "speed": robot.speed,
            "page": opened,
        }


class Watch:
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
                self.driven_s += max(0.0, min(GAP_S, status.at_s - self._last.at_s))
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


def _tour(lab: Lab, robot: Robot, watch: Watch) -> dict[str, int]:
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


def _look_for_a_second(watch: Watch) -> None:
    end_s = time.monotonic() + 1.0
    while time.monotonic() < end_s:
        watch.look()
        time.sleep(LOOK_S)


def _go_on(robot: Robot, goal_id: str) -> None:
    """Be the person who lets it go on after a stop."""
    status = robot.status
    if status is not None and status.mode is Mode.DISARMED:
        robot.operate("arm")
    if status is not None and status.held is not None:
        with suppress(Refused):  # the goal may have ended meanwhile
            call(robot.settings, "POST", f"/v1/goals/{goal_id}/resume", {})
