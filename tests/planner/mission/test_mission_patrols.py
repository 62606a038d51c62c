"""A patrol looks at every stop, tells at its end what it saw where, and keeps a picture of each."""

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
from planner.plan import Code, GoalState, Patrol, Repeat, Say, StepPlan
from planner.site.polygon import contains
from tests.planner.mission.fakes import FACTS, outcome_of
from tests.planner.mission.telling import Telling, thing, untruths
from wire import Image, Pose2

CUP = thing("cup", 1.5, 0.0, "hall")
PERSON = thing("person", 4.5, 0.5, "kitchen")
NAMES = {place: target.name for place, target in FACTS.targets.items()}
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
