"""Exploring goes from frontier to frontier, ends where none is left, and says what it did."""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from typing import Any

import pytest

from planner.mission.effects import AskRoute
from planner.mission.events import Pause, Resume
from planner.mission.leg_routes import AGAIN_S
from planner.navigation import FloorReport
from planner.plan import Code, Explore, ReturnHome, StepPlan, StepState
from planner.skills import Way
from planner.skills.explore import DRAWN_S, MOST_SHUT, TURNS
from tests.planner.mission.fakes import FACTS, outcome_of, straight
from tests.planner.mission.lockstep import PAUSED, RUNNING, SUCCEEDED, Together
from wire import Pose2

EXPLORE = StepPlan(steps=(Explore(),))


@dataclass
class Exploring(Together):
    """Answer each request to explore with the next spot, until none is left."""

    spots: list[Pose2] = field(default_factory=list)
    known_m2: float = 10.0
    asked: list[AskRoute] = field(default_factory=list)

    def __post_init__(self) -> None:
        super().__post_init__()
        self.engine.book = replace(self.book, facts=replace(FACTS, grows=True))
        self.run(0.2)

    def answer(self, effect: Any) -> None:
        if not (isinstance(effect, AskRoute) and effect.way is Way.EXPLORE):
            super().answer(effect)
            return
        self.asked.append(effect)
        failure = self.way(effect)
        if failure is not None:
            self.carry(self.engine.take_route(effect, None, failure, self.now_s))
            return
        seen = [spot for spot in self.spots if abs(spot.x_m - effect.request.start.x_m) > 0.3]
        points = straight(effect.request.start, seen[0] if seen else effect.request.start)
        floor = FloorReport(self.known_m2, explored=not seen)
        self.carry(self.engine.take_route(effect, points, None, self.now_s, floor))


def test_it_looks_from_spot_to_spot_and_tells_what_it_mapped() -> None:
    world = Exploring(spots=[Pose2(2.0, 0.0, 0.0)])
    goal = world.give(EXPLORE)
    world.run(4.0 + DRAWN_S / 2)
    assert world.goal(goal).state is RUNNING
    assert world.bridge.pose.x_m == pytest.approx(2.0, abs=0.1)
    asked = len(world.asked)
    world.spots, world.known_m2 = [Pose2(0.0, 0.0, 0.0)], 20.0
    world.run(DRAWN_S)
    assert len(world.asked) == asked + 1, "only once the map shows what was seen"
    world.run(4.0)
    world.spots, world.known_m2 = [], 31.4
    mission = world.run_until(goal, SUCCEEDED)
    assert outcome_of(mission).code is Code.EXPLORED
    assert "31 m² of floor" in outcome_of(mission).message.en
    assert "drove 4 m" in outcome_of(mission).message.en
    assert "31 平方米" in outcome_of(mission).message.zh


def test_on_the_way_it_turns_to_where_more_is_to_be_seen() -> None:
    world = Exploring(spots=[Pose2(6.0, 0.0, 0.0)])
    goal = world.give(EXPLORE)
    world.run(1.0)
    legs = {points.leg for points in world.bridge.waypoints}
    world.spots = [Pose2(-2.0, 0.0, 0.0)]
    world.run(AGAIN_S)
    assert {points.leg for points in world.bridge.waypoints} > legs
    before = world.bridge.pose.x_m
    world.run(1.0)
    assert world.bridge.pose.x_m < before
    world.spots = []
    world.run_until(goal, SUCCEEDED, limit_s=AGAIN_S + 2.0)
    assert world.bridge.pose.x_m > -1.5, "nothing was left to look at before it was there"


def test_a_question_on_the_way_that_has_no_answer_stops_nothing() -> None:
    world = Exploring(spots=[Pose2(6.0, 0.0, 0.0)])
    goal = world.give(EXPLORE)
    world.run(1.0)
    world.way = lambda _: "no_route"
    leg = world.bridge.waypoints[-1].leg
    world.run(AGAIN_S + 1.0)
    assert len(world.asked) > 1
    assert world.bridge.waypoints[-1].leg == leg
    assert world.goal(goal).state is RUNNING


def test_ways_that_are_shut_one_after_the_other_end_it_and_it_says_so() -> None:
    world = Exploring(way=lambda _: "no_route")
    mission = world.run_until(world.give(EXPLORE), SUCCEEDED)
    assert len(world.asked) == MOST_SHUT
    assert outcome_of(mission).code is Code.PARTLY_EXPLORED
    assert mission.steps[0].state is StepState.SUCCEEDED


def test_it_ends_before_its_grant_does_and_the_goal_goes_on() -> None:
    world = Exploring(spots=[Pose2(x_m, 0.0, 0.0) for x_m in (20.0, 0.0)])
    goal = world.give(StepPlan(steps=(Explore(), ReturnHome())))
    mission = world.run_until(goal, SUCCEEDED, limit_s=600.0)
    assert mission.steps[0].code is Code.PARTLY_EXPLORED
    assert mission.metres < 60.0 + 20.0
    assert mission.steps[1].state is StepState.SUCCEEDED


def test_a_pause_forgets_nothing() -> None:
    world = Exploring(spots=[Pose2(2.0, 0.0, 0.0)])
    goal = world.give(EXPLORE)
    world.run(2.0)
    world.event(Pause(goal))
    assert world.goal(goal).state is PAUSED
    world.run(1.0)
    world.event(Resume(goal))
    world.run(6.0)
    world.spots = []
    assert world.run_until(goal, SUCCEEDED).steps[0].code is Code.EXPLORED


def test_where_no_map_is_made_it_is_refused_and_told_how_one_is(world: Together) -> None:
    mission = world.goal(world.give(EXPLORE))
    assert outcome_of(mission).code is Code.NOT_MAPPING
    assert "pons up --map NAME" in outcome_of(mission).message.en
    assert "pons up --map" in outcome_of(mission).message.zh


def test_where_a_way_is_shut_it_looks_round_and_asks_again() -> None:
    """Who stood in the corridor is gone once the robot has turned: then it goes on."""
    world = Exploring(spots=[Pose2(2.0, 0.0, 0.0)], way=lambda _: "no_route")
    goal = world.give(EXPLORE)
    world.run(0.5)
    assert len(world.asked) == 1
    world.way = lambda _: None
    for _ in range(200):
        world.run(0.2)
        if len(world.asked) > 1:
            break
    legs = {points.leg for points in world.bridge.waypoints}
    assert len(legs) >= TURNS
    world.run(8.0)
    assert world.bridge.pose.x_m == pytest.approx(2.0, abs=0.1)
    world.spots = []
    assert world.run_until(goal, SUCCEEDED).steps[0].code is Code.EXPLORED
