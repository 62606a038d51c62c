"""Do each kind of step: one pure function a kind, in a file with its law and its budget.

``act_of(scene)`` returns what is to be done next for a step. A plan was accepted whole before
(``planner.mission.plan_check``); here a step ends whose camera or detector is gone since then.
"""

from collections.abc import Callable
from types import MappingProxyType, NoneType
from typing import Any

from planner.language.catalogue import message, say_or_quote
from planner.plan import Code
from planner.skills.actions import (
    AskImage,
    CallTool,
    DriveLeg,
    Fail,
    Finish,
    LookUp,
    Observe,
    Question,
    Retry,
    Scene,
    SkillAction,
    Skip,
    Speak,
    Stand,
    Think,
    Way,
)
from planner.skills.ask import ask
from planner.skills.conditions import clock, judge_condition
from planner.skills.count import count
from planner.skills.drive_to_place import come_back, go_to, go_to_pose, return_home
from planner.skills.explore import explore
from planner.skills.find import find
from planner.skills.follow import follow
from planner.skills.go_to_object import go_to_object, go_to_point
from planner.skills.look import look
from planner.skills.measured_motions import move, no_room, turn
from planner.skills.patrol import patrol
from planner.skills.perception import Eyesight, ImageAnswer
from planner.skills.plain_steps import decide, recall, say, wait
from planner.skills.skill_state import STATES, SkillStateBase, begin_state
from planner.skills.stand_at import stand_at
from planner.skills.use_tool import use_tool
from planner.skills.wait_for import wait_for

SKILLS: MappingProxyType[str, Callable[[Scene[Any]], SkillAction]] = MappingProxyType(
    {
        "go_to": go_to,
        "go_to_pose": go_to_pose,
        "stand_at": stand_at,
        "come_back": come_back,
        "return_home": return_home,
        "turn": turn,
        "move": move,
        "patrol": patrol,
        "explore": explore,
        "wait": wait,
        "wait_for": wait_for,
        "clock": clock,
        "say": say,
        "ask": ask,
        "decide": decide,
        "find": find,
        "count": count,
        "look": look,
        "follow": follow,
        "go_to_object": go_to_object,
        "go_to_point": go_to_point,
        "recall": recall,
        "use_tool": use_tool,
    }
)


def act_of(scene: Scene[Any]) -> SkillAction:
    """Return a step's wish now; it fails where its camera or detector is gone by now.

    Raises:
        TypeError: the scene holds another skill's state.
    """
    kind, state = scene.step.kind, STATES.get(scene.step.kind, NoneType)
    if type(scene.state) is not state:
        got = type(scene.state).__name__
        raise TypeError(f"the step {kind!r} needs the state {state.__name__}, got {got}")
    code = scene.eyes.means(scene.sight.blind, grows=scene.facts.grows).lacks(kind)
    skill = SKILLS.get(kind)
    if skill is not None and code is None:
        return judge_condition(scene, skill(scene))
    code = code or Code.NO_CAPABILITY
    return Fail(code, code.value, message(code, part=say_or_quote("step_kind", kind)))


__all__ = [
    "SKILLS",
    "AskImage",
    "CallTool",
    "DriveLeg",
    "Eyesight",
    "Fail",
    "Finish",
    "ImageAnswer",
    "LookUp",
    "Observe",
    "Question",
    "Retry",
    "Scene",
    "SkillAction",
    "SkillStateBase",
    "Skip",
    "Speak",
    "Stand",
    "Think",
    "Way",
    "act_of",
    "begin_state",
    "no_room",
]
