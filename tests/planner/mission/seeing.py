"""Let a mission see, in simulated time: pictures come, with the things in them that a test puts."""

from __future__ import annotations

from dataclasses import replace

from planner.mission.events import Sighted
from planner.perception.snapshot import LookSnapshot, Sight, Thing
from planner.plan import GoalState
from planner.skills import Eyesight
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
            look = LookSnapshot(self.seq, self.now_s, None, 320, 240, ())
            self.event(Sighted(Sight(look, fresh, self.blind)))

    def see_until(self, goal: str, *states: GoalState, limit_s: float = 120.0) -> None:
        end_s = self.now_s + limit_s
        while self.goal(goal).state not in states:
            assert self.now_s < end_s, self.goal(goal)
            self.see(0.2)
