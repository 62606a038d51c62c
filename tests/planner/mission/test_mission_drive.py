"""A mission drives, waits its turn, stops, pauses and goes on."""

from __future__ import annotations

from math import pi

import pytest

from planner.mission.events import (
    Cancel,
    Move,
    Pause,
    Planned,
    Resume,
    Stopped,
)
from planner.plan import (
    Code,
    ComeBack,
    GoTo,
    ReturnHome,
    StepPlan,
    StepState,
)
from tests.planner.mission.driving import (
    CANCELLED,
    PAUSED,
    QUEUED,
    RUNNING,
    SUCCEEDED,
    driving,
    standing_still,
)
from tests.planner.mission.lockstep import Together, go, talk
from wire import HeldReason, Pose2


def test_arrives_and_says_how(world: Together) -> None:
    goal = world.give(go("kitchen"))
    done = world.run_until(goal, SUCCEEDED)
    outcome = done.outcome
    assert outcome is not None
    assert outcome.code is Code.ARRIVED
    assert outcome.asked is not None
    assert outcome.asked.place == "kitchen"
    assert outcome.reached is not None
    assert outcome.reached.room == "kitchen"
    assert outcome.metres == pytest.approx(4.0, abs=0.1)
    assert outcome.seconds == pytest.approx(8.0, abs=1.0)
    assert outcome.limited_by == ("max_speed",)
    assert done.steps[0].state is StepState.SUCCEEDED
    assert outcome.message.zh != outcome.message.en


def test_there_and_back_ends_where_the_goal_was_accepted(world: Together) -> None:
    world.bridge.pose = Pose2(0.5, 0.25, 0.0)
    world.run()
    plan = StepPlan(steps=(GoTo(place="kitchen"), ComeBack(), ReturnHome()))
    goal = world.give(plan)
    done = world.run_until(goal, SUCCEEDED)
    assert [s.state for s in done.steps] == [StepState.SUCCEEDED] * 3
    assert world.routes[1].goal == Pose2(0.5, 0.25, 0.0)
    assert [ask.heading for ask in world.routes] == [False, True, True]
    assert done.leg == 3


def test_first_waypoint_needs_no_further_status_once_granted(world: Together) -> None:
    goal = world.give(go("kitchen"))
    assert world.bridge.granted == goal, "the grant is asked for as soon as there is a plan"
    world.run()
    assert world.bridge.waypoints, "the first horizon answers the status that shows the grant"


def test_speaks_once_and_waits(world: Together) -> None:
    goal = world.give(talk("hi", 1.0))
    assert world.said == ["hi"]
    world.run(0.5)
    assert world.goal(goal).state is RUNNING
    world.run(1.0)
    assert world.goal(goal).state is SUCCEEDED
    assert world.said == ["hi"]


def test_nothing_moves_or_speaks_before_the_journal_is_safe(world: Together) -> None:
    world.disk = False
    goal = world.give(go("kitchen"))
    world.run(2.0)
    assert world.goal(goal).state is RUNNING
    assert world.bridge.waypoints == []
    world.sync()
    world.run(0.2)
    assert world.bridge.waypoints
    other = Together(disk=False)
    other.run(0.2)
    other.give(talk())
    other.run(1.0)
    assert other.said == []
    other.sync()
    assert other.said == ["hello"]


def test_second_goal_waits_its_turn(world: Together) -> None:
    first, second, third = (driving(world), world.give(go("hall")), world.give(go("dock")))
    assert world.book.queue == (second, third)
    world.event(Move(third, second))
    assert world.book.queue == (third, second)
    world.run_until(first, SUCCEEDED)
    assert world.goal(third).state is RUNNING
    world.run_until(second, SUCCEEDED)


def test_replace_ends_the_running_goal_once_the_new_one_is_understood(world: Together) -> None:
    first = driving(world)
    waiting = world.give(go("hall"))
    thinking = world.give(None, replace=True)
    world.run(0.5)
    assert world.goal(first).state is RUNNING
    world.event(Planned(thinking, go("dock")))
    assert world.goal(first).state is CANCELLED
    assert world.book.running == thinking
    assert world.book.queue == (waiting,)


def test_stop_pauses_ends_streaming_and_holds_the_queue(world: Together) -> None:
    goal = driving(world)
    waiting, thinking = world.give(go("hall")), world.give(None)
    world.event(Stopped("test"))
    assert world.bridge.horizon is None, "a horizon of no points leaves at once"
    world.bridge.hold(HeldReason.STOP)
    assert (world.goal(goal).state, world.goal(goal).reason) == (PAUSED, "stop")
    assert (world.goal(thinking).state, world.goal(thinking).reason) == (PAUSED, "stop")
    assert world.dropped == [thinking]
    assert standing_still(world, 5.0)
    assert world.goal(waiting).held


def test_stop_said_by_another_pauses(world: Together) -> None:
    goal = driving(world)
    world.bridge.hold(HeldReason.STOP)
    world.run()
    assert (world.goal(goal).state, world.goal(goal).reason) == (PAUSED, "stop")
    world.act()
    assert standing_still(world), "the hold's end alone moves nothing"


def test_a_goal_given_after_a_stop_runs_at_once_and_the_old_ones_stay(world: Together) -> None:
    paused = driving(world)
    waiting = world.give(go("hall"))
    world.bridge.hold(HeldReason.STOP)
    world.run(1.0)
    fresh = world.give(go("dock"))
    world.act()
    world.run(0.2)
    assert world.book.running == fresh
    world.run_until(fresh, SUCCEEDED)
    assert standing_still(world)
    assert (world.goal(paused).state, world.goal(waiting).state) == (PAUSED, QUEUED)
    world.event(Resume(paused))
    world.run_until(waiting, SUCCEEDED)
    assert world.goal(paused).state is SUCCEEDED


def test_a_goal_whose_act_clears_nothing_pauses(world: Together) -> None:
    world.bridge.hold(HeldReason.STOP)
    world.run(1.0)
    goal = world.give(go("kitchen"))
    world.run(3.0)
    assert (world.goal(goal).state, world.goal(goal).reason) == (PAUSED, "stop")


def test_pause_and_resume_keep_the_place(world: Together) -> None:
    goal = driving(world)
    waiting = world.give(go("hall"))
    world.event(Pause(goal))
    assert standing_still(world)
    assert world.goal(waiting).held
    world.event(Resume(goal))
    done = world.run_until(goal, SUCCEEDED)
    assert done.leg == 2
    assert done.metres == pytest.approx(4.0, abs=0.1)
    world.run_until(waiting, SUCCEEDED)


def test_cancel_halts_with_a_horizon_of_no_points(world: Together) -> None:
    goal = driving(world)
    world.event(Cancel(goal))
    last = world.bridge.waypoints[-1]
    assert (last.mission, last.points) == (goal, ())
    assert standing_still(world)
    assert world.goal(goal).state is CANCELLED
    outcome = world.goal(goal).outcome
    assert outcome is not None
    assert outcome.metres is not None
    assert outcome.metres > 0.2


def test_a_way_to_furniture_ends_at_the_heading_that_faces_it(world: Together) -> None:
    """The heading is taken from where the way ends, not from where it was to end."""
    plan = StepPlan(steps=(GoTo(place="dock"),))
    for faces, ends, heading in (
        (None, None, 1.0),  # the dock's own
        ((3.0, 3.0), Pose2(3.0, 2.0, 0.0), pi / 2),
    ):
        world.faces, world.ends = faces, ends
        goal = world.give(plan)
        seen: set[float] = set()
        for _ in range(600):
            world.run(0.1)
            points = world.bridge.horizon.points if world.bridge.horizon is not None else ()
            seen |= {p.heading_rad for p in points if p.heading_rad is not None}
            if world.goal(goal).state is SUCCEEDED:
                break
        assert {round(each, 4) for each in seen} == {round(heading, 4)}
