"""What words about kept orders change: what is named and nothing besides; days left out."""

from __future__ import annotations

from datetime import date, datetime, timedelta
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from planner.language.schedule import ChangeOrders, CorrectOrder, read_order_command
from planner.language.schedule.parts import OnceDay
from planner.orders.decision import SPOKEN_S, KeptOrders, NoneSuch, OrderEdits, WhichOrder, decide
from planner.orders.errors import OrderRefusal
from planner.orders.order import StandingOrder
from planner.orders.rule import coming_runs, days_left_out, find_day, runs_on, upcoming
from planner.orders.scheduler import OrderBook, put
from planner.orders.store import OrderStore
from planner.plan import Clarify
from planner.plan.timing import AtRule, CronRule, EventRule, EveryRule, Rule, WorldEvent
from planner.state_database import StateDatabase
from tests.planner.orders.fakes import BERLIN, NOON_UNIX_S, kept_in
from tests.planner.orders.player import Player, order
from tests.planner.orders.test_intake import say, take

DAY_S = 86_400.0


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


TODAY = date(2027, 1, 15)
TOMORROW, SUNDAY = TODAY + timedelta(days=1), TODAY + timedelta(days=2)
SOMEBODY = EventRule(event=WorldEvent.PERSON_SEEN)
RULES = st.sampled_from(
    ["0 0 * * *", "30 7 * * *", "0 * * * *", "0 20 * * 1,4", "45 23 * * 6", "30 2 * * *"]
)


def left_out(rule: Rule, *days: date) -> StandingOrder:
    return order(1, rule).model_copy(update={"skipped": days})


@given(RULES, st.sets(st.integers(0, 30), max_size=8))
def test_the_runs_of_a_day_left_out_are_left_out_and_no_others(cron: str, ahead: set[int]) -> None:
    rule, days = CronRule(cron=cron), [TODAY + timedelta(days=each) for each in ahead]
    runs = list(coming_runs(left_out(rule, *days), NOON_UNIX_S, BERLIN, 30))
    all_runs = upcoming(rule, NOON_UNIX_S, BERLIN, 30 + 24 * len(days))
    wanted = [s for s in all_runs if datetime.fromtimestamp(s, BERLIN).date() not in days]
    assert runs == wanted[:30]


@pytest.mark.parametrize(
    ("rule", "day", "runs"),
    [
        (CronRule(cron="0 7 * * *"), TOMORROW, True),
        (CronRule(cron="0 7 * * *"), TODAY, False),  # it is noon
        (CronRule(cron="0 0 * * *"), TOMORROW, True),
        (CronRule(cron="0 7 * * 1"), SUNDAY, False),
        (CronRule(cron="0 20 * * 1-5"), TOMORROW, False),
        (EveryRule(seconds=3600.0, anchor_unix_s=NOON_UNIX_S), TOMORROW, True),
        (AtRule(unix_s=NOON_UNIX_S + DAY_S), TOMORROW, True),
        (AtRule(unix_s=NOON_UNIX_S + 60.0), TOMORROW, False),
        (SOMEBODY, TOMORROW, True),
        (SOMEBODY, TODAY - timedelta(days=1), False),
    ],
)
def test_whether_an_order_runs_on_a_day(rule: Rule, day: date, runs: bool) -> None:
    assert runs_on(order(1, rule), day, NOON_UNIX_S, BERLIN) is runs
    assert not runs_on(left_out(rule, day), day, NOON_UNIX_S, BERLIN)


def test_days_that_are_over_are_forgotten_as_another_is_left_out() -> None:
    kept = left_out(SOMEBODY, TODAY - timedelta(days=1), SUNDAY)
    assert days_left_out(kept, TOMORROW, NOON_UNIX_S, BERLIN) == [TOMORROW, SUNDAY]


def test_a_weekday_is_the_coming_one() -> None:
    assert find_day(OnceDay(weekday=6), NOON_UNIX_S, BERLIN) == SUNDAY
    assert find_day(OnceDay(ahead=0), NOON_UNIX_S, BERLIN) == TODAY


def test_a_day_left_out_is_neither_fired_nor_missed_nor_told() -> None:
    player = Player({"o1": left_out(CronRule(cron="0 7 * * *"), TOMORROW)})
    player.start()
    player.live(3 * DAY_S)
    assert [due_s for _, due_s, _ in player.fired] == [
        NOON_UNIX_S + (1 + each) * DAY_S + 19 * 3600.0 for each in (0, 1)
    ]
    assert player.told == []


async def test_one_day_leaves_all_others(tmp_path: Path) -> None:
    kept = await kept_in(tmp_path)
    await say(kept, "every evening at eight remind me to take my pills")
    told = await say(kept, "no pills tomorrow")
    assert "Left out: o1: every day at 20:00 (not on Saturday 2027-01-16)" in told
    await say(kept, "don't remind me about the pills on Sunday")
    [pills] = kept.orders.keeper.book.orders.values()
    assert (pills.paused, pills.skipped) == (False, (TOMORROW, SUNDAY))
    assert kept.orders.keeper.book.due["o1"] == NOON_UNIX_S + 8 * 3600.0  # tonight, as ever
    assert "nothing has changed" in await say(kept, "no pills tomorrow")
    again = await kept_in(tmp_path, kept.clock)
    assert again.orders.keeper.book.orders["o1"].skipped == (TOMORROW, SUNDAY)


async def test_resuming_takes_the_days_back_and_a_pause_keeps_them(tmp_path: Path) -> None:
    kept = await kept_in(tmp_path)
    await say(kept, "every day at seven wake me up")
    await say(kept, "don't wake me tomorrow")
    for text, days in (("pause o1", (TOMORROW,)), ("resume o1", (TOMORROW,)),
                       ("resume o1", ())):  # fmt: skip
        await say(kept, text)
        assert kept.orders.keeper.book.orders["o1"].skipped == days, text


@pytest.mark.parametrize(
    ("order", "text", "told"),
    [
        ("when somebody comes in, say hello", "don't say hello today", "not on Friday 2027-01-15"),
        ("tomorrow at nine remind me to call Sam", "don't remind me tomorrow", "Removed: o1"),
    ],
    ids=["upon an event", "a single one"],
)
async def test_an_order_is_deaf_on_that_day_and_a_single_one_of_it_is_removed(
    tmp_path: Path, order: str, text: str, told: str
) -> None:
    kept = await kept_in(tmp_path)
    await say(kept, order)
    assert told in await say(kept, text)


@pytest.mark.parametrize("text", ["don't remind me to go tomorrow", "今天不用提醒我"])
async def test_of_several_a_person_says_which(tmp_path: Path, text: str) -> None:
    kept = await kept_in(tmp_path)
    await say(kept, "every day at 16:00 remind me to go and stretch")
    await say(kept, "every day at 18:00 remind me to go for a walk")
    asked = await take(kept, text)
    assert isinstance(asked, Clarify)
    assert not any(o.skipped for o in kept.orders.keeper.book.orders.values())
    await say(kept, asked.options[1].text)
    assert kept.orders.keeper.book.orders["o2"].skipped


def test_an_order_of_an_older_program_leaves_no_day_out(tmp_path: Path) -> None:
    database = StateDatabase(tmp_path)
    OrderStore(database).keep([order(1, CronRule(cron="0 7 * * *"))])
    with database.change() as connection:
        connection.execute("UPDATE standing_orders SET record = json_remove(record, '$.skipped')")
    [kept], *_ = OrderStore(database).load()
    assert kept.skipped == ()


@pytest.mark.parametrize("text", ["not on Sunday", "这周日不用"])
async def test_a_day_alone_is_of_the_order_that_was_spoken_of_last(
    tmp_path: Path, text: str
) -> None:
    kept = await kept_in(tmp_path)
    await say(kept, "every day at seven say hello")
    await say(kept, "every evening at eight remind me to take my pills")
    await say(kept, text)
    skipped = {o.id: o.skipped for o in kept.orders.keeper.book.orders.values()}
    assert skipped == {"o1": (), "o2": (SUNDAY,)}
