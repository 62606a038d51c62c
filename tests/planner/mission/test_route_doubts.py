"""A doubted way bends where a better one is known, else is kept; way is made for one as wide."""

from __future__ import annotations

from dataclasses import dataclass, field
from itertools import pairwise

import pytest
from hypothesis import given
from hypothesis import strategies as st

from planner.mission.activity import RouteDoubt
from planner.mission.effects import AskRoute
from planner.mission.events import Oncoming, RouteDoubted
from planner.mission.leg_routes import HOLDS_S
from planner.mission.recovery import PASSING_S, WIDE_S
from planner.mission.route_doubts import (
    AGAIN_S,
    BENT,
    DOUBTED,
    KEPT,
    KEPT_SHORTER,
    LASTS_S,
    MAX_BENDS,
    MEETING_S,
    NEAR_M,
    PATIENCE_S,
    PERIOD_S,
    RIGHT,
    SETTLE_S,
)
from planner.mission.spoken_status import tell_doubt
from planner.navigation.route import WIDE_M
from planner.skills import Way
from tests.laws import at_least
from tests.planner.mission.fakes import FACTS
from tests.planner.mission.lockstep import RUNNING, SUCCEEDED, Together, driving
from wire import Mode, Pose2

AT = (2.5, 0.0)
REPORT_S = 0.2


@dataclass
class Doubts:
    """Show a world what the route search sees in its way, five times a second."""

    world: Together
    goal: str
    seen: list[str | None] = field(default_factory=list)

    def run(self, seconds: float, *, closed: bool = True) -> None:
        for _ in range(round(seconds / REPORT_S)):
            leg = self.world.engine.leg
            if closed and leg is not None:
                self.world.event(RouteDoubted(leg.mission, leg.leg, AT))
            self.world.run(REPORT_S)
            self.seen.append(self.code)

    @property
    def doubt(self) -> RouteDoubt | None:
        leg = self.world.engine.leg
        return leg.doubt if leg is not None else None

    @property
    def code(self) -> str | None:
        return self.doubt.code if self.doubt is not None else None

    @property
    def asked(self) -> list[AskRoute]:
        return [ask for ask in self.world.routes if ask.request.strict]


@pytest.fixture
def doubts(world: Together) -> Doubts:
    """Return a robot half a metre on its way, with three and a half to go."""
    return Doubts(world, driving(world))


def test_a_doubt_that_lasts_bends_the_way_without_a_stop(doubts: Doubts) -> None:
    world = doubts.world
    before = world.bridge.pose.x_m
    doubts.run(SETTLE_S + 0.3)
    assert world.goal(doubts.goal).leg == 2
    assert doubts.doubt is not None
    assert (doubts.doubt.leg, doubts.doubt.at_m, doubts.doubt.code) == (2, AT, BENT)
    assert world.bridge.pose.x_m - before > 0.4, "it drove on meanwhile"
    assert all(message.points for message in world.bridge.waypoints)
    doubts.run(3.0, closed=False)
    assert doubts.code == BENT, "why it bends is told as long as it is driven"
    world.run_until(doubts.goal, SUCCEEDED)


def test_who_walks_by_bends_nothing(doubts: Doubts) -> None:
    """Somebody closes the way for 0.4 s, until they are known to move."""
    doubts.run(0.4)
    doubts.run(2.0, closed=False)
    doubts.run(0.4)
    doubts.run(2.0, closed=False)
    assert not doubts.asked
    assert doubts.code is None
    assert DOUBTED in doubts.seen


def test_without_another_way_the_leg_is_kept_and_says_so_until_the_way_is_open(
    doubts: Doubts,
) -> None:
    world = doubts.world
    world.way = lambda ask: "no_route" if ask.request.strict else None
    doubts.run(2.0)
    assert doubts.code == KEPT
    assert (world.goal(doubts.goal).leg, world.goal(doubts.goal).state) == (1, RUNNING)
    assert world.bridge.mode is Mode.ACTIVE
    assert not world.goal(doubts.goal).steps[0].recoveries
    doubts.run(LASTS_S + 0.4, closed=False)
    assert doubts.code is None
    world.run_until(doubts.goal, SUCCEEDED)


def test_a_search_that_breaks_keeps_the_leg(doubts: Doubts) -> None:
    doubts.world.way = lambda ask: "route_worker_died" if ask.request.strict else None
    doubts.run(2.0)
    assert (doubts.code, doubts.world.goal(doubts.goal).leg) == (KEPT, 1)
    doubts.world.run_until(doubts.goal, SUCCEEDED)


def test_a_way_that_ends_elsewhere_is_not_taken(doubts: Doubts) -> None:
    doubts.world.ends = Pose2(3.5, 0.0, 0.0)
    doubts.run(1.0)
    assert (doubts.code, doubts.world.goal(doubts.goal).leg) == (KEPT, 1)


def test_a_much_longer_way_is_taken_only_after_three_seconds(doubts: Doubts) -> None:
    """Most people have gone on by then; and the robot drives up to it meanwhile."""
    world = doubts.world
    world.aside_m = 3.0
    doubts.run(PATIENCE_S - 0.6)
    assert (doubts.code, world.goal(doubts.goal).leg) == (KEPT_SHORTER, 1)
    doubts.run(2 * PERIOD_S)
    assert (doubts.code, world.goal(doubts.goal).leg) == (BENT, 2)
    world.run_until(doubts.goal, SUCCEEDED)


def test_a_leg_bends_a_bounded_number_of_times_and_then_arrives(doubts: Doubts) -> None:
    world = doubts.world
    world.aside_m = 0.8
    for _ in range(400):
        if world.goal(doubts.goal).has_ended:
            break
        doubts.run(REPORT_S)
    assert world.goal(doubts.goal).state is SUCCEEDED
    assert len(doubts.asked) == MAX_BENDS


@at_least(30)
@given(st.lists(st.tuples(st.booleans(), st.integers(1, 15)), max_size=8))
def test_a_way_round_is_searched_once_a_second_at_most(spans: list[tuple[bool, int]]) -> None:
    world = Together(way=lambda ask: "no_route" if ask.request.strict else None)
    world.run(0.2)
    doubts = Doubts(world, driving(world))
    asked_s: list[float] = []
    for closed, reports in spans:
        for _ in range(reports):
            before = len(doubts.asked)
            doubts.run(REPORT_S, closed=closed)
            asked_s += [world.now_s] * (len(doubts.asked) - before)
    assert all(later - earlier >= PERIOD_S - 0.01 for earlier, later in pairwise(asked_s))


def test_a_doubt_of_another_leg_or_goal_means_nothing(doubts: Doubts) -> None:
    world = doubts.world
    for goal, leg in ((doubts.goal, 7), ("other", 1)):
        for _ in range(10):
            world.event(RouteDoubted(goal, leg, AT))
            world.run(REPORT_S)
    assert not doubts.asked
    assert doubts.doubt is None


def test_a_robot_that_the_bridge_holds_is_left_to_recovery(doubts: Doubts) -> None:
    doubts.world.bridge.blocked = True
    doubts.run(2.0)
    assert not doubts.asked
    assert doubts.world.goal(doubts.goal).steps[0].recoveries == ("wait",)


def test_what_the_bridge_slows_for_is_left_to_recovery(doubts: Doubts) -> None:
    """A lidar that sees things everywhere shall end in standing, not in turning to and fro."""
    doubts.world.bridge.limited_by = "obstacle"
    doubts.run(2.0)
    assert not doubts.asked
    assert doubts.code == DOUBTED
    doubts.world.bridge.limited_by = "max_speed"
    doubts.run(1.0)
    assert BENT in doubts.seen


def test_without_a_pose_nothing_is_searched(doubts: Doubts) -> None:
    doubts.world.bridge.localized = False
    doubts.run(2.0)
    assert not doubts.asked


@pytest.mark.parametrize("code", [DOUBTED, KEPT, KEPT_SHORTER, BENT, RIGHT])
def test_each_code_is_told_with_its_spot_in_both_languages(code: str) -> None:
    said = tell_doubt(FACTS, RouteDoubt(1, (0.2, 0.1), 0.0, 0.0, code))
    assert "in the hall" in said.en
    assert "hall里" in said.zh


MET_AT = (2.5, 0.0)
ROBOT_M, PERSON_M = WIDE_M + 0.02, WIDE_M - 0.02


def come(world: Together, far_m: float = NEAR_M - 0.2, radius_m: float = ROBOT_M) -> None:
    leg = world.engine.leg
    assert leg is not None
    world.event(Oncoming(leg.mission, leg.leg, MET_AT, far_m, MET_AT, radius_m))


def asked(world: Together) -> list[AskRoute]:
    return [ask for ask in world.routes if ask.way is Way.ASIDE]


def told(world: Together, goal: str) -> tuple[str, ...]:
    return world.goal(goal).steps[0].recoveries


def test_it_goes_aside_stands_there_and_then_goes_on_to_its_goal(world: Together) -> None:
    goal = driving(world)
    came = len(world.routes)
    come(world)
    (ask,) = asked(world)
    assert (ask.request.passes_m, ask.request.strict) == (ROBOT_M, True), (
        "only who has the shorter way goes"
    )
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


def keep_coming(world: Together, seconds: float, far_m: float = 3.0) -> None:
    """Let somebody keep_coming for a while, as five reports a second say it."""
    for _ in range(round(seconds / REPORT_S)):
        leg = world.engine.leg
        if leg is not None:
            world.event(Oncoming(leg.mission, leg.leg, AT, far_m))
        world.run(REPORT_S)


def asked_right(world: Together) -> list[AskRoute]:
    return [ask for ask in world.routes if ask.request.keep_right_m > 0.0]


def test_a_way_on_the_right_is_taken_at_once_and_says_so(world: Together) -> None:
    goal = driving(world)
    keep_coming(world, 0.4)
    leg = world.engine.leg
    assert leg is not None
    assert leg.doubt is not None
    assert (leg.leg, leg.doubt.code, leg.doubt.at_m) == (2, RIGHT, AT)
    assert asked_right(world)[0].request.strict
    assert 1.0 < asked_right(world)[0].request.keep_right_m < 4.0
    assert world.bridge.mode is Mode.ACTIVE
    world.run_until(goal, SUCCEEDED)


def test_one_meeting_is_one_search_and_the_next_is_another(world: Together) -> None:
    driving(world)
    keep_coming(world, 1.6)
    assert len(asked_right(world)) == 1
    world.run(MEETING_S + 0.2)
    keep_coming(world, 0.4)
    assert len(asked_right(world)) == 2


def test_without_room_the_leg_is_kept_and_asked_for_once_a_second_at_most(world: Together) -> None:
    world.way = lambda ask: "no_route" if ask.request.keep_right_m > 0.0 else None
    goal = driving(world)
    keep_coming(world, 2.0)
    assert world.goal(goal).leg == 1
    assert 1 <= len(asked_right(world)) <= 3
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
    assert not asked_right(world)
