"""Find, go to, count, look and follow in lockstep, by the truth with a detector's faults."""

from __future__ import annotations

from math import atan2, hypot, pi
from pathlib import Path

import pytest

from planner.brain import ScriptedBrain
from planner.plan import (
    Code,
    Count,
    Find,
    Follow,
    GoalState,
    GoToObject,
    GoToPoint,
    Look,
    Patrol,
    Step,
    StepPlan,
    StepRecord,
)
from planner.skills.skill_state import FindState
from tests.known import known
from tests.tools.lockstep.conftest import Ready
from tools.lockstep import GoalHandle, LockstepWorld
from tools.lockstep.homes import stock_home
from wire import Pose2, wrap

RED, BLUE, ON_SOFA = (2.6, 0.6), (2.6, 1.0), (1.2, 5.5)
OBJECTS: dict[str, object] = {
    "red_cup": {"class": "cup", "color": "red", "at": [*RED], "on": "counter"},
    "blue_cup": {"class": "cup", "color": "blue", "at": [*BLUE], "on": "counter"},
    "other_blue_cup": {"class": "cup", "color": "blue", "at": [*ON_SOFA], "on": "sofa"},
}
PEOPLE: dict[str, object] = {"anna": {"at": [2.4, 4.3]}}
TO_THE_DOOR, BY_THE_COUNTER = Pose2(1.5, 4.0, -pi / 2), Pose2(1.5, 1.9, -0.9)

pytestmark = [pytest.mark.timeout(180), pytest.mark.nightly(keep=6)]
"""A search is a minute of simulated time: 6 s of a free core, ten times that on a busy one."""


@pytest.fixture(scope="session")
def home(tmp_path_factory: pytest.TempPathFactory, repository: Path) -> Path:
    """Return the two rooms with three cups and a person in them."""
    return stock_home(
        tmp_path_factory.mktemp("sites"), repository / "sites" / "two_room", OBJECTS, PEOPLE
    )


@pytest.fixture
def world_with(ready: Ready, home: Path) -> Ready:
    """Return a maker of worlds that see, and whose brain says this plan."""

    def made(*steps: Step, start: Pose2 = BY_THE_COUNTER, seed: int = 3) -> LockstepWorld:
        world = ready(site=home, seed=seed, start=start)
        world.open_eyes()
        world.think_with(ScriptedBrain([StepPlan(steps=steps)] * 4))
        return world

    return made


def done(world: LockstepWorld, goal: GoalHandle, limit_s: float = 90.0) -> StepRecord:
    world.run_until(lambda _: goal.has_ended, limit_s)
    plan = known(goal.record.plan)
    assert world.contacts == 0
    assert world.standing or goal.state is GoalState.SUCCEEDED
    return plan.steps[0]


def told(goal: GoalHandle) -> tuple[Code, str, str]:
    outcome = known(goal.record.outcome)
    return outcome.code, outcome.message.en, outcome.message.zh


def moved_m(world: LockstepWorld, since: Pose2) -> float:
    return hypot(world.truth.x_m - since.x_m, world.truth.y_m - since.y_m)


def test_what_is_in_another_room_is_found_and_not_what_stands_beside_it(world_with: Ready) -> None:
    world = world_with(Find(object="红色的杯子"), start=TO_THE_DOOR)
    goal = world.say("找红色的杯子")
    step = done(world, goal)
    assert goal.state is GoalState.SUCCEEDED
    found = known(step.found)
    assert (found.label, found.color, found.room) == ("cup", "red", "kitchen")
    assert hypot(found.x_m - RED[0], found.y_m - RED[1]) < 0.15
    away_m = hypot(world.truth.x_m - RED[0], world.truth.y_m - RED[1])
    assert found.distance_m == pytest.approx(away_m, abs=0.2)
    code, en, zh = told(goal)
    assert code is Code.FOUND
    assert en == f"I found a red cup in the kitchen, {found.distance_m:.1f} m from me."
    assert zh == f"我在厨房找到了一个红色的杯子，离我 {found.distance_m:.1f} 米。"


def test_what_was_just_seen_is_told_without_a_search_and_gone_things_are_not(
    world_with: Ready,
) -> None:
    world = world_with(Find(object="the red cup", place="kitchen"))
    world.run(2.0)
    began, at_s = world.truth, world.now_s
    goal = world.say("find the red cup")
    done(world, goal)
    assert goal.state is GoalState.SUCCEEDED
    assert world.now_s - at_s < 6.0
    assert moved_m(world, began) < 0.1
    world.put("red_cup", None)
    world.teleport(Pose2(began.x_m, began.y_m, pi / 2))  # it does not see that it is gone
    world.run(3.0)
    again = world.say("find the red cup", None)
    step = done(world, again)
    assert (again.state, step.reason) == (GoalState.FAILED, "not_found")
    assert step.rooms == ("kitchen",)


def test_what_is_not_there_is_told_with_where_was_looked(world_with: Ready) -> None:
    world = world_with(Find(object="green cup", place="kitchen"))
    goal = world.say("find the green cup in the kitchen")
    step = done(world, goal)
    assert (goal.state, step.reason, step.rooms) == (GoalState.FAILED, "not_found", ("kitchen",))
    assert told(goal)[1:] == (
        "I saw no green cup. I looked in the kitchen. I saw a blue cup; light may change a colour.",
        "没有看到绿色的杯子。我看过了厨房。我看到了一个蓝色的杯子；光线可能让颜色看起来不一样。",
    )
    assert world.room == "kitchen", "the order named one room"


@pytest.mark.parametrize(
    ("step", "blind", "code", "says"),
    [
        (Find(object="unicorn"), None, Code.OBJECT_UNKNOWN, "cup"),
        (GoToObject(object="独角兽"), None, Code.OBJECT_UNKNOWN, "cup"),
        (Count(object="cups"), "no_camera", Code.NO_CAMERA, "camera"),
        (Follow(object="me"), "no_detector", Code.NO_DETECTOR, "recognises"),
    ],
)
def test_what_these_eyes_can_not_do_is_refused_before_anything_moves(
    world_with: Ready, step: Step, blind: str | None, code: Code, says: str
) -> None:
    world = world_with(step)
    world.open_eyes().blind = blind
    world.run(1.0)
    began, goal = world.truth, world.say("do it")
    world.run(1.0)
    assert goal.state is GoalState.REFUSED
    assert told(goal)[0] is code
    assert says in told(goal)[1]
    assert moved_m(world, began) < 0.01


def test_it_drives_up_to_a_thing_and_faces_it(world_with: Ready) -> None:
    world = world_with(GoToObject(object="blue cup", place="kitchen"))
    goal = world.say("go to the blue cup in the kitchen")
    step = done(world, goal)
    assert goal.state is GoalState.SUCCEEDED, told(goal)
    here = world.truth
    away_m = hypot(BLUE[0] - here.x_m, BLUE[1] - here.y_m)
    assert 0.75 <= away_m <= 1.15, "half a metre before the robot's edge, off the counter"
    ahead = atan2(BLUE[1] - here.y_m, BLUE[0] - here.x_m)
    assert abs(wrap(here.yaw_rad - ahead)) < 0.25
    assert step.found is not None
    assert told(goal)[0] is Code.ARRIVED


def test_a_thing_that_is_taken_away_on_the_way_is_looked_for_once_and_then_told(
    world_with: Ready,
) -> None:
    world = world_with(GoToObject(object="red cup", place="kitchen"), start=Pose2(0.7, 1.9, -0.5))
    goal = world.say("go to the red cup")
    world.run_until(lambda w: w.twist.v_mps > 0.2, 30.0)
    world.put("red_cup", None)
    step = done(world, goal)
    assert (goal.state, step.reason) == (GoalState.FAILED, "moved")
    assert "no more where I had seen it" in told(goal)[1]


def test_things_are_counted_and_questions_answered_in_one_place_or_here(world_with: Ready) -> None:
    world = world_with(Count(object="cups", place="kitchen"))
    goal = world.say("how many cups are in the kitchen")
    assert done(world, goal).count == 2
    assert told(goal)[1:] == ("I saw two cups in the kitchen.", "在厨房看到两个杯子。")
    for question, answer in (
        ("is there a red cup?", "Yes, I see a red cup."),
        ("有没有人？", "没有，没有看到人。"),
        ("what do you see?", "I see a blue cup and a red cup."),
    ):
        world.teleport(BY_THE_COUNTER)
        world.run(3.0)
        world.think_with(ScriptedBrain([StepPlan(steps=(Look(question=question),))]))
        goal, began = world.say(question), world.truth
        done(world, goal)
        assert told(goal)[0] is Code.SEEN
        assert answer in told(goal)[1:]
        assert moved_m(world, began) < 0.01


def test_eyes_that_fail_midway_end_the_step_standing(world_with: Ready) -> None:
    world = world_with(Find(object="green cup"))
    goal = world.say("find the green cup")
    world.run(6.0)
    world.open_eyes().blind = "camera_frozen"
    step = done(world, goal, 30.0)
    assert (goal.state, step.reason) == (GoalState.FAILED, "camera_frozen")
    assert told(goal)[0] is Code.BLIND
    world.run_until(lambda w: w.standing, 2.0)


@pytest.mark.parametrize("way", ["pause", "stop", "crash"])
def test_an_interrupted_search_goes_on_where_it_was_and_never_by_itself(
    world_with: Ready, way: str
) -> None:
    world = world_with(Find(object="green cup", place="kitchen"))
    goal = world.say("find the green cup in the kitchen")

    def looked() -> tuple[int, ...]:
        state = world.planner.book.missions[goal.id].skill_state
        return state.views if isinstance(state, FindState) else ()

    world.run_until(lambda _: len(looked()) == 3, 30.0)
    world.run(0.3)
    if way == "crash":
        world.kill_planner()
        world.run(1.0)
        world.start_planner()
    elif way == "stop":
        world.stop()
    else:
        world.pause(goal)
    world.run(2.0)
    still = world.truth
    world.run(3.0)
    assert goal.state is GoalState.PAUSED
    assert abs(wrap(world.truth.yaw_rad - still.yaw_rad)) < 0.01
    assert len(looked()) == 3, "what was looked at stays looked at"
    world.resume(goal)

    def is_done(_: object) -> bool:
        state = world.planner.book.missions[goal.id].skill_state
        return isinstance(state, FindState) and bool(state.spots)

    took_s = world.run_until(is_done, 30.0)
    assert took_s < 14.0, "three directions were left, not six"
    step = done(world, goal)
    assert (goal.state, step.reason) == (GoalState.FAILED, "not_found")


def test_a_person_is_followed_at_a_distance_and_lost_cleanly(world_with: Ready) -> None:
    world = world_with(Follow(object="person"), start=Pose2(1.5, 1.2, pi / 2))
    here = [1.5, 2.6]
    world.put("anna", Pose2(here[0], here[1], 0.0))
    world.run(1.5)
    goal, nearest_m, legs = world.say("follow me"), 9.0, set[int]()
    for tick in range(1_500):
        world.tick()
        if here[1] < 4.7:
            here[1] += 0.004
            world.put("anna", Pose2(here[0], here[1], 0.0))
        nearest_m = min(nearest_m, hypot(world.truth.x_m - here[0], world.truth.y_m - here[1]))
        legs |= {world.status.leg.leg} if world.status.leg is not None else set()
        if tick == 700:
            assert world.truth.y_m > 1.5, "it goes after her"
    assert 1.0 < hypot(world.truth.x_m - here[0], world.truth.y_m - here[1]) < 1.7
    assert nearest_m > 0.9
    assert 3 <= len(legs) <= 24, "laid anew as she walks, twice a second at most"
    world.put("anna", None)
    step = done(world, goal, 60.0)
    assert (goal.state, step.reason) == (GoalState.FAILED, "lost_person")
    assert told(goal)[0] is Code.LOST_PERSON


def test_a_point_of_the_picture_is_driven_to_on_floor_and_refused_on_a_wall(
    world_with: Ready,
) -> None:
    world = world_with(GoToPoint(x=500, y=820), start=Pose2(0.8, 1.9, 0.3))
    world.run(1.0)
    began, goal = world.truth, world.say("go there")
    done(world, goal)
    assert goal.state is GoalState.SUCCEEDED
    assert 0.8 < moved_m(world, began) < 2.2
    world.think_with(ScriptedBrain([StepPlan(steps=(GoToPoint(x=500, y=430),))]))
    world.run(1.0)
    still, refused = world.truth, world.say("go there")
    step = done(world, refused)
    assert told(refused)[0] is Code.POINT_REFUSED
    assert step.reason in ("point_on_wall", "point_no_depth", "point_off_map")
    assert moved_m(world, still) < 0.01


SOFA = (1.5, 5.6)
"""Its middle. It is on the map; behind it stands the wall."""


def test_a_point_on_mapped_furniture_is_driven_up_to_and_faced(world_with: Ready) -> None:
    world = world_with(GoToPoint(x=500, y=860), start=Pose2(1.5, 3.7, pi / 2))
    world.run(1.0)
    goal = world.say("go there")
    step = done(world, goal)
    assert goal.state is GoalState.SUCCEEDED, (step.reason, told(goal))
    at = world.truth
    assert at.y_m < 5.2 - 0.3
    assert abs(wrap(atan2(SOFA[1] - at.y_m, SOFA[0] - at.x_m) - at.yaw_rad)) < 0.35


def test_a_patrol_sees_what_stands_at_each_stop_and_tells_it_at_the_end(world_with: Ready) -> None:
    world = world_with(Patrol(places=("kitchen", "living_room"), look=True), start=TO_THE_DOOR)
    goal = world.say("patrol the kitchen and the living room and tell me what you saw")
    step = done(world, goal, limit_s=240.0)
    assert goal.state is GoalState.SUCCEEDED
    assert [(stop.place, stop.shut) for stop in step.stops] == [
        ("kitchen", False), ("living_room", False),
    ]  # fmt: skip
    code, english, chinese = told(goal)
    assert code is Code.SEEN
    kitchen, living_room = english.split("living room: ")
    assert "cup" in kitchen
    assert "a person" in living_room
    assert "一个人" in chinese


BRAKING_M = 0.3
START = Pose2(1.5, 1.2, pi / 2)


@pytest.fixture(scope="session")
def lived_in(tmp_path_factory: pytest.TempPathFactory, repository: Path) -> Path:
    """Return the two rooms with a person in them."""
    people: dict[str, object] = {"anna": {"at": [2.4, 4.3]}}
    return stock_home(
        tmp_path_factory.mktemp("sites"), repository / "sites" / "two_room", {}, people
    )


@pytest.fixture
def world(ready: Ready, lived_in: Path) -> LockstepWorld:
    """Return a world that sees, and whose brain says to follow."""
    world = ready(site=lived_in, seed=3, start=START)
    world.put("anna", Pose2(1.5, 2.6, 0.0))
    world.open_eyes()
    world.think_with(ScriptedBrain([StepPlan(steps=(Follow(object="person"),))] * 2))
    return world


def away_m(world: LockstepWorld, y_m: float) -> float:
    return hypot(world.truth.x_m - 1.5, world.truth.y_m - y_m)


def walk_on(world: LockstepWorld, from_m: float, to_m: float, seconds: float = 20.0) -> float:
    """Let her walk at 0.4 m/s, then stand; return the least distance."""
    least_m, y_m = 9.0, from_m
    for _ in range(round(seconds / 0.01)):
        y_m = min(to_m, y_m + 0.004)
        world.put("anna", Pose2(1.5, y_m, 0.0))
        world.tick()
        least_m = min(least_m, away_m(world, y_m))
    return least_m


@pytest.mark.parametrize("driving", [False, True], ids=["standing", "driving"])
def test_a_camera_that_falls_silent_ends_it_where_it_stands(
    world: LockstepWorld, driving: bool
) -> None:
    world.run(1.5)
    goal, y_m = world.say("follow me"), 3.4
    walk_on(world, 2.6, y_m, 3.0 if driving else 9.0)
    assert (world.twist.v_mps > 0.1) is driving
    world.open_eyes().blind = "camera_silent"
    before_m, least_m, at_s = away_m(world, y_m), 9.0, world.now_s
    while not goal.has_ended:
        world.tick()
        least_m = min(least_m, away_m(world, y_m))
        assert world.now_s - at_s < 15.0
    assert least_m > before_m - (BRAKING_M if driving else 0.0) - 0.1
    plan = known(goal.record.plan)
    assert (goal.state, plan.steps[0].reason) == (GoalState.FAILED, "camera_silent")
    world.run_until(lambda w: w.standing, 2.0)


@pytest.mark.parametrize("way", ["pause", "stop"])
def test_one_that_is_stopped_or_paused_stands_while_she_walks_on(
    world: LockstepWorld, way: str
) -> None:
    world.run(1.5)
    goal = world.say("follow me")
    walk_on(world, 2.6, 3.4, 3.0)
    assert world.twist.v_mps > 0.1
    _order(world, goal, way)
    world.run_until(lambda w: w.standing, 2.0)
    still = world.truth
    walk_on(world, 3.4, 4.2, 4.0)
    assert goal.state is GoalState.PAUSED
    assert hypot(world.truth.x_m - still.x_m, world.truth.y_m - still.y_m) < 0.02
    world.resume(goal)
    assert walk_on(world, 4.2, 4.4, 8.0) > 0.9
    assert world.truth.y_m > still.y_m + 0.3, "it goes after her again"
    assert world.contacts == 0


def _order(world: LockstepWorld, goal: GoalHandle, way: str) -> None:
    if way == "stop":
        world.stop()
    else:
        world.pause(goal)
