"""Another map, clocks that jump, a full disk: survived with a clear record, the robot still."""

from __future__ import annotations

import threading
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest
import sqlalchemy as sa

from planner.bridge_client import Identity
from planner.mission import Engine, MissionJournal
from planner.mission.api_view import goal_of
from planner.mission.effects import Journal
from planner.mission.events import Planned, Reply, Restarted, Resume
from planner.mission.goal_lifecycle import MAP_CHANGED
from planner.mission.journal_sync import JournalWriter, PendingEntry
from planner.mission.state import Mission, MissionState
from planner.plan import (
    Bilingual,
    Clarify,
    Code,
    ComeBack,
    GoalState,
    GoTo,
    Language,
    MoveStraight,
    Say,
    StepPlan,
)
from tests.planner.mission.driving import FAILED, PAUSED, SUCCEEDED, driving, standing_still
from tests.planner.mission.fakes import FACTS, HASH
from tests.planner.mission.lockstep import Together, go

MAP_A, MAP_B = replace(FACTS, map_id="a"), replace(FACTS, map_id="b")


def on_map(world: Together, facts: Any) -> Together:
    world.engine = Engine(MissionState(facts), Identity(world.planner_id, HASH, HASH, HASH))
    return world


def restarted(before: Together, facts: Any, wall_offset_s: float = 0.0) -> Together:
    """Return a new planner on the old journal, with these places; a person has cleared the hold."""
    newest: dict[str, Mission] = {}
    for entry in before.disk_entries:
        newest.update({m.id: m for m in entry.missions})
    before.bridge.lose_owner()
    after = Together(bridge=before.bridge, planner_id="p2", now_s=before.now_s)
    on_map(after, facts)
    kept = tuple(newest.values())
    after.event(Restarted(kept, before.disk_entries[-1].queue, wall_offset_s))
    after.run(0.2)
    after.act()
    return after


def test_on_another_map_places_are_found_anew_and_there_is_no_way_back() -> None:
    before = on_map(Together(), MAP_A)
    before.run(0.2)
    steps = (GoTo(place="kitchen"), ComeBack())
    goal = before.give(StepPlan(steps=steps))
    before.run(1.0)
    after = restarted(before, MAP_B)
    mission = after.goal(goal)
    assert (mission.state, mission.accepted_at, mission.map_id) == (PAUSED, None, "b")
    assert mission.outcome is not None
    assert mission.outcome.message == MAP_CHANGED
    assert standing_still(after)
    after.event(Resume(goal))
    after.plans[goal] = StepPlan(steps=(ComeBack(),))
    done = after.run_until(goal, FAILED)
    assert [(s.kind, s.state.value) for s in done.steps] == [
        ("go_to", "succeeded"), ("come_back", "failed")]  # fmt: skip
    assert done.outcome is not None
    assert done.outcome.code is Code.NO_ROUTE


def test_where_the_order_before_was_given_is_kept_on_the_same_map_alone() -> None:
    before = on_map(Together(), MAP_A)
    before.run(0.2)
    before.run_until(before.give(go("kitchen")), SUCCEEDED)
    goal = before.give(None)
    assert before.goal(goal).departed_at is not None
    assert restarted(before, MAP_A).goal(goal).departed_at == before.goal(goal).departed_at
    assert restarted(before, MAP_B).goal(goal).departed_at is None


def test_a_move_of_which_nobody_knows_how_far_it_came_is_not_done_again() -> None:
    before = on_map(Together(), MAP_A)
    before.run(0.2)
    goal = before.give(StepPlan(steps=(MoveStraight(distance_m=2.0),)))
    before.run(1.0)
    after = restarted(before, MAP_B)
    mission = after.goal(goal)
    assert (mission.state, mission.reason) == (FAILED, "map_changed")
    assert mission.outcome is not None
    assert mission.outcome.code is Code.NOT_REACHED
    assert standing_still(after)


def test_a_question_from_before_is_still_the_question_on_another_map() -> None:
    before = on_map(Together(), MAP_A)
    goal = before.give(None)
    question = Bilingual(en="Which one?", zh="哪一个？")
    before.event(Planned(goal, Clarify(code=Code.AMBIGUOUS, question=question)))
    after = restarted(before, MAP_B)
    outcome = after.goal(goal).outcome
    assert outcome is not None
    assert outcome.message == question
    after.plans[goal] = go("hall")
    after.event(Reply(goal, "the hall"))
    after.run_until(goal, SUCCEEDED)


@pytest.mark.parametrize("jump_s", [-400e6, -3600.0, 3600.0, 400e6])
def test_a_wall_clock_that_jumps_moves_no_goal_and_no_time_runs_backwards(jump_s: float) -> None:
    before = Together()
    before.run(0.2)
    goal = driving(before)
    created = goal_of(before.book, before.goal(goal)).created
    after = restarted(before, FACTS, wall_offset_s=jump_s)
    assert standing_still(after)
    after.event(Resume(goal))
    done = goal_of(after.book, after.run_until(goal, SUCCEEDED))
    assert done.created == created
    assert done.updated >= created
    assert done.outcome is not None
    assert done.outcome.seconds is not None
    assert done.outcome.seconds >= 0.0


def test_a_disk_that_fills_up_on_the_way_lets_no_further_step_begin(world: Together) -> None:
    goal = driving(world, "kitchen", "hall")
    world.disk = False
    world.run(20.0)
    assert world.bridge.pose.x_m == pytest.approx(4.0, abs=0.1), "the step on disk was walked"
    assert standing_still(world, 5.0)
    assert world.goal(goal).state is GoalState.RUNNING
    world.disk = True
    world.sync()
    world.run_until(goal, SUCCEEDED)


def test_words_are_not_said_on_a_full_disk(world: Together) -> None:
    world.disk = False
    world.give(StepPlan(steps=(Say(text="hello"),)))
    world.run(5.0)
    assert world.said == []


@contextmanager
def pages(most: list[int]) -> Iterator[list[Any]]:
    """Let databases grow to so many pages and no further; give their connections."""
    opened: list[Any] = []

    def connect(connection: Any, _: object) -> None:
        connection.execute(f"PRAGMA max_page_count={most[0]}")
        opened.append(connection)

    sa.event.listen(sa.engine.Engine, "connect", connect)
    try:
        yield opened
    finally:
        sa.event.remove(sa.engine.Engine, "connect", connect)


def test_a_full_disk_calls_nothing_safe_and_loses_nothing_once_there_is_room(
    tmp_path: Path,
) -> None:
    MissionJournal.in_home(tmp_path).close()
    why: list[str] = []
    full, done = threading.Event(), threading.Event()

    def failed(text: str) -> None:
        why.append(text)
        full.set()

    with pages([20]) as opened:
        journal = MissionJournal.in_home(tmp_path)
        writer = JournalWriter(journal, lambda entry: done.set(), failed)
        missions = tuple(
            Mission(id=f"g{i}", order=i, text="x" * 2000, language=Language.EN,
                    state=GoalState.QUEUED, created_unix_s=1.0, updated_unix_s=1.0)
            for i in range(40)
        )  # fmt: skip
        writer.write(PendingEntry(Journal(1, missions, ("g0",))))
        assert full.wait(5.0)
        assert "full" in why[0]
        assert not done.is_set()
        for connection in opened:
            connection.execute("PRAGMA max_page_count=100000")
        assert done.wait(5.0)
        writer.close()
    after = MissionJournal.in_home(tmp_path)
    assert len(after.load().missions) == 40
    after.close()
