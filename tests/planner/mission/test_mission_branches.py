"""Tell goals whose plan holds a condition, a fallback or a round: what is walked, what is told."""

from __future__ import annotations

import asyncio
from dataclasses import dataclass, field, replace
from math import cos, pi, sin
from typing import Any

import pytest

from planner.memory import KeptPicture
from planner.mission.effects import SavePicture
from planner.mission.events import Restarted, Resume
from planner.mission.outcomes import looks_into
from planner.mission.state import Mission
from planner.perception.interfaces import Picture
from planner.perception.snapshot import Sight
from planner.plan import (
    Ask,
    Attempt,
    ClockTime,
    Code,
    ComeBack,
    Find,
    GoalState,
    GoTo,
    If,
    Look,
    Patrol,
    Repeat,
    Say,
    Step,
    StepPlan,
    StepState,
    Wait,
    WaitFor,
)
from planner.plan.plan_walk import NOT_CHOSEN
from planner.site.polygon import contains
from tests.planner.mission.fakes import FACTS, outcome_of
from tests.planner.mission.lockstep import Together
from tests.planner.mission.telling import Telling, thing, untruths
from wire import Image, Pose2

CUP = thing("cup", 1.5, 0.0, "hall")
FAR_CUP = thing("cup", 4.5, 0.5, "kitchen")
PERSON = thing("person", 4.5, 0.5, "kitchen")
NAMES = {place: target.name for place, target in FACTS.targets.items()}
THEN, ELSE = Say(text="then"), Say(text="else")
KITCHEN, DOCK = GoTo(place="kitchen"), GoTo(place="dock")
IN_KITCHEN = Look(question="is anybody there?", place="kitchen")


def plan(*steps: Step) -> StepPlan:
    return StepPlan(steps=steps)


def chooses(when: Any) -> StepPlan:
    """Return a plan that says "then" where this holds, and "else" where it does not."""
    return plan(If(when=when, then=(THEN,), otherwise=(ELSE,)))


def kinds_done(mission: Any) -> list[str]:
    return [s.kind for s in mission.steps if s.state is StepState.SUCCEEDED]


def test_the_branch_that_the_look_calls_for_is_walked_and_the_other_is_not() -> None:
    for there, walked in ((True, "then"), (False, "else")):
        world = Telling(truth=(PERSON,) if there else ())
        mission = world.play(chooses(IN_KITCHEN))
        said = [s for s in mission.steps if s.kind == "say"]
        assert mission.state is GoalState.SUCCEEDED
        assert [s.text for s in said if s.state is StepState.SUCCEEDED] == [walked]
        assert [s.reason for s in said if s.state is StepState.SKIPPED] == [NOT_CHOSEN]
        assert len(world.asked) == 1, "nobody thinks again"
        assert not untruths(mission, NAMES)


def test_an_if_without_a_second_branch_goes_on_behind_it() -> None:
    world = Telling()
    mission = world.play(plan(If(when=IN_KITCHEN, then=(THEN,)), Say(text="after")))
    assert mission.state is GoalState.SUCCEEDED
    assert kinds_done(mission) == ["if", "look", "say"]
    assert "then" not in outcome_of(mission).message.en
    assert "Not done" not in outcome_of(mission).message.en


def test_what_nobody_can_tell_takes_neither_branch_and_says_so() -> None:
    world = Telling(truth=(PERSON,), unseen=(PERSON.id,))
    world.model.manner = "affirms"  # the detector says no, the model says yes
    mission = world.play(chooses(IN_KITCHEN))
    assert mission.state is GoalState.FAILED
    assert outcome_of(mission).code is Code.UNSURE
    assert outcome_of(mission).message.en.startswith("I can't tell, so I do neither.")
    assert outcome_of(mission).message.zh.startswith("我判断不了，所以两样都没有做。")
    assert "say" not in kinds_done(mission)


def test_what_only_a_model_sees_steers_by_one_bit() -> None:
    door = Look(question="is the door open?")
    for manner, walked in (("affirms", "then"), ("denies", "else")):
        world = Telling()
        world.model.manner = manner
        mission = world.play(plan(If(when=door, then=(KITCHEN,), otherwise=(ELSE,))))
        assert mission.state is GoalState.SUCCEEDED, mission.outcome
        assert ("go_to" in kinds_done(mission)) is (walked == "then"), mission.steps
        assert len(world.asked) == 1


def test_a_model_that_is_down_or_only_describes_takes_neither_branch() -> None:
    for manner in ("down", "describes"):
        world = Telling()
        world.model.manner = manner
        door = Look(question="is the door open?")
        mission = world.play(plan(If(when=door, then=(KITCHEN,))))
        assert outcome_of(mission).code is Code.UNSURE
        assert world.bridge.moved_epochs == []


def test_a_search_that_finds_nothing_is_a_no_and_no_failure() -> None:
    search = Find(object="cup", place="kitchen")
    for truth, walked in (((FAR_CUP,), "then"), ((), "else")):
        world = Telling(truth=truth)
        mission = world.play(chooses(search))
        assert mission.state is GoalState.SUCCEEDED, mission.outcome
        assert world.said == [walked]


def test_a_room_that_was_not_looked_in_is_not_empty() -> None:
    world = Telling()
    world.shut((FACTS.targets["kitchen"].pose,))
    search = Find(object="cup", place="kitchen")
    mission = world.play(plan(If(when=search, then=(Say(text="a"),), otherwise=(Say(text="b"),))))
    assert mission.state is GoalState.FAILED
    assert world.said == []


def test_an_answer_chooses_and_what_is_neither_is_asked_once_more() -> None:
    asks = Ask(question="May I come in?")
    steps = plan(If(when=asks, then=(KITCHEN,), otherwise=(ELSE,)))
    for replies, moves in ((["yes"], True), (["no"], False), (["tea", "yes please"], True)):
        world = Telling(replies=list(replies))
        mission = world.play(steps)
        assert mission.state is GoalState.SUCCEEDED, (replies, mission.outcome)
        assert bool(world.bridge.moved_epochs) is moves
        assert world.answers == replies
    world = Telling(replies=["tea", "coffee"])
    mission = world.play(steps)
    assert outcome_of(mission).code is Code.UNSURE
    assert world.bridge.moved_epochs == []


def test_where_a_step_fails_the_plan_has_a_way_of_its_own() -> None:
    world = Telling()
    world.shut((FACTS.targets["kitchen"].pose,))
    mission = world.play(
        plan(
            Attempt(
                steps=(KITCHEN, Say(text="dinner is ready")),
                on_failure=(Say(text="dinner is ready, here"),),
            )
        )
    )
    assert mission.state is GoalState.SUCCEEDED
    assert world.said == ["dinner is ready, here"]
    assert len(world.asked) == 1, "nobody thinks again"
    assert outcome_of(mission).code is Code.DONE, "nobody arrived"
    assert outcome_of(mission).message.en == (
        "I found no way to the kitchen. Instead: I said “dinner is ready, here”."
    )
    assert not untruths(mission, NAMES)


def test_a_way_that_is_free_leaves_the_fallback_out() -> None:
    world = Telling()
    mission = world.play(
        plan(
            Attempt(steps=(KITCHEN,), on_failure=(DOCK,)),
            Say(text="after"),
        )
    )
    assert kinds_done(mission) == ["try", "go_to", "say"]
    assert outcome_of(mission).message.en == "Arrived: kitchen. I said “after”."


def test_a_fallback_that_fails_too_ends_the_goal_with_both() -> None:
    world = Telling()
    world.shut((FACTS.targets["kitchen"].pose, FACTS.targets["dock"].pose))
    mission = world.play(plan(Attempt(steps=(KITCHEN,), on_failure=(DOCK,))))
    assert mission.state is GoalState.FAILED
    assert "kitchen" in outcome_of(mission).message.en
    assert "dock" in outcome_of(mission).message.en


def test_rounds_are_counted_and_told() -> None:
    world = Telling(truth=(CUP,))
    mission = world.play(plan(Repeat(times=2, steps=(Look(question="is there a cup?"),))))
    assert mission.state is GoalState.SUCCEEDED
    assert mission.steps[0].round == 2
    assert outcome_of(mission).message.en.startswith("2 times: Yes, I see a cup")


def test_a_repeat_ends_as_soon_as_it_holds_and_fails_where_it_never_does() -> None:
    seen = Look(question="is there a cup?")
    mission = None
    for truth, rounds, state in ((CUP,), 1, GoalState.SUCCEEDED), ((), 3, GoalState.FAILED):
        world = Telling(truth=truth)
        mission = world.play(plan(Repeat(times=3, steps=(Wait(seconds=1.0),), until=seen)))
        assert (mission.state, mission.steps[0].round) == (state, rounds)
    assert mission is not None
    assert outcome_of(mission).code is Code.UNMET
    assert "It did not come to that within 3 rounds." in outcome_of(mission).message.en


def test_a_repeat_for_a_time_ends_with_it() -> None:
    world = Telling()
    mission = world.play(plan(Repeat(seconds=5.0, steps=(Wait(seconds=2.0),))))
    assert mission.state is GoalState.SUCCEEDED
    assert mission.steps[0].round == 3


def test_the_clock_chooses() -> None:
    always = chooses(ClockTime(after="00:00"))
    world = Telling()
    world.play(always)
    assert world.said == ["then"]


def test_who_waits_for_somebody_stands_until_they_come() -> None:
    somebody = thing("person", 2.0, 0.0, "hall")
    world = Telling()
    world.thoughts = [plan(WaitFor(object="person", seconds=60.0), Say(text="welcome"))]
    goal = world.give(None)
    world.see(10.0)
    assert world.said == []
    assert world.goal(goal).state is GoalState.RUNNING
    world.truth = (somebody,)
    world.see(4.0)
    assert world.said == ["welcome"]
    assert world.goal(goal).state is GoalState.SUCCEEDED
    assert world.bridge.moved_epochs == []


def test_nobody_comes_and_that_is_told() -> None:
    world = Telling()
    mission = world.play(plan(WaitFor(object="person", seconds=5.0), Say(text="welcome")))
    assert mission.state is GoalState.FAILED
    assert outcome_of(mission).code is Code.UNMET
    assert world.bridge.moved_epochs == []
    assert world.said == []


def test_a_word_lets_it_go_on_and_another_does_not() -> None:
    world = Telling(replies=["not yet", "ok, GO!"])
    mission = world.play(plan(WaitFor(word="go"), KITCHEN))
    assert mission.state is GoalState.SUCCEEDED
    assert world.answers == ["not yet", "ok, GO!"]


def test_a_failure_in_a_branch_comes_back_where_the_order_says() -> None:
    world = Telling()
    mission = world.play(
        plan(
            If(when=ClockTime(after="00:00"), then=(Find(object="cup"),)),
            ComeBack(),
            Say(text="x"),
        ),
        None,
    )
    assert mission.state is GoalState.FAILED
    assert kinds_done(mission)[-1] == "come_back"
    assert world.said == []


TWICE_THEN_BACK = plan(
    Repeat(times=2, steps=(KITCHEN, Say(text="round"), GoTo(place="hall"))),
    If(when=ClockTime(after="00:00"), then=(THEN,), otherwise=(ELSE,)),
    Attempt(steps=(KITCHEN,), on_failure=(Say(text="failed"),)),
)


@pytest.mark.parametrize("after_s", range(1, 40, 3))
def test_a_planner_killed_in_a_round_or_a_branch_goes_on_there(
    world: Together, after_s: int
) -> None:
    goal = world.give(TWICE_THEN_BACK)
    world.run(float(after_s))
    before = world.goal(goal)
    assert before.state is GoalState.RUNNING
    after = world.restart()
    assert after.goal(goal).state is GoalState.PAUSED
    assert after.goal(goal).steps == before.steps, "what was done is known"
    standing = after.bridge.pose
    after.run(2.0)
    assert after.bridge.pose == standing, "nothing moves before a person acts"
    after.act()
    after.event(Resume(goal))
    mission = after.run_until(goal, GoalState.SUCCEEDED, GoalState.FAILED, limit_s=120.0)
    assert mission.state is GoalState.SUCCEEDED
    assert mission.steps[0].round == 2
    words = [*world.said, *after.said]
    assert words.count("round") <= 2
    assert words.count("then") <= 1
    assert not {"else", "failed"} & set(words)


@pytest.mark.parametrize("after_s", range(1, 12, 2))
def test_a_planner_killed_while_it_looks_for_a_condition_chooses_the_same_branch(
    after_s: int,
) -> None:
    world = Telling(truth=(PERSON,))
    steps = chooses(IN_KITCHEN)
    world.thoughts = [steps]
    goal = world.give(None)
    world.see(float(after_s))
    if world.goal(goal).has_ended:
        return
    again = Telling(truth=(PERSON,), bridge=world.bridge, planner_id="p2", now_s=world.now_s)
    world.bridge.lose_owner()
    again.ids = world.ids
    again.event(Restarted(tuple(world.book.missions.values()), (), 0.0))
    again.see(1.0)
    again.act()
    again.event(Resume(goal))
    end_s = again.now_s + 120.0
    while not again.goal(goal).has_ended:
        assert again.now_s < end_s, again.goal(goal)
        again.see(0.2)
    assert again.said == ["then"]


ROUND = StepPlan(steps=(Patrol(places=("hall", "kitchen"), look=True),))
JPEG = b"\xff\xd8 a picture"


@dataclass
class Patrolling(Telling):
    """Keep what patrols want kept; its camera makes JPEG."""

    album: list[tuple[KeptPicture, bytes]] = field(default_factory=list)

    def __post_init__(self) -> None:
        super().__post_init__()
        self.door.keep_in(self.keep)

    async def keep(self, picture: KeptPicture, data: bytes) -> None:
        self.album.append((picture, data))

    @property
    def looked_picture(self) -> Picture | None:
        shown = super().looked_picture
        return shown and Picture(Image(shown.color.header, JPEG), None, shown.taken_s)

    def answer(self, effect: Any) -> None:
        if isinstance(effect, SavePicture):
            saving = self.door.save(effect)
            assert saving is not None, "the picture is the one that is meant"
            asyncio.run(saving)
            return
        super().answer(effect)


def told(mission: Mission) -> str:
    return outcome_of(mission).message.en


def test_what_was_seen_where_is_told_at_the_end() -> None:
    world = Patrolling(truth=(CUP, PERSON))
    mission = world.play(ROUND)
    assert mission.state is GoalState.SUCCEEDED, mission.outcome
    assert outcome_of(mission).code is Code.SEEN
    assert told(mission) == "hall: a cup. kitchen: a person."
    assert "一个杯子。" in outcome_of(mission).message.zh
    (step,) = mission.steps
    assert (step.visited, [stop.place for stop in step.stops]) == (2, ["hall", "kitchen"])
    assert not untruths(mission, NAMES)
    kept = {(p.goal, p.step, p.stop, p.place) for p, _ in world.album}
    assert kept == {(mission.id, 0, 0, "hall"), (mission.id, 0, 1, "kitchen")}
    assert {data for _, data in world.album} == {JPEG}


def test_a_patrol_that_only_visits_looks_at_nothing() -> None:
    world = Patrolling(truth=(CUP, PERSON))
    mission = world.play(StepPlan(steps=(Patrol(places=("hall", "kitchen")),)))
    assert told(mission) == "Visited one after the other: hall, kitchen."
    assert world.album == []


def test_a_stop_without_a_way_is_told_and_passed_over() -> None:
    world = Patrolling(truth=(PERSON,))
    world.shut((FACTS.targets["hall"].pose,))
    mission = world.play(ROUND)
    assert mission.state is GoalState.SUCCEEDED
    assert told(mission) == "hall: I found no way there. kitchen: a person."
    assert mission.steps[0].visited == 1
    world = Patrolling()
    world.shut(tuple(target.pose for target in FACTS.targets.values()))
    mission = world.play(ROUND, None)
    assert mission.state is GoalState.FAILED
    assert outcome_of(mission).code is Code.NO_ROUTE
    assert "hall: I found no way there. kitchen: I found no way there." in told(mission)


@dataclass
class GoesBlind(Patrolling):
    """Lose its pictures once the robot is in the kitchen."""

    def see(self, seconds: float) -> None:
        if self.bridge.pose.x_m < 3.5:
            super().see(seconds)
            return
        self.run(seconds)


def test_what_was_seen_before_the_eyes_went_blind_is_told() -> None:
    world = GoesBlind(truth=(CUP, PERSON))
    mission = world.play(ROUND, None)
    assert mission.state is GoalState.FAILED
    assert outcome_of(mission).code is Code.BLIND
    assert told(mission).startswith("hall: a cup. ")


def test_a_robot_that_recognises_nothing_drives_on_and_says_so() -> None:
    world = Patrolling()
    world.sight = Sight(blind="no_detector")
    world.engine.book = replace(world.book, sight=world.sight)
    world.thoughts = [ROUND]
    goal = world.give(None)
    mission = world.run_until(goal, GoalState.SUCCEEDED, GoalState.FAILED)
    assert mission.state is GoalState.SUCCEEDED
    assert told(mission).count("nothing here recognises what my camera shows") == 2


@pytest.mark.parametrize("after_s", range(2, 26, 3))
def test_killed_at_a_stop_it_looks_there_anew_and_forgets_none_before(after_s: int) -> None:
    world = Patrolling(truth=(CUP, PERSON))
    world.thoughts = [ROUND]
    goal = world.give(None)
    world.see(float(after_s))
    before = world.goal(goal)
    if before.has_ended:
        return
    again = Patrolling(truth=(CUP, PERSON), bridge=world.bridge, planner_id="p2", now_s=world.now_s)
    world.bridge.lose_owner()
    again.ids = world.ids
    newest = {m.id: m for entry in world.disk_entries for m in entry.missions}
    again.event(Restarted(tuple(newest.values()), world.disk_entries[-1].queue, 0.0))
    standing = again.bridge.pose
    again.see(2.0)
    assert again.bridge.pose == standing, "nothing moves before a person acts"
    again.act()
    again.event(Resume(goal))
    for _ in range(600):
        again.see(0.2)
        if again.goal(goal).has_ended:
            break
    mission = again.goal(goal)
    assert mission.state is GoalState.SUCCEEDED, mission.outcome
    assert told(mission) == "hall: a cup. kitchen: a person."


def test_rounds_look_at_every_stop_again() -> None:
    world = Patrolling(truth=(CUP,))
    mission = world.play(
        StepPlan(
            steps=(Repeat(times=2, steps=(Patrol(places=("hall",), look=True),)), Say(text="x"))
        )
    )
    assert mission.state is GoalState.SUCCEEDED
    assert told(mission) == "2 times: hall: a cup. I said “x”."


@pytest.mark.parametrize("place", ["hall", "kitchen"])
def test_what_is_seen_through_a_door_is_of_another_room(place: str) -> None:
    """Of the pictures of a stop, one that looks into its own room is kept for what it shows."""
    target = FACTS.targets[place]
    assert target.polygon is not None
    for number in range(16):
        pose = replace_yaw(target.pose, number / 16 * 2 * pi)
        ahead = (pose.x_m + cos(pose.yaw_rad), pose.y_m + sin(pose.yaw_rad))
        assert looks_into(FACTS, place, pose) is contains(target.polygon, *ahead)
    assert looks_into(FACTS, place, None)
    assert looks_into(FACTS, "nowhere", target.pose)


def test_labels_of_another_room_do_not_choose_the_picture() -> None:
    world = Patrolling(truth=(CUP, PERSON))
    world.play(ROUND)
    out = [p for p, _ in world.album if p.place == "kitchen" and "cup" in p.labels]
    assert out == [], "the cup is in the hall"


def replace_yaw(pose: Pose2, yaw_rad: float) -> Pose2:
    return Pose2(pose.x_m, pose.y_m, yaw_rad)
