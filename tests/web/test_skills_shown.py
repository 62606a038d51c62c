"""The page lists the owner's skills as their files are, and tells what is wrong in the others."""

from __future__ import annotations

import json

import pytest

from tests.e2e.robot import Robot
from tests.web.conftest import OpenPage
from tests.web.test_looks import PHONE, assert_fits, violations

pytestmark = [pytest.mark.e2e, pytest.mark.nightly]

ROUND = """
en = ["[do|make] the evening round [and end in {where}]"]
zh = ["[做|开始]晚间巡视"]
about = "Say that all is well."
steps = [{kind = "go_to", place = "{where}"}]
[parameters.where]
kind = "place"
default = "PLACE"
"""


@pytest.mark.parametrize(
    ("locale", "words", "line"),
    [("en-US", "the evening round", "broken.toml, line 3"), ("zh-CN", "晚间巡视", "第 3 行")],
)
def test_skills_are_listed_with_their_words_and_a_broken_one_with_line_and_cure(
    robot: Robot, open_page: OpenPage, locale: str, words: str, line: str
) -> None:
    folder = robot.system.home / "skills"
    folder.mkdir(exist_ok=True)
    place = robot.elsewhere().id
    page = open_page(PHONE, locale)
    page.locator("#tab-orders").click()
    page.locator("#skills").wait_for()
    good, broken = folder / "evening_round.toml", folder / "broken.toml"
    try:
        good.write_text(ROUND.replace("PLACE", place), "utf-8")
        broken.write_text('en = ["the little dance"]\nsteps = [\n  {kind = "fly"},\n]\n', "utf-8")
        row = page.locator('[data-skill="evening_round"]')
        row.get_by_text(words).wait_for()
        row.get_by_text(place).wait_for()
        problem = page.locator("#skills [data-problem]")
        problem.get_by_text(line).wait_for()
        told = json.dumps(robot.system.http("GET", "/v1/skills").body["problems"])
        assert (problem.get_attribute("data-problem") or "none") in told
        assert_fits(page)
        assert violations(page) == []
    finally:
        good.unlink()
        broken.unlink()
    row.wait_for(state="detached")
