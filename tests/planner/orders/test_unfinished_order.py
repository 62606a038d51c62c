"""An order without its time is asked about, and finished by the time that is said next."""

from __future__ import annotations

from typing import TYPE_CHECKING

import pytest

from planner.orders.unfinished_order import WAITS_S
from planner.plan import Clarify
from tests.planner.orders.test_corrector import due, orders, say, take, tell

if TYPE_CHECKING:
    from pathlib import Path

    from tests.planner.orders.fakes import Kept


@pytest.mark.parametrize(
    ("said", "time", "when"),
    [
        ("remind me to ring the doctor", "about ten tomorrow", "01-16 10:00"),
        ("don't let me forget the bins", "at five in the afternoon", "01-15 17:00"),
        ("提醒我给大姨打电话", "吃完晚饭，晚上七点来钟吧", "01-15 19:00"),
    ],
)  # fmt: skip
def test_the_time_that_is_said_next_finishes_it(
    tmp_path: Path, said: str, time: str, when: str
) -> None:
    async def story(kept: Kept) -> None:
        assert isinstance(await take(kept, said), Clarify)
        assert orders(kept) == {}
        await say(kept, time)
        assert due(kept, "o1") == when
        assert "o2" not in orders(kept), "it is finished once"

    tell(tmp_path, story)


def test_a_time_long_after_finishes_nothing(tmp_path: Path) -> None:
    async def story(kept: Kept) -> None:
        await take(kept, "remind me to ring the doctor")
        await kept.run_s(WAITS_S + 60.0, 30.0)
        assert "What am I to do" in await say(kept, "tomorrow at ten")
        assert orders(kept) == {}

    tell(tmp_path, story)


def test_what_no_event_tells_offers_the_nearest(tmp_path: Path) -> None:
    async def story(kept: Kept) -> None:
        asked = await take(kept, "if you see anybody in the hallway at night, let me know")
        assert isinstance(asked, Clarify)
        assert [o.text for o in asked.options] == [
            "when you see somebody at night, say I see somebody"
        ]
        assert "What I can notice" in await say(
            kept, "whenever you see a backpack in the hallway tell the kids to put it away"
        )
        assert orders(kept) == {}

    tell(tmp_path, story)
