"""Do each kind of step: one pure function a kind, in a file with its law and its budget.

``act_of(scene)`` returns what is to be done next for a step. What needs a camera has no skill yet
and is refused before anything moves.
"""

from collections.abc import Callable
from types import MappingProxyType

from planner.mission.skills.act import (
    Act,
    Cannot,
    Done,
    Drive,
    Later,
    Question,
    Scene,
    Skip,
    Speak,
    Stand,
    Think,
    Way,
)
from planner.mission.skills.ask import ask
from planner.mission.skills.come_back import come_back
from planner.mission.skills.decide import decide
from planner.mission.skills.go_to import go_to
from planner.mission.skills.move import move, no_room
from planner.mission.skills.patrol import patrol
from planner.mission.skills.return_home import return_home
from planner.mission.skills.say import say
from planner.mission.skills.turn import turn
from planner.mission.skills.wait import wait
from planner.plan import NEEDS_CAMERA, Code, message, same

SKILLS: MappingProxyType[str, Callable[[Scene], Act]] = MappingProxyType(
    {
        "go_to": go_to,
        "come_back": come_back,
        "return_home": return_home,
        "turn": turn,
        "move": move,
        "patrol": patrol,
        "wait": wait,
        "say": say,
        "ask": ask,
        "decide": decide,
    }
)


def act_of(scene: Scene) -> Act:
    """Return what a step asks for now; a kind without a skill can't be done."""
    skill = SKILLS.get(scene.step.kind)
    if skill is not None:
        return skill(scene)
    code = Code.NO_CAMERA if scene.step.kind in NEEDS_CAMERA else Code.NO_CAPABILITY
    return Cannot(code, code.value, message(code, part=same(scene.step.kind)))


__all__ = [
    "SKILLS",
    "Act",
    "Cannot",
    "Done",
    "Drive",
    "Later",
    "Question",
    "Scene",
    "Skip",
    "Speak",
    "Stand",
    "Think",
    "Way",
    "act_of",
    "no_room",
]
