"""Drive an engine against the fake bridge in simulated time: every effect is answered at once."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field, replace
from typing import Any

from planner.bridge_client import Identity
from planner.mission import effects
from planner.mission.engine import Engine, Output
from planner.mission.events import Event, Journalled, Planned, Restarted, Sighted, Submitted
from planner.mission.state import Mission, MissionState
from planner.navigation import RoutePoint
from planner.perception.snapshot import LookSnapshot, Sight, Thing
from planner.plan import BrainTag, GoalState, GoTo, Language, Outcome, Say, StepPlan, Wait
from planner.skills import Eyesight, Way
from tests.planner.mission.fakes import FACTS, HASH, PERIOD_S, FakeBridge, straight
from wire import CameraConfig, Mode, Pose2

Reply = Callable[[effects.AskBrain], Planned | None]
WayAnswer = Callable[[effects.AskRoute], str | None]
"""Return the code of a failure, or None for a straight way."""


def go(*places: str) -> StepPlan:
    """Return a plan that goes to places."""
    return StepPlan(steps=tuple(GoTo(place=place) for place in places))


def talk(text: str = "hello", seconds: float = 0.2) -> StepPlan:
    """Return a plan that says something, then waits."""
    return StepPlan(steps=(Say(text=text), Wait(seconds=seconds)))


@dataclass
class Together:
    """Hold planner and bridge on one simulated clock."""

    plans: dict[str, StepPlan | None] = field(default_factory=dict)
    bridge: FakeBridge = field(default_factory=FakeBridge)
    planner_id: str = "p1"
    disk: bool = True
    """Entries are safe at once; False: not before ``sync``."""
    way: WayAnswer = lambda ask: None
    ends: Pose2 | None = None
    """Where every way ends, whatever its goal."""
    faces: tuple[float, float] | None = None
    """What the end of every way is to face."""
    aside_m: float = 0.0
    """So far to the left leads every way that was asked for because another is doubted."""
    stays_aside: bool = False
    """A way aside ends where the robot stands: it can be passed there."""
    now_s: float = 100.0
    disk_entries: list[effects.Journal] = field(default_factory=list)
    said: list[str] = field(default_factory=list)
    routes: list[effects.AskRoute] = field(default_factory=list)
    dropped: list[str] = field(default_factory=list)
    cleared: list[str] = field(default_factory=list)
    """Goals whose person's act was brought to the bridge; ``act`` clears its hold."""
    ids: int = 0

    def __post_init__(self) -> None:
        self.engine = Engine(MissionState(FACTS), Identity(self.planner_id, HASH, HASH, HASH))

    @property
    def book(self) -> MissionState:
        return self.engine.book

    def goal(self, goal_id: str) -> Mission:
        return self.book.missions[goal_id]

    def event(self, event: Event) -> None:
        self.carry(self.engine.event(event, self.now_s))

    def give(self, plan: StepPlan | None, **more: Any) -> str:
        """Submit a goal that the brain will answer with this plan; None: it thinks on."""
        self.ids += 1
        goal_id = f"g{self.ids}"
        self.plans[goal_id] = plan
        self.event(Submitted(goal_id, f"text {goal_id}", Language.EN, **more))
        return goal_id

    def act(self) -> None:
        """Clear the bridge's hold as a person's ``op/resume`` does."""
        self.bridge.held = None

    def carry(self, output: Output) -> None:
        for message in output.messages:
            self.bridge.hear(message)
        for effect in output.effects:
            self.answer(effect)

    def answer(self, effect: effects.Effect) -> None:
        match effect:
            case effects.Journal():
                self.disk_entries.append(effect)
                if self.disk:
                    self.carry(self.engine.event(Journalled(effect.entry), self.now_s))
            case effects.AskBrain():
                plan = self.plans.get(effect.id)
                if plan is not None:
                    self.event(Planned(effect.id, plan))
            case effects.AskRoute():
                self.routes.append(effect)
                failure = self.way(effect)
                points = self.lay(effect) if failure is None else None
                floor, faces = None, self.faces
                output = self.engine.take_route(effect, points, failure, self.now_s, floor, faces)
                self.carry(output)
            case effects.SayAloud():
                self.said.append(effect.text)
            case effects.ClearHold():
                self.cleared.append(effect.id)
            case effects.DropBrain():
                self.dropped.append(effect.id)
            case effects.GoalChange():
                pass

    def lay(self, ask: effects.AskRoute) -> tuple[RoutePoint, ...]:
        """Return a straight way, or one with a bend in its middle."""
        start, goal = ask.request.start, self.ends or ask.request.goal
        if ask.way is Way.ASIDE and self.stays_aside:
            return (RoutePoint(start.x_m, start.y_m, 0.05),)
        if not (ask.request.strict and self.aside_m):
            return straight(start, goal)
        middle_m = ((start.x_m + goal.x_m) / 2, (start.y_m + goal.y_m) / 2)
        bend = Pose2(middle_m[0], middle_m[1] + self.aside_m, 0.0)
        return (*straight(start, bend), *straight(bend, goal)[1:])

    def sync(self) -> None:
        """Let the disk catch up."""
        for entry in tuple(self.disk_entries):
            self.carry(self.engine.event(Journalled(entry.entry), self.now_s))

    def run(self, seconds: float = PERIOD_S, every_s: float = PERIOD_S) -> None:
        """Let simulated time pass, one status in each ``every_s``."""
        for _ in range(max(1, round(seconds / every_s))):
            self.now_s += every_s
            self.carry(self.engine.status(self.bridge.step(), self.now_s))

    def run_until(self, goal_id: str, *states: GoalState, limit_s: float = 60.0) -> Mission:
        """Let time pass until a goal is in one of these states."""
        end_s = self.now_s + limit_s
        while self.goal(goal_id).state not in states:
            assert self.now_s < end_s, f"{goal_id} is still {self.goal(goal_id)}"
            self.run()
        return self.goal(goal_id)

    def restart(self, planner_id: str = "p2") -> Together:
        """Return a new planner process on the same disk and bridge; ours is dead."""
        newest: dict[str, Mission] = {}
        for entry in self.disk_entries:
            newest.update({m.id: m for m in entry.missions})
        queue = self.disk_entries[-1].queue if self.disk_entries else ()
        bridge = self.bridge
        bridge.lose_owner()
        after = Together(plans=self.plans, bridge=bridge, planner_id=planner_id, now_s=self.now_s)
        after.ids = self.ids
        after.event(Restarted(tuple(newest.values()), queue, 0.0))
        return after


RUNNING, PAUSED, QUEUED = GoalState.RUNNING, GoalState.PAUSED, GoalState.QUEUED
SUCCEEDED, FAILED, CANCELLED = GoalState.SUCCEEDED, GoalState.FAILED, GoalState.CANCELLED


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
            look = LookSnapshot(self.seq, self.now_s, None, 320, 240, ())
            self.event(Sighted(Sight(look, fresh, self.blind)))

    def see_until(self, goal: str, *states: GoalState, limit_s: float = 120.0) -> None:
        end_s = self.now_s + limit_s
        while self.goal(goal).state not in states:
            assert self.now_s < end_s, self.goal(goal)
            self.see(0.2)


TAG = BrainTag(name="b", version="1")
SHUT = "no_route"


@dataclass
class Rethinking(Together):
    """Let each goal's brain give one answer after the other; None: it thinks on."""

    thoughts: list[Any] = field(default_factory=list)
    asked: list[effects.AskBrain] = field(default_factory=list)
    tag: BrainTag = TAG

    def answer(self, effect: Any) -> None:
        if isinstance(effect, effects.AskBrain):
            self.asked.append(effect)
            thought = self.thoughts.pop(0) if self.thoughts else None
            if thought is not None:
                down = isinstance(thought, Outcome)
                self.event(Planned(effect.id, None if down else thought,
                                   thought if down else None, self.tag))  # fmt: skip
            return
        super().answer(effect)


def rethinking(*thoughts: Any, shut: bool = False) -> Rethinking:
    """Return a world of these thoughts, in which every way is shut or none."""
    world = Rethinking(thoughts=list(thoughts), way=lambda _: SHUT if shut else None)
    world.run(0.2)
    return world


def given(*thoughts: Any, shut: bool = False) -> tuple[Rethinking, str]:
    """Return such a world with a goal that was given to it."""
    world = rethinking(*thoughts, shut=shut)
    return world, world.give(None)
