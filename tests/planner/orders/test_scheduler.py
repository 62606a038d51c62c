"""Laws of the scheduler: each run once, told or fired, whatever clocks and restarts do."""

from __future__ import annotations

from dataclasses import replace
from datetime import datetime
from itertools import pairwise
from pathlib import Path

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from planner.orders.rule import is_quiet, next_due, settle
from planner.orders.scheduler import (
    BACK_S,
    CLOCK_MOVED,
    LATE,
    LATE_S,
    STEP_S,
    UNSET_S,
    WAS_OFF,
    OrderBook,
    RobotView,
    add,
)
from planner.plan import QuietHours
from planner.plan.timing import AtRule, CronRule, EveryRule, InRule, Rule, WorldEvent
from planner.plan.timing import EventRule as Upon
from tests.planner.orders.fakes import BERLIN, NOON_UNIX_S, kept_in
from tests.planner.orders.player import Player, order

_RULES = st.one_of(
    st.sampled_from(
        [CronRule(cron=c) for c in ("0 13 * * *", "30 2 * * *", "0 * * * *", "15 20 * * 1-5")]
    ),
    st.sampled_from([EveryRule(seconds=s, anchor_unix_s=NOON_UNIX_S) for s in (300.0, 5400.0)]),
    st.floats(10.0, 90_000.0).map(lambda s: AtRule(unix_s=NOON_UNIX_S + s)),
)
_DEEDS = st.lists(
    st.one_of(
        st.tuples(st.just("pass"), st.floats(0.05, 7200.0)),
        st.tuples(st.just("wait"), st.floats(0.05, 1.0)),
        st.tuples(st.just("off"), st.floats(1.0, 100_000.0)),
        st.tuples(st.just("hold"), st.floats(1.0, 4000.0)),
    ),
    max_size=40,
)


@settings(deadline=None)
@given(st.lists(_RULES, min_size=1, max_size=4), _DEEDS)
def test_every_run_is_fired_or_told_exactly_once(
    rules: list[Rule], deeds: list[tuple[str, float]]
) -> None:
    life = Player({f"o{n}": order(n, rule) for n, rule in enumerate(rules)})
    life.start()
    life.tick()
    for deed, seconds in deeds:
        life.pass_s(seconds)
        if deed == "off":
            life.start()
        life.tick(RobotView(hindrance="held") if deed == "hold" else RobotView())
    for n, rule in enumerate(rules):
        name, due, wanted = f"o{n}", NOON_UNIX_S, []
        while (later := next_due(rule, due, BERLIN)) is not None and later <= life.unix_s:
            wanted.append(later)
            due = later
        fired = [at for who, at, _ in life.fired if who == name]
        told = [(a, b, c) for who, a, b, c in life.told if who == name]
        assert fired == sorted(set(fired))  # never twice, never back in time
        covered = sum(c for _, _, c in told) + len(fired)
        assert covered == min(len(wanted), covered if covered > 900 else len(wanted))
        for at in fired:
            assert not any(a <= at <= b for a, b, _ in told)
    assert all(0.0 <= now - due <= LATE_S for _, due, now in life.fired)


def test_a_relative_order_given_on_an_unset_clock_keeps_its_time() -> None:
    life = Player({})
    life.book = replace(OrderBook(BERLIN), floor_unix_s=NOON_UNIX_S + 5000.0)
    life.tick()
    assert life.book.unset
    given_now = order(1, settle(InRule(seconds=600.0), life.unix_s, BERLIN), life.unix_s)
    life.book = add(life.book, given_now)
    life.pass_s(300.0)
    life.tick()
    life.unix_s += 6000.0
    life.tick()
    life.pass_s(299.0)
    life.tick()
    assert life.fired == []
    life.pass_s(1.5)
    life.tick()
    assert [name for name, _, _ in life.fired] == ["o1"]


def test_events_fire_with_a_pause_between_and_not_while_held() -> None:
    life = Player({"o1": order(1, Upon(event=WorldEvent.PERSON_SEEN))})
    life.start()
    seen = RobotView(happened=(WorldEvent.PERSON_SEEN,))
    life.tick(seen)
    life.pass_s(10.0)
    life.tick(seen)
    life.tick(RobotView(happened=(WorldEvent.MOVEMENT,)))
    assert len(life.fired) == 1
    life.pass_s(60.0)
    life.tick(RobotView(hindrance="held", happened=(WorldEvent.PERSON_SEEN,)))
    assert len(life.fired) == 1
    assert len(life.told) == 1


def test_an_event_counts_only_in_its_hours() -> None:
    by_day, by_night = (
        order(number, Upon(event=WorldEvent.PERSON_SEEN, hours=hours))
        for number, hours in ((1, "11:00-18:00"), (2, "22:00-06:00"))
    )
    life = Player({"o1": by_day, "o2": by_night})
    life.start()
    seen = RobotView(happened=(WorldEvent.PERSON_SEEN,))
    life.tick(seen)
    assert [name for name, *_ in life.fired] == ["o1"], "at noon"
    life.pass_s(11 * 3600.0)
    life.tick(seen)
    assert [name for name, *_ in life.fired] == ["o1", "o2"], "at eleven at night"


HOUR_S, DAY_S, YEAR_S = 3600.0, 86_400.0, 365.0 * 86_400.0


def at(text: str, fold: int = 0) -> float:
    return datetime.fromisoformat(text).replace(tzinfo=BERLIN, fold=fold).timestamp()


EVES = (NOON_UNIX_S, at("2027-03-27T23:50"), at("2027-10-30T23:50"))
"""A plain noon, and the evenings before clocks go on, and back."""
_CRONS = st.sampled_from(
    ["0 13 * * *", "30 2 * * *", "0 3 * * *", "0 * * * *", "*/5 * * * *", "15 20 * * 1-5"]
)
_HOURS_S = st.one_of(
    st.sampled_from([-DAY_S, -3 * HOUR_S, -HOUR_S, HOUR_S, 3 * HOUR_S, DAY_S]),
    st.floats(-DAY_S, DAY_S),
)
_NIGHTS = st.lists(
    st.one_of(
        st.tuples(st.just("live"), st.floats(0.5, 4000.0)),
        st.tuples(st.just("jump"), _HOURS_S),
        st.tuples(st.just("sleep"), st.floats(60.0, 7200.0)),
        st.tuples(st.just("restart"), st.floats(1.0, 7200.0)),
    ),
    max_size=15,
)
Deeds = list[tuple[str, float]]


def play(life: Player, deeds: Deeds) -> float:
    """Play deeds; return how much time really passed [s]."""
    began_s = life.monotonic_s
    life.start()
    life.tick()
    for deed, seconds in deeds:
        match deed:
            case "live":
                life.live(seconds)
            case "jump":
                life.unix_s += seconds
                life.tick()
            case "sleep":  # elapsed time goes on in it, and no tick is taken
                life.pass_s(seconds)
                life.tick()
            case _:
                life.pass_s(seconds)
                life.start()
                life.tick()
    return life.monotonic_s - began_s


@settings(deadline=None)
@given(st.sampled_from(EVES), _CRONS, _NIGHTS)
def test_no_due_time_fires_twice_and_nothing_comes_in_a_burst(
    eve_s: float, cron: str, deeds: Deeds
) -> None:
    life = Player({"o1": order(1, CronRule(cron=cron), eve_s)}, eve_s)
    passed_s = play(life, deeds)
    due = [due_s for _, due_s, _ in life.fired]
    back_s = sum(-seconds for deed, seconds in deeds if deed == "jump" and seconds < 0.0)
    if back_s < BACK_S:  # beyond it the clock was wrong before, and times of day are due anew
        assert due == sorted(set(due))
    assert all(0.0 <= now_s - due_s <= LATE_S for _, due_s, now_s in life.fired)
    jumps = sum(deed == "jump" for deed, _ in deeds)
    assert len(life.fired) <= passed_s / 300.0 + jumps + 1
    for fired, later in pairwise(life.fired):
        assert fired[2] != later[2], "two runs at one instant"


@settings(deadline=None)
@given(st.sampled_from(EVES), _CRONS, _NIGHTS)
def test_each_run_that_the_clock_reaches_is_fired_or_told(
    eve_s: float, cron: str, deeds: Deeds
) -> None:
    ahead = [(deed, abs(seconds)) for deed, seconds in deeds]
    rule = CronRule(cron=cron)
    life = Player({"o1": order(1, rule, eve_s)}, eve_s)
    play(life, ahead)
    history = sorted(
        [(due_s, due_s, 1) for _, due_s, _ in life.fired]
        + [(first_s, last_s, count) for _, first_s, last_s, count in life.told]
    )
    for (_, last_s, _), (first_s, _, _) in pairwise(history):
        assert last_s < first_s
    wanted, due_s = 0, next_due(rule, eve_s, BERLIN)
    while due_s is not None and due_s <= life.unix_s:
        wanted, due_s = wanted + 1, next_due(rule, due_s, BERLIN)
    assert sum(count for *_, count in history) == wanted


@settings(deadline=None)
@given(st.floats(60.0, 2 * HOUR_S), st.lists(_HOURS_S, min_size=1, max_size=6), st.floats(0.0, 1.0))
def test_what_was_counted_from_an_instant_comes_after_that_time_whatever_the_clock_does(
    wait_s: float, jumps: list[float], share: float
) -> None:
    rules: list[Rule] = [
        settle(InRule(seconds=wait_s), NOON_UNIX_S, BERLIN),
        EveryRule(seconds=max(300.0, wait_s), anchor_unix_s=NOON_UNIX_S),
    ]
    life = Player({f"o{n}": order(n, rule) for n, rule in enumerate(rules)})
    life.start()
    life.tick()
    began_s = life.monotonic_s
    fired_s: dict[str, float] = {}
    for jump_s in jumps:
        life.live(wait_s * share / len(jumps) - 0.1)
        life.unix_s += jump_s
        life.tick()
        fired_s |= {name: life.monotonic_s - began_s for name, *_ in life.fired[len(fired_s) :]}
    while len(life.fired) < 2:
        life.live(min(life.book.due.values()) - life.unix_s + 0.05)
        fired_s |= {name: life.monotonic_s - began_s for name, *_ in life.fired[len(fired_s) :]}
    slewed_s = sum(abs(jump_s) for jump_s in jumps if abs(jump_s) <= STEP_S + 0.01)
    assert life.told == []
    assert fired_s["o0"] == pytest.approx(wait_s, abs=0.2 + slewed_s)
    assert fired_s["o1"] == pytest.approx(max(300.0, wait_s), abs=0.2 + slewed_s)


@settings(deadline=None)
@given(st.floats(300.0, DAY_S), _HOURS_S, st.integers(1, 40))
def test_a_run_that_was_just_done_is_not_due_again_as_the_clock_is_put_right(
    every_s: float, jump_s: float, runs: int
) -> None:
    rule = EveryRule(seconds=every_s, anchor_unix_s=NOON_UNIX_S)
    due_s = NOON_UNIX_S + runs * every_s
    life = Player({"o1": order(1, rule, NOON_UNIX_S + (runs - 0.5) * every_s)}, due_s)
    play(life, [("live", 0.05), ("jump", jump_s), ("live", every_s - 2.0)])
    assert len(life.fired) == 1
    life.live(3.2)  # a step of a second or less counts as slewing
    assert len(life.fired) == 2


@settings(deadline=None)
@given(st.sampled_from(EVES), _CRONS, _NIGHTS)
def test_nothing_that_is_due_in_quiet_hours_fires(eve_s: float, cron: str, deeds: Deeds) -> None:
    quiet = QuietHours(22 * 60, 7 * 60)
    life = Player({"o1": order(1, CronRule(cron=cron), eve_s)}, eve_s, quiet=quiet)
    play(life, deeds)
    assert not [due_s for _, due_s, _ in life.fired if is_quiet(quiet, due_s, BERLIN)]


@settings(deadline=None)
@given(st.floats(-20 * YEAR_S, 20 * YEAR_S), st.floats(1.0, DAY_S), _NIGHTS)
def test_no_order_waits_for_a_year_that_a_wrong_clock_has_shown(
    wrong_s: float, off_s: float, deeds: Deeds
) -> None:
    """A process lived by a wrong clock; the next one begins by a right one."""
    rules: list[Rule] = [
        CronRule(cron="0 * * * *"),
        EveryRule(seconds=HOUR_S, anchor_unix_s=NOON_UNIX_S),
    ]
    life = Player({f"o{n}": order(n, rule) for n, rule in enumerate(rules)})
    play(life, [("live", 700.0), ("jump", wrong_s), ("live", 700.0), *deeds])
    life.unix_s = NOON_UNIX_S + DAY_S  # set while the planner was off
    life.monotonic_s += off_s
    life.start()
    life.tick()
    life.fired.clear()
    life.told.clear()
    life.live(BACK_S + UNSET_S + 2 * HOUR_S)
    alive = {name for name, *_ in (*life.fired, *life.told)}
    assert alive == {"o0", "o1"}


@pytest.mark.parametrize(
    ("eve", "until", "rules", "wanted"),
    [
        (
            "2027-03-27T23:30", "2027-03-28T06:30",
            ["30 2 * * *", "0 3 * * *", "0 * * * *"],
            {
                "o0": ["03:00"],
                "o1": ["03:00"],
                "o2": ["00:00", "01:00", "03:00", "04:00", "05:00", "06:00"],
            },
        ),
        (
            "2027-10-30T23:30", "2027-10-31T06:30",
            ["30 2 * * *", "0 3 * * *", "0 * * * *"],
            {
                "o0": ["02:30"],
                "o1": ["03:00"],
                "o2": ["00:00", "01:00", "02:00", "02:00", "03:00", "04:00", "05:00", "06:00"],
            },
        ),
    ],
)  # fmt: skip
def test_nights_with_23_and_25_hours_are_lived_through(
    eve: str, until: str, rules: list[str], wanted: dict[str, list[str]]
) -> None:
    eve_s = at(eve)
    orders = {f"o{n}": order(n, CronRule(cron=cron), eve_s) for n, cron in enumerate(rules)}
    orders["in"] = order(9, settle(InRule(seconds=4 * HOUR_S), eve_s, BERLIN), eve_s).model_copy(
        update={"id": "in"}
    )
    life = Player(orders, eve_s)
    life.start()
    life.tick()
    life.live(at(until) - eve_s)
    assert life.told == []
    for name, times in wanted.items():
        fired = [now_s for who, _, now_s in life.fired if who == name]
        assert [datetime.fromtimestamp(s, BERLIN).strftime("%H:%M") for s in fired] == times
    [counted_s] = [now_s for who, _, now_s in life.fired if who == "in"]
    assert counted_s - eve_s == pytest.approx(4 * HOUR_S, abs=1.0)


@pytest.mark.parametrize("wrong_s", [-HOUR_S, HOUR_S])
@pytest.mark.parametrize("eve_s", EVES[1:])
def test_an_hour_that_a_clock_is_wrong_by_in_such_a_night_doubles_nothing(
    eve_s: float, wrong_s: float
) -> None:
    """As where another system has set the machine's clock for summer too, and it is put right."""
    life = Player({"o1": order(1, CronRule(cron="30 2 * * *"), eve_s)}, eve_s)
    play(life, [("live", 2.4 * HOUR_S), ("jump", wrong_s), ("live", 900.0), ("jump", -wrong_s),
                ("live", 6 * HOUR_S)])  # fmt: skip
    assert len(life.fired) + sum(count for *_, count in life.told) == 1


def test_a_clock_that_was_reset_is_not_believed_however_long_it_lasts() -> None:
    life = Player({"o1": order(1, CronRule(cron="0 * * * *"))})
    play(life, [("live", 700.0)])
    life.unix_s = 0.0  # 1970: no battery behind the clock, and no network to set it
    life.start()
    life.tick()
    life.live(3 * HOUR_S)
    assert life.fired == []
    life.unix_s = NOON_UNIX_S + HOUR_S - 10.0
    life.tick()
    life.live(60.0)
    assert [due_s for _, due_s, _ in life.fired] == [NOON_UNIX_S + HOUR_S]
    assert life.told == []


def test_why_a_run_is_missed_is_told_by_what_came_between() -> None:
    rule = AtRule(unix_s=NOON_UNIX_S + HOUR_S)
    for deeds, why in (
        ([("sleep", 2 * HOUR_S)], LATE),
        ([("restart", 2 * HOUR_S)], WAS_OFF),
        ([("jump", 2 * HOUR_S)], CLOCK_MOVED),
    ):
        life = Player({"o1": order(1, rule)})
        play(life, deeds)
        assert (life.fired, life.reasons) == ([], [why])


async def test_a_suspended_hour_is_an_hour_for_what_was_counted_from_an_instant(
    tmp_path: Path,
) -> None:
    """Monotonic time stands in it, elapsed time goes on: the reminder is told as missed at once."""
    kept = await kept_in(tmp_path)
    for text in ("remind me in 20 minutes to take the cake out", "in 90 minutes say hello"):
        await kept.give(text)
    await kept.run_s(600.0, 10.0)
    kept.clock.suspend(HOUR_S)
    await kept.turn()
    assert kept.missions.told() == [("missed", "late")]
    assert kept.missions.given == []
    await kept.run_s(1190.0, 1.0)  # 70 minutes are over, and 19.8
    assert kept.missions.given == []
    await kept.run_s(12.0, 1.0)
    assert [text for _, text, *_ in kept.missions.given] == ["say hello"]
