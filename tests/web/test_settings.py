"""An owner sets limits on a telephone, starts again by a button, and sets a robot up."""

from __future__ import annotations

import re
from pathlib import Path

import pytest
from playwright.sync_api import Browser, Page, expect

from tests.e2e.system import System, new_home
from tests.planner.tool_servers.servers import calendar_server, free_port

pytestmark = [pytest.mark.e2e, pytest.mark.nightly]

SERVERS = """
[tools.calendar]
url = "{here}"
may_write = ["add_event"]

[tools.mail]
url = "http://127.0.0.1:{gone}/mcp"
"""
TELEPHONE = {"width": 390, "height": 844}


def field(page: Page, name: str) -> str:
    return f"[data-setting='{name}'] :is(input, select)"


def test_settings_are_saved_and_in_force_and_a_wizard_leads_to_set_up(browser: Browser) -> None:
    with new_home() as folder, calendar_server() as tools:
        home = Path(folder)
        (home / "settings.toml").write_text("# by hand\n[orders]\n" + SERVERS.format(
            here=tools, gone=free_port()), "utf-8")  # fmt: skip
        system = System(home)
        with system.running():
            context = browser.new_context(viewport=TELEPHONE, locale="en-US")  # type: ignore[arg-type]
            page = context.new_page()
            complaints: list[str] = []
            page.on("pageerror", lambda error: complaints.append(str(error)))
            page.set_default_timeout(30_000)
            page.goto(f"http://127.0.0.1:{system.port}")
            page.click("#tab-settings")
            see_tool_servers(page)
            save_settings(page, home)
            become_a_robot_of_ones_own(page, home)
            assert complaints == []
            context.close()


def see_tool_servers(page: Page) -> None:
    tools = page.locator("#tools")
    tools.wait_for()
    expect(tools).to_contain_text("set a model")
    here = tools.locator("[data-server=calendar]:not([data-problem])")
    here.wait_for()  # its list is fetched beside the start
    expect(here).to_contain_text("Only reads: events, stop, broken")
    expect(here).to_contain_text("May write, after your yes to each call: add_event")
    expect(here.locator("[data-left-out=tool_unmarked]")).to_contain_text("unmarked")
    expect(here).to_contain_text("0 of 200 calls today")
    tools.locator("[data-server=mail][data-problem=unreachable]").wait_for()


def save_settings(page: Page, home: Path) -> None:
    limits = page.locator("[data-group=limits]")
    page.fill(field(page, "limits.max_speed_mps"), "0.9")
    limits.get_by_role("button", name="Save").click()
    expect(page.locator(".toast, #told, [role=status], [role=alert]").filter(
        has_text=re.compile("0.05 … 0.5"))).not_to_have_count(0)  # fmt: skip
    page.fill(field(page, "limits.max_speed_mps"), "0,25")
    limits.get_by_role("button", name="Save").click()
    page.wait_for_selector("#settings-pending")
    text = (home / "settings.toml").read_text("utf-8")
    assert "# by hand" in text
    assert "max_speed_mps = 0.25" in text
    # somebody else saves meanwhile: nothing of theirs is lost
    (home / "settings.toml").write_text(text + '\n[voice]\nmodel = "theirs"\n', "utf-8")
    page.fill(field(page, "budget.day.calls"), "50")
    page.locator("[data-group=budget]").get_by_role("button", name="Save").click()
    expect(page.locator(field(page, "voice.model"))).to_have_value("theirs")
    page.locator("[data-group=budget]").get_by_role("button", name="Save").click()
    expect(page.locator("#settings-last")).to_contain_text("Calls a day")
    page.click("#settings-pending button")
    page.wait_for_selector("#settings-pending", state="detached", timeout=60_000)
    expect(page.locator(field(page, "limits.max_speed_mps"))).to_have_value("0.25")
    assert page.evaluate("document.documentElement.scrollWidth") <= TELEPHONE["width"]


def become_a_robot_of_ones_own(page: Page, home: Path) -> None:
    page.click("#wizard[data-step=look] button.main")
    page.wait_for_selector("#wizard[data-step=choose]", timeout=60_000)
    page.check("#wizard input[value=pons_mcu_ld19]")
    page.click("#wizard button.main")
    page.wait_for_selector("#wizard[data-step=measure]")
    page.reload()  # it goes on where it was
    page.click("#tab-settings")
    for key, value in (("name", "rover"), ("wheel_radius_m", "0.034"),
                       ("wheel_separation_m", "0.21"), ("radius_m", "0.19")):  # fmt: skip
        page.fill(f"#measure-{key}", value)
    page.click("#wizard button.main")
    page.wait_for_selector("#wizard[data-step=try]")
    page.click("#wizard button.main")
    page.wait_for_selector("#trial", timeout=90_000)
    page.wait_for_selector("#wizard[data-step=try] [data-state=done] >> nth=2")
    assert 'id = "rover"' in (home / "robot.toml").read_text("utf-8")
    assert (home / "operator.key").stat().st_mode & 0o077 == 0
