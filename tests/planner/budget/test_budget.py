"""Check that nothing goes round the budget: not a restart, a clock, another program or a crash."""

from __future__ import annotations

import json
import os
from collections.abc import Iterator
from contextlib import closing, contextmanager
from datetime import UTC, date, datetime
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from planner.brain import OutOfBudget
from planner.brain.usage_meter import thinking_about
from planner.budget import Clocks, Ledger, Purse
from planner.budget.ledger import FOLDER, KEPT_DAYS
from planner.budget.totals import Spent, cost, overrun
from planner.budget.utc_day import DAY_S, Days, utc_date
from planner.settings import BudgetSettings, DayLimits, GoalLimits, Price
from wire import Misconfigured

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
    def clocks(self) -> Clocks:
        return Clocks(lambda: self.unix_s, lambda: self.monotonic_s)


@contextmanager
def purse(home: Path, time: Time, budget: BudgetSettings = FEW, most: int = 10) -> Iterator[Purse]:
    kept = Purse(budget, Ledger(home), model="m", most_reply=most, clocks=time.clocks)
    try:
        yield kept
    finally:
        kept.close()


def call(kept: Purse, goal: str = "g1", prompt: int = 20, reply: int = 5) -> None:
    with thinking_about(goal):
        kept.open(prompt).close(prompt, reply)


def test_a_call_is_counted_at_its_worst_and_settled_by_what_it_came_to(tmp_path: Path) -> None:
    time = Time()
    with purse(tmp_path, time) as kept:
        with thinking_about("g1"):
            bill = kept.open(20)
        assert bill.most == 10
        open_ = kept.usage("g1")
        assert (open_.under_way, open_.today.calls, open_.today.reply_tokens) == (1, 1, 10)
        assert open_.goal == open_.today
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
        (("g1", "g1", "g1"), "goal", "3 of 3 calls are spent. It does not come back", "3 / 3 次"),
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
        bill = kept.open(20)
        time.pass_(2.0)
        bill.close(20, 5)
        with pytest.raises(OutOfBudget, match=told):
            kept.open(20)


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
        bill = kept.open(20)
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
        kept.open(20)
    with purse(tmp_path, Time()) as kept:
        today = kept.usage().today
        assert (today.calls, today.prompt_tokens, today.reply_tokens) == (1, 20, 10)


def test_two_programs_of_one_home_spend_from_one_budget(tmp_path: Path) -> None:
    with purse(tmp_path, Time()) as one, purse(tmp_path, Time()) as other:
        for kept in (one, other, one):
            call(kept, "g1")
        with pytest.raises(OutOfBudget, match="per goal"):
            call(other, "g1")
        assert one.usage() == other.usage().model_copy(
            update={"calls_since_start": 2, "refused": None}
        )


def test_no_goal_no_call(tmp_path: Path) -> None:
    with purse(tmp_path, Time()) as kept:
        with pytest.raises(OutOfBudget, match="no goal asked") as refused:
            kept.open(20)
        assert refused.value.said.zh
        assert (kept.usage().idle_calls, kept.usage().today.calls) == (1, 0)
        assert not (tmp_path / FOLDER).exists()


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


def test_a_disk_that_is_full_refuses_the_call_and_says_so(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    with purse(tmp_path, Time()) as kept:
        monkeypatch.setattr("planner.budget.daily_file.os.write", lambda _file, _line: 3)
        with pytest.raises(OutOfBudget, match="written down") as refused:
            call(kept)
        assert "disk" in refused.value.said.en
        monkeypatch.undo()
        call(kept)
        assert kept.usage().refused is None


@pytest.mark.parametrize("mine", [False, True])
@pytest.mark.parametrize("settling", [False, True])
def test_a_line_that_a_full_disk_cut_spoils_no_other(
    settling: bool, mine: bool, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    write = os.write
    (tmp_path / FOLDER).mkdir()
    (tmp_path / FOLDER / f"{TODAY}.jsonl").write_text("")
    with purse(tmp_path, Time()) as kept, purse(tmp_path, Time()) as other:
        next_ = kept if mine else other
        assert other.usage() == kept.usage()
        with thinking_about("g0"):
            bill = kept.open(20) if settling else None
        assert other.usage().today == kept.usage().today
        monkeypatch.setattr(
            "planner.budget.daily_file.os.write", lambda f, line: write(f, line[:9])
        )
        if bill is not None:
            bill.close(30, 5)  # stays at its worst
        else:
            with pytest.raises(OutOfBudget):
                call(kept, "g0")
        monkeypatch.undo()
        call(next_, "g1")
        usage = kept.usage("g1")
        assert usage.goal is not None
        assert (usage.goal.calls, usage.goal.prompt_tokens, usage.goal.reply_tokens) == (1, 20, 5)
        assert (usage.today.calls, usage.today.reply_tokens) == ((3, 15) if settling else (2, 5))


def test_a_folder_that_cannot_be_read_refuses_to_start(tmp_path: Path) -> None:
    (tmp_path / FOLDER).write_text("no folder")
    with pytest.raises(Misconfigured) as wrong:
        Ledger(tmp_path)
    assert wrong.value.code == "budget_unreadable"


def test_an_old_day_that_cannot_be_thrown_away_at_present_refuses_nothing(tmp_path: Path) -> None:
    (tmp_path / FOLDER / "2020-01-01.jsonl").mkdir(parents=True)  # even root unlinks no folder
    with closing(Ledger(tmp_path)) as ledger:
        ledger.remember(date(2026, 1, 1))


def test_old_days_are_thrown_away_and_other_files_are_left_alone(tmp_path: Path) -> None:
    folder = tmp_path / FOLDER
    folder.mkdir()
    old = date.fromordinal(TODAY.toordinal() - KEPT_DAYS - 1)
    names = [f"{old}.jsonl", "2026-13-77.jsonl", "notes.txt", "2026-03-01.jsonl"]
    for name in names:
        (folder / name).write_text("")
    with purse(tmp_path, Time()) as kept:
        assert kept.usage().day == TODAY
    assert sorted(path.name for path in folder.iterdir()) == sorted(names[1:])


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
    one = Spent(1, 2, 3, 4.0, 5.0)
    assert one + one - one == one
    assert overrun("goal", Spent(), Spent(calls=12), GoalLimits()) is None
    over = overrun("goal", Spent(calls=12), Spent(calls=1), GoalLimits())
    assert over is not None
    assert (over.kind, over.spent, over.limit) == ("calls", 12.0, 12.0)
    nan = overrun("day", Spent(money=float("nan")), Spent(), DayLimits(money=1.0))
    assert nan is not None
    assert nan.kind == "money"
