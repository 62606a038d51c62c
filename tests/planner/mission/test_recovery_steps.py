"""A blocked drive climbs the ladder, tells each rung, and ends with place, size and since when."""

from __future__ import annotations

from dataclasses import replace
from math import pi

import pytest

from planner.mission.activity import Driving
from planner.mission.effects import AskRoute
from planner.mission.events import Pause, Resume, Surveyed
from planner.mission.legs import OCCUPIED_S
from planner.mission.recovery import (
    FRESH,
    LADDER,
    MAX_WALKER_LADDERS,
    NEW_LADDER_M,
    Recovery,
    turn_out,
)
from planner.navigation.obstruction import Obstruction
from planner.navigation.route import WIDE_M
from planner.plan import Code, GoTo, StepPlan
from planner.skills import Way
from tests.planner.mission.fakes import outcome_of, row
from tests.planner.mission.lockstep import FAILED, PAUSED, RUNNING, SUCCEEDED, Together, driving, go
from wire import Pose2

CRATE = Obstruction((2.5, -0.25), (2.5, 0.25))
NAMES = [rung.recovery.value for rung in LADDER if rung.recovery is not Recovery.GIVE_WAY]
"""Before a thing: way is given to people alone."""


def told(world: Together, goal: str) -> tuple[str, ...]:
    return world.goal(goal).steps[0].recoveries


def shut(
    world: Together,
    seen: Obstruction | None = CRATE,
    *,
    moves: bool = False,
    radius_m: float = 0.0,
) -> str:
    """Return a goal whose way is shut, and that no way leads round."""
    world.way = lambda ask: "no_route" if ask.obstacles and ask.way is Way.ROUTE else None
    goal = driving(world)
    world.bridge.blocked = True
    world.run(1.0)
    world.event(Surveyed(seen, moves, local_offset_s=3600.0, radius_m=radius_m))
    return goal


def test_every_rung_is_told_in_its_order_and_the_failure_names_place_size_and_time(
    world: Together,
) -> None:
    goal = shut(world)
    began_s = world.now_s
    mission = world.run_until(goal, FAILED, limit_s=60.0)
    assert world.now_s - began_s <= 26.0
    assert list(mission.steps[0].recoveries) == NAMES[: len(mission.steps[0].recoveries)]
    assert Recovery.OTHER_WAY.value in mission.steps[0].recoveries
    assert outcome_of(mission).code is Code.BLOCKED
    said = outcome_of(mission).message
    assert "kitchen is blocked by something 0.5 m wide" in said.en
    assert "since 01:01" in said.en  # 100 s after midnight, an hour east
    assert "0.5 米宽" in said.zh


def test_without_a_sight_of_it_the_failure_names_no_size(world: Together) -> None:
    goal = shut(world, seen=None)
    mission = world.run_until(goal, FAILED, limit_s=60.0)
    assert outcome_of(mission).message.en == "The way to the kitchen is blocked."


def test_a_drive_that_the_bridge_keeps_shutting_ends_although_every_way_is_granted(
    world: Together,
) -> None:
    goal = driving(world)
    world.bridge.blocked = True
    began_s = world.now_s
    world.run_until(goal, FAILED, limit_s=60.0)
    assert 15.0 <= world.now_s - began_s <= 30.0


def test_a_gate_that_opens_for_moments_starts_no_wait_anew(world: Together) -> None:
    goal = driving(world)
    began_s = world.now_s
    while world.goal(goal).state is RUNNING and world.now_s - began_s < 60.0:
        world.bridge.blocked = True
        world.run(1.0)
        world.bridge.blocked = False
        world.run(0.1)  # 5 cm
    assert world.goal(goal).state is FAILED
    assert world.now_s - began_s <= 40.0


def test_free_again_the_old_way_is_driven_on(world: Together) -> None:
    goal = driving(world)
    world.bridge.blocked = True
    world.run(2.0)
    assert told(world, goal) == ("wait",)
    world.bridge.blocked = False
    world.run_until(goal, SUCCEEDED)
    assert len(world.routes) == 1


def test_backing_off_is_straight_slow_and_short(world: Together) -> None:
    goal = shut(world)
    world.run_until(goal, FAILED, limit_s=60.0)
    backs = [ask for ask in world.routes if ask.way is Way.STRAIGHT]
    assert len(backs) == 1
    (back,) = backs
    assert back.speed_mps == 0.1
    gone_m = abs(back.request.goal.x_m - back.request.start.x_m) + abs(
        back.request.goal.y_m - back.request.start.y_m
    )
    assert gone_m <= 0.43


def test_routes_lead_round_what_is_remembered_and_through_what_was_seen_open(
    world: Together,
) -> None:
    world.way = lambda ask: None
    goal = driving(world)
    world.bridge.blocked = True
    world.run(1.0)
    world.event(Surveyed(CRATE))
    world.run(3.0)
    assert world.routes[-1].shut == (CRATE,)
    world.event(Surveyed(None, opened=(CRATE,)))
    assert world.goal(goal).recovery.shut == ()


def test_the_ladder_is_kept_over_a_pause_and_a_crash(world: Together) -> None:
    goal = shut(world)
    world.run(4.0)
    before = world.goal(goal).recovery
    assert before.rung > 0
    assert before.newest is not None
    world.event(Pause(goal))
    assert world.goal(goal).recovery == before
    after = world.restart()
    assert after.goal(goal).recovery == before
    after.run(0.5)
    after.act()
    after.event(Resume(goal))
    after.run(0.5)
    assert after.routes[-1].shut == (CRATE,)


def occupied(world: Together, answer: str | None = "goal_occupied") -> str:
    """Return a goal that is driven to until a metre before it, where something stands on it."""
    world.way = lambda ask: answer if ask.obstacles else None
    goal = driving(world)
    world.bridge.pose = Pose2(3.2, 0.0, 0.0)
    world.bridge.ahead = []
    world.bridge.blocked = True
    return goal


def test_an_occupied_goal_is_waited_for_then_given_up_with_how_near_the_robot_came(
    world: Together,
) -> None:
    goal = occupied(world)
    began_s = world.now_s
    mission = world.run_until(goal, FAILED, limit_s=60.0)
    assert OCCUPIED_S <= world.now_s - began_s <= 20.0
    assert outcome_of(mission).code is Code.GOAL_OCCUPIED
    assert "0.8 m of the kitchen" in outcome_of(mission).message.en


def test_who_leaves_the_goal_in_time_lets_it_be_reached(world: Together) -> None:
    goal = occupied(world)
    world.run(8.0)
    assert world.goal(goal).state is RUNNING
    world.bridge.blocked = False
    world.run_until(goal, SUCCEEDED)


def test_a_goal_is_moved_once_and_the_choice_is_kept(world: Together) -> None:
    world.ends = Pose2(3.6, 0.0, 0.0)
    goal = driving(world)
    world.bridge.blocked = True
    world.run(4.0)
    assert world.goal(goal).recovery.goal_moved == (3.6, 0.0)
    world.run_until(goal, FAILED, limit_s=60.0)
    asked = [ask.request.goal.x_m for ask in world.routes if ask.way is Way.ROUTE]
    assert set(asked[2:]) == {3.6}


def test_a_straight_way_climbs_no_ladder(world: Together) -> None:
    from planner.plan import MoveStraight

    goal = world.give(StepPlan(steps=(MoveStraight(distance_m=1.0),)))
    world.run(1.0)
    world.bridge.blocked = True
    world.run_until(goal, FAILED, limit_s=120.0)
    assert told(world, goal) == ()


def test_each_step_begins_with_a_fresh_ladder(world: Together) -> None:
    goal = world.give(StepPlan(steps=(GoTo(place="kitchen"), GoTo(place="hall"))))
    world.run(1.0)
    world.bridge.blocked = True
    world.run(2.0)
    assert world.goal(goal).recovery.ladders == 1
    world.bridge.blocked = False
    world.run_until(goal, SUCCEEDED)
    assert world.goal(goal).recovery.ladders == 0


@pytest.mark.parametrize("when_s", [4.0, 11.0, 15.0, 18.0])
def test_a_lost_pose_on_any_rung_leaves_no_drive_standing_for_ever(
    world: Together, when_s: float
) -> None:
    goal = shut(world)
    world.run(when_s)
    world.bridge.localized = False
    world.run(20.0)
    world.bridge.localized = True
    world.bridge.blocked = False
    world.way = lambda ask: None
    mission = world.run_until(goal, SUCCEEDED, FAILED, PAUSED, limit_s=60.0)
    assert mission.has_ended or mission.state is PAUSED


def test_no_horizon_is_streamed_between_two_rungs(world: Together) -> None:
    goal = shut(world)
    while world.goal(goal).state is RUNNING:
        world.run()
        leg = world.book.activity
        if isinstance(leg, Driving) and leg.leg is None:
            assert world.bridge.waypoints[-1].points == ()


def test_a_manoeuvre_asks_for_its_own_way_alone(world: Together) -> None:
    goal = shut(world)
    world.run_until(goal, FAILED, limit_s=60.0)
    assert all(isinstance(ask, AskRoute) for ask in world.routes)
    assert all(not ask.shut for ask in world.routes if ask.way is not Way.ROUTE)


def walked_up(world: Together) -> str:
    """Return a goal whose way is shut by somebody who walked up."""
    return shut(world, moves=True)


def test_before_somebody_who_walked_up_the_ladder_is_climbed_thrice(world: Together) -> None:
    goal = walked_up(world)
    began_s = world.now_s
    mission = world.run_until(goal, FAILED, limit_s=120.0)
    tried = mission.steps[0].recoveries
    assert tried.count(Recovery.OTHER_WAY.value) == MAX_WALKER_LADDERS
    assert Recovery.LOOK.value not in tried, "there is nothing to be found out about a person"
    assert 40.0 <= world.now_s - began_s <= 100.0


def let_people_pass(world: Together, goal: str, seconds: float) -> None:
    """Have somebody walk through the door every five seconds, until the goal ends or time is up."""
    end_s = world.now_s + seconds
    while world.now_s < end_s and world.goal(goal).state is RUNNING:
        world.event(Surveyed(CRATE, moves=True))
        world.run(5.0, every_s=0.25)


def test_where_people_come_and_go_it_waits_on_and_arrives_when_they_are_gone(
    world: Together,
) -> None:
    goal = walked_up(world)
    let_people_pass(world, goal, 150.0)
    assert world.goal(goal).state is RUNNING
    world.bridge.blocked = False
    world.way = lambda ask: None
    world.run_until(goal, SUCCEEDED)


def test_where_people_come_and_go_for_ever_it_gives_up_in_the_end(world: Together) -> None:
    goal = walked_up(world)
    let_people_pass(world, goal, 900.0)
    mission = world.goal(goal)
    assert mission.state is FAILED
    assert outcome_of(mission).code is Code.BLOCKED


def test_who_leaves_on_the_second_ladder_lets_the_robot_arrive(world: Together) -> None:
    goal = walked_up(world)
    world.run(35.0)
    assert world.goal(goal).state is RUNNING
    world.bridge.blocked = False
    world.way = lambda ask: None
    world.run_until(goal, SUCCEEDED)


def test_what_is_as_round_as_a_robot_is_a_thing_for_one_ladder_and_then_made_way_for(
    world: Together,
) -> None:
    """Two that wait for each other stand: neither was seen to walk up."""
    goal = shut(world, radius_m=WIDE_M + 0.02)
    began_s = world.now_s
    mission = world.run_until(goal, FAILED, limit_s=180.0)
    tried = list(mission.steps[0].recoveries)
    first = tried[: tried.index(Recovery.GIVE_WAY.value)]
    assert first[: len(NAMES) - 1] == NAMES[:-1], "the ladder before a thing, without its end"
    assert tried.count(Recovery.OTHER_WAY.value) == MAX_WALKER_LADDERS
    assert world.now_s - began_s <= 120.0


def test_as_round_as_a_robot_and_gone_it_shuts_no_way(world: Together) -> None:
    goal = shut(world, radius_m=WIDE_M + 0.02)
    world.run(30.0)
    assert Recovery.GIVE_WAY.value in told(world, goal)
    assert not world.goal(goal).recovery.shut
    world.bridge.blocked = False
    world.way = lambda ask: None
    world.run_until(goal, SUCCEEDED)


def test_a_robot_that_can_be_passed_stays_on_its_way_and_goes_on_at_once(world: Together) -> None:
    """The way aside ends where the robot stands: its own way is streamed on."""
    goal = walked_up(world)
    world.way = lambda ask: "no_route" if ask.obstacles and ask.way is Way.ROUTE else None
    world.stays_aside = True
    while Recovery.GIVE_WAY.value not in told(world, goal):
        world.run(0.1)
    world.run(1.0)
    leg = world.book.activity
    assert isinstance(leg, Driving)
    assert leg.manoeuvre is not None
    assert leg.manoeuvre.stays
    assert world.bridge.waypoints[-1].points
    world.bridge.blocked = False
    world.run(0.3)
    leg = world.book.activity
    assert isinstance(leg, Driving)
    assert leg.manoeuvre is None
    world.run_until(goal, SUCCEEDED)
    assert world.goal(goal).leg == 1


def test_a_wait_without_a_way_searches_again_each_second(world: Together) -> None:
    goal = shut(world)
    world.run(4.5)
    leg = world.book.activity
    assert isinstance(leg, Driving)
    before = len(world.routes)
    world.run(3.0)
    assert len(world.routes) - before <= 4
    world.way = lambda ask: None
    world.bridge.blocked = False
    world.run_until(goal, SUCCEEDED, limit_s=30.0)


@pytest.mark.parametrize("grants", [0, 1])
def test_a_silent_sector_is_turned_from_once_and_the_way_is_searched_again(
    world: Together, grants: int
) -> None:
    goal = world.give(go("kitchen"))
    renewed = world.goal(goal).model_copy(update={"grants": grants})  # a search that went on
    world.engine.book = replace(world.book, missions={goal: renewed})
    world.run(1.0)
    world.bridge.rows = (row("LIDAR_SECTOR"),)
    world.run(0.1)
    assert world.bridge.pose.yaw_rad == pytest.approx(pi / 2), "the fake turns in one status"
    world.run(0.5)
    assert told(world, goal) == ("turn_out",)
    assert [ask.request.start.yaw_rad for ask in world.routes] == [0.0, pytest.approx(pi / 2)]
    world.bridge.rows = ()
    world.run_until(goal, SUCCEEDED)


def test_beside_another_row_that_holds_no_turn_is_tried(world: Together) -> None:
    goal = driving(world)
    world.bridge.rows = (row("LIDAR_SECTOR"), row("BUMPER"))
    world.run(5.0)
    assert told(world, goal) == ()


def test_a_metre_on_the_next_silence_is_turned_from_too() -> None:
    first = turn_out(FRESH, (0.0, 0.0))
    assert first is not None
    assert turn_out(first, (0.5, 0.0)) is None
    assert turn_out(first, (NEW_LADDER_M, 0.0)) is not None
