"""Hold the ledger's law: killed at any write, each run is given once or told as missed."""

from __future__ import annotations

import asyncio
import sqlite3
from collections.abc import Iterator
from contextlib import contextmanager
from itertools import count
from pathlib import Path
from typing import Any

import pytest

from planner.orders.errors import OrderRefusal
from planner.orders.order import FiringState, StandingOrder, key_of
from planner.orders.rule import next_due
from planner.state_database import StateDatabase, StateUnavailable
from tests.planner.orders.fakes import BERLIN, NOON_UNIX_S, FakeMissions, Kept, MovedClocks, kept_in

MANY, NEVER = 200, 10**9
"""More moments than any story has, and than all of them."""


class Death(BaseException):
    """The process is gone, at this very moment."""


class Fate:
    """Count the moments at which a process may die: before and after each write and each goal."""

    def __init__(self, at: int) -> None:
        self.at, self.moments = at, count()
        self.struck = False

    def pass_moment(self) -> None:
        if self.struck or next(self.moments) >= self.at:
            self.struck = True
            raise Death


class MortalDatabase(StateDatabase):
    """Be a database whose process may die before a change, or after it; the machine never does."""

    def __init__(self, home: Path, fate: Fate) -> None:
        super().__init__(home)
        self._fate = fate

    @contextmanager
    def change(self, *, sync: bool = True) -> Iterator[sqlite3.Connection]:
        self._fate.pass_moment()
        with super().change(sync=False) as connection:
            yield connection
        self._fate.pass_moment()


class MortalMissions(FakeMissions):
    """Give goals, and die before or after one was written into the journal."""

    fate = Fate(MANY)

    async def give(self, *given: Any) -> str:
        self.fate.pass_moment()
        goal = await super().give(*given)
        self.fate.pass_moment()
        return goal


ORDERS = (
    "every hour say hello",
    "every 10 minutes go to the kitchen",
    "in 20 minutes say hello",
    "remind me in 50 minutes to take the cake out",
)


async def _live(kept: Kept) -> None:
    """Play runs, a planner that is held up for long, and a person who pauses just then."""
    await kept.run_s(620.0, 10.0)
    for goal, *_ in kept.missions.given:
        kept.missions.end(goal)
    kept.clock.pass_s(2400.0 - 20.0)  # held up, and looks again right after several were due
    kept.orders.keeper.turn()
    await kept.orders.intake.pause("o2")  # before anything of it is written
    await kept.orders.intake.pause("o2", paused=False)
    await kept.run_s(1800.0, 30.0)


async def _die_at(home: Path, at: int) -> bool:
    """Play the story with a death at a moment and a new process after it; tell whether it came."""
    clock, fate = MovedClocks(), Fate(at)
    missions = MortalMissions(clock)
    made = await kept_in(home, clock, missions, database=MortalDatabase(home, Fate(NEVER)))
    for text in ORDERS:
        await made.give(text)
    missions.fate = fate
    mortal = await kept_in(home, clock, missions, database=MortalDatabase(home, fate))
    try:
        await _live(mortal)
    except Death:
        missions.fate = Fate(MANY)
    again = await kept_in(home, clock, missions, database=MortalDatabase(home, Fate(NEVER)))
    if again.orders.intake.find("o2").paused:
        await again.orders.intake.pause("o2", paused=False)
    await again.run_s(4000.0, 20.0)
    for order in again.orders.keeper.book.orders.values():
        await _judge(again, order)
    return fate.struck


async def _judge(kept: Kept, order: StandingOrder) -> None:
    """Hold that each run of an order is in its history once, and each of its goals too."""
    history = await kept.orders.keeper.history(order.id, 200)
    assert all(firing.state is not FiringState.BEGUN for firing in history)
    wanted, due_s = 0, next_due(order.rule, NOON_UNIX_S, BERLIN)
    while due_s is not None and due_s <= kept.clock.unix_s:
        wanted, due_s = wanted + 1, next_due(order.rule, due_s, BERLIN)
    assert sum(firing.count for firing in history) == wanted, (order.id, history)
    goals = [firing.goal for firing in history if firing.goal is not None]
    given = [goal for goal, _, _, source in kept.missions.given if source == f"order:{order.id}"]
    assert sorted(goals) == sorted(given)
    assert order.fired == len(given)
    assert order.missed == wanted - len(given)


async def test_a_kill_at_any_write_doubles_nothing_and_loses_nothing(tmp_path: Path) -> None:
    for at in range(MANY):
        home = tmp_path / str(at)
        home.mkdir()
        if not await _die_at(home, at):
            assert at > 20
            return
    pytest.fail(f"the story has more than {MANY} moments")


async def test_a_reminder_whose_goal_a_kill_cut_off_is_told_at_the_next_start(
    tmp_path: Path,
) -> None:
    clock = MovedClocks()
    missions = MortalMissions(clock)
    made = await kept_in(tmp_path, clock, missions)
    text = "remind me in 20 minutes to take the cake out"
    await made.give(text)
    missions.fate = Fate(1)  # after its goal was written, before its words were told
    with pytest.raises(Death):
        await made.run_s(1201.0, 10.0)
    assert missions.told() == []
    await kept_in(tmp_path, clock, missions)
    assert missions.told() == [("reminder", "reminder")]
    missions.end("goal-1")
    await kept_in(tmp_path, clock, missions)
    assert len(missions.told()) == 1


async def test_a_pause_holds_from_the_moment_it_is_said(tmp_path: Path) -> None:
    kept = await kept_in(tmp_path)
    await kept.give("every hour say hello")
    kept.clock.pass_s(3599.95)
    pausing = asyncio.create_task(kept.orders.intake.pause("o1"))
    await asyncio.sleep(0)  # it is on its way to the disk
    await kept.turn()
    paused = await pausing
    assert paused.paused
    assert kept.missions.given == []
    await kept.orders.intake.pause("o1", paused=False)
    await kept.run_s(3600.0, 10.0)
    assert [key for *_, key, _ in kept.missions.given] == [key_of(paused, 1)]


async def test_resuming_what_is_not_paused_passes_nothing_over(tmp_path: Path) -> None:
    kept = await kept_in(tmp_path)
    await kept.give("every hour say hello")
    kept.clock.pass_s(3600.01)  # due, and no tick has looked yet
    await kept.orders.intake.pause("o1", paused=False)
    await kept.turn()
    assert len(kept.missions.given) == 1


async def test_what_a_full_disk_refuses_is_written_once_there_is_room(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    kept = await kept_in(tmp_path)
    await kept.give("every hour say hello")

    def full(*_: object) -> None:
        raise StateUnavailable(tmp_path, OSError(28, "No space left on device"))

    with monkeypatch.context() as patched:
        patched.setattr(kept.orders.keeper._store, "keep", full)
        with pytest.raises(OrderRefusal):
            await kept.orders.intake.pause("o1")
        assert not kept.orders.intake.find("o1").paused
        await kept.run_s(3610.0, 10.0)
        assert kept.orders.keeper.trouble is not None
    await kept.turn()
    assert kept.orders.keeper.trouble is None
    [firing] = await kept.orders.keeper.history("o1", 10)
    assert (firing.state, firing.reason) == (FiringState.MISSED, "orders_unwritable")
    assert kept.missions.told() == [("missed", "orders_unwritable")]
