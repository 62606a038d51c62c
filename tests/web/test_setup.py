"""A person without a shell begins a trial on the page, turns a wheel by hand, and stops it."""

from __future__ import annotations

import subprocess
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import pytest
from playwright.sync_api import Browser, expect

from tests.conftest import ROOT
from tests.e2e.system import System, new_home

pytestmark = [pytest.mark.e2e, pytest.mark.nightly]

KEY = "0123456789abcdef" * 2
IN_SIGHT = """() => {
    const box = document.querySelector("#trial-refused").getBoundingClientRect();
    return [box.top + 8, box.bottom - 8].every(
        (y) => document.elementFromPoint(180, y)?.closest("#trial-refused"));
}"""
"""Whether nothing hides the refusal, on a page 360 wide."""
TELEPHONE = {"width": 360, "height": 740}


@contextmanager
def on_a_stand(home: Path) -> Iterator[subprocess.Popen[bytes]]:
    """Play a base whose wheels are off the ground; its standard input is the hands."""
    robot = home / "robot.toml"
    text = (ROOT / "robots" / "pons_mcu.toml").read_text("utf-8")
    robot.write_text(text.replace("/dev/ttyACM0", str(home / "base")), "utf-8")
    command = [sys.executable, "-m", "sim.twin.stand", "--robot", str(robot)]
    with subprocess.Popen(command, stdin=subprocess.PIPE, cwd=ROOT) as played:
        try:
            yield played
        finally:
            played.terminate()


def test_a_trial_is_begun_and_stopped_on_a_telephone_in_chinese(browser: Browser) -> None:
    with new_home() as folder, on_a_stand(Path(folder)) as stand:
        home = Path(folder)
        (home / "operator.key").write_text(KEY, "utf-8")
        (home / "operator.key").chmod(0o600)
        system = System(home, PONS_ROBOT=str(home / "robot.toml"))
        system.arguments = ("--set-up",)
        with system.running():
            context = browser.new_context(viewport=TELEPHONE, locale="zh-CN")  # type: ignore[arg-type]
            page = context.new_page()
            page.set_default_timeout(20_000)
            page.goto(f"http://127.0.0.1:{system.port}")
            page.fill("#trial input[type=password]", KEY)
            page.check("#lifted")
            page.click("#trial-begin")
            page.wait_for_selector("#trial-question[data-ask='1']")
            expect(page.locator("#trial-question strong")).to_contain_text("左轮向前转三整圈")
            assert page.evaluate("document.documentElement.scrollWidth") <= TELEPHONE["width"]
            assert stand.stdin is not None
            stand.stdin.write(b"left 3\n")
            stand.stdin.flush()
            page.wait_for_timeout(2_500)
            page.click("#trial-question button")
            page.wait_for_selector("#trial-question[data-ask='2']")
            page.keyboard.press("Escape")
            page.wait_for_selector("#trial-refused[data-code=trial_stopped]")
            page.wait_for_selector("#stop-state.good")
            assert page.evaluate(IN_SIGHT), "why it ended lies below Stop, or above the page"
            assert page.locator(".skip").count() == 0, "it leads to a goal box that is not there"
            context.close()
        assert "[trial]" not in (home / "robot.toml").read_text("utf-8")
