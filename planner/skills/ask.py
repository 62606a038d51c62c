"""Ask a person a question and wait for the answer, standing.

Law: the robot is free for others meanwhile, and who waits behind this goal is kept waiting. Where
something moves upon the answer before anybody reads it (mission/scene.py), only a plain yes
goes on. A plain no ends the goal where the robot stands. What is neither is thought about once by a
brain that can, and every new way needs a yes of its own; else it is asked once more, and what is
then neither is a no. Any other answer is an observation for a later ``decide`` and never becomes a
step by itself. Budget: the time set for answers, after which the goal ends and the robot stays
where it is.
"""

from __future__ import annotations

from planner.language.catalogue import message, say
from planner.language.sentence import parse
from planner.plan import JUDGED, Bilingual, Code, say_same
from planner.skills.actions import (
    Fail,
    Finish,
    Question,
    Scene,
    SkillAction,
    Think,
)
from planner.skills.conditions import ask_condition
from planner.skills.skill_state import AskStage, AskState

_QUOTED = 80
_NO = say("question.said_no")
_UNCLEAR = say("question.said_neither")


def ask(scene: Scene[AskState]) -> SkillAction:
    """Return the question, until it is answered; then whether that lets the goal go on."""
    if scene.step.role in JUDGED:
        return ask_condition(scene)
    answer, state = scene.step.answer, scene.state
    if answer is None:
        again = state.stage is AskStage.AGAIN
        return (
            Question(_shall_i(scene), state) if again else Question(say_same(scene.step.text or ""))
        )
    if scene.upon is None:
        return Finish()
    yes = parse(answer).consent
    if yes is True:
        return Finish({"answer": f"{state.heard}; {answer}"} if state.heard is not None else {})
    if yes is False or state.stage is AskStage.AGAIN:
        said = tell_declined(scene.upon, plainly=yes is False)
        return Fail(Code.DECLINED, Code.DECLINED.value, said)
    if scene.thinks or state.stage is AskStage.THOUGHT:
        return Think(state.but(stage=AskStage.THOUGHT))
    return ask_again(scene)


def tell_declined(deed: Bilingual, *, plainly: bool = True) -> Bilingual:
    """Tell a person that something is not done, because they said no; else neither yes nor no."""
    return message(Code.DECLINED, said=_NO if plainly else _UNCLEAR, deed=deed)


def ask_again(scene: Scene[AskState]) -> Question:
    """Ask for a plain yes or no, once, after an answer that is neither."""
    scene = scene.but(scene.state.but(stage=AskStage.AGAIN, heard=scene.step.answer))
    return Question(_shall_i(scene), scene.state)


def _shall_i(scene: Scene[AskState]) -> Bilingual:
    deed, heard = (
        scene.upon or say("question.go_on"),
        (scene.state.heard or "")[:_QUOTED],
    )
    return say("question.shall_i", heard=heard, deed=deed)
