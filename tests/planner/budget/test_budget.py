"""Check that nothing goes round the budget: not a restart, a clock, another program or a crash."""

from __future__ import annotations

import asyncio
import json
import resource
import sqlite3
from collections.abc import Iterator
from contextlib import closing, contextmanager
from datetime import UTC, date, datetime
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from planner.brain import OutOfBudget
from planner.brain.usage_meter import thinking_about
from planner.budget import DayClocks, Ledger, Purse, Usage
from planner.budget.budget import OpenCall
from planner.budget.ledger import FOLDER, KEPT_DAYS, LOOK_BACK_DAYS
from planner.budget.totals import Expense, cost, overrun
from planner.budget.utc_day import DAY_S, Days, utc_date
from planner.settings import BudgetSettings, DayLimits, GoalLimits, Price
from planner.state_database import FILE, StateDatabase
from wire import ConfigError, Unwritable

NOON = datetime(2026, 3, 10, 12, 0, tzinfo=UTC).timestamp()
TODAY = date(2026, 3, 10)
FEW = BudgetSettings(
    goal=GoalLimits(calls=3),
    day=DayLimits(calls=5, money=1.0),
    price=Price(prompt_per_million=1000.0, reply_per_million=10_000.0, currency="EUR"),
)


class Time:
    """Tell what a test sets."""

    def __init__(self) -> None:
        self.unix_s, self.monotonic_s = NOON, 1000.0

    def pass_(self, seconds: float) -> None:
        self.unix_s += seconds
        self.monotonic_s += seconds

    @property
    def clocks(self) -> DayClocks:
        return DayClocks(lambda: self.unix_s, lambda: self.monotonic_s)


@contextmanager
def purse(home: Path, time: Time, budget: BudgetSettings = FEW, most: int = 10) -> Iterator[Purse]:
    kept = Purse(budget, Ledger.in_home(home), model="m", most_reply=most, clocks=time.clocks)
    try:
        yield kept
    finally:
        kept.close()


def open_(kept: Purse, prompt: int = 20) -> OpenCall:
    return asyncio.run(kept.open(prompt))


def call(kept: Purse, goal: str = "g1", prompt: int = 20, reply: int = 5) -> None:
    with thinking_about(goal):
        open_(kept, prompt).close(prompt, reply)


def look(kept: Purse) -> Usage:
    """Return the meter with what other programs have spent."""
    asyncio.run(kept.look())
    return kept.usage()


def test_a_call_is_counted_at_its_worst_and_settled_by_what_it_came_to(tmp_path: Path) -> None:
    time = Time()
    with purse(tmp_path, time) as kept:
        with thinking_about("g1"):
            bill = open_(kept)
        assert bill.max_reply_tokens == 10
        now = kept.usage("g1")
        assert (now.under_way, now.today.calls, now.today.reply_tokens) == (1, 1, 10)
        assert now.goal == now.today
        time.pass_(1.5)
        bill.close(30, 5)
        bill.close(30, 5)
        done = kept.usage()
        assert (done.under_way, done.today.prompt_tokens, done.today.reply_tokens) == (0, 30, 5)
        assert (done.today.seconds, done.today.money, done.currency) == (1.5, 0.08, "EUR")
        assert (done.calls_since_start, done.idle_calls, done.resets_in_s) == (1, 0, 43_198)


@pytest.mark.parametrize(
    ("goals", "per", "en", "zh"),
    [
        (("g1", "g1", "g1"), "goal", "3 of 3 questions. It does not come back", "3 / 3 次"),
        (("g1", "g2", "g3", "g4", "g5"), "day", "midnight UTC, in 12 h 1 min", "12 小时 1 分钟"),
    ],
)
def test_the_last_call_is_the_last_and_a_restart_changes_nothing(
    goals: tuple[str, ...], per: str, en: str, zh: str, tmp_path: Path
) -> None:
    for goal in goals:
        with purse(tmp_path, Time()) as kept:
            call(kept, goal)
    with purse(tmp_path, Time()) as kept:
        before = kept.changes
        with pytest.raises(OutOfBudget, match=f"calls per {per}") as refused:
            call(kept)
        assert en in refused.value.said.en
        assert zh in refused.value.said.zh
        usage = kept.usage()
        assert usage.refused is not None
        assert (usage.refused.code, usage.today.calls) == ("out_of_budget", len(goals))
        assert kept.changes > before


@pytest.mark.parametrize(
    ("budget", "told"),
    [
        (BudgetSettings(goal=GoalLimits(prompt_tokens=39)), "prompt_tokens per goal: 20 of 39"),
        (BudgetSettings(goal=GoalLimits(reply_tokens=14)), "reply_tokens per goal: 5 of 14"),
        (BudgetSettings(day=DayLimits(seconds=2.0)), "seconds per day: 2 of 2"),
        (BudgetSettings(day=DayLimits(money=0.18), price=FEW.price), "money per day: 0.07 of 0.18"),
        (BudgetSettings(day=DayLimits(calls=1)), "calls per day: 1 of 1"),
    ],
)
def test_each_limit_refuses_the_call_that_would_pass_it(
    budget: BudgetSettings, told: str, tmp_path: Path
) -> None:
    time = Time()
    with purse(tmp_path, time, budget) as kept, thinking_about("g1"):
        bill = open_(kept)
        time.pass_(2.0)
        bill.close(20, 5)
        with pytest.raises(OutOfBudget, match=told):
            open_(kept)


def test_midnight_gives_the_day_anew_but_not_the_goal(tmp_path: Path) -> None:
    time = Time()
    with purse(tmp_path, time) as kept:
        for goal in ("g1", "g1", "g1", "g2", "g3"):
            call(kept, goal)
        time.pass_(DAY_S / 2)
        assert kept.usage().today.calls == 0
        call(kept, "g2")
        with pytest.raises(OutOfBudget, match="per goal"):
            call(kept, "g1")
    with purse(tmp_path, time) as kept:
        assert kept.usage("g2").goal == kept.usage("g2").today.model_copy(
            update={"calls": 2, "prompt_tokens": 40, "reply_tokens": 10, "money": 0.14}
        )


def test_a_call_over_midnight_counts_to_the_day_it_went_out(tmp_path: Path) -> None:
    time = Time()
    patient = BudgetSettings(goal=GoalLimits(seconds=DAY_S))
    with purse(tmp_path, time, patient) as kept, thinking_about("g1"):
        bill = open_(kept)
        time.pass_(DAY_S / 2)
        assert kept.usage().today.calls == 0
        bill.close(20, 5)
        call(kept, "g1")
        usage = kept.usage("g1")
        assert usage.goal is not None
        assert (usage.today.calls, usage.goal.calls) == (1, 2)


def test_a_clock_that_steps_back_or_swings_gives_no_day_anew(tmp_path: Path) -> None:
    time = Time()
    with purse(tmp_path, time) as kept:
        for goal in ("a", "b", "c", "d", "e"):
            call(kept, goal)
    for step_s in (-1.0, -DAY_S, -3 * DAY_S, -NOON, 0.0, -10 * DAY_S, 3600.0):
        time.unix_s = NOON + step_s
        with purse(tmp_path, time) as kept:
            assert kept.usage().day == TODAY
            with pytest.raises(OutOfBudget, match="calls per day"):
                call(kept, "f")


def test_a_clock_that_leapt_ahead_shuts_the_budget_for_a_day_of_running_at_most(
    tmp_path: Path,
) -> None:
    time = Time()
    with purse(tmp_path, time) as kept:
        call(kept, "before")
        time.unix_s += 5000 * DAY_S
        for goal in ("a", "b", "c", "d", "e"):
            call(kept, goal)
        time.unix_s -= 5000 * DAY_S
        assert kept.usage().day > TODAY
        assert kept.usage().resets_in_s == DAY_S
        time.pass_(DAY_S - 1.0)
        with pytest.raises(OutOfBudget, match="per day"):
            call(kept, "f")
        time.pass_(1.0)
        assert kept.usage().day == date(2026, 3, 11)
        call(kept, "f")
    with purse(tmp_path, time) as kept:
        assert (kept.usage().day, kept.usage().today.calls) == (date(2026, 3, 11), 1)


def test_a_call_that_dies_with_the_process_stays_counted(tmp_path: Path) -> None:
    with purse(tmp_path, Time()) as kept, thinking_about("g1"):
        open_(kept)
    with purse(tmp_path, Time()) as kept:
        today = kept.usage().today
        assert (today.calls, today.prompt_tokens, today.reply_tokens) == (1, 20, 10)


def test_two_programs_of_one_home_spend_from_one_budget(tmp_path: Path) -> None:
    with purse(tmp_path, Time()) as one, purse(tmp_path, Time()) as other:
        for kept in (one, other, one):
            call(kept, "g1")
        with pytest.raises(OutOfBudget, match="per goal"):
            call(other, "g1")
        assert look(one) == look(other).model_copy(update={"calls_since_start": 2, "refused": None})


def test_no_goal_no_call(tmp_path: Path) -> None:
    with purse(tmp_path, Time()) as kept:
        with pytest.raises(OutOfBudget, match="no goal asked") as refused:
            open_(kept)
        assert refused.value.said.zh
        assert (kept.usage().idle_calls, kept.usage().today.calls) == (1, 0)
        assert look(kept).today.calls == 0
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize(
    "line",
    [
        "nonsense",
        '{"goal": "g1", "calls": 1e999}',
        '{"goal": "g1", "calls": NaN}',
        '{"goal": "g1", "rockets": 1}',
        '{"goal": 7, "calls": 0}',
        '{"calls": 0}',
        "[" * 9000,
        '"text"',
        '{"goal": "g1", "calls": 1',
    ],
)
def test_a_line_that_cannot_be_read_counts_as_a_call(line: str, tmp_path: Path) -> None:
    (tmp_path / FOLDER).mkdir()
    path = tmp_path / FOLDER / f"{TODAY}.jsonl"
    path.write_text(json.dumps({"goal": "g1", "calls": 1}) + f"\n{line}")
    with purse(tmp_path, Time()) as kept:
        assert kept.usage().today.calls == 2
        call(kept)
        assert kept.usage().today.calls == 3


@contextmanager
def full_disk() -> Iterator[None]:
    """Refuse each write of this process, as a full disk does."""
    most = resource.getrlimit(resource.RLIMIT_FSIZE)
    resource.setrlimit(resource.RLIMIT_FSIZE, (0, most[1]))
    try:
        yield
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, most)


@pytest.mark.parametrize("kept_before", [True, False])
def test_a_disk_that_is_full_refuses_the_call_and_says_so(
    kept_before: bool, tmp_path: Path
) -> None:
    if kept_before:
        with purse(tmp_path, Time()) as kept:
            call(kept, "g0")
    with purse(tmp_path, Time()) as kept:
        with full_disk(), pytest.raises(OutOfBudget, match="written down") as refused:
            call(kept)
        assert "disk" in refused.value.said.en
        call(kept)
        assert kept.usage().refused is None
        assert kept.usage().today.calls == 1 + kept_before


def test_what_cannot_be_settled_stays_at_its_worst(tmp_path: Path) -> None:
    with purse(tmp_path, Time()) as kept:
        with thinking_about("g0"):
            bill = open_(kept)
        with full_disk():
            bill.close(30, 5)
            look(kept)
        assert (kept.usage().today.calls, kept.usage().today.reply_tokens) == (1, 10)
        call(kept, "g1")
        assert (kept.usage().today.calls, kept.usage().today.reply_tokens) == (2, 15)


async def test_a_ledger_that_another_program_holds_keeps_the_loop_free(tmp_path: Path) -> None:
    with purse(tmp_path, Time()) as kept:
        with thinking_about("g0"):
            (await kept.open(20)).close(20, 5)
        with closing(sqlite3.connect(tmp_path / FILE, isolation_level=None)) as holder:
            await kept.look()
            holder.execute("BEGIN IMMEDIATE")
            with thinking_about("g1"):
                opening = asyncio.create_task(kept.open(20))
            for _ in range(10):
                await asyncio.sleep(0)
            assert not opening.done()
            assert kept.usage().today.calls == 1
            holder.execute("ROLLBACK")
            (await opening).close(20, 5)
        await kept.look()
        assert kept.usage().today.calls == 2


def test_a_folder_that_cannot_be_read_refuses_to_start(tmp_path: Path) -> None:
    (tmp_path / FOLDER).write_text("no folder")
    with pytest.raises(ConfigError) as wrong:
        Ledger.in_home(tmp_path)
    assert wrong.value.code == "budget_unreadable"
    assert not isinstance(wrong.value, Unwritable), "no restart mends it"


def test_old_days_are_thrown_away_and_what_goals_spent_long_ago_counts_to_its_day_alone(
    tmp_path: Path,
) -> None:
    time = Time()
    with purse(tmp_path, time) as kept:
        call(kept, "old")
    time.pass_((LOOK_BACK_DAYS + 1) * DAY_S)
    with purse(tmp_path, time) as kept:
        call(kept, "new")
        goal = kept.usage("old").goal
        assert goal is not None
        assert goal.calls == 0
    query = "SELECT day, goal, calls FROM spent"
    with closing(StateDatabase(tmp_path)) as database:
        assert sorted(database.read(query)) == [(str(TODAY), "", 1), ("2026-03-19", "new", 1)]
    time.pass_((KEPT_DAYS + 1) * DAY_S)
    with purse(tmp_path, time):
        pass
    with closing(StateDatabase(tmp_path)) as database:
        assert database.read(query) == []


# The layout before -------------------------------------------------------------------------------


def write_days(home: Path, **days: str) -> Path:
    folder = home / FOLDER
    folder.mkdir()
    for day, text in days.items():
        (folder / f"{day.removeprefix('d').replace('_', '-')}.jsonl").write_text(text)
    return folder


def test_the_files_of_days_are_taken_over_once_and_kept_beside(tmp_path: Path) -> None:
    line = json.dumps({"goal": "g1", "calls": 1, "prompt_tokens": 20, "money": 0.07}) + "\n"
    folder = write_days(tmp_path, d2026_03_10=line * 2, d2026_03_01=line, d2025_01_01=line)
    (folder / "notes.txt").write_text("mine")
    (folder / "2026-13-77.jsonl").write_text(line)
    for _ in range(2):
        with purse(tmp_path, Time()) as kept:
            usage = kept.usage("g1")
            assert (usage.today.calls, usage.today.money) == (2, 0.14)
            assert usage.goal is not None
            assert usage.goal.calls == 2, "it began over a week ago: that day is not looked at"
    beside = tmp_path / "spent.old"
    assert {path.name for path in tmp_path.iterdir()} == {beside.name, FILE}
    assert (beside / "notes.txt").read_text() == "mine"
    assert (beside / f"{TODAY}.jsonl").read_text() == line * 2


_STEPS = st.lists(
    st.tuples(st.sampled_from(["wall", "run"]), st.floats(-4 * DAY_S, 4 * DAY_S)), max_size=30
)


@given(_STEPS)
def test_the_day_goes_back_only_after_a_day_of_running(steps: list[tuple[str, float]]) -> None:
    time = Time()
    days = Days(None, time.clocks)
    last, ran_s = days.today(), 0.0
    for what, seconds in steps:
        if what == "wall":
            time.unix_s += seconds
        else:
            time.pass_(abs(seconds))
            ran_s += abs(seconds)
        day = days.today()
        assert days.resets_in_s() >= 0.0
        assert day >= last or ran_s >= DAY_S
        if day != last:
            last, ran_s = day, 0.0


@pytest.mark.parametrize("unix_s", [float("inf"), -1e30, 1e30])
def test_a_clock_out_of_its_mind_is_the_first_day(unix_s: float) -> None:
    assert utc_date(unix_s) == date(1970, 1, 1)


def test_the_arithmetic_of_cost_and_limits() -> None:
    assert cost(None, 10, 10) == 0.0
    assert cost(FEW.price, 1_000_000, 100_000) == 2000.0
    one = Expense(1, 2, 3, 4.0, 5.0)
    assert one + one - one == one
    assert overrun("goal", Expense(), Expense(calls=100), GoalLimits()) is None
    over = overrun("goal", Expense(calls=100), Expense(calls=1), GoalLimits())
    assert over is not None
    assert (over.kind, over.spent, over.limit) == ("calls", 100.0, 100.0)
    nan = overrun("day", Expense(money=float("nan")), Expense(), DayLimits(money=1.0))
    assert nan is not None
    assert nan.kind == "money"
