"""A restart on another map, or with a clock that jumped, brings goals back with a clear record."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import pytest

from planner.bridge_client import Identity
from planner.mission.api_view import goal_of
from planner.mission.engine import Engine
from planner.mission.events import Planned, Reply, Restarted, Resume
from planner.mission.goal_lifecycle import MAP_CHANGED
from planner.mission.state import Mission, MissionState
from planner.plan import Bilingual, Clarify, Code, ComeBack, GoTo, MoveStraight, StepPlan
from tests.planner.mission.fakes import FACTS, HASH, outcome_of
from tests.planner.mission.lockstep import (
    FAILED,
    PAUSED,
    SUCCEEDED,
    Together,
    driving,
    go,
    standing_still,
)

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
    assert outcome_of(mission).message == MAP_CHANGED
    assert standing_still(after)
    after.event(Resume(goal))
    after.plans[goal] = StepPlan(steps=(ComeBack(),))
    done = after.run_until(goal, FAILED)
    assert [(s.kind, s.state.value) for s in done.steps] == [
        ("go_to", "succeeded"), ("come_back", "failed")]  # fmt: skip
    assert outcome_of(done).code is Code.NO_ROUTE


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
    assert outcome_of(mission).code is Code.NOT_REACHED
    assert standing_still(after)


def test_a_question_from_before_is_still_the_question_on_another_map() -> None:
    before = on_map(Together(), MAP_A)
    goal = before.give(None)
    question = Bilingual(en="Which one?", zh="哪一个？")
    before.event(Planned(goal, Clarify(code=Code.AMBIGUOUS, question=question)))
    after = restarted(before, MAP_B)
    outcome = outcome_of(after.goal(goal))
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
    seconds = outcome_of(done).seconds
    assert seconds is not None
    assert seconds >= 0.0
