"""Measure the page: its size, its first view, how soon it shows a change, and what watching costs.

Real processes and a headless Chromium behind them in priority, as a person's browser is on another
machine. One clock: the bridge stamps an event with its monotonic clock at the tick that made it;
the page notes ``Date.now()`` in the frame that draws the change; the difference of the two clocks
is taken before and after, and a run in which it moved is invalid.
"""

from __future__ import annotations

import gzip
import os
import re
import shutil
import time
from concurrent.futures import ThreadPoolExecutor
from contextlib import ExitStack, contextmanager
from functools import partial
from http.client import HTTPConnection
from importlib.util import find_spec
from pathlib import Path
from shlex import quote
from typing import TYPE_CHECKING, Any

from pons.settings import CHECKOUT
from tools.bench.context import until
from tools.bench.figures import percentile
from tools.bench.processes import cpu_s
from tools.bench.report import ReportRow, row_of
from tools.bench.robot import SLOW, BenchRobot
from tools.bench.watchers import Watchers
from wire import Event, Mode
from wire.keys import EVENT, STATUS, Party
from wire.session import open_session

if TYPE_CHECKING:
    from collections.abc import Iterator

    from playwright.sync_api import Browser, Page

    from tools.bench.context import BenchLab
    from wire import Status
    from wire.session import Subscriber

NAME = "page"
TITLE = "the page: size, first view, a change seen, the planner's CPU"
LONG_ONLY = False
CHROMIUM = ("chromium", "chromium-browser", "google-chrome-stable", "google-chrome")
BEHIND = """#!/bin/sh
if [ "$(ps -o sid= -p $$ | tr -d ' ')" = $$ ]; then
  {{ echo 10 > /proc/self/autogroup; }} 2> /dev/null
fi
exec nice -n 10 {} "$@"
"""
"""Where Linux weighs sessions, a process's own nice counts within its session only (ADR 0026)."""
GOAL_VIEW = "<= 1500"
GOAL_SIZE = "<= 250"
GOAL_SEEN = "p95 <= 250"
GOAL_CPU = "<= 10"
VIEWS = 10
CHANGES = 36
SOCKETS = 9
CPU_S = 12.0
SETTLE_S = 2.0
CLOCKS_AGREE_S = 0.002
LAPTOP = (1280, 800)
_ASSET = re.compile(rb'(?:src|href)="(/assets/[^"]+\.(?:js|css))"')
_USABLE = """() => new Promise((done) => {
  const usable = () => {
    const cells = document.querySelector("img.cells");
    const box = document.querySelector("#goal-text");
    const robot = document.querySelector(".robot");
    const drawn = cells?.complete && cells.naturalWidth > 0 && robot?.style.transform;
    if (drawn && box && !box.disabled) done(performance.now());
    else requestAnimationFrame(usable);
  };
  usable();
})"""
"""Milliseconds from the navigation's start until map, robot and goal box are there."""
_WATCH = """() => {
  window.shown = [];
  const mode = document.querySelector("#mode");
  let last = mode.dataset.mode;
  new MutationObserver(() => {
    const now = mode.dataset.mode;
    if (now === last) return;
    last = now;
    requestAnimationFrame(() => window.shown.push([now, Date.now()]));
  }).observe(mode, { attributes: true, childList: true, subtree: true });
}"""


def measure(lab: BenchLab) -> list[ReportRow]:
    """Measure on the default home."""
    lacking = missing()
    if lacking:  # no failure of the page: this machine can't show it
        return [ReportRow("the page", "", GOAL_VIEW, value="not measured", note=lacking)]
    runs = list(lab.slices("page", lab.count(1, 3), lambda _: _run(lab)))
    views = [value for run in runs for value in run["view_ms"]]
    seen = [value for run in runs for value in run["seen_ms"]]
    valid = all(run["slowest"] >= SLOW and run["clocks_agree"] for run in runs)
    at_95 = f"p95 {percentile(seen, 0.95):.0f} ms; " if seen else ""
    how = "drawn in the page - the bridge's tick"
    rows = [
        row_of("first view usable, nothing cached", "ms", GOAL_VIEW, views, "map, robot, goal box"),
        row_of("change at the bridge -> drawn", "ms", GOAL_SEEN, seen, at_95 + how, valid=valid),
    ]
    if runs:
        size = f"{runs[0]['bytes'] / 1000:.0f}"
        note = f"as served; {runs[0]['files']} files"
        rows.append(ReportRow("script and style, gzip", "kB", GOAL_SIZE, value=size, note=note))
    for what, goal in (("nobody watches", ""), ("one page", ""), (WATCHED, GOAL_CPU)):
        shares = [run["cpu"][what] for run in runs]
        if shares:
            rows.append(row_of(f"planner's CPU, {what}", "% of a core", goal, shares))
    return rows


WATCHED = f"one page and {SOCKETS} sockets"


def missing() -> str:
    """Say what a measurement of the page lacks here; nothing where all is there."""
    if chromium() is None:
        return f"no Chromium (looked for {', '.join(CHROMIUM)})"
    if find_spec("playwright") is None:
        return "no playwright here; `make dev` installs it"
    if not (CHECKOUT / "web" / "dist" / "index.html").is_file():
        return "the page is not built; `make page` builds it"
    return ""


def chromium() -> str | None:
    """Return the system's Chromium, if there is one."""
    return os.environ.get("CHROMIUM") or next(filter(None, map(shutil.which, CHROMIUM)), None)


def behind(folder: Path, chromium: str) -> Path:
    """Write a command that starts Chromium behind the robot: a person's is on another machine."""
    command = folder / "chromium"
    command.write_text(BEHIND.format(quote(chromium)), "utf-8")
    command.chmod(0o700)
    return command


@contextmanager
def browser(folder: Path) -> Iterator[Browser]:
    """Run a headless Chromium, a session of its own, behind the robot in priority."""
    from playwright.sync_api import sync_playwright  # a package of development alone

    command = behind(folder, chromium() or "")
    flags = ["--no-sandbox"] if os.geteuid() == 0 else []  # root may not have its sandbox
    with sync_playwright() as playwright:
        made = playwright.chromium.launch(executable_path=command, args=flags)
        try:
            yield made
        finally:
            made.close()


def _run(lab: BenchLab) -> dict[str, Any]:
    with ExitStack() as stack:
        home = stack.enter_context(lab.folder())
        robot = stack.enter_context(BenchRobot(home, "home"))
        robot.make_ready()
        robot.forget()
        lab.say("planner alone")
        cpu = {"nobody watches": _cpu_share(robot)}
        chromium = stack.enter_context(browser(home))
        sizes = _served_sizes(robot)
        view_ms = [_first_view(lab, chromium, robot, number) for number in range(VIEWS)]
        page = _open(chromium, robot)
        lab.say("one page")
        cpu["one page"] = _cpu_share(robot, page)
        with Watchers(f"ws://{robot.settings.host}:{robot.settings.port}/v1/events", SOCKETS):
            lab.say(WATCHED)
            cpu[WATCHED] = _cpu_share(robot, page)
        offsets_s = [_offset_s()]
        seen_ms = _changes(lab, robot, page)
        offsets_s.append(_offset_s())
        robot.status  # noqa: B018  # drains what tells the simulator's speed
        return {
            "bytes": sum(sizes),
            "files": len(sizes),
            "view_ms": view_ms,
            "seen_ms": seen_ms,
            "cpu": cpu,
            "slowest": robot.speed,
            "clocks_agree": abs(offsets_s[1] - offsets_s[0]) <= CLOCKS_AGREE_S,
        }


def _offset_s() -> float:
    """Return wall minus monotonic clock [s]."""
    return time.time() - time.monotonic()


def _address(robot: BenchRobot) -> str:
    return f"http://{robot.settings.host}:{robot.settings.port}/"


def _served_sizes(robot: BenchRobot) -> list[int]:
    """Return the bytes of each script and style as they cross the wire."""
    index = gzip.decompress(_body(robot, "/"))
    return [len(_body(robot, path.decode())) for path in sorted(set(_ASSET.findall(index)))]


def _body(robot: BenchRobot, path: str) -> bytes:
    connection = HTTPConnection(robot.settings.host, robot.settings.port, timeout=5.0)
    try:
        connection.request("GET", path, headers={"Accept-Encoding": "gzip"})
        return connection.getresponse().read()
    finally:
        connection.close()


def _first_view(lab: BenchLab, chromium: Browser, robot: BenchRobot, number: int) -> float:
    """Open the page with nothing cached; return when a person can use it [ms]."""
    lab.say(f"first view {number + 1}/{VIEWS}")
    context = chromium.new_context(viewport={"width": LAPTOP[0], "height": LAPTOP[1]})
    try:
        page = context.new_page()
        page.goto(_address(robot), wait_until="commit")
        page.wait_for_selector("#page")
        return float(page.evaluate(_USABLE))
    finally:
        context.close()


def _open(chromium: Browser, robot: BenchRobot) -> Page:
    page = chromium.new_page(viewport={"width": LAPTOP[0], "height": LAPTOP[1]})
    page.goto(_address(robot))
    page.wait_for_selector("#link[data-state=good]")
    return page


def _cpu_share(robot: BenchRobot, page: Page | None = None) -> float:
    """Return the planner's CPU over a while [% of a core]; a page is kept going meanwhile."""
    _wait(SETTLE_S, page)
    pid, began_s = robot.pid("planner"), time.monotonic()
    used_s = cpu_s(pid)
    _wait(CPU_S, page)
    return 100.0 * (cpu_s(pid) - used_s) / (time.monotonic() - began_s)


def _wait(seconds: float, page: Page | None) -> None:
    if page is None:
        time.sleep(seconds)
    else:
        page.wait_for_timeout(seconds * 1e3)


def _hears(statuses: Subscriber[Status]) -> bool:
    return statuses.newest() is not None


def _changes(lab: BenchLab, robot: BenchRobot, page: Page) -> list[float]:
    """Disarm and arm over and over; return how long each change of mode took to be drawn [ms]."""
    page.evaluate(_WATCH)
    offset_s = _offset_s()
    took_ms: list[float] = []
    robot_id = robot.status.robot if robot.status is not None else "r1"
    with ExitStack() as stack:
        ears = open_session(Party.JUDGE, robot_id, robot.settings.home)
        stack.callback(ears.close)
        events = ears.subscriber(EVENT)
        hand = stack.enter_context(ThreadPoolExecutor(1))
        until(partial(_hears, ears.subscriber(STATUS)), 10.0, "the bridge")
        changes = lab.count(CHANGES // 2, CHANGES)
        for number in range(changes):
            lab.say(f"change {number + 1}/{changes}")
            wanted = Mode.DISARMED if number % 2 == 0 else Mode.HOLD
            events.drain()
            page.evaluate("window.shown.length = 0")
            asked = hand.submit(robot.operate, "disarm" if wanted is Mode.DISARMED else "arm")
            page.wait_for_selector(f"#mode[data-mode={wanted.value}]")
            asked.result()
            page.wait_for_timeout(50)  # for the frame that draws it
            drawn = dict(page.evaluate("window.shown"))
            made = [
                event for event in events.drain().items
                if isinstance(event, Event) and event.code == "mode" and event.mode is wanted
            ]  # fmt: skip
            if made and wanted.value in drawn:
                took_ms.append(drawn[wanted.value] - (made[-1].at_s + offset_s) * 1e3)
            page.wait_for_timeout(700 + 37 * (number % 10))  # it must stand 0.5 s to be armed
    return took_ms
