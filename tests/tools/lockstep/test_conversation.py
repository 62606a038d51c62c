"""Words said while the robot drives, with the real planner, bridge and physics."""

from __future__ import annotations

from math import hypot

import pytest

from planner.brain.scripted import ScriptedBrain
from planner.plan import GoTo, Patrol, PlanRole, Say, StepPlan
from tests.known import known
from tools.lockstep import LockstepWorld
from wire import Pose2

pytestmark = [pytest.mark.timeout(120), pytest.mark.nightly(keep=3)]
START = Pose2(1.0, 4.2, 0.0)


def world_of(brain: ScriptedBrain | None = None) -> LockstepWorld:
    return LockstepWorld(site="two_room", seed=3, start=START, brain=brain)


@pytest.mark.parametrize(
    ("order", "correction"),
    [
        ("go to the kitchen", "no, I meant the sofa"),
        ("去厨房", "不对，沙发"),
        ("去厨房", "不是厨房，是沙发"),
    ],
)
def test_a_correction_under_way_ends_the_drive_and_goes_where_it_was_meant(
    order: str, correction: str
) -> None:
    world = world_of()
    first = world.say(order)
    world.run(2.0)
    second = world.say(correction)
    world.run_until(lambda _: second.has_ended, limit_s=60.0)
    assert (first.state, second.state) == ("cancelled", "succeeded")
    outcome = known(second.record.outcome)
    assert known(outcome.reached).place == "sofa"


def test_what_takes_a_drive_back_by_a_stop_word_drives_on_its_own_signature() -> None:
    """The sentence's own stop voids what came signed with it."""
    sofa = StepPlan(steps=(GoTo(place="sofa"),), does=PlanRole.INSTEAD)
    kitchen = StepPlan(steps=(GoTo(place="kitchen"),))
    world = world_of(ScriptedBrain([kitchen, sofa], by_grammar=False))
    first = world.say("go to the kitchen")
    world.run(2.0)
    second = world.say("forget that, go to the sofa instead")
    world.run(1.0)
    world.run_until(lambda _: second.has_ended, limit_s=60.0)
    assert (first.state, second.state) == ("cancelled", "succeeded")


def test_one_more_waits_for_what_runs_and_again_drives_it_once_more() -> None:
    world = world_of()
    first = world.say("go to the sofa")
    world.run(1.0)
    more = world.say("and then the kitchen too")
    world.run_until(lambda _: more.has_ended, limit_s=90.0)
    assert (first.state, more.state) == ("succeeded", "succeeded")
    again = world.say("do that again")
    world.run_until(lambda _: again.has_ended, limit_s=60.0)
    plan = known(again.record.plan)
    assert [(step.kind, step.place) for step in plan.steps] == [("go_to", "kitchen")]


@pytest.mark.parametrize(
    ("order", "back"), [("go to the kitchen", "ok, now come back"), ("去厨房", "好，回来吧")]
)
def test_the_robot_is_called_back_to_where_its_errand_was_given(order: str, back: str) -> None:
    world = world_of()
    asked = world.say(back)
    world.run(1.0)
    assert asked.state == "needs_clarification"  # back from where?
    errand = world.say(order)
    world.run_until(lambda _: errand.has_ended, limit_s=60.0)
    goal = world.say(back)
    world.run_until(lambda _: goal.has_ended, limit_s=60.0)
    assert (errand.state, goal.state) == ("succeeded", "succeeded")
    here = known(world.status.base_in_map)
    assert hypot(here.x_m - START.x_m, here.y_m - START.y_m) < 0.3


def test_a_hostile_model_turns_no_wheel_until_a_person_says_yes() -> None:
    roams = StepPlan(
        steps=(Say(text="hello"), Patrol(places=("kitchen", "sofa")), GoTo(place="sofa"))
    )
    world = world_of(ScriptedBrain([roams] * 4, by_grammar=False))
    goal = world.say("say hello")
    world.run(5.0)
    assert (goal.state, goal.record.reason) == ("awaiting_confirmation", "unasked_motion")
    assert world.status.base_in_map is not None
    assert abs(world.status.measured.v_mps) < 1e-3
