"""Standing orders as a calendar file: what is written is read, what can't be kept is refused."""

from __future__ import annotations

import contextlib
from dataclasses import replace
from datetime import date, timedelta
from pathlib import Path

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from planner.orders.calendar_import import ImportedCalendar, keep_proposed, propose
from planner.orders.calendar_orders import read_orders, write_orders
from planner.orders.calendar_text import read_components, write_lines
from planner.orders.errors import OrderRefusal
from planner.orders.new_order import NewOrder
from planner.orders.order import StandingOrder
from planner.orders.rule import coming_runs
from planner.plan import Language
from planner.plan.timing import AtRule, CronRule, EventRule, EveryRule, Rule, WorldEvent
from tests.planner.orders.fakes import BERLIN, NOON_UNIX_S, kept_in
from tests.planner.orders.player import order
from tests.planner.orders.test_intake import say

TODAY = date(2027, 1, 15)
DAYS = st.sets(st.integers(0, 6), min_size=1)
CRONS = st.builds(
    lambda m, h, days: f"{m} {h} * * {'*' if len(days) == 7 else ','.join(map(str, sorted(days)))}",
    st.integers(0, 59), st.sampled_from(["*", *map(str, range(24))]), DAYS,
)  # fmt: skip
OTHER_CRONS = st.sampled_from(["0 9 1 * *", "*/15 8-10 * * 1", "0 9 * 3 *"])
RULES: st.SearchStrategy[Rule] = st.one_of(
    st.builds(CronRule, cron=st.one_of(CRONS, OTHER_CRONS)),
    st.builds(EveryRule, seconds=st.integers(300, 900_000).map(float),
              anchor_unix_s=st.integers(-900_000, 0).map(lambda s: NOON_UNIX_S + s)),
    st.builds(AtRule, unix_s=st.integers(60, 30_000_000).map(lambda s: NOON_UNIX_S + s),
              relative=st.booleans()),
    st.builds(EventRule, event=st.sampled_from(WorldEvent),
              hours=st.sampled_from([None, "16:00-00:00"])),
)  # fmt: skip
WORDS = st.text(
    st.characters(categories=("L", "N", "P", "Zs"), include_characters=';,:\\"'), min_size=1,
    max_size=120,
).map(str.strip).filter(bool)  # fmt: skip


@st.composite
def kept_orders(draw: st.DrawFn) -> StandingOrder:
    rule, reminds = draw(RULES), draw(st.booleans())
    kept = order(draw(st.integers(1, 99)), rule).model_copy(
        update={"order": draw(WORDS), "text": draw(WORDS), "paused": draw(st.booleans()),
                "language": draw(st.sampled_from(Language))}
    )  # fmt: skip
    if reminds:
        kept = kept.model_copy(update={"reminder": draw(WORDS)})
    ahead = draw(st.sets(st.integers(0, 9), max_size=3)) if not kept.is_once else set()
    days = sorted(TODAY + timedelta(days=each) for each in ahead)
    return kept.model_copy(update={"skipped": tuple(days)})


def what(each: NewOrder | StandingOrder, rule: object) -> tuple[object, ...]:
    """Return what an order is, without the number that a robot gives it."""
    shown = each.order if each.reminder is None else ""
    whole = StandingOrder(
        id="o", number=0, text="t", order="x", language=Language.EN, rule=rule,
        created_unix_s=NOON_UNIX_S, handled_unix_s=NOON_UNIX_S, skipped=each.skipped,
    )  # fmt: skip
    timed = isinstance(rule, AtRule | CronRule | EveryRule)
    runs = tuple(coming_runs(whole, NOON_UNIX_S, BERLIN, 4)) if timed else rule
    return shown, each.reminder, each.text, each.language, each.paused, runs


@given(st.lists(kept_orders(), max_size=4))
@settings(max_examples=40, deadline=None)
def test_what_is_written_is_read_as_the_same_orders(orders: list[StandingOrder]) -> None:
    text = write_orders(orders, BERLIN, NOON_UNIX_S)
    assert all(len(line.encode()) <= 75 for line in text.split("\r\n"))
    if not orders:
        return
    read = [new for _, new in read_orders(text, BERLIN, NOON_UNIX_S, "api")]
    assert all(isinstance(each, NewOrder) for each in read), read
    assert [what(n, n.when) for n in read if isinstance(n, NewOrder)] == [
        what(o, o.rule) for o in orders
    ]


def event(*lines: str, kind: str = "VEVENT") -> str:
    body = ("BEGIN:VCALENDAR", "VERSION:2.0", f"BEGIN:{kind}", "SUMMARY:go to the kitchen", *lines)
    return write_lines([*body, f"END:{kind}", "END:VCALENDAR"])


START = "DTSTART;TZID=Europe/Berlin:20270115T200000"


@pytest.mark.parametrize(
    ("lines", "when"),
    [
        ((START, "RRULE:FREQ=DAILY"), CronRule(cron="0 20 * * *")),
        ((START, "RRULE:FREQ=WEEKLY"), CronRule(cron="0 20 * * 5")),
        ((START, "RRULE:FREQ=WEEKLY;BYDAY=MO,FR;WKST=MO"), CronRule(cron="0 20 * * 1,5")),
        ((START.replace("200000", "130000"), "RRULE:FREQ=HOURLY"), CronRule(cron="0 * * * *")),
        ((START, "DURATION:PT1H", "BEGIN:VALARM", "TRIGGER:-PT5M", "END:VALARM"),
         AtRule(unix_s=NOON_UNIX_S + 8 * 3600.0)),
        (("DTSTART;TZID=America/New_York:20270115T140000",),
         AtRule(unix_s=NOON_UNIX_S + 8 * 3600.0)),
    ],
)  # fmt: skip
def test_a_calendar_of_others_is_read(lines: tuple[str, ...], when: Rule) -> None:
    [(name, new)] = read_orders(event(*lines), BERLIN, NOON_UNIX_S, "api")
    assert isinstance(new, NewOrder), new
    assert (name, new.order, new.when, new.reminder) == ("go to the kitchen",) * 2 + (when, None)


@pytest.mark.parametrize(
    ("lines", "code"),
    [
        ((START, "RRULE:FREQ=DAILY;COUNT=3"), "order_no_end"),
        ((START, "RRULE:FREQ=DAILY;UNTIL=20270301T000000Z"), "order_no_end"),
        ((START, "RRULE:FREQ=DAILY;INTERVAL=2"), "calendar_repeats"),
        ((START, "RRULE:FREQ=MONTHLY"), "calendar_repeats"),
        ((START, "RRULE:FREQ=WEEKLY;BYDAY=1MO"), "calendar_repeats"),
        ((START, "RRULE:FREQ=WEEKLY;BYDAY=MO"), "calendar_repeats"),  # its start is a Friday
        ((START, "RRULE:FREQ=DAILY", "RDATE:20270120T200000Z"), "calendar_repeats"),
        ((START, "EXDATE:20270115T190000Z"), "calendar_repeats"),
        ((START, "RRULE:FREQ"), "calendar_malformed"),
        ((START, START), "calendar_malformed"),
        (("DTSTART;TZID=Europe/Berlin:20270130T200000", "RRULE:FREQ=DAILY"),
         "calendar_begins_later"),
        (("DTSTART;TZID=America/New_York:20270115T140000", "RRULE:FREQ=DAILY"), "calendar_zone"),
        (("DTSTART:20270115T190000Z", "RRULE:FREQ=DAILY"), "calendar_zone"),
        (("DTSTART:20270115T200000",), "calendar_zone"),
        (("DTSTART;TZID=Mars/Base:20270115T200000",), "calendar_zone"),
        (("DTSTART;TZID=../x:20270115T200000",), "calendar_zone"),
        (("DTSTART;VALUE=DATE:20270115",), "order_time_missing"),
        ((), "order_time_missing"),
        (("DTSTART;TZID=Europe/Berlin:20270328T023000",), "order_time_unknown"),
        ((START.replace("200000", "130000"), "RRULE:FREQ=HOURLY",
          "EXDATE;TZID=Europe/Berlin:20270116T100000"), "calendar_exdate"),
    ],
)  # fmt: skip
def test_what_can_not_be_kept_is_refused(lines: tuple[str, ...], code: str) -> None:
    [(_, refused)] = read_orders(event(*lines), BERLIN, NOON_UNIX_S, "api")
    assert isinstance(refused, OrderRefusal), refused
    assert refused.code == code
    assert all(refused.message.of(language) for language in Language)


@pytest.mark.parametrize(
    "text", ["", "hello", "BEGIN:VCALENDAR", "END:VCALENDAR", "BEGIN:VEVENT\nEND:VEVENT",
             "BEGIN:VCALENDAR\nBEGIN:VEVENT\nEND:VCALENDAR", "x" * 300_000,
             "BEGIN:VCALENDAR\n\x00:1"]
)  # fmt: skip
def test_what_is_no_calendar_is_refused_whole(text: str) -> None:
    with pytest.raises(OrderRefusal, match="calendar_malformed"):
        read_components(text)


@given(st.text(max_size=300))
@settings(max_examples=50)
def test_any_text_is_read_or_refused(text: str) -> None:
    with contextlib.suppress(OrderRefusal):
        read_orders(f"BEGIN:VCALENDAR\n{text}\nEND:VCALENDAR", BERLIN, NOON_UNIX_S, "api")


async def test_nothing_of_a_file_is_kept_before_a_yes_to_just_that(tmp_path: Path) -> None:
    kept = await kept_in(tmp_path)
    await say(kept, "every evening at eight go to the kitchen")
    await say(kept, "when somebody comes in, say hello")
    await say(kept, "not tomorrow")
    keeper = kept.orders.keeper
    text = write_orders(keeper.book.orders.values(), BERLIN, NOON_UNIX_S)
    own = await propose(text, keeper, kept.orders.intake, "api", "g")
    assert [p.refused.code for p in own.proposals if p.refused] == ["calendar_kept"] * 2
    other = await kept_in(tmp_path / "other", kept.clock)
    desk = other.orders.intake

    async def told() -> ImportedCalendar:
        return await propose(text, other.orders.keeper, desk, "api", "g")

    imported = await told()
    assert other.orders.keeper.book.orders == {}
    with pytest.raises(OrderRefusal, match="calendar_changed"):
        await keep_proposed(imported, "0" * 32, desk, "g")
    assert other.orders.keeper.book.orders == {}
    await keep_proposed(await told(), imported.digest, desk, "g")
    again = [replace_id(o) for o in other.orders.keeper.book.orders.values()]
    assert again == [replace_id(o) for o in keeper.book.orders.values()]


def replace_id(kept: StandingOrder) -> StandingOrder:
    return kept.model_copy(update={"id": "o", "number": 0, "nonce": "", "source": "api"})


async def test_an_entry_that_the_brain_does_not_understand_is_told_and_not_kept(
    tmp_path: Path,
) -> None:
    kept = await kept_in(tmp_path)
    text = event(START, "RRULE:FREQ=DAILY").replace("go to the kitchen", "Dentist")
    imported = await propose(text, kept.orders.keeper, kept.orders.intake, "api", "g")
    assert [p.new for p in imported.proposals] == [None]
    assert await keep_proposed(imported, imported.digest, kept.orders.intake, "g") == ()
    assert replace(imported, digest="").proposals[0].refused is not None
