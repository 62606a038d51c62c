"""What words about kept orders change: decided purely, and nothing besides what is named."""

from __future__ import annotations

from pathlib import Path

import pytest

from planner.language.schedule import ChangeOrders, CorrectOrder, read_order_command
from planner.language.schedule.parts import OnceDay
from planner.orders.decision import SPOKEN_S, KeptOrders, NoneSuch, OrderEdits, WhichOrder, decide
from planner.orders.errors import OrderRefusal
from planner.orders.scheduler import OrderBook, put
from planner.plan.timing import CronRule
from tests.planner.orders.fakes import BERLIN, NOON_UNIX_S, kept_in
from tests.planner.orders.player import order
from tests.planner.orders.test_intake import say, take

DAY_S = 86_400.0
TOMORROW, SUNDAY = OnceDay(ahead=1), OnceDay(weekday=6)
"""It is Friday, noon."""


@pytest.mark.parametrize(
    ("text", "gone"),
    [("drop the first one", "o1"), ("delete the second one", "o2"), ("cancel the last one", "o3"),
     ("forget the second reminder", "o2")],
)  # fmt: skip
async def test_the_place_in_a_list_that_was_told_names_an_order(
    tmp_path: Path, text: str, gone: str
) -> None:
    kept = await kept_in(tmp_path)
    for hour, name in ((18, "Sam"), (19, "Mia"), (20, "Tom")):
        await say(kept, f"remind me at {hour}:00 to call {name}")
    await say(kept, "what are all my reminders?")
    assert f"Removed: {gone}" in await say(kept, text)
    assert await take(kept, "delete the second one") is None  # the list is another one now


async def test_without_a_list_a_place_names_nothing(tmp_path: Path) -> None:
    kept = await kept_in(tmp_path)
    await say(kept, "remind me at 18:00 to call Sam")
    assert await take(kept, "delete the first one") is None
    await say(kept, "what are all my reminders?")
    kept.clock.pass_s(3600.0)
    assert await take(kept, "delete the first one") is None


async def test_days_named_first_move_the_whole_order(tmp_path: Path) -> None:
    kept = await kept_in(tmp_path)
    await say(kept, "every day at seven wake me up")
    await say(kept, "make it Fridays at eight")
    [order] = kept.orders.keeper.book.orders.values()
    assert order.rule == CronRule(cron="0 8 * * 5")


@pytest.mark.parametrize("text", ["move the wake-up call to eight on Fridays",
                                  "make it eight on Fridays"])  # fmt: skip
async def test_an_hour_of_some_days_alone_is_refused(tmp_path: Path, text: str) -> None:
    kept = await kept_in(tmp_path)
    await say(kept, "every day at seven wake me up")
    assert "Give it anew" in await say(kept, text)
    [order] = kept.orders.keeper.book.orders.values()
    assert order.rule == CronRule(cron="0 7 * * *")


async def test_all_of_them_are_dropped_where_all_are_meant(tmp_path: Path) -> None:
    kept = await kept_in(tmp_path)
    for text in ("cancel both reminders", "remove all the reminders", "取消所有提醒"):
        await say(kept, "remind me at 18:00 to call Sam")
        await say(kept, "remind me at 19:00 to call Mia")
        await say(kept, text)
        assert not kept.orders.keeper.book.orders, text


async def test_two_reminders_at_once_are_told_again_together(tmp_path: Path) -> None:
    kept = await kept_in(tmp_path)
    await say(kept, "remind me in 20 minutes to take the cake out")
    await say(kept, "remind me in 20 minutes to call Tom")
    await kept.run_s(1210.0, 10.0)
    await say(kept, "five more minutes")
    again = [o for o in kept.orders.keeper.book.orders.values() if not o.ended]
    assert [o.reminder for o in again] == ["take the cake out", "call Tom"]


def kept_orders(count: int, ago_s: float = 0.0) -> KeptOrders:
    """Return so many daily orders, at eight in the evening, nine and so on."""
    book = OrderBook(BERLIN)
    for number in range(1, count + 1):
        daily = order(number, CronRule(cron=f"0 {19 + number} * * *"))
        book = put(book, daily.model_copy(update={"created_unix_s": NOON_UNIX_S - ago_s}))
    return KeptOrders(book, NOON_UNIX_S)


def decided(text: str, kept: KeptOrders, answer: str | None = None) -> object:
    command = read_order_command(text)
    assert isinstance(command, ChangeOrders | CorrectOrder), text
    found = decide(command, kept, answer)
    assert repr(found) == repr(decide(command, kept, answer)), "the same words decide the same"
    return found


@pytest.mark.parametrize(
    ("text", "told", "fields"),
    [
        ("remove order o2", "removed", None), ("pause order o2", "paused", {"paused"}),
        ("skip order o2 tomorrow", "skipped", {"skipped"}),
        ("move the one at nine to ten", "changed", {"rule", "text"}),
        ("把任务o2暂停到周一", "paused", {"paused", "resume_unix_s"}),
    ],
)  # fmt: skip
def test_only_the_order_that_is_named_changes_and_only_in_what_is_said(
    text: str, told: str, fields: set[str] | None
) -> None:
    kept = kept_orders(3)
    found = decided(text.replace("the one at nine", "order o2") if fields is None else text, kept)
    assert isinstance(found, OrderEdits), text
    (edit,) = found.edits
    assert (edit.order, edit.told, found.given) == ("o2", told, ())
    before = kept.book.orders["o2"]
    changed = {k for k, v in (edit.fields or {}).items() if getattr(before, k) != v}
    assert changed - {"handled_unix_s"} == (fields or set())


@pytest.mark.parametrize("text", ["make it ten", "改成十点", "not on Sundays", "ten minutes later"])
def test_it_is_the_order_of_a_moment_ago_or_a_person_says_which(text: str) -> None:
    found = decided(text, kept_orders(2))
    assert isinstance(found, OrderEdits)
    assert [edit.order for edit in found.edits] == ["o2"]
    later = kept_orders(2, SPOKEN_S + 1.0)
    asked = decided(text, later)
    assert isinstance(asked, WhichOrder)
    assert len(asked.orders) == 2
    for each in asked.orders:  # each offer names its order, and does it
        again = decided(asked.form.format(id=each.id), later)
        assert isinstance(again, OrderEdits)
        assert [edit.order for edit in again.edits] == [each.id]


def test_what_fits_none_or_can_not_be_is_said_and_changes_nothing() -> None:
    kept = kept_orders(1)
    assert isinstance(decided("cancel the laundry reminder", kept), NoneSuch)
    assert decided("cancel the red one", kept) is None
    refused = decided("make it eight", kept)
    assert isinstance(refused, OrderRefusal)
    assert refused.code == "order_change_none"
