"""Skills drive the simulated robot: turns, moves, patrols, questions, second thoughts, crashes."""

from __future__ import annotations

from math import atan2, cos, degrees, hypot, pi, radians, sin
from pathlib import Path

import pytest

from planner.brain import ScriptedBrain
from planner.plan import (
    Ask,
    Code,
    Decide,
    GoalState,
    MoveStraight,
    Patrol,
    Say,
    StandAt,
    Step,
    StepPlan,
    StepRecord,
    Turn,
)
from planner.skill_files.folder import read_folder
from tests.known import known
from tests.tools.lockstep.conftest import Ready
from tools.lockstep import GoalHandle, LockstepWorld
from wire import Pose2

pytestmark = pytest.mark.nightly(keep=5)


IN_KITCHEN = Pose2(1.5, 2.0, 1.5)
BY_THE_DOCK = Pose2(1.4, 1.0, -2.6)


@pytest.fixture
def world_with(ready: Ready) -> Ready:
    """Return a maker of worlds whose brain says these plans, one after the other."""

    def made(*plans: tuple[Step, ...], start: Pose2 = IN_KITCHEN) -> LockstepWorld:
        world = ready(seed=2, start=start)
        world.think_with(ScriptedBrain([StepPlan(steps=steps) for steps in plans]))
        return world

    return made


def done(world: LockstepWorld, goal: GoalHandle, limit_s: float = 60.0) -> tuple[StepRecord, ...]:
    world.run_until(lambda _: goal.has_ended, limit_s)
    plan = known(goal.record.plan)
    assert world.contacts == 0
    return plan.steps


def turned_deg(before: Pose2, after: Pose2) -> float:
    return degrees(atan2(sin(after.yaw_rad - before.yaw_rad), cos(after.yaw_rad - before.yaw_rad)))


def ahead_m(before: Pose2, after: Pose2) -> float:
    dx, dy = after.x_m - before.x_m, after.y_m - before.y_m
    return dx * cos(before.yaw_rad) + dy * sin(before.yaw_rad)


@pytest.mark.parametrize(("asked_deg", "ends_deg"), [(90, 90), (-200, 160)])
def test_it_turns_by_the_angle_that_was_asked_and_drives_nowhere(
    world_with: Ready, asked_deg: float, ends_deg: float
) -> None:
    world = world_with((Turn(angle_rad=radians(asked_deg)),))
    before, goal, way_rad = world.truth, world.say("turn"), 0.0
    newest = before

    def watch(w: LockstepWorld) -> bool:
        nonlocal newest, way_rad
        way_rad += radians(turned_deg(newest, w.truth))
        newest = w.truth
        return goal.has_ended

    world.run_until(watch, 30.0)
    (step,) = done(world, goal)
    assert goal.state is GoalState.SUCCEEDED
    assert turned_deg(before, world.truth) == pytest.approx(ends_deg, abs=4.0)
    assert degrees(way_rad) == pytest.approx(asked_deg, abs=4.0), "and by the way that was asked"
    assert hypot(world.truth.x_m - before.x_m, world.truth.y_m - before.y_m) < 0.03
    assert step.turned_rad == pytest.approx(radians(asked_deg), abs=0.1)
    assert abs(known(step.residual_rad)) < 0.1


@pytest.mark.parametrize("distance_m", [0.5, -0.3])
def test_it_moves_straight_by_the_distance_that_was_asked(
    world_with: Ready, distance_m: float
) -> None:
    world = world_with((MoveStraight(distance_m=distance_m),))
    before, goal = world.truth, world.say("move")
    (step,) = done(world, goal)
    assert goal.state is GoalState.SUCCEEDED
    assert ahead_m(before, world.truth) == pytest.approx(distance_m, abs=0.06)
    assert turned_deg(before, world.truth) == pytest.approx(0.0, abs=4.0)
    assert step.moved_m == pytest.approx(distance_m, abs=0.06)
    outcome = known(goal.record.outcome)
    assert f"{abs(distance_m):.1f} m" in outcome.message.en


def test_towards_a_wall_nothing_moves_and_the_room_there_is_is_told(world_with: Ready) -> None:
    world = world_with((MoveStraight(distance_m=5.0),))
    before, goal = world.truth, world.say("move")
    (step,) = done(world, goal)
    assert (goal.state, goal.record.reason, step.reason) == (
        GoalState.FAILED, "no_room", "no_room")  # fmt: skip
    world.run(1.0)
    assert world.truth.x_m == pytest.approx(before.x_m, abs=1e-3)
    outcome = known(goal.record.outcome)
    assert outcome.code is Code.NO_ROOM
    assert outcome.message.en.startswith("In a straight line there is room for ")
    assert outcome.message.en.endswith(" m, not for 5.0 m.")


def test_a_patrol_visits_its_places_in_their_order(world_with: Ready) -> None:
    world = world_with((Patrol(places=("charging_dock", "kitchen")),), start=BY_THE_DOCK)
    goal = world.say("patrol")
    dock = known(world.scene.site.place("charging_dock"))
    world.run_until(lambda w: hypot(w.truth.x_m - dock.pose.x_m, w.truth.y_m - dock.pose.y_m) < 0.1)
    assert not goal.has_ended
    (step,) = done(world, goal)
    assert (goal.state, step.visited, world.room) == (GoalState.SUCCEEDED, 2, "kitchen")


def test_the_answer_to_a_question_decides_what_is_done(world_with: Ready) -> None:
    world = world_with(
        (Ask(question="Left or right?"), Decide(question="which way?")),
        (Turn(angle_rad=-pi / 4), Say(text="there")),
    )
    before, goal = world.truth, world.say("turn where I tell you")
    world.run_until(lambda _: goal.state is GoalState.NEEDS_CLARIFICATION, 5.0)
    world.run(5.0)
    assert turned_deg(before, world.truth) == pytest.approx(0.0, abs=0.1)
    world.answer(goal, "right")
    done(world, goal)
    assert goal.state is GoalState.SUCCEEDED
    assert turned_deg(before, world.truth) == pytest.approx(-45, abs=4.0)
    assert world.planner.said == ["Left or right?", "there"]


@pytest.mark.parametrize("answer", ["no, not yet", "先不要", "maybe", "yes"])
def test_what_turns_upon_an_answer_turns_upon_a_yes_alone(world_with: Ready, answer: str) -> None:
    world = world_with((Ask(question="Shall I turn?"), Turn(angle_rad=pi / 4)))
    before, goal = world.truth, world.say("wait here until I say go, then turn")
    world.run_until(lambda _: goal.state is GoalState.NEEDS_CLARIFICATION, 5.0)
    world.answer(goal, answer)
    world.run(4.0)
    turns = answer == "yes"
    assert turned_deg(before, world.truth) == pytest.approx(45 if turns else 0.0, abs=4.0)
    asks = answer == "maybe"
    assert goal.state is (GoalState.NEEDS_CLARIFICATION if asks else
                          GoalState.SUCCEEDED if turns else GoalState.CANCELLED)  # fmt: skip


@pytest.mark.parametrize("crash", [False, True])
def test_a_turn_that_was_interrupted_ends_where_it_would_have(
    world_with: Ready, crash: bool
) -> None:
    world = world_with((Turn(angle_rad=1.5 * pi),))
    before, goal = world.truth, world.say("turn")
    world.run_until(lambda w: 150 < abs(turned_deg(before, w.truth)) < 175, 20.0)
    if crash:
        world.kill_planner()
        world.run(1.0)
        world.start_planner()
        world.run(1.0)
    else:
        world.pause(goal)
        world.run(2.0)
    still = world.truth
    world.run(2.0)
    assert turned_deg(still, world.truth) == pytest.approx(0.0, abs=0.1)
    assert goal.record.reason == ("planner_restarted" if crash else "operator")
    world.resume(goal)
    (step,) = done(world, goal)
    assert goal.state is GoalState.SUCCEEDED
    assert turned_deg(before, world.truth) == pytest.approx(-90, abs=4.0)
    assert step.turned_rad == pytest.approx(1.5 * pi, abs=0.1)


def test_it_stands_so_far_before_the_sofa_and_faces_it(world_with: Ready) -> None:
    stand = StandAt(place="sofa", side="before", distance_m=0.8)
    world = world_with((stand, StandAt(place="charging_dock", side="facing")))
    goal = world.say("stop 80 centimetres before the sofa, then face the dock")
    before, facing = done(world, goal, limit_s=120.0)
    assert goal.state is GoalState.SUCCEEDED
    assert known(before.reached).x_m == pytest.approx(1.7, abs=0.3)
    assert known(before.reached).y_m == pytest.approx(5.25 - 0.3 - 0.8, abs=0.3)
    assert known(before.said).en.startswith(("I stand 0.7 m", "I stand 0.8 m", "I stand 0.9 m"))
    assert facing.said is not None
    bearing = atan2(0.8 - world.truth.y_m, 0.9 - world.truth.x_m)
    assert abs(degrees(sin(bearing - world.truth.yaw_rad))) < 15.0


def test_where_there_is_no_floor_it_stays_and_says_so(world_with: Ready) -> None:
    world = world_with((StandAt(place="sofa", side="behind"),))
    before = world.truth
    goal = world.say("stand behind the sofa")
    (step,) = done(world, goal)
    assert goal.state is GoalState.FAILED
    assert step.reason == "no_spot"
    assert "no free floor behind the sofa" in known(goal.record.outcome).message.en
    assert hypot(world.truth.x_m - before.x_m, world.truth.y_m - before.y_m) < 0.01


ROUND = """
en = "do the evening round"
zh = "做晚间巡视"
steps = [{kind = "go_to", place = "kitchen"},
  {kind = "say", text = {en = "All is well.", zh = "一切正常。"}}]
"""


def test_a_skill_saved_under_way_is_driven_by_its_words(tmp_path: Path) -> None:
    world = LockstepWorld(site="two_room", seed=3, start=Pose2(1.0, 4.2, 0.0))
    places = world.planner.missions.memory
    first = world.say("go to the sofa")
    world.run(1.0)
    (tmp_path / "evening_round.toml").write_text(ROUND, "utf-8")
    places.keep_skills(read_folder(tmp_path, places.vocabulary).skills)
    second = world.say("do the evening round")
    world.run_until(lambda _: second.has_ended, limit_s=90.0)
    assert (first.state, second.state) == ("succeeded", "succeeded")
    assert world.room == "kitchen"
    assert world.contacts == 0
    plan = known(second.record.plan)
    assert [step.kind for step in plan.steps] == ["go_to", "say"]
    assert "All is well." in world.planner.said
    third = world.say("不要做晚间巡视")
    world.run_until(lambda _: third.has_ended, limit_s=20.0)
    assert third.state == "refused"
    (tmp_path / "evening_round.toml").unlink()
    places.keep_skills(read_folder(tmp_path, places.vocabulary).skills)
    gone = world.say("do the evening round")
    world.run(2.0)
    assert gone.state != "running"
    assert world.standing
