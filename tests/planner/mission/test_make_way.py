"""One as wide as a robot is made way for two metres before; a person is not, and goes on."""

from __future__ import annotations

from planner.mission.effects import AskRoute
from planner.mission.events import Oncoming
from planner.mission.leg_routes import HOLDS_S
from planner.mission.recovery import PASSING_S, WIDE_S
from planner.mission.route_doubts import AGAIN_S, NEAR_M
from planner.navigation.route import WIDE_M
from planner.skills import Way
from tests.planner.mission.driving import SUCCEEDED, driving
from tests.planner.mission.lockstep import Together

AT = (2.5, 0.0)
ROBOT_M, PERSON_M = WIDE_M + 0.02, WIDE_M - 0.02


def come(world: Together, far_m: float = NEAR_M - 0.2, radius_m: float = ROBOT_M) -> None:
    leg = world.engine.leg
    assert leg is not None
    world.event(Oncoming(leg.mission, leg.leg, AT, far_m, AT, radius_m))


def asked(world: Together) -> list[AskRoute]:
    return [ask for ask in world.routes if ask.way is Way.ASIDE]


def told(world: Together, goal: str) -> tuple[str, ...]:
    return world.goal(goal).steps[0].recoveries


def test_it_goes_aside_stands_there_and_then_goes_on_to_its_goal(world: Together) -> None:
    goal = driving(world)
    came = len(world.routes)
    come(world)
    (ask,) = asked(world)
    assert (ask.passes_m, ask.doubted) == (ROBOT_M, True), "only who has the shorter way goes"
    assert told(world, goal) == ("give_way",)
    world.run(PASSING_S)
    assert len(world.routes) == came + 1
    assert not world.goal(goal).has_ended
    world.run_until(goal, SUCCEEDED, limit_s=60.0 + WIDE_S[1])


def test_one_that_is_to_be_made_way_for_stands_and_looks_for_its_way_again(
    world: Together,
) -> None:
    world.way = lambda ask: "no_route" if ask.way is Way.ASIDE else None
    goal = driving(world)
    come(world)
    assert world.engine.leg is None, "nothing is streamed: it stands"
    assert told(world, goal) == ("wait",)
    world.run(HOLDS_S + 1.0)
    assert world.engine.leg is not None
    world.run_until(goal, SUCCEEDED)


def test_where_it_can_be_passed_it_stands_until_that_is_done(world: Together) -> None:
    world.stays_aside = True
    goal = driving(world)
    come(world)
    assert world.engine.leg is None
    assert told(world, goal) == ("wait",)
    world.run(PASSING_S - 0.5)
    assert world.engine.leg is None
    world.run_until(goal, SUCCEEDED)


def test_a_person_or_one_that_is_far_is_met_as_before(world: Together) -> None:
    driving(world)
    come(world, radius_m=PERSON_M)
    come(world, far_m=NEAR_M + 0.2)
    come(world, far_m=float("nan"))
    come(world, radius_m=float("nan"))
    assert not asked(world)


def test_a_meeting_is_decided_again_only_after_some_seconds(world: Together) -> None:
    world.way = lambda ask: "no_route" if ask.way is Way.ASIDE else None
    driving(world)
    come(world)
    world.run(HOLDS_S + 0.4)
    come(world)
    assert len(asked(world)) == 1
    world.run(AGAIN_S - HOLDS_S)
    come(world)
    assert len(asked(world)) == 2
