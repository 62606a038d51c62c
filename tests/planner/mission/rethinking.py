"""Let each goal's brain think again, one answer of a script after the other."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

from planner.mission.effects import AskBrain
from planner.mission.events import Planned
from planner.plan import BrainTag, Outcome
from tests.planner.mission.lockstep import Together

TAG = BrainTag(name="b", version="1")
SHUT = "no_route"


@dataclass
class Rethinking(Together):
    """Let each goal's brain give one answer after the other; None: it thinks on."""

    thoughts: list[Any] = field(default_factory=list)
    asked: list[AskBrain] = field(default_factory=list)
    tag: BrainTag = TAG

    def answer(self, effect: Any) -> None:
        if isinstance(effect, AskBrain):
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
