"""Measure the page on a robot that runs: ``python -m tools.bench.page [--seconds 60] URL``.

Prints how soon the map is drawn, which share of a core the page's renderer takes (driving if the
robot is given something to drive), and by how many steps somebody who knows visible names alone
does four things. Asserts nothing; says how loaded the machine was. The robot drives: take one that
is simulated.
"""

from __future__ import annotations

import argparse
import os
import statistics
import sys
import time
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

from playwright.sync_api import sync_playwright

from scripts.browser import chromium

if TYPE_CHECKING:
    from collections.abc import Callable

    from playwright.sync_api import Browser, Page

FIRST_VIEWS = 10
LONGEST_MS = 60_000.0
QUESTION, ANSWER = "go to the garage", "the kitchen"
TOUR = "go to the kitchen, then the bedroom, then the living room and then the entrance"
"""It asks nothing: every brain reads it, the built-in one too."""
FREE_OF_HOME = ((6.0, 4.75), (8.5, 4.75))
"""Points of the hallway of sites/home [m]."""
CORNERS = ((9.2, 5.3), (9.8, 5.3), (9.8, 4.9))

DRAWN = """() => {
  const seen = () => {
    const walls = document.querySelector("#map .standing");
    const image = document.querySelector("#map .cells");
    if (walls?.getAttribute("d") && image?.complete && image.style.width)
      requestAnimationFrame(() => setTimeout(() => (window.drawnMs = performance.now())));
    else requestAnimationFrame(seen);
  };
  seen();
}"""
"""Note when the frame with the map has been handed to the screen, since the navigation began."""


def load() -> str:
    """Return the machine's load of the last minute, beside which a number stands."""
    return f"load {os.getloadavg()[0]:.1f} on {os.cpu_count()} cores"


def first_views(browser: Browser, url: str) -> list[float]:
    """Return how long the map took to be drawn [s], each time by a browser that keeps nothing."""
    found = []
    for _ in range(FIRST_VIEWS):
        context = browser.new_context(viewport={"width": 1440, "height": 900})
        page = context.new_page()
        page.add_init_script(f"({DRAWN})()")
        page.goto(url, timeout=LONGEST_MS)
        while (drawn_ms := page.evaluate("window.drawnMs ?? null")) is None:
            page.wait_for_timeout(20)  # the page's own policy forbids a watcher of Playwright's
        found.append(float(drawn_ms) / 1e3)
        context.close()
    return found


def cpu_s(pids: list[int]) -> float:
    """Return the processor time that processes have had [s]."""
    ticks = 0
    for pid in pids:
        fields = Path(f"/proc/{pid}/stat").read_text("ascii").rpartition(")")[2].split()
        ticks += int(fields[11]) + int(fields[12])
    return ticks / os.sysconf("SC_CLK_TCK")


def shares(browser: Browser, seconds_s: float) -> dict[str, float]:
    """Return the share of a core that each kind of the browser's processes took."""
    session = browser.new_browser_cdp_session()
    processes = session.send("SystemInfo.getProcessInfo")["processInfo"]
    kinds = {kind: [int(p["id"]) for p in processes if p["type"] == kind]
             for kind in ("renderer", "GPU", "browser")}  # fmt: skip
    before = {kind: cpu_s(pids) for kind, pids in kinds.items()}
    began_s = time.monotonic()
    time.sleep(seconds_s)
    took_s = time.monotonic() - began_s
    return {kind: (cpu_s(pids) - before[kind]) / took_s for kind, pids in kinds.items()}


@dataclass(slots=True)
class Newcomer:
    """Be somebody who sees the page for the first time: each act is by a name that is shown."""

    page: Page
    steps: int = 0

    def press(self, role: str, name: str) -> None:
        """Press what is shown by that name."""
        self.steps += 1
        self.page.get_by_role(role, name=name).first.click()  # type: ignore[arg-type]

    def tap(self, x_m: float, y_m: float) -> None:
        """Tap a spot of the map."""
        self.steps += 1
        drawing = self.page.locator(".drawing")
        box, view = drawing.bounding_box(), drawing.get_attribute("viewBox")
        if box is None or view is None:
            raise RuntimeError("the map is not drawn")
        left, top, wide, high = map(float, view.split())
        across, down = (x_m - left) / wide * box["width"], (-y_m - top) / high * box["height"]
        self.page.mouse.click(box["x"] + across, box["y"] + down)

    def read(self, text: str) -> None:
        """Wait until the page says so."""
        self.page.get_by_text(text).first.wait_for()


def answer_a_question(person: Newcomer) -> None:
    """Answer what the robot asks in words of one's own: it names what it knows, and offers none."""
    person.read("I know no place called")
    person.steps += 1
    person.page.get_by_role("textbox", name="Your answer").first.fill(ANSWER)
    person.press("button", "Answer")
    person.page.locator("#asked .clarify").first.wait_for(state="detached")


def send_to_a_point(person: Newcomer) -> None:
    """Send the robot to a spot of the map."""
    person.tap(*FREE_OF_HOME[0])
    person.press("button", "Go here")
    person.read("go to the point")


def draw_a_keep_out(person: Newcomer) -> None:
    """Draw where the robot is to stay out; take it back uncounted."""
    first, *others = CORNERS
    person.tap(*first)
    person.press("button", "Stay out of here")
    for corner in others:
        person.tap(*corner)
    person.press("button", "Save")
    person.read("Saved.")
    person.page.get_by_text("Layers", exact=True).click()  # not counted: puts back what was
    person.page.get_by_role("button", name="Delete: Stay out 1").click()


def replay_the_last_stop(person: Newcomer) -> None:
    """Look at the newest mission, and move through its recording."""
    person.press("tab", "Past")
    person.steps += 1
    person.page.locator("button.mission").first.click()
    slider = person.page.get_by_role("slider", name="Time")
    slider.wait_for()
    person.steps += 1
    slider.press("End")


TASKS: tuple[tuple[str, Callable[[Newcomer], None]], ...] = (
    ("send to a point", send_to_a_point),
    ("draw a keep-out", draw_a_keep_out),
    ("replay the last stop", replay_the_last_stop),
    ("find and answer a question", answer_a_question),
)


def newcomers(browser: Browser, url: str) -> None:
    """Print the steps and the script's seconds of each task, each on a page newly opened."""
    for name, task in TASKS:
        context = browser.new_context(viewport={"width": 1440, "height": 900}, locale="en-US")
        page = context.new_page()
        page.set_default_timeout(LONGEST_MS)
        page.goto(url)
        page.locator("#link[data-state=good]").wait_for()
        if task is answer_a_question:
            say(page, QUESTION)
            page.reload()
        person, began_s = Newcomer(page), time.monotonic()
        task(person)
        took_s = time.monotonic() - began_s
        print(f"newcomer: {name}: {person.steps} steps, {took_s:.1f} s by the script; {load()}")
        if task is send_to_a_point:
            page.wait_for_timeout(2_000)
            page.get_by_role("button", name="Stop").first.click()  # the stop to be replayed
            page.wait_for_timeout(1_000)
        context.close()


def say(page: Page, text: str) -> None:
    """Give an order in words."""
    page.fill("#goal-text", text)
    with page.expect_response("**/v1/goals"):
        page.keyboard.press("Enter")


def main() -> int:
    """Measure and print."""
    options = argparse.ArgumentParser(prog="python -m tools.bench.page", description=__doc__)
    options.add_argument("url", help="of a simulated robot in sites/home, armed")
    options.add_argument("--seconds", type=float, default=60.0, dest="seconds_s")
    options.add_argument("--only", choices=("views", "share", "newcomers"))
    given = options.parse_args()
    found = chromium()
    if found is None:
        print("no_browser: no Chromium here", file=sys.stderr)
        return 1
    with sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=found, args=["--no-sandbox"])
        if given.only in (None, "views"):
            took = first_views(browser, given.url)
            print(f"first view: n {len(took)}, median {statistics.median(took):.2f} s, "
                  f"{min(took):.2f} to {max(took):.2f} s; goal 1.5 s; {load()}")  # fmt: skip
        if given.only in (None, "share"):
            page = browser.new_context(viewport={"width": 1440, "height": 900}).new_page()
            page.goto(given.url)
            page.locator("#link[data-state=good]").wait_for(timeout=LONGEST_MS)
            say(page, TOUR)
            page.wait_for_timeout(3_000)
            motion = page.locator(".motion")
            began = motion.inner_text()
            taken = shares(browser, given.seconds_s)
            told = ", ".join(f"{kind} {100 * share:.1f} %" for kind, share in taken.items())
            print(f"share of a core over {given.seconds_s:g} s: {told}; goal 10 %; {load()}; "
                  f"it said {began!r} before, {motion.inner_text()!r} after")  # fmt: skip
            page.context.close()
        if given.only in (None, "newcomers"):
            newcomers(browser, given.url)
        browser.close()
    return 0


if __name__ == "__main__":
    sys.exit(main())
