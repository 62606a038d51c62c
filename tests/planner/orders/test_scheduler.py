"""Laws of the scheduler: each run once, told or fired, whatever clocks, restarts and holds do."""

from __future__ import annotations

from dataclasses import replace

from hypothesis import given, settings
from hypothesis import strategies as st

from planner.orders.order import FiringState
from planner.orders.rule import next_due, settle
from planner.orders.scheduler import (
    LATE_S,
    ClockReading,
    Fire,
    OrderBook,
    RobotView,
    add,
    put,
    tick,
)
from planner.plan.timing import AtRule, CronRule, EveryRule, InRule, Rule, WorldEvent
from planner.plan.timing import EventRule as Upon
from tests.planner.orders.fakes import BERLIN, NOON_UNIX_S
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


@given(_RULES, st.lists(st.floats(-90_000.0, 90_000.0), max_size=12), st.floats(0.5, 400.0))
def test_no_jump_of_the_clock_fires_one_run_twice(
    rule: Rule, jumps: list[float], between_s: float
) -> None:
    life = Player({"o1": order(1, rule)})
    life.start()
    life.tick()
    for jump_s in jumps:
        life.pass_s(between_s)
        life.tick()
        life.unix_s += jump_s
        life.tick()
        for _ in range(3):
            life.pass_s(0.5)
            life.tick()
    due = [at for _, at, _ in life.fired]
    assert len(due) == len(set(due))
    again = [now for _, _, now in life.fired]
    assert len(again) <= 1 + len(jumps) * 2


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


def test_the_same_arguments_give_the_same_answer() -> None:
    book = put(OrderBook(BERLIN), order(1, CronRule(cron="0 13 * * *")))
    book, _ = tick(book, RobotView(), ClockReading(NOON_UNIX_S, 1.0))
    now = ClockReading(NOON_UNIX_S + 3600.2, 3601.2)
    assert tick(book, RobotView(), now) == tick(book, RobotView(), now)
    _, [fire] = tick(book, RobotView(), now)
    assert isinstance(fire, Fire)
    assert fire.firing.state is FiringState.BEGUN
