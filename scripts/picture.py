"""Take the README's picture: the page while a robot drives. ``python -m scripts.picture [URL]``.

Needs a running ``pons up`` and Chromium. Gives the robot a goal, waits until the page says that it
moves, and writes docs/page.png. Where the robot stands by itself afterwards is its own affair.
"""

from __future__ import annotations

import argparse
import os
import sys
from pathlib import Path

from playwright.sync_api import Page, sync_playwright

from scripts.browser import chromium

ROOT = Path(__file__).resolve().parents[1]
TARGET = ROOT / "docs" / "page.png"
MAX_BYTES = 400_000
PATIENCE_MS = 120_000
DRIVES_MS = 4_000
"""So long into the drive the way, the camera's boxes and the goal's card are all on the page."""


def main() -> int:
    """Take the picture; 1 where it can't be taken or is too large."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("url", nargs="?", default="http://127.0.0.1:8420")
    parser.add_argument("--out", type=Path, default=TARGET)
    parser.add_argument("--width", type=int, default=1280)
    parser.add_argument("--height", type=int, default=800)
    parser.add_argument("--say", default="go to the kitchen", help="'' gives no goal")
    asked = parser.parse_args()
    command = chromium()
    if command is None:
        print("no_chromium: install one, or name it in $CHROMIUM", file=sys.stderr)
        return 1
    arguments = ["--no-sandbox"] if os.geteuid() == 0 else []  # root may not have its sandbox
    with sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=command, args=arguments)
        size = {"width": asked.width, "height": asked.height}
        page = browser.new_page(viewport=size)  # type: ignore[arg-type]  # a TypedDict of its own
        page.set_default_timeout(PATIENCE_MS)
        _drive(page, asked.url, asked.say)
        page.screenshot(path=asked.out)
        browser.close()
    size_bytes = asked.out.stat().st_size
    print(f"{asked.out}: {size_bytes} bytes")
    return int(size_bytes > MAX_BYTES)


def _drive(page: Page, url: str, sentence: str) -> None:
    """Open the page with its camera, and give the goal."""
    page.goto(url)
    page.evaluate("localStorage.setItem('pons.camera', 'open')")
    page.reload()
    page.locator("#link[data-state=good]").wait_for()
    if not sentence:
        return
    page.fill("#goal-text", sentence)
    page.keyboard.press("Enter")
    page.locator(".motion", has_text="Moving").first.wait_for()
    page.locator("#camera .screen:not([hidden])").wait_for()
    page.wait_for_timeout(DRIVES_MS)


if __name__ == "__main__":
    sys.exit(main())
