"""Drive whole missions against the fake bridge, in simulated time."""

from __future__ import annotations

import pytest

from planner.mission.events import (
    Cancel,
    Confirm,
    Move,
    Pause,
    Planned,
    Reply,
    Resume,
    Stopped,
    Submitted,
    Tick,
)
from planner.mission.records import MAX_ENDED
from planner.plan import (
    Answer,
    Bilingual,
    Clarify,
    Code,
    ComeBack,
    GoalState,
    GoTo,
    Language,
    Look,
    Refuse,
    ReturnHome,
    StepPlan,
    StepState,
)
from tests.planner.mission.fakes import FakeBridge, row
from tests.planner.mission.lockstep import Together, go, talk
from wire import Action, HeldReason, LegReport, Mode, Pose2
from wire import Answer as BridgeAnswer

RUNNING, PAUSED, QUEUED = GoalState.RUNNING, GoalState.PAUSED, GoalState.QUEUED
SUCCEEDED, FAILED, CANCELLED = GoalState.SUCCEEDED, GoalState.FAILED, GoalState.CANCELLED


@pytest.fixture
def world() -> Together:
    world = Together()
    world.run(0.2)
    assert world.bridge.owner == "p1"
    return world


def driving(world: Together, *places: str) -> str:
    goal = world.give(go(*(places or ("kitchen",))))
    world.run(1.0)
    assert world.goal(goal).state is RUNNING
    assert world.bridge.mode is Mode.ACTIVE
    return goal


def standing_still(world: Together, seconds: float = 2.0) -> bool:
    before = world.bridge.pose
    world.run(seconds)
    return world.bridge.pose == before


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
    assert mission.outcome is not None
    assert mission.outcome.code is Code.NOT_ARMED
    world.bridge.mode = Mode.HOLD
    assert standing_still(world)
    world.event(Resume(goal))
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
    world.event(Tick())
    assert (world.goal(goal).state, world.goal(goal).reason) == (PAUSED, "fault(BRAIN_GONE)")


def test_our_own_long_freeze_pauses(world: Together) -> None:
    goal = driving(world)
    world.now_s += 6.0
    world.run()
    assert world.goal(goal).state is PAUSED


@pytest.mark.parametrize(
    ("name", "limit_s", "reason"),
    [("LIDAR_STALE", 30.0, "fault(LIDAR_STALE)"), ("OBSTACLE", 300.0, "blocked")],
)
def test_a_row_that_stays_revokes_the_mission(
    world: Together, name: str, limit_s: float, reason: str
) -> None:
    goal = driving(world)
    world.bridge.rows = (row(name),)
    world.bridge.blocked = True
    world.run(limit_s - 1.0, every_s=0.5)
    assert world.goal(goal).state is RUNNING
    world.run(2.0)
    assert (world.goal(goal).state, world.goal(goal).reason) == (PAUSED, reason)


def test_budget_row_fails_the_mission_and_only_its_own(world: Together) -> None:
    goal = driving(world)
    world.bridge.rows = (row("BUDGET"),)
    world.run()
    mission = world.goal(goal)
    assert (mission.state, mission.reason) == (FAILED, "budget")
    assert mission.outcome is not None
    assert mission.outcome.code is Code.OUT_OF_BUDGET
    after = world.give(go("kitchen"))
    world.run()
    world.bridge.rows = ()
    world.run_until(after, SUCCEEDED)


def test_stuck_row_fails_the_mission(world: Together) -> None:
    goal = driving(world)
    world.bridge.rows = (row("STUCK"),)
    world.run()
    mission = world.goal(goal)
    assert (mission.state, mission.reason) == (FAILED, "stuck")
    assert mission.outcome is not None
    assert mission.outcome.code is Code.FAULT


def test_rows_that_only_cap_or_do_not_bind_change_nothing(world: Together) -> None:
    goal = driving(world)
    world.bridge.rows = (row("BRAIN_LATE", Action.CAP), row("LIDAR_STALE", binding=False))
    world.run_until(goal, SUCCEEDED)


def test_blocked_for_three_seconds_routes_around_and_streams_on(world: Together) -> None:
    goal = driving(world)
    world.bridge.blocked = True
    world.run(2.5)
    assert len(world.routes) == 1
    streamed = len(world.bridge.waypoints)
    world.run(1.0)
    assert len(world.routes) == 2
    assert world.routes[1].obstacles
    assert len(world.bridge.waypoints) > streamed
    assert world.bridge.waypoints[-1].leg == 2
    world.bridge.blocked = False
    world.run_until(goal, SUCCEEDED)


def test_no_way_round_fails_after_some_tries(world: Together) -> None:
    goal = driving(world)
    world.way = lambda ask: "no_route" if ask.obstacles else None
    world.bridge.blocked = True
    mission = world.run_until(goal, FAILED, limit_s=120.0)
    assert mission.reason == "blocked"
    assert mission.outcome is not None
    assert mission.outcome.code is Code.BLOCKED
    assert mission.outcome.asked is not None
    assert len(world.routes) == 4


def test_no_route_fails_and_the_next_goal_runs(world: Together) -> None:
    world.way = lambda ask: "no_route" if ask.goal.x_m > 3 else None
    first, second = world.give(go("kitchen", "hall")), world.give(go("dock"))
    mission = world.goal(first)
    assert (mission.state, mission.reason) == (FAILED, "no_route")
    assert [s.state for s in mission.steps] == [StepState.FAILED, StepState.SKIPPED]
    world.run_until(second, SUCCEEDED)


def test_a_search_that_dies_is_tried_again(world: Together) -> None:
    deaths = iter(("route_worker_died", "route_timed_out"))
    world.way = lambda ask: next(deaths, None)
    goal = world.give(go("kitchen"))
    world.run_until(goal, SUCCEEDED)
    assert len(world.routes) == 3


def test_off_the_path_stands_then_routes_anew(world: Together) -> None:
    goal = driving(world)
    x_m = world.bridge.pose.x_m
    world.bridge.pose = Pose2(x_m, 0.6, 0.0)
    world.run()
    assert world.bridge.waypoints[-1].points == ()
    world.run_until(goal, SUCCEEDED)
    assert len(world.routes) == 2
    assert world.goal(goal).leg == 2


def test_thrown_off_again_and_again_fails(world: Together) -> None:
    goal = driving(world)
    for _ in range(40):
        world.bridge.pose = Pose2(world.bridge.pose.x_m, world.bridge.pose.y_m + 0.6, 0.0)
        world.run(0.5)
    assert (world.goal(goal).state, world.goal(goal).reason) == (FAILED, "no_route")


def test_a_horizon_the_bridge_refuses_is_routed_anew(world: Together) -> None:
    goal = driving(world)
    assert world.bridge.leg is not None
    world.bridge.horizon = None
    world.bridge.blocked = True  # so that the fake does not move
    world.bridge.leg = world.bridge.leg.model_copy(
        update={"refusal": "fence_crossed", "following": False}
    )
    world.bridge.deaf = True
    world.run(1.0)
    assert len(world.routes) == 2
    world.bridge.deaf, world.bridge.blocked = False, False
    world.run_until(goal, SUCCEEDED)


def test_a_pose_jump_routes_anew_standing(world: Together) -> None:
    goal = driving(world)
    world.bridge.rows = (row("POSE_JUMP"),)
    world.bridge.turn()
    world.bridge.mode = Mode.HOLD
    world.run(0.5)
    assert len(world.routes) == 1
    world.bridge.rows = ()
    world.run_until(goal, SUCCEEDED)
    assert len(world.routes) == 2


def test_without_a_pose_nothing_is_streamed(world: Together) -> None:
    goal = driving(world)
    world.bridge.localized = False
    world.run()
    assert world.bridge.waypoints[-1].points == ()
    world.bridge.localized = True
    world.run_until(goal, SUCCEEDED)


def test_a_leg_that_nobody_follows_is_given_up(world: Together) -> None:
    goal = driving(world)
    world.bridge.owner, world.bridge.horizon = "p9", None
    world.bridge.turn()
    world.run(40.0, every_s=0.5)
    assert (world.goal(goal).state, world.goal(goal).reason) == (PAUSED, "blocked")


@pytest.mark.parametrize("change", [{"leg": 7}, {"mission": "other"}, {"reached": False}])
def test_only_our_own_leg_counts_as_reached(world: Together, change: dict[str, object]) -> None:
    goal = driving(world)
    told = LegReport(mission=goal, leg=1, following=False, reached=True, residual_m=0.0,
                     residual_rad=0.0, refusal=None).model_copy(update=change)  # fmt: skip
    world.bridge.pose = Pose2(4.0, 0.0, 0.0)
    world.bridge.horizon, world.bridge.leg, world.bridge.deaf = None, told, True
    world.run(0.2)
    assert world.goal(goal).state is RUNNING


def test_reached_outside_the_room_is_not_arrival(world: Together) -> None:
    goal = driving(world)
    assert world.bridge.leg is not None
    world.bridge.leg = world.bridge.leg.model_copy(update={"reached": True})
    world.bridge.horizon, world.bridge.mode = None, Mode.HOLD
    world.run()
    assert world.goal(goal).state is RUNNING
    done = world.run_until(goal, SUCCEEDED)
    assert done.leg == 2


def test_a_new_leg_is_above_every_one_the_bridge_knows(world: Together) -> None:
    goal = driving(world)
    world.event(Pause(goal))
    assert world.bridge.leg is not None
    world.bridge.leg = world.bridge.leg.model_copy(update={"leg": 9, "reached": True})
    world.run()
    world.event(Resume(goal))
    world.run()
    assert world.goal(goal).leg == 10
    assert world.goal(goal).state is RUNNING


def test_restart_brings_back_paused_and_never_driving() -> None:
    before = Together()
    before.run(0.2)
    goal = driving(before)
    waiting, thinking = before.give(go("hall")), before.give(None)
    after = before.restart()
    states = {m.id: (m.state, m.reason) for m in after.book.missions.values()}
    assert states[goal] == (PAUSED, "planner_restarted")
    assert states[thinking] == (PAUSED, "planner_restarted")
    assert states[waiting] == (QUEUED, None)
    after.bridge.mode = Mode.HOLD
    assert standing_still(after, 10.0)
    after.act()
    assert standing_still(after, 10.0), "queued goals wait for a person too"
    after.event(Resume(goal))
    after.run_until(waiting, SUCCEEDED)
    after.event(Resume(thinking))
    assert after.goal(thinking).state is GoalState.PLANNING


def test_words_perhaps_said_before_a_crash_are_not_said_again() -> None:
    before = Together(disk=False)
    before.run(0.2)
    goal = before.give(talk("hi"))
    after = before.restart()
    after.run(0.2)
    after.event(Resume(goal))
    after.act()
    done = after.run_until(goal, SUCCEEDED)
    assert after.said == []
    assert (done.steps[0].state, done.steps[0].reason) == (StepState.SKIPPED, "perhaps_said")


def test_confirm_waits_for_a_yes(world: Together) -> None:
    goal = world.give(go("kitchen"), confirm=True)
    assert world.goal(goal).state is GoalState.AWAITING_CONFIRMATION
    assert standing_still(world)
    world.event(Confirm(goal))
    world.run_until(goal, SUCCEEDED)


def test_a_question_waits_for_an_answer_and_holds_nobody(world: Together) -> None:
    goal = world.give(None)
    question = Bilingual(en="Which one?", zh="哪一个？")
    world.event(Planned(goal, Clarify(code=Code.AMBIGUOUS, question=question)))
    assert world.goal(goal).state is GoalState.NEEDS_CLARIFICATION
    other = world.give(go("hall"))
    world.run_until(other, SUCCEEDED)
    world.plans[goal] = go("kitchen")
    world.event(Reply(goal, "the kitchen"))
    world.run_until(goal, SUCCEEDED)


def test_answers_and_refusals_end_at_once(world: Together) -> None:
    said = Bilingual(en="In the hall.", zh="在走廊。")
    told, refused, lost = (world.give(None) for _ in range(3))
    world.event(Planned(told, Answer(text=said)))
    world.event(Planned(refused, Refuse(code=Code.NO_CAPABILITY, reason=said)))
    world.event(Planned(lost, None))
    assert world.goal(told).state is SUCCEEDED
    assert world.goal(refused).state is GoalState.REFUSED
    assert world.goal(lost).state is GoalState.REFUSED
    assert world.bridge.granted is None


@pytest.mark.parametrize(
    ("plan", "code"),
    [
        (StepPlan(steps=(GoTo(place="hall"), Look(question="who?"))), Code.NO_CAPABILITY),
        (go("hall", "cellar"), Code.UNKNOWN_PLACE),
        (StepPlan(steps=()), Code.BAD_PLAN),
    ],
)
def test_what_cannot_be_walked_whole_is_refused_before_anything_moves(
    world: Together, plan: StepPlan, code: Code
) -> None:
    goal = world.give(plan)
    mission = world.goal(goal)
    assert mission.state is GoalState.REFUSED
    assert mission.outcome is not None
    assert mission.outcome.code is code
    assert standing_still(world)


def test_an_order_to_stop_is_a_goal_that_is_done(world: Together) -> None:
    goal = driving(world)
    world.event(Submitted("s1", "stop", Language.EN, stop=True))
    assert world.goal("s1").state is SUCCEEDED
    assert world.goal(goal).state is PAUSED
    world.event(Submitted("s2", "stop", Language.EN, stop=True, echoed=False))
    assert (world.goal("s2").state, world.goal("s2").reason) == (FAILED, "bridge_silent")


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
    world.event(Resume(goal))
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


def test_a_hold_by_fault_names_its_row(world: Together) -> None:
    goal = driving(world)
    world.bridge.rows = (row("DRIVER_NACK", Action.STOP1),)
    world.bridge.hold(HeldReason.FAULT)
    world.run()
    assert (world.goal(goal).state, world.goal(goal).reason) == (PAUSED, "fault(DRIVER_NACK)")


def test_a_protective_stop_pauses_by_its_own_name(world: Together) -> None:
    goal = driving(world)
    world.bridge.rows = (row("ESTOP", Action.FAST1),)
    world.bridge.hold(HeldReason.FAULT)
    world.bridge.mode = Mode.ESTOPPED
    world.run()
    assert (world.goal(goal).state, world.goal(goal).reason) == (PAUSED, "estop")


def test_thinking_and_queued_goals_can_be_paused_and_resumed(world: Together) -> None:
    running, queued, thinking = driving(world), world.give(go("hall")), world.give(None)
    world.event(Pause(thinking))
    assert (world.goal(thinking).state, world.dropped) == (PAUSED, [thinking])
    world.event(Pause(queued))
    assert world.goal(queued).held
    world.run_until(running, SUCCEEDED)
    assert standing_still(world)
    world.event(Resume(queued))
    world.run_until(queued, SUCCEEDED)
    world.plans[thinking] = go("dock")
    world.event(Resume(thinking))
    world.run_until(thinking, SUCCEEDED)


def test_a_goal_put_last_is_last(world: Together) -> None:
    driving(world)
    second, third, fourth = (world.give(go("hall")) for _ in range(3))
    world.event(Move(second))
    assert world.book.queue == (third, fourth, second)
    assert world.disk_entries[-1].queue == world.book.queue, "the order outlives us"


def test_only_so_many_ended_goals_stay_at_hand(world: Together) -> None:
    running = driving(world)
    goals = [world.give(go("cellar")) for _ in range(MAX_ENDED + 5)]
    assert len(world.book.missions) == MAX_ENDED + 1
    assert goals[4] not in world.book.missions
    assert {goals[5], goals[-1], running} <= set(world.book.missions)


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
