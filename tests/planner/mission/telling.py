"""Play goals with a brain, a detector and a vision model that a test scripts; judge what is told.

The robot turns, so a picture shows what lies before it and nothing else. The model stands behind
the missions' own door: it is shown what that hands out, and answers by it as its script lets it.
"""

from __future__ import annotations

import asyncio
import re
from dataclasses import dataclass, field, replace
from math import atan2, hypot
from typing import Any, cast

from planner.brain.errors import BrainDown
from planner.brain.image_questions import ImageDescription, ImageQuestion
from planner.language.catalogue import message
from planner.mission.effects import AskBrain, AskEyes, KeepPicture
from planner.mission.events import Confirm, Planned, Reply, Sighted
from planner.mission.perception_requests import EyeDoor
from planner.mission.state import Mission
from planner.perception.interfaces import Eyes, Picture
from planner.perception.snapshot import LookSnapshot, Sight, Thing
from planner.plan import (
    Bilingual,
    BrainTag,
    Code,
    GoalState,
    Language,
    Outcome,
    StepRecord,
    StepState,
)
from planner.skills import Eyesight
from tests.planner.mission.lockstep import Together
from wire import CameraConfig, Image, ImageHeader, Pose2, wrap

CAMERA = CameraConfig()
EYES = Eyesight(CAMERA, ("cup", "person", "chair", "table"), model=True)
TAG = BrainTag(name="scripted", version="1")
DOWN = Outcome(code=Code.MODEL_UNAVAILABLE, message=message(Code.MODEL_UNAVAILABLE))
SEES_M = 3.0
ENDED = (GoalState.SUCCEEDED, GoalState.FAILED, GoalState.REFUSED, GoalState.CANCELLED)
SHUT = "no_route"


def thing(label: str, x_m: float, y_m: float, room: str) -> Thing:
    """Return a thing that stands there, well known once it is seen."""
    return Thing(f"{label}_{x_m}_{y_m}", label, None, x_m, y_m, 0.8, 0.05, 0.9, 0.0, 0.0, 5, room)


def is_shown(pose: Pose2 | None, one: Thing) -> bool:
    """Tell whether a thing lies in the picture that is taken from a pose."""
    if pose is None:
        return False
    dx, dy = one.x_m - pose.x_m, one.y_m - pose.y_m
    aside = wrap(atan2(dy, dx) - pose.yaw_rad)
    return abs(aside) <= CAMERA.fov_rad / 2.0 and hypot(dx, dy) <= SEES_M


@dataclass
class Model:
    """Look at the pictures that it is shown, and answer as its script says."""

    world: Telling
    manner: str = "honest"
    """``honest``, ``denies`` and ``affirms`` whatever it sees, ``describes`` alone, ``down``."""
    asked: list[ImageQuestion] = field(default_factory=list)

    @property
    def tag(self) -> BrainTag:
        return TAG

    async def describe(self, asked: ImageQuestion) -> ImageDescription:
        self.asked.append(asked)
        if self.manner == "down":
            raise BrainDown("503", why="server_error")
        shown = [view.picture for view in asked.views] or [asked.picture]
        label = "person" if re.search(r"body|人", asked.words) else "cup"
        there = any(
            is_shown(picture.base_in_map, one)
            for picture in shown
            for one in self.world.truth
            if one.label == label
        )
        seen = {"denies": False, "affirms": True, "describes": None}.get(self.manner, there)
        words = Bilingual(en="Somebody or something.", zh="有的。") if seen else NOTHING
        return ImageDescription(words, seen, TAG)

    async def point(self, asked: ImageQuestion) -> Any:
        raise BrainDown("503", why="server_error")

    async def seek(self, asked: ImageQuestion) -> Any:
        raise BrainDown("503", why="server_error")


NOTHING = Bilingual(en="Only a wall and an armchair", zh="只有墙和一把扶手椅")


@dataclass
class Telling(Together):
    """Give each goal one thought after the other; take pictures where the robot faces."""

    thoughts: list[Any] = field(default_factory=list)
    asked: list[AskBrain] = field(default_factory=list)
    replies: list[str] = field(default_factory=list)
    answers: list[str] = field(default_factory=list)
    """Answers that were given."""
    truth: tuple[Thing, ...] = ()
    unseen: tuple[str, ...] = ()
    """Ids of what the detector misses."""
    seq: int = 0
    forgets: bool = False
    """The pictures of directions are gone when the model is asked, as after a crash."""

    def __post_init__(self) -> None:
        super().__post_init__()
        self.model = Model(self)
        self.door = EyeDoor(cast("Eyes", self), self.model)
        self.known: dict[str, Thing] = {}
        self.sight = Sight()
        self.engine.book = replace(self.book, eyes=EYES, sight=self.sight)
        self.run(0.2)

    # What the door asks of eyes

    @property
    def looked_picture(self) -> Picture | None:
        if self.sight.look is None:
            return None
        header = ImageHeader(
            boot_id="b", seq=self.sight.look.seq, stamp_s=self.now_s, width=320, height=240,
            focal_px=200.0, center_x_px=160.0, center_y_px=120.0,
        )  # fmt: skip
        return Picture(Image(header, b"jpeg"), None, self.now_s)

    picture = looked_picture

    async def fresh(self) -> Picture | None:
        return self.looked_picture

    def crash(self) -> None:
        """Lose the pictures that were kept, as with a process that ends."""
        self.door = EyeDoor(cast("Eyes", self), self.model)

    def see(self, seconds: float) -> None:
        """Let time pass; a picture each fifth of a second."""
        for _ in range(max(1, round(seconds / 0.2))):
            self.run(0.2)
            self.seq += 1
            pose = self.bridge.pose
            for one in self.truth:
                if is_shown(pose, one) and one.id not in self.unseen:
                    self.known[one.id] = replace(one, seen_s=self.now_s)
            look = LookSnapshot(self.seq, self.now_s, pose, 320, 240, ())
            self.sight = Sight(look, tuple(self.known.values()))
            self.event(Sighted(self.sight, EYES.classes))

    def answer(self, effect: Any) -> None:
        match effect:
            case AskBrain():
                self.asked.append(effect)
                plan = self.thoughts.pop(0) if self.thoughts else None
                failure = None if plan is not None else DOWN
                self.event(Planned(effect.id, plan, failure, TAG))
            case KeepPicture():
                self.door.keep(effect)
            case AskEyes():
                if self.forgets:
                    self.crash()
                self.event(asyncio.run(self.door.ask(effect)))
            case _:
                super().answer(effect)

    def shut(self, poses: tuple[Pose2, ...]) -> None:
        """Leave no way to these poses."""
        self.way = lambda ask: SHUT if ask.request.goal in poses else None

    def play(self, *thoughts: Any, limit_s: float = 240.0) -> Mission:
        """Let a goal with these thoughts end: questions are answered in turn, plans confirmed."""
        self.thoughts = list(thoughts)
        goal, end_s = self.give(None), self.now_s + limit_s
        while self.goal(goal).state not in ENDED:
            assert self.now_s < end_s, self.goal(goal)
            state = self.goal(goal).state
            if state is GoalState.NEEDS_CLARIFICATION:
                answer = self.replies.pop(0) if self.replies else "yes"
                self.answers.append(answer)
                self.event(Reply(goal, answer))
            elif state is GoalState.AWAITING_CONFIRMATION:
                self.event(Confirm(goal))
            self.see(0.2)
        return self.goal(goal)


_ARRIVED = (
    (Language.EN, re.compile(r"Arrived: ([^.]*)\."), ", then "),
    (Language.ZH, re.compile(r"我到了：([^。]*)。"), "，然后"),
)
_DRIVES = ("go_to", "return_home", "come_back")


def untruths(mission: Mission, names: dict[str, Bilingual]) -> list[str]:
    """Return what is wrong in what a goal tells at its end; nothing, if the laws hold.

    Args:
        mission: a goal that has ended.
        names: of places, by id.
    """
    assert mission.outcome is not None
    wrong: list[str] = []
    for language, arrived, comma in _ARRIVED:
        text = mission.outcome.message.of(language)
        for found in arrived.findall(text):
            for name in found.split(comma):
                drives = [s for s in mission.steps if s.kind in _DRIVES and s.place is not None
                          and s.state is not StepState.SKIPPED]  # fmt: skip
                last = [s for s in drives if names[s.place or ""].of(language) == name]
                if last and last[-1].state is not StepState.SUCCEEDED:
                    wrong.append(f"arrived at {name}: {text}")
        wrong += [
            f"untold {told!r}: {text}"
            for step in mission.steps
            for told in _to_be_told(step, language)
            if told not in text
        ]
    return wrong


def _to_be_told(step: StepRecord, language: Language) -> list[str]:
    """Return what of a step must stand in the end of its goal, word for word."""
    told: list[str] = []
    if step.kind == "say" and step.state is StepState.SUCCEEDED:
        told.append(step.text or "")
    if step.answer is not None:
        told.append(step.answer)
    if step.said is not None and (step.read is None or step.said.en.startswith("Yes")):
        told.append(step.said.of(language).rstrip(".。"))  # a detector's yes is never taken back
    if step.read is not None:
        told.append(step.read.of(language))
    return told
