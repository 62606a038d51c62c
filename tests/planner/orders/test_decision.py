"""One day left out of orders that are kept: paused, removed or asked about, and nothing besides."""

from __future__ import annotations

from pathlib import Path

import pytest

from planner.language.schedule.parts import OnceDay
from planner.plan.timing import CronRule
from tests.planner.orders.fakes import Kept
from tests.planner.orders.test_intake import say, take, tell

DAY_S = 86_400.0
TOMORROW, SUNDAY = OnceDay(ahead=1), OnceDay(weekday=6)
"""It is Friday, noon."""


@pytest.mark.parametrize(
    ("text", "gone"),
    [("drop the first one", "o1"), ("delete the second one", "o2"), ("cancel the last one", "o3"),
     ("forget the second reminder", "o2")],
)  # fmt: skip
def test_the_place_in_a_list_that_was_told_names_an_order(
    tmp_path: Path, text: str, gone: str
) -> None:
    async def story(kept: Kept) -> None:
        for hour, name in ((18, "Sam"), (19, "Mia"), (20, "Tom")):
            await say(kept, f"remind me at {hour}:00 to call {name}")
        await say(kept, "what are all my reminders?")
        assert f"Removed: {gone}" in await say(kept, text)
        assert await take(kept, "delete the second one") is None  # the list is another one now

    tell(tmp_path, story)


def test_without_a_list_a_place_names_nothing(tmp_path: Path) -> None:
    async def story(kept: Kept) -> None:
        await say(kept, "remind me at 18:00 to call Sam")
        assert await take(kept, "delete the first one") is None
        await say(kept, "what are all my reminders?")
        kept.clock.pass_s(3600.0)
        assert await take(kept, "delete the first one") is None

    tell(tmp_path, story)


def test_days_named_first_move_the_whole_order(tmp_path: Path) -> None:
    async def story(kept: Kept) -> None:
        await say(kept, "every day at seven wake me up")
        await say(kept, "make it Fridays at eight")
        [order] = kept.orders.keeper.book.orders.values()
        assert order.rule == CronRule(cron="0 8 * * 5")

    tell(tmp_path, story)


@pytest.mark.parametrize("text", ["move the wake-up call to eight on Fridays",
                                  "make it eight on Fridays"])  # fmt: skip
def test_an_hour_of_some_days_alone_is_refused(tmp_path: Path, text: str) -> None:
    async def story(kept: Kept) -> None:
        await say(kept, "every day at seven wake me up")
        assert "Give it anew" in await say(kept, text)
        [order] = kept.orders.keeper.book.orders.values()
        assert order.rule == CronRule(cron="0 7 * * *")

    tell(tmp_path, story)


def test_all_of_them_are_dropped_where_all_are_meant(tmp_path: Path) -> None:
    async def story(kept: Kept) -> None:
        for text in ("cancel both reminders", "remove all the reminders", "取消所有提醒"):
            await say(kept, "remind me at 18:00 to call Sam")
            await say(kept, "remind me at 19:00 to call Mia")
            await say(kept, text)
            assert not kept.orders.keeper.book.orders, text

    tell(tmp_path, story)


def test_two_reminders_at_once_are_told_again_together(tmp_path: Path) -> None:
    async def story(kept: Kept) -> None:
        await say(kept, "remind me in 20 minutes to take the cake out")
        await say(kept, "remind me in 20 minutes to call Tom")
        await kept.run_s(1210.0, 10.0)
        await say(kept, "five more minutes")
        again = [o for o in kept.orders.keeper.book.orders.values() if not o.ended]
        assert [o.reminder for o in again] == ["take the cake out", "call Tom"]

    tell(tmp_path, story)
