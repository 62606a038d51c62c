"""What is pasted into the page is sent whole: the planner refuses its length, and nothing is cut.

A browser cuts a paste at maxLength without a word; of an order, the rest may say "but not …".
"""

from __future__ import annotations

import pytest

from tests.e2e.robot import Robot
from tests.web.conftest import OpenPage

pytestmark = [pytest.mark.e2e, pytest.mark.nightly]

ORDER = "every evening at eight go to the kitchen" + " and look" * 40
FACT = "the keys are on the sofa, " * 400
REFUSED = {
    "en-US": ("An order may be 300 characters long.", "I remember up to 300 at a time."),
    "zh-CN": ("一个任务最多 300 个字符。", "我一次最多记 300 个。"),
}


@pytest.mark.parametrize("locale", sorted(REFUSED))
def test_what_is_too_long_is_refused_and_stays_in_its_box(
    robot: Robot, open_page: OpenPage, locale: str
) -> None:
    page = open_page(locale=locale)
    for tab, box, words, told in (
        ("orders", "#order-text", ORDER, REFUSED[locale][0]),
        ("objects", "#memory-fact", FACT, REFUSED[locale][1]),
    ):
        page.click(f"#tab-{tab}")
        page.fill(box, words)
        page.press(box, "Enter")
        page.locator("#announcer", has_text=told).wait_for()
        assert page.input_value(box) == words
    assert robot.system.http("GET", "/v1/orders").body["orders"] == []
    assert robot.system.http("GET", "/v1/memory?kind=fact").body["memories"] == []
