"""Somebody who comes is met on the right, once for each meeting; the leg goes on anyhow."""

from __future__ import annotations

import pytest

from planner.mission.effects import AskRoute
from planner.mission.events import Oncoming
from planner.mission.route_doubts import MEETING_S, RIGHT
from tests.planner.mission.driving import SUCCEEDED, driving
from tests.planner.mission.lockstep import Together
from wire import Mode

AT = (2.5, 0.0)
REPORT_S = 0.2


def come(world: Together, seconds: float, far_m: float = 3.0) -> None:
    """Let somebody come for a while, as five reports a second say it."""
    for _ in range(round(seconds / REPORT_S)):
        leg = world.engine.leg
        if leg is not None:
            world.event(Oncoming(leg.mission, leg.leg, AT, far_m))
        world.run(REPORT_S)


def asked(world: Together) -> list[AskRoute]:
    return [ask for ask in world.routes if ask.request.keep_right_m > 0.0]


def test_a_way_on_the_right_is_taken_at_once_and_says_so(world: Together) -> None:
    goal = driving(world)
    come(world, 0.4)
    leg = world.engine.leg
    assert leg is not None
    assert leg.doubt is not None
    assert (leg.leg, leg.doubt.code, leg.doubt.at_m) == (2, RIGHT, AT)
    assert asked(world)[0].request.strict
    assert 1.0 < asked(world)[0].request.keep_right_m < 4.0
    assert world.bridge.mode is Mode.ACTIVE
    world.run_until(goal, SUCCEEDED)


def test_one_meeting_is_one_search_and_the_next_is_another(world: Together) -> None:
    driving(world)
    come(world, 1.6)
    assert len(asked(world)) == 1
    world.run(MEETING_S + 0.2)
    come(world, 0.4)
    assert len(asked(world)) == 2


def test_without_room_the_leg_is_kept_and_asked_for_once_a_second_at_most(world: Together) -> None:
    world.way = lambda ask: "no_route" if ask.request.keep_right_m > 0.0 else None
    goal = driving(world)
    come(world, 2.0)
    assert world.goal(goal).leg == 1
    assert 1 <= len(asked(world)) <= 3
    world.run_until(goal, SUCCEEDED)


@pytest.mark.parametrize("far", ["another goal", "another leg", "blocked", "slowed"])
def test_what_is_not_for_this_leg_now_means_nothing(world: Together, far: str) -> None:
    goal = driving(world)
    world.bridge.blocked = far == "blocked"
    world.bridge.limited_by = "obstacle" if far == "slowed" else "max_speed"
    world.run(0.2)
    told = "other" if far == "another goal" else goal
    world.event(Oncoming(told, 9 if far == "another leg" else 1, AT, 3.0))
    world.run(0.2)
    assert not asked(world)
