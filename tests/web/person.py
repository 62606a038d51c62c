"""Do what a person does at the page, and read what it tells them. Knows no robot."""

from __future__ import annotations

import re
import time
from dataclasses import dataclass
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from playwright.sync_api import Page

ARRIVAL_MS = 40_000


def give(page: Page, text: str) -> str:
    """Type an order and send it; return the id of the goal that it became."""
    page.fill("#goal-text", text)
    with page.expect_response("**/v1/goals") as answered:
        page.keyboard.press("Enter")
    assert answered.value.status == 202, answered.value.text()
    return str(answered.value.json()["id"])


def ended(page: Page, goal_id: str, state: str = "succeeded") -> str:
    """Wait for a goal's line among those that ended so; return what it says."""
    line = page.locator(f".turn[data-goal='{goal_id}'][data-state={state}]")
    line.wait_for(timeout=ARRIVAL_MS)
    return line.inner_text()


def pixel_of(page: Page, x_m: float, y_m: float) -> tuple[float, float]:
    """Return where a point given in metres lies in the window; the map is not turned."""
    box = page.locator(".drawing").bounding_box()
    view = page.locator(".drawing").get_attribute("viewBox")
    assert box is not None
    assert view is not None
    left, top, wide, high = map(float, view.split())
    across, down = (x_m - left) / wide * box["width"], (-y_m - top) / high * box["height"]
    return box["x"] + across, box["y"] + down


def click_at(page: Page, x_m: float, y_m: float) -> None:
    """Click a point of the map given in metres."""
    page.locator("#map").scroll_into_view_if_needed()
    page.mouse.click(*pixel_of(page, x_m, y_m))


def note_presses(page: Page) -> None:
    """Let the page note when a person pressed: a busy machine hands a press on late."""
    page.evaluate(
        """() => ["pointerdown", "keydown"].forEach((kind) =>
          addEventListener(kind, () => (window.pressedMs = Date.now()), { capture: true }))"""
    )


def pressed_s(page: Page) -> float:
    """Return when the newest press came, on this process's monotonic clock [s]."""
    ago_s = time.time() - float(page.evaluate("window.pressedMs")) / 1e3
    return time.monotonic() - ago_s


@dataclass(frozen=True, slots=True)
class Claim:
    """Hold what the page tells a person at one instant; None where it says that it is old."""

    mode: str | None
    moving: bool | None
    at_m: tuple[float, float] | None
    link: str
    goals: dict[str, str] | None
    """Open goals with their states."""


_LOOK = """() => {
  const old = (element) => element === null || element.closest(".stale") !== null;
  const at = (name) => document.querySelector(name);
  const [mode, motion, robot, now] = [at("#mode"), at(".motion"), at(".robot"), at("#said")];
  const ended = ["succeeded", "failed", "refused", "cancelled"];
  const goals = [...document.querySelectorAll(".turn")]
    .filter((goal) => !ended.includes(goal.dataset.state));
  return {
    mode: old(mode) ? null : mode.dataset.mode,
    motion: old(motion) ? null : motion.textContent,
    at: old(robot) ? null : robot.style.transform,
    link: at("#link").dataset.state,
    goals: old(now) ? null : goals.map((goal) => [goal.dataset.goal, goal.dataset.state]),
  };
}"""
_MOVES = re.compile("Moving|Turning")
_AT = re.compile(r"translate\((-?[\d.e-]+)px, (-?[\d.e-]+)px\)")


def look(page: Page) -> Claim:
    """Read the page at one instant."""
    found = page.evaluate(_LOOK)
    at = _AT.search(found["at"] or "")
    return Claim(
        mode=found["mode"],
        moving=None if found["motion"] is None else bool(_MOVES.search(found["motion"])),
        at_m=None if at is None else (float(at[1]), float(at[2])),
        link=found["link"],
        goals=None if found["goals"] is None else dict(found["goals"]),
    )
