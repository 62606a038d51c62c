"""Who says "come back" and nothing before it means where the order before was given."""

from __future__ import annotations

import asyncio
from dataclasses import replace
from math import hypot
from typing import TYPE_CHECKING, Any

import pytest

from planner.brain.offline_brain import OfflineBrain
from planner.mission.effects import AskBrain
from planner.mission.events import Cancel, Submitted
from planner.mission.follow_up import AWAY_M, LEANS_S, departure_of
from planner.mission.plan_request import thinker
from planner.mission.reducer import advance
from planner.mission.state import ORDER_SOURCE
from planner.plan import Clarify, ComeBack, GoTo, Language, Plan, Say, StepPlan
from tests.planner.brain.conftest import HOME
from tests.planner.mission.driving import QUEUED, RUNNING, SUCCEEDED
from tests.planner.mission.fakes import FACTS, outcome_of, status
from tests.planner.mission.lockstep import Together, go
from wire import Pose2

if TYPE_CHECKING:
    from planner.mission.state import MissionState

HERE = Pose2(0.4, -0.3, 0.5)
BACK = StepPlan(steps=(ComeBack(),))


def world_at(pose: Pose2 = HERE) -> Together:
    world = Together()
    world.bridge.pose = pose
    world.run(0.2)
    return world


def after_errand(place: str = "kitchen") -> Together:
    world = world_at()
    world.run_until(world.give(go(place)), SUCCEEDED)
    return world


def is_near(world: Together, pose: Pose2) -> bool:
    return hypot(world.bridge.pose.x_m - pose.x_m, world.bridge.pose.y_m - pose.y_m) < 0.1


def departed(world: Together, **changes: Any) -> tuple[float, float, float] | None:
    return departure_of(replace(world.book, **changes), world.now_s)


def test_the_robot_comes_back_to_where_the_errand_was_given() -> None:
    world = after_errand()
    assert not is_near(world, HERE)
    assert departed(world) == (HERE.x_m, HERE.y_m, HERE.yaw_rad)
    goal = world.give(BACK)
    world.run_until(goal, SUCCEEDED)
    assert is_near(world, HERE)
    outcome = outcome_of(world.goal(goal))
    assert outcome.message.en == "Arrived: where you gave the order."


def test_a_second_come_back_stays_there() -> None:
    world = after_errand()
    world.run_until(world.give(BACK), SUCCEEDED)
    world.run_until(world.give(go("kitchen")), SUCCEEDED)
    world.run_until(world.give(BACK), SUCCEEDED)
    assert is_near(world, HERE)


def test_what_was_done_without_driving_lies_between_and_changes_nothing() -> None:
    world = after_errand()
    world.run_until(world.give(StepPlan(steps=(Say(text="hello"),))), SUCCEEDED)
    world.run_until(world.give(BACK), SUCCEEDED)
    assert is_near(world, HERE)


def test_said_while_the_errand_goes_on_it_is_the_same_spot() -> None:
    world = world_at()
    errand = world.give(go("kitchen"))
    world.run(0.5)
    goal = world.give(BACK, first=True)
    assert (world.goal(errand).state, world.goal(goal).state) == (RUNNING, QUEUED)
    world.run_until(goal, SUCCEEDED)
    assert is_near(world, HERE)


def test_an_errand_broken_off_near_by_is_the_one_that_is_meant() -> None:
    world = after_errand()
    begun = world.bridge.pose
    errand = world.give(go("hall"))
    while world.goal(errand).metres < AWAY_M / 2:
        world.run(0.05)
    world.event(Cancel(errand))
    assert departed(world) == (begun.x_m, begun.y_m, begun.yaw_rad)


def test_coming_back_behind_a_drive_of_the_same_order_is_back_to_where_that_was_given() -> None:
    world = after_errand()
    begun = world.bridge.pose
    goal = world.give(StepPlan(steps=(GoTo(place="hall"), ComeBack())))
    world.run_until(goal, SUCCEEDED)
    assert is_near(world, begun)


@pytest.mark.parametrize(
    "changes",
    [
        {"status": None},
        {"status": status(base_in_map=None)},
        {"status_s": 0.0},
        {"facts": replace(FACTS, map_id="another")},
        {"wall_offset_s": LEANS_S + 100.0},
        {"wall_offset_s": float("nan")},
        {"missions": {}},
    ],
    ids=["silent", "not_localized", "stale", "other_map", "long_ago", "clock_broken", "first"],
)
def test_where_it_is_in_doubt_nothing_is_meant(changes: dict[str, Any]) -> None:
    world = after_errand()
    assert departed(world) is not None
    assert departed(world, **changes) is None


def test_an_order_whose_own_pose_was_unknown_is_passed_over_for_none_before_it() -> None:
    world = after_errand()
    newest = world.goal("g1").model_copy(update={"id": "g2", "order": 9, "accepted_at": None})
    assert departed(world, missions={**world.book.missions, "g2": newest}) is None


def test_a_standing_order_is_nobodys_last_order() -> None:
    world = after_errand()
    world.bridge.pose = Pose2(3.0, 0.0, 0.0)
    world.run(0.1)
    world.run_until(world.give(go("dock"), source=f"{ORDER_SOURCE}o1"), SUCCEEDED)
    assert departed(world) is not None
    orders = {k: v for k, v in world.book.missions.items() if v.source.startswith(ORDER_SOURCE)}
    assert departed(world, missions=orders) is None


@pytest.mark.parametrize("text", ["come back", "ok, now come back", "回来", "好，回来吧"])
def test_the_grammar_comes_back_where_an_order_led_away_and_asks_where_none_did(
    text: str,
) -> None:
    think = thinker(OfflineBrain(), HOME)

    def plan_of(book: MissionState, now_s: float) -> Plan | None:
        _, effects = advance(book, Submitted("new", text, Language.EN), now_s)
        ask = next(each for each in effects if isinstance(each, AskBrain))
        return asyncio.run(think(ask)).plan  # type: ignore[arg-type]

    world = after_errand()
    assert plan_of(world.book, world.now_s) == BACK
    asked = plan_of(replace(world.book, missions={}), world.now_s)
    assert isinstance(asked, Clarify)
