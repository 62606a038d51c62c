"""One day left out of orders that are kept: paused, removed or asked about, and nothing besides."""

from __future__ import annotations

from pathlib import Path

import pytest

from planner.language.schedule.parts import OnceDay
from planner.plan.timing import CronRule
from tests.planner.orders.fakes import NOON_UNIX_S, Kept
from tests.planner.orders.test_corrector import say, take, tell

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


def test_all_of_them_are_dropped_where_all_are_meant(tmp_path: Path) -> None:
    async def story(kept: Kept) -> None:
        for text in ("cancel both reminders", "remove all the orders",
                     "delete everything I've set up"):  # fmt: skip
            await say(kept, "remind me at 18:00 to call Sam")
            await say(kept, "remind me at 19:00 to call Mia")
            await say(kept, text)
            assert not kept.orders.keeper.book.orders, text

    tell(tmp_path, story)


def test_an_order_that_begins_later_is_paused_until_that_day(tmp_path: Path) -> None:
    async def story(kept: Kept) -> None:
        told = await say(kept, "from Monday on, every night at eleven say good night")
        assert "paused, on again on 2027-01-18 at 00:00" in told
        monday = kept.orders.keeper.book.orders["o1"].resume_unix_s
        assert monday is not None
        assert monday - NOON_UNIX_S == 2.5 * DAY_S

    tell(tmp_path, story)


@pytest.mark.parametrize(
    "text",
    [
        "move the wake-up call to eight on Fridays",
        "on Fridays make it eight",
        "make it eight on Fridays",
    ],
)
def test_an_hour_of_some_days_leaves_the_others_as_they_were(tmp_path: Path, text: str) -> None:
    async def story(kept: Kept) -> None:
        await say(kept, "every day at seven wake me up")
        assert "Changed." in await say(kept, text)
        rules = [order.rule for order in kept.orders.keeper.book.orders.values()]
        assert rules == [CronRule(cron="0 7 * * 0,1,2,3,4,6"), CronRule(cron="0 8 * * 5")]
        words = {order.reminder for order in kept.orders.keeper.book.orders.values()}
        assert words == {"time to get up"}

    tell(tmp_path, story)


def test_what_is_so_on_these_days_already_changes_nothing(tmp_path: Path) -> None:
    async def story(kept: Kept) -> None:
        await say(kept, "every day at seven wake me up")
        assert "nothing has changed" in await say(kept, "move the wake-up call to seven on Fridays")
        assert len(kept.orders.keeper.book.orders) == 1

    tell(tmp_path, story)


def test_days_named_first_move_the_whole_order(tmp_path: Path) -> None:
    async def story(kept: Kept) -> None:
        await say(kept, "every day at seven wake me up")
        await say(kept, "make it Fridays at eight")
        [order] = kept.orders.keeper.book.orders.values()
        assert order.rule == CronRule(cron="0 8 * * 5")

    tell(tmp_path, story)
