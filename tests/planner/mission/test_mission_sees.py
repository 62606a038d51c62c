"""What sights do to a running mission: gazes, walks laid anew, and searches that a yes leads on."""

from __future__ import annotations

from copy import deepcopy
from dataclasses import replace
from functools import cache

import pytest

from planner.mission.activity import Driving, Observing
from planner.mission.events import Reply, Tick
from planner.mission.state import Mission
from planner.plan import (
    Code,
    ComeBack,
    Count,
    Find,
    Follow,
    Frozen,
    GoalState,
    GoTo,
    GoToObject,
    If,
    Look,
    Say,
    Step,
    StepPlan,
    StepState,
)
from planner.site.site_view import SiteView
from planner.skills.skill_state import FindState
from tests.planner.mission.fakes import FACTS, outcome_of, room, row
from tests.planner.mission.lockstep import (
    ANNA,
    CUP,
    FAILED,
    RUNNING,
    SUCCEEDED,
    Seeing,
)
from wire import Grant


@pytest.fixture
def seeing() -> Seeing:
    world = Seeing()
    world.open_eyes()
    world.run(0.2)
    return world


def find(what: str) -> StepPlan:
    return StepPlan(steps=(Find(object=what),))


def test_a_room_whose_way_is_shut_is_passed_over_and_told(seeing: Seeing) -> None:
    goal = seeing.give(find("cup"))
    while not isinstance(leg := seeing.book.activity, Driving) or leg.act.goal.x_m < 3.0:
        seeing.see(0.2)
    assert seeing.goal(goal).state is RUNNING
    seeing.bridge.blocked = True
    seeing.see_until(goal, FAILED)
    mission = seeing.goal(goal)
    assert outcome_of(mission).code is Code.NOT_FOUND
    assert outcome_of(mission).message.en == (
        "I saw no cup. I looked in the hall. I found no way to the kitchen."
    )
    assert mission.steps[0].state is StepState.FAILED


def test_what_is_seen_on_the_way_is_looked_at_at_once(seeing: Seeing) -> None:
    goal = seeing.give(find("red cup"))
    seeing.see(12.0)
    seeing.things = (CUP,)
    seeing.see_until(goal, SUCCEEDED, limit_s=20.0)
    assert seeing.bridge.pose.x_m < 4.2, "it did not look round in the kitchen first"
    found = seeing.goal(goal).steps[0].found
    assert isinstance(found, Frozen)
    assert (found.room, found.x_m) == ("kitchen", 5.0)


def test_a_gaze_needs_pictures_taken_standing_and_ends_without_any(seeing: Seeing) -> None:
    goal = seeing.give(find("cup"))
    seeing.run(4.0)
    assert seeing.goal(goal).state is RUNNING
    seeing.see(0.4)  # two pictures are no three
    seeing.blind = "camera_frozen"
    seeing.see(1.0)
    state = seeing.goal(goal).skill_state
    views = len(state.views) if isinstance(state, FindState) else 0
    seeing.see_until(goal, FAILED, limit_s=20.0)
    assert views <= 1
    assert seeing.goal(goal).reason == "camera_frozen"


def test_who_walks_is_gone_after_by_legs_laid_anew_and_no_more_than_twice_a_second(
    seeing: Seeing,
) -> None:
    seeing.things = (ANNA,)
    goal = seeing.give(StepPlan(steps=(Follow(object="me"),)))
    began_s, legs = seeing.now_s, set[int]()
    for step in range(40):
        seeing.things = (replace(ANNA, x_m=3.0 + 0.1 * step),)
        seeing.see(0.2)
        legs.add(seeing.goal(goal).leg)
    assert 3 <= len(legs) <= 2 * (seeing.now_s - began_s) + 1
    seeing.see(6.0)
    assert seeing.bridge.pose.x_m == pytest.approx(6.9 - 1.2, abs=0.4)
    written = len(seeing.disk_entries)
    seeing.see(4.0)
    assert len(seeing.disk_entries) - written <= 6, "standing by, little is written"
    seeing.things = ()
    seeing.see_until(goal, FAILED, limit_s=60.0)
    assert seeing.goal(goal).reason == "lost_person"


FOLLOWING = StepPlan(steps=(Follow(object="me"),))


@pytest.mark.parametrize("near", [True, False], ids=["standing", "driving"])
def test_a_follower_that_sees_nothing_stands_and_comes_no_nearer(
    seeing: Seeing, near: bool
) -> None:
    seeing.things = (ANNA,)
    goal = seeing.give(FOLLOWING)
    seeing.see(9.0 if near else 1.6)
    here = seeing.bridge.pose.x_m
    assert (here > 1.5) is near
    seeing.things, seeing.blind = (), "camera_silent"
    seeing.see_until(goal, FAILED, limit_s=15.0)
    assert seeing.bridge.pose.x_m - here < 0.15
    assert (seeing.goal(goal).reason, seeing.book.activity) == ("camera_silent", None)


def test_where_a_person_was_seen_last_is_not_driven_onto(seeing: Seeing) -> None:
    seeing.things = (ANNA,)
    goal = seeing.give(FOLLOWING)
    seeing.see(2.0)
    seeing.things = ()
    seeing.see_until(goal, FAILED)
    assert seeing.goal(goal).reason == "lost_person"
    assert 1.15 <= ANNA.x_m - seeing.bridge.pose.x_m <= 1.6


def stands_while_blind(seeing: Seeing, goal: str) -> None:
    """See a drive stand while its eyes see nothing, go on with them, and end without them."""
    here, seeing.blind = seeing.bridge.pose.x_m, "camera_silent"
    seeing.see(1.0)
    assert isinstance(seeing.book.activity, Observing)
    seeing.blind = None
    seeing.see(1.0)
    assert seeing.bridge.pose.x_m > here, "eyes that come back go on"
    here, seeing.blind = seeing.bridge.pose.x_m, "camera_silent"
    seeing.see_until(goal, FAILED, limit_s=15.0)
    assert seeing.bridge.pose.x_m - here < 0.3
    assert seeing.goal(goal).reason == "camera_silent"


@pytest.mark.parametrize("what", ["cup", "cups"])
def test_a_search_goes_nowhere_while_its_eyes_see_nothing(seeing: Seeing, what: str) -> None:
    step = Find(object=what) if what == "cup" else Count(object=what)
    goal = seeing.give(StepPlan(steps=(step,)))
    while seeing.bridge.pose.x_m < 0.6:
        seeing.see(0.2)
    stands_while_blind(seeing, goal)


def test_what_is_known_is_not_driven_up_to_by_eyes_that_fail(seeing: Seeing) -> None:
    seeing.things = (CUP,)
    seeing.see(1.0)
    goal = seeing.give(StepPlan(steps=(GoToObject(object="red cup"),)))
    while seeing.bridge.pose.x_m < 0.6:
        seeing.see(0.2)
    assert isinstance(leg := seeing.book.activity, Driving)
    assert (leg.act.wanted, leg.act.watch) == (None, False)
    stands_while_blind(seeing, goal)


def test_a_person_without_a_way_to_them_is_watched_and_given_up_in_time(seeing: Seeing) -> None:
    seeing.things, seeing.way = (ANNA,), lambda _: "no_route"
    goal = seeing.give(FOLLOWING)
    began_s = seeing.now_s
    seeing.see_until(goal, FAILED, limit_s=60.0)
    mission, took_s = seeing.goal(goal), seeing.now_s - began_s
    assert mission.reason == "no_route"
    assert "person" in outcome_of(mission).message.en
    assert 10.0 < took_s < 60.0
    assert 3 <= len(seeing.routes) <= took_s
    assert len(seeing.disk_entries) <= 2 * took_s


def test_after_a_jump_of_the_pose_no_way_is_laid_before_the_robot_stands(seeing: Seeing) -> None:
    seeing.things = (ANNA,)
    seeing.give(FOLLOWING)
    seeing.see(1.0)
    seeing.bridge.rows = (row("POSE_JUMP"),)
    seeing.see(0.2)
    routes = len(seeing.routes)
    for step in range(10):
        seeing.things = (replace(ANNA, x_m=3.0 + 0.3 * step),)
        seeing.see(0.2)
    assert len(seeing.routes) == routes
    seeing.bridge.rows = ()
    seeing.see(0.4)
    assert len(seeing.routes) > routes


def test_a_leg_that_is_laid_anew_is_bounded_as_its_skill_says(seeing: Seeing) -> None:
    seeing.things, seeing.way = (ANNA,), lambda _: "no_route"
    seeing.give(FOLLOWING)
    seeing.see(1.0)
    seeing.things, seeing.way = (), lambda _: None
    while not isinstance(leg := seeing.book.activity, Driving):
        seeing.see(0.2)
    assert leg.act.limit_m is not None
    assert leg.act.limit_s is not None
    seeing.things = (replace(ANNA, x_m=4.5),)
    seeing.see(0.8)
    assert isinstance(leg := seeing.book.activity, Driving)
    assert (leg.act.limit_m, leg.act.limit_s) == (None, None)


@pytest.mark.parametrize(
    ("step", "refused"),
    [
        (GoToObject(object="the small cup"), True),
        (GoToObject(object="窗户上的杯子"), True),
        (GoToObject(object="桌子上的杯子"), False),
        (Follow(object="the person next to the table"), True),
        (Follow(object="the other person"), True),
        (Follow(object="另一个人"), True),
        (GoToObject(object="the nearest cup"), False),
        (Find(object="the small cup"), False),
    ],
)
def test_what_only_one_of_a_kind_can_be_is_not_taken_for_any_of_it(
    seeing: Seeing, step: Step, refused: bool
) -> None:
    seeing.things = (ANNA, CUP)
    goal = seeing.give(StepPlan(steps=(step,)))
    seeing.see(1.0)
    mission = seeing.goal(goal)
    assert (mission.state is GoalState.REFUSED) is refused
    if refused:
        assert outcome_of(mission).code is Code.OBJECT_UNKNOWN
        said, stands = outcome_of(mission).message, step.kind == "go_to_object"
        assert "which one" in said.en
        assert ("on, under or near" in said.en) is stands, "who walks has no neighbour"
        assert ("上面、下面或旁边" in said.zh) is stands
        assert seeing.routes == []


@pytest.mark.parametrize(("model", "refused"), [(False, True), (True, False)])
def test_a_question_about_what_these_eyes_do_not_know_is_answered_before_anything_moves(
    seeing: Seeing, model: bool, refused: bool
) -> None:
    eyes = replace(seeing.book.eyes, classes=("cup",), model=model)
    seeing.engine.book = replace(seeing.book, eyes=eyes)
    look = Look(question="is there a piano in the kitchen?", place="kitchen")
    goal = seeing.give(StepPlan(steps=(GoTo(place="kitchen"), look)))
    seeing.see(0.6)
    assert (seeing.goal(goal).state is GoalState.REFUSED) is refused
    assert (seeing.routes == []) is refused


APART_M = 16.0
ROOMS = ("hall", "r1", "r2", "r3", "r4")
HOME = SiteView(
    {
        **{name: room(name, APART_M * n) for n, name in enumerate(ROOMS)},
        "dock": FACTS.targets["dock"],
    },
    home="dock",
)
ASKS_TO_SEARCH_ON, DONE = GoalState.NEEDS_CLARIFICATION, (GoalState.SUCCEEDED, GoalState.FAILED)


def large_home() -> Seeing:
    world = Seeing()
    world.open_eyes()
    world.engine.book = replace(world.book, facts=HOME)
    world.run(0.2)
    return world


@pytest.fixture
def large() -> Seeing:
    return large_home()


def searching(world: Seeing, *steps: Step) -> str:
    goal = world.give(StepPlan(steps=steps))
    world.see_until(goal, ASKS_TO_SEARCH_ON, *DONE, limit_s=600.0)
    return goal


@cache
def _searched(step: Step) -> Seeing:
    world = large_home()
    assert searching(world, step) == "g1"
    return world


def searched(step: Step) -> Seeing:
    """Return a world of its own in which goal g1 has searched until it asked."""
    return deepcopy(_searched(step))


def told(mission: Mission) -> str:
    return outcome_of(mission).message.en


def grants(world: Seeing) -> set[str]:
    return {message.mission for message in world.bridge.heard if isinstance(message, Grant)}


@pytest.mark.parametrize("step", [Find(object="cup"), Count(object="cup")])
def test_a_yes_goes_on_in_the_rooms_that_were_left_and_under_a_grant_of_its_own(
    step: Step,
) -> None:
    large, goal = searched(step), "g1"
    mission = large.goal(goal)
    assert mission.state is ASKS_TO_SEARCH_ON
    left = [name for name in ROOMS if name not in mission.skill_state.rooms]  # type: ignore[union-attr]
    assert 0 < len(left) < len(ROOMS)
    assert all(name in told(mission).split("I did not look in")[1] for name in left)
    assert "Shall I look in the" in told(mission)
    assert mission.metres < 60.0
    assert grants(large) == {goal}
    before = len(large.routes)
    large.event(Reply(goal, "yes"))
    large.see_until(goal, ASKS_TO_SEARCH_ON, *DONE, limit_s=600.0)
    ended = large.goal(goal)
    assert ended.state is (GoalState.FAILED if step.kind == "find" else GoalState.SUCCEEDED)
    assert grants(large) == {goal, f"{goal}.1"}
    driven_to = {HOME_AT.get(ask.request.goal.x_m) for ask in large.routes[before:]} - {None}
    assert set(left) <= driven_to, "each room that was left"
    assert ended.steps[0].rooms == tuple(mission.skill_state.order)  # type: ignore[union-attr]
    assert "I did not look in" not in told(ended)
    assert ended.steps[0].count == (0 if step.kind == "count" else None)


HOME_AT = {target.pose.x_m: name for name, target in HOME.targets.items() if target.room}


@pytest.mark.parametrize("answer", ["no", "no, thanks"])
def test_a_no_ends_it_with_what_was_seen(answer: str) -> None:
    large, goal = searched(Find(object="cup")), "g1"
    large.event(Reply(goal, answer))
    large.see_until(goal, *DONE)
    ended = large.goal(goal)
    assert outcome_of(ended).code is Code.NOT_FOUND
    assert "I did not look in the" in told(ended)
    assert grants(large) == {goal}, "no word, no grant"


def test_who_does_not_answer_is_told_what_was_not_looked_at() -> None:
    large, goal = searched(Count(object="cup")), "g1"
    large.now_s += large.book.rules.answer_s + 1.0
    large.event(Tick())
    assert large.goal(goal).state is GoalState.FAILED
    assert "I did not look in the" in told(large.goal(goal))


def test_the_persons_else_is_taken_and_nobody_is_asked(large: Seeing) -> None:
    seek = If(when=Find(object="cup"), then=(Say(text="here"),), otherwise=(Say(text="gone"),))
    goal = searching(large, seek)
    ended = large.goal(goal)
    assert ended.state is GoalState.SUCCEEDED
    assert large.said == ["gone"]
    assert "I did not look in the" in told(ended)
    assert "So I do what you said for that case." in told(ended)


def test_the_way_that_the_else_drives_is_left(large: Seeing) -> None:
    """Come back: the search ends while the way back still fits into the grant."""
    back = If(when=Find(object="cup"), then=(Say(text="here"),), otherwise=(ComeBack(),))
    goal = searching(large, back)
    ended = large.goal(goal)
    assert ended.state is GoalState.SUCCEEDED, told(ended)
    assert ended.metres < 60.0
    assert large.bridge.pose.x_m < 1.0


@pytest.mark.parametrize(
    "steps", [(GoTo(place="hall"), Find(object="cup"), ComeBack()), (Find(object="cup"),)]
)
def test_nobody_is_asked_while_others_wait_or_the_robot_is_to_come_back(
    large: Seeing, steps: tuple[Step, ...]
) -> None:
    goal = large.give(StepPlan(steps=steps))
    large.run(0.2)
    if len(steps) == 1:
        large.give(StepPlan(steps=(Say(text="next"),)))
    large.see_until(goal, ASKS_TO_SEARCH_ON, *DONE, limit_s=600.0)
    assert large.goal(goal).state is GoalState.FAILED
    assert "I did not look in the" in told(large.goal(goal))


def test_what_is_found_after_a_yes_is_found() -> None:
    large, goal = searched(Find(object="cup")), "g1"
    last = HOME.targets[ROOMS[-1]].pose
    large.things = (replace(CUP, x_m=last.x_m, y_m=0.5, room=ROOMS[-1]),)
    large.event(Reply(goal, "yes"))
    large.see_until(goal, *DONE, limit_s=600.0)
    assert large.goal(goal).state is GoalState.SUCCEEDED


def test_a_search_that_asks_is_still_one_after_a_restart() -> None:
    large, goal = searched(Find(object="cup")), "g1"
    entry = next(e for e in reversed(large.disk_entries) if any(m.id == goal for m in e.missions))
    kept = next(m for m in entry.missions if m.id == goal)
    again = Mission.model_validate_json(kept.model_dump_json())
    assert isinstance(again.skill_state, FindState)
    assert again.skill_state.offered
