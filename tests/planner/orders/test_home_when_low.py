"""The one switch of the page for a low battery is a sentence: it keeps what the page looks for."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from planner.api.orders import order_view
from tests.planner.orders.fakes import READY, kept_in
from tests.planner.orders.test_intake import say

CATALOGUES = Path(__file__).resolve().parents[3] / "web" / "src" / "i18n"


@pytest.mark.parametrize("language", ["en", "zh"])
async def test_the_pages_sentence_sends_it_home_on_a_low_battery(
    tmp_path: Path, language: str
) -> None:
    text = (CATALOGUES / f"{language}.ts").read_text("utf-8")
    found = re.search(r'"orders\.low_home_said":\s*"([^"]+)"', text)
    assert found is not None
    kept = await kept_in(tmp_path)
    await say(kept, found.group(1))
    view = order_view(kept.orders, kept.orders.keeper.book.orders["o1"])
    assert view["rule"]["event"] == "battery_low"
    assert [step["kind"] for step in view["may"]] == ["return_home"]


async def test_it_is_given_once_the_battery_is_low_and_not_again_before_it_was_charged(
    tmp_path: Path,
) -> None:
    kept = await kept_in(tmp_path)
    await say(kept, "when the battery is low, go home")
    for charge in (0.5, 0.15, 0.25, 0.15):
        drive = READY.drive.model_copy(update={"battery": charge})
        kept.missions.say_status(drive=drive)
        await kept.run_s(30.0, 1.0)
    assert [text for _, text, _, _ in kept.missions.given] == ["go home"]
