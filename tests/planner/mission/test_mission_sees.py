"""What sights do to a running mission: gazes, legs given up, walks laid anew, and nothing else."""

from __future__ import annotations

from dataclasses import replace

import pytest

from planner.mission.events import Sighted
from planner.mission.skills import Eyesight
from planner.plan import Code, Find, Follow, Frozen, GoalState, StepPlan, StepState
from planner.vision.records import Look, Sight, Thing
from tests.planner.mission.driving import FAILED, RUNNING, SUCCEEDED
from tests.planner.mission.lockstep import Together
from wire import CameraConfig

CUP = Thing("cup_1", "cup", "red", 5.0, 0.0, 0.8, 0.05, 0.9, 0.0, 0.0, 5, "kitchen")
ANNA = Thing("person_1", "person", None, 3.0, 0.0, 0.9, 0.05, 0.9, 0.0, 0.0, 5, "hall")


class Seeing(Together):
    """Look on while time passes: a new picture each fifth of a second, with these things in it."""

    things: tuple[Thing, ...] = ()
    blind: str | None = None
    seq = 0

    def open_eyes(self) -> None:
        self.engine.book = replace(self.book, eyes=Eyesight(CameraConfig()))

    def see(self, seconds: float) -> None:
        for _ in range(round(seconds / 0.2)):
            self.run(0.2)
            self.seq += 1
            fresh = tuple(replace(t, seen_s=self.now_s) for t in self.things)
            look = Look(self.seq, self.now_s, None, 320, 240, ())
            self.event(Sighted(Sight(look, fresh, self.blind)))

    def see_until(self, goal: str, *states: GoalState, limit_s: float = 120.0) -> None:
        end_s = self.now_s + limit_s
        while self.goal(goal).state not in states:
            assert self.now_s < end_s, self.goal(goal)
            self.see(0.2)


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
    while (walk := seeing.book.walk) is None or walk.goal is None or walk.goal.x_m < 3.0:
        seeing.see(0.2)
    assert seeing.goal(goal).state is RUNNING
    seeing.bridge.blocked = True
    seeing.see_until(goal, FAILED)
    mission = seeing.goal(goal)
    assert mission.outcome is not None
    assert mission.outcome.code is Code.NOT_FOUND
    assert mission.outcome.message.en == (
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
    views = len(seeing.goal(goal).notes.views)
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
