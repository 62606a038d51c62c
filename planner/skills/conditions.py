"""Judge a condition by what its step came to: it holds, it does not, or that can't be told.

A condition is a step like any other (a look, a search, a question, memory, the clock) that notes
``holds`` among its figures. Laws: what can't be told chooses no branch: the step fails as
``unsure``, and the plan's own ``on_failure``, a brain or a person is next. A thing counts as not
there only where all that was to be looked at was looked at. Memory is asked what was seen or done:
what it does not know does not hold, and that is told; a memory that can't be read tells nothing.
What a vision model says steers by this one bit alone, between steps that were written before any
picture was taken (ADR 0060). A question is read as yes or no and nothing else; what is neither is
asked once more.
"""

from __future__ import annotations

from dataclasses import replace
from typing import Any

from planner.language.catalogue import message, say
from planner.language.sentence import parse
from planner.plan import JUDGED, Bilingual, Code, StepRole, say_same
from planner.skills.actions import Fail, Finish, Question, Scene, SkillAction
from planner.skills.skill_state import AskStage, AskState

HOLDS = "holds"


def judge_condition(scene: Scene[Any], act: SkillAction) -> SkillAction:
    """Return what a step asks for next, with its end turned into an answer where it is one."""
    if scene.step.role not in JUDGED:
        return act
    said: Bilingual | None = None
    if (isinstance(act, Fail) and act.code is Code.NOT_FOUND) or isinstance(act, Finish):
        said, figures = act.said, act.figures
    else:
        return act
    holds = figures.get(HOLDS)
    if holds is None and scene.step.role is StepRole.WHEN:
        return _unsure(said, figures)
    return Finish(figures, Code.SEEN, said, act.read if isinstance(act, Finish) else None)


def _unsure(said: Bilingual | None, figures: dict[str, Any]) -> Fail:
    """Tell that neither branch is taken, with all that is known."""
    told = message(Code.UNSURE, told=said if said is not None else say_same(""))
    return Fail(Code.UNSURE, Code.UNSURE.value, told, figures)


def ask_condition(scene: Scene[AskState]) -> SkillAction:
    """Return a question that branches hang on, until its answer is a yes or a no."""
    answer, state = scene.step.answer, scene.state
    if answer is None:
        asked = say_same(scene.step.text or "")
        if state.stage is AskStage.AGAIN:
            asked = say("question.plainly", text=scene.step.text)
        return Question(asked, state if state.stage is AskStage.AGAIN else None)
    yes = parse(answer).consent
    if yes is None and state.stage is not AskStage.AGAIN:
        again = scene.but(state.but(stage=AskStage.AGAIN, heard=answer))
        asked = say("question.plainly", text=scene.step.text)
        return Question(asked, again.state)
    return Finish({HOLDS: yes})


def clock(scene: Scene[None]) -> SkillAction:
    """Return whether it is as late as the step asks."""
    step = scene.step
    local_s = scene.unix_s + scene.local_offset_s
    holds = is_between(step.after, step.before, local_s)
    said = say("condition.clock", time=clock_time(local_s))
    return Finish({HOLDS: holds}, Code.SEEN, said)


def judge_recalled(role: StepRole | None, code: Code, said: Bilingual) -> Finish | Fail:
    """Return how a step ends that memory has answered; what is not remembered does not hold.

    Args:
        role: of the step, where another one holds it.
        code: ``recalled``, ``not_remembered`` or ``memory_unavailable``.
        said: the answer in words, with its age.
    """
    if code is not Code.MEMORY_UNAVAILABLE:
        return Finish({HOLDS: code is Code.RECALLED} if role in JUDGED else {}, code, said)
    if role is StepRole.WHEN:
        return _unsure(said, {})
    return Finish({HOLDS: None}, code, said) if role in JUDGED else Fail(code, code.value, said)


def with_answer(act: Finish, holds: bool | None) -> Finish:
    """Return the end of a step with the answer that branches may hang on."""
    return replace(act, figures={**act.figures, HOLDS: holds})


def agree(detected: bool | None, read: bool | None) -> bool | None:
    """Return one answer of what the detector saw and what a vision model says, or None.

    The detector's yes holds: it saw the thing twice, standing. Its no holds unless the model says
    yes; then nobody can tell. Where it can't judge, the model alone does.
    """
    if detected is True:
        return True
    if detected is False:
        return None if read is True else False
    return read


DAY_S = 86400.0
"""Local time is Unix time and an offset from UTC [s] that was read when the planner began: where
summer time begins or ends while it runs, HH:MM is an hour off until it is started anew."""
MAX_AHEAD_S = 12 * 3600.0
"""An HH:MM whose next coming is farther off than this was meant for a time that is past."""


def clock_time(local_s: float) -> str:
    """Return HH:MM of a local time [s]."""
    minutes = int(local_s % DAY_S // 60)
    return f"{minutes // 60:02d}:{minutes % 60:02d}"


def seconds_until(time: str, local_s: float) -> float | None:
    """Return how long it is until HH:MM comes next [s]; None where that time is past."""
    hour, minute = (int(part) for part in time.split(":"))
    ahead_s = (3600.0 * hour + 60.0 * minute - local_s) % DAY_S
    return ahead_s if ahead_s <= MAX_AHEAD_S else None


def is_between(after: str | None, before: str | None, local_s: float) -> bool:
    """Tell whether it is ``after`` already and not yet ``before``, over midnight too."""
    now = clock_time(local_s)
    if after is None or before is None:
        return (after is None or after <= now) and (before is None or now < before)
    if after <= before:
        return after <= now < before
    return after <= now or now < before
