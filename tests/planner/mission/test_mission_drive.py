"""A mission drives, waits its turn, is interrupted by the bridge or a person, and goes on."""

from __future__ import annotations

from dataclasses import replace
from math import pi

import pytest

from planner.mission import events
from planner.mission.plan_roles import LEAST_SPEED_SHARE
from planner.mission.route_doubts import LASTS_S, MEETING_SHARE
from planner.plan import Code, ComeBack, GoTo, MoveStraight, ReturnHome, StepPlan, StepState, Turn
from tests.planner.mission.fakes import FACTS, FakeBridge, outcome_of, row
from tests.planner.mission.lockstep import (
    CANCELLED,
    FAILED,
    PAUSED,
    QUEUED,
    RUNNING,
    SUCCEEDED,
    Together,
    driving,
    go,
    standing_still,
    talk,
)
from wire import Action, HeldReason, Mode, Pose2, RowReport
from wire import Answer as BridgeAnswer


def test_arrives_and_says_how(world: Together) -> None:
    goal = world.give(go("kitchen"))
    done = world.run_until(goal, SUCCEEDED)
    outcome = outcome_of(done)
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
    assert world.routes[1].request.goal == Pose2(0.5, 0.25, 0.0)
    assert [ask.heading for ask in world.routes] == [False, True, True]
    assert done.leg == 3


def test_coming_back_without_a_pose_to_come_back_to_fails(world: Together) -> None:
    world.bridge.localized = False
    world.run()
    goal = world.give(StepPlan(steps=(ComeBack(),)))
    assert (world.goal(goal).state, world.goal(goal).reason) == (FAILED, "no_route")


def test_a_goal_given_before_the_robot_is_localized_starts_once_it_is(world: Together) -> None:
    world.bridge.localized = False
    world.run()
    goal = world.give(go("kitchen"))
    world.run(2.0)
    assert world.routes == []
    world.bridge.localized = True
    world.run_until(goal, SUCCEEDED)


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
    world.event(events.Move(third, second))
    assert world.book.queue == (third, second)
    world.run_until(first, SUCCEEDED)
    assert world.goal(third).state is RUNNING
    world.run_until(second, SUCCEEDED)


def test_a_goal_put_last_is_last(world: Together) -> None:
    driving(world)
    second, third, fourth = (world.give(go("hall")) for _ in range(3))
    world.event(events.Move(second))
    assert world.book.queue == (third, fourth, second)
    assert world.disk_entries[-1].queue == world.book.queue, "the order outlives us"


def test_replace_ends_the_running_goal_once_the_new_one_is_understood(world: Together) -> None:
    first = driving(world)
    waiting = world.give(go("hall"))
    thinking = world.give(None, replace=True)
    world.run(0.5)
    assert world.goal(first).state is RUNNING
    world.event(events.Planned(thinking, go("dock")))
    assert world.goal(first).state is CANCELLED
    assert world.book.running == thinking
    assert world.book.queue == (waiting,)


def test_stop_pauses_ends_streaming_and_holds_the_queue(world: Together) -> None:
    goal = driving(world)
    waiting, thinking = world.give(go("hall")), world.give(None)
    world.event(events.Stopped("test"))
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
    world.event(events.Resume(paused))
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
    world.event(events.Pause(goal))
    assert standing_still(world)
    assert world.goal(waiting).held
    world.event(events.Resume(goal))
    done = world.run_until(goal, SUCCEEDED)
    assert done.leg == 2
    assert done.metres == pytest.approx(4.0, abs=0.1)
    world.run_until(waiting, SUCCEEDED)


def test_thinking_and_queued_goals_can_be_paused_and_resumed(world: Together) -> None:
    running, queued, thinking = driving(world), world.give(go("hall")), world.give(None)
    world.event(events.Pause(thinking))
    assert (world.goal(thinking).state, world.dropped) == (PAUSED, [thinking])
    world.event(events.Pause(queued))
    assert world.goal(queued).held
    world.run_until(running, SUCCEEDED)
    assert standing_still(world)
    world.event(events.Resume(queued))
    world.run_until(queued, SUCCEEDED)
    world.plans[thinking] = go("dock")
    world.event(events.Resume(thinking))
    world.run_until(thinking, SUCCEEDED)


def test_cancel_halts_with_a_horizon_of_no_points(world: Together) -> None:
    goal = driving(world)
    world.event(events.Cancel(goal))
    last = world.bridge.waypoints[-1]
    assert (last.mission, last.points) == (goal, ())
    assert standing_still(world)
    assert world.goal(goal).state is CANCELLED
    outcome = outcome_of(world.goal(goal))
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


def test_a_place_that_is_forgotten_on_the_way_stops_the_robot_and_is_told(world: Together) -> None:
    goal = world.give(go("kitchen"))
    world.plans[goal] = go("kitchen")  # the brain knows nothing better
    world.run(1.0)
    left = {place: target for place, target in FACTS.targets.items() if place != "kitchen"}
    world.event(events.Known(replace(FACTS, targets=left)))
    world.run(0.2)
    mission = world.goal(goal)
    assert (mission.state, mission.reason) == (FAILED, "place_gone")
    assert outcome_of(mission).code is Code.UNKNOWN_PLACE
    assert (outcome_of(mission).metres or 0.0) > 0.2
    assert world.bridge.horizon is None


@pytest.mark.parametrize(
    ("mode", "reason"),
    [
        (Mode.DISARMED, "disarmed"),
        (Mode.ESTOPPED, "estop"),
        (Mode.TELEOP, "teleop"),
        (Mode.FAULT, "fault(RUNAWAY)"),
    ],
)
def test_modes_that_end_driving_pause(world: Together, mode: Mode, reason: str) -> None:
    goal = driving(world)
    world.bridge.mode = mode
    world.bridge.rows = (row("RUNAWAY", Action.FAST1),)
    world.run()
    assert (world.goal(goal).state, world.goal(goal).reason) == (PAUSED, reason)


def test_bridge_restart_pauses_disarmed_and_arm_then_resume_goes_on(world: Together) -> None:
    goal = driving(world)
    world.bridge.reboot()
    world.run(1.0)
    mission = world.goal(goal)
    assert (mission.state, mission.reason) == (PAUSED, "disarmed")
    assert outcome_of(mission).code is Code.NOT_ARMED
    world.bridge.mode = Mode.HOLD
    assert standing_still(world)
    world.event(events.Resume(goal))
    world.run_until(goal, SUCCEEDED)


def test_goal_without_a_bridge_pauses_disarmed() -> None:
    world = Together()
    goal = world.give(go("kitchen"))
    assert (world.goal(goal).state, world.goal(goal).reason) == (PAUSED, "disarmed")


def test_short_loss_of_the_owner_goes_on_with_hello_and_grant(world: Together) -> None:
    goal = driving(world)
    world.bridge.lose_owner()
    world.bridge.mode = Mode.HOLD
    world.run_until(goal, SUCCEEDED)
    assert world.goal(goal).leg == 1


def test_silence_of_the_bridge_pauses(world: Together) -> None:
    goal = driving(world)
    world.now_s += 6.0
    world.event(events.Tick())
    assert (world.goal(goal).state, world.goal(goal).reason) == (PAUSED, "fault(BRAIN_GONE)")


def test_our_own_long_freeze_pauses(world: Together) -> None:
    goal = driving(world)
    world.now_s += 6.0
    world.run()
    assert world.goal(goal).state is PAUSED


def test_a_row_that_stays_revokes_the_mission_and_nothing_recovers_meanwhile(
    world: Together,
) -> None:
    goal = driving(world)
    world.bridge.rows = (row("LIDAR_STALE"),)
    world.bridge.blocked = True
    world.run(29.0, every_s=0.5)
    assert world.goal(goal).state is RUNNING
    assert world.goal(goal).steps[0].recoveries == ()
    world.run(2.0)
    assert (world.goal(goal).state, world.goal(goal).reason) == (PAUSED, "fault(LIDAR_STALE)")


@pytest.mark.parametrize("step", [Turn(angle_rad=1.0), MoveStraight(distance_m=1.0)])
def test_a_measured_step_without_a_pose_is_given_up_like_any_other(
    world: Together, step: Turn | MoveStraight
) -> None:
    world.bridge.localized, world.bridge.rows = False, (row("LOC_LOST"),)
    world.run(0.2)
    goal = world.give(StepPlan(steps=(step,)))
    entries = len(world.disk_entries)
    world.run(29.0, every_s=0.25)
    assert (world.goal(goal).state, len(world.disk_entries)) == (RUNNING, entries)
    world.run(2.0)
    assert (world.goal(goal).state, world.goal(goal).reason) == (PAUSED, "fault(LOC_LOST)")


@pytest.mark.parametrize(("name", "code"), [("BUDGET", Code.OUT_OF_BUDGET), ("STUCK", Code.FAULT)])
def test_a_row_that_ends_a_mission_ends_it_alone(world: Together, name: str, code: Code) -> None:
    goal = driving(world)
    world.bridge.rows = (row(name),)
    world.run()
    mission = world.goal(goal)
    assert (mission.state, mission.reason) == (FAILED, name.lower())
    assert outcome_of(mission).code is code
    if name == "BUDGET":
        world.run_until(world.give(go("kitchen")), SUCCEEDED)


def test_rows_that_only_cap_or_do_not_bind_change_nothing(world: Together) -> None:
    goal = driving(world)
    world.bridge.rows = (row("BRAIN_LATE", Action.CAP), row("LIDAR_STALE", binding=False))
    world.run_until(goal, SUCCEEDED)


def test_each_slower_halves_the_cap_down_to_a_quarter_and_faster_takes_it_back(
    world: Together,
) -> None:
    goal = world.give(go("kitchen"))
    world.run(1.0)
    seen = []
    for slower in (True, True, True, False, False, False):
        world.event(events.ChangeSpeed(goal, slower=slower))
        seen.append(world.goal(goal).speed_share)
    assert seen == [0.5, LEAST_SPEED_SHARE, LEAST_SPEED_SHARE, 0.5, 1.0, 1.0]


@pytest.mark.parametrize("share", [0.5, 0.25])
def test_no_waypoint_is_faster_than_the_cap(world: Together, share: float) -> None:
    goal = world.give(go("kitchen"))
    world.run(1.0)
    while world.goal(goal).speed_share != share:
        world.event(events.ChangeSpeed(goal, slower=True))
    world.run(0.2)
    assert fastest_mps(world) <= share * 0.5 + 1e-9


def test_a_late_or_repeated_status_changes_nothing(world: Together) -> None:
    driving(world)
    old = world.book.status
    assert old is not None
    world.run(0.5)
    newest = world.book.status
    world.engine.status(old, world.now_s)
    assert world.book.status is newest


def test_an_external_owner_is_never_pushed_aside() -> None:
    world = Together(bridge=FakeBridge(owner="p9"))
    goal = world.give(go("kitchen"))
    world.run(0.5)
    assert world.goal(goal).state is PAUSED or world.bridge.waypoints == []


def test_the_operators_budget_pauses_and_a_person_goes_on(world: Together) -> None:
    goal = driving(world)
    spent = {"operator_metres": 0.0, "rows": (row("BUDGET"),)}
    said = world.bridge.step().model_copy(update=spent)
    world.carry(world.engine.status(said, world.now_s + 0.05))
    assert (world.goal(goal).state, world.goal(goal).reason) == (PAUSED, "budget")
    world.event(events.Resume(goal))
    world.run_until(goal, SUCCEEDED)


@pytest.mark.parametrize("code", ["budget", "not_owner"])
def test_a_refused_grant_ends_the_mission_only_where_nothing_can_help(
    world: Together, code: str
) -> None:
    goal = driving(world)
    world.bridge.turn()
    refused = BridgeAnswer(id=goal, kind="grant", accepted=False, code=code, detail="")
    said = world.bridge.step().model_copy(update={"answers": (refused,)})
    world.carry(world.engine.status(said, world.now_s + 0.05))
    assert (world.goal(goal).state is FAILED) == (code == "budget")


@pytest.mark.parametrize(
    ("shown", "mode", "reason"),
    [
        (row("DRIVER_NACK", Action.STOP1), Mode.HOLD, "fault(DRIVER_NACK)"),
        (row("ESTOP", Action.FAST1), Mode.ESTOPPED, "estop"),
    ],
)
def test_a_hold_by_fault_names_its_row_and_a_protective_stop_itself(
    world: Together, shown: RowReport, mode: Mode, reason: str
) -> None:
    goal = driving(world)
    world.bridge.rows = (shown,)
    world.bridge.hold(HeldReason.FAULT)
    world.bridge.mode = mode
    world.run()
    assert (world.goal(goal).state, world.goal(goal).reason) == (PAUSED, reason)


def fastest_mps(world: Together) -> float:
    """Return the highest speed among the newest waypoints."""
    return max(abs(point.speed_mps) for point in world.bridge.waypoints[-1].points)


def test_another_robot_that_closes_in_is_met_at_half_the_speed_as_long_as_it_does(
    world: Together,
) -> None:
    goal = world.give(go("kitchen"))
    world.run(1.0)
    free_mps, leg = fastest_mps(world), world.engine.leg
    assert leg is not None
    world.event(events.ClosingIn("another", leg.leg))
    world.event(events.ClosingIn(leg.mission, leg.leg - 1))
    world.run(0.2)
    assert fastest_mps(world) == free_mps, "it was told of another leg"
    world.event(events.ClosingIn(leg.mission, leg.leg))
    world.run(0.2)
    assert fastest_mps(world) <= MEETING_SHARE * free_mps + 1e-9
    assert world.goal(goal).speed_share == 1.0, "which is a person's word"
    world.event(events.ChangeSpeed(goal, slower=True))
    world.event(events.ChangeSpeed(goal, slower=True))
    world.run(0.2)
    assert fastest_mps(world) <= LEAST_SPEED_SHARE * free_mps + 1e-9
    for _ in range(2):
        world.event(events.ChangeSpeed(goal, slower=False))
    world.run(LASTS_S + 0.2)
    assert fastest_mps(world) == free_mps
