"""Ask a tool of the owner's servers, standing.

Law: what it answers is told and read (``StepRecord.read``), and nothing that is done follows from
it; a failure ends the goal and takes no other way. A tool that writes is called upon the plain yes
of a person who was told the call whole, and once: where it was perhaps made before a pause or a
crash, it is not made again. Budget: the server's own time, calls by goal and by day.
"""

from __future__ import annotations

from planner.language.catalogue import join, message, say
from planner.language.sentence import parse
from planner.plan import Code
from planner.skills.actions import CallTool, Fail, Question, Scene, SkillAction
from planner.skills.ask import tell_declined
from planner.skills.skill_state import ToolState


def use_tool(scene: Scene[ToolState]) -> SkillAction:
    """Return the call, or the question that a person is asked before it."""
    state, answer = scene.state, scene.step.answer
    if state.is_sent:
        return Fail(Code.TOOL_FAILED, "tool_unsure", message(
            Code.TOOL_FAILED, call=scene.step.tool, why=say("tool_problem.tool_unsure"),
        ))  # fmt: skip
    if state.question is None:
        return CallTool()
    if answer is None:
        plainly = join((say("question.yes_or_no"), state.question), "joint.none")
        return Question(plainly if state.is_again else state.question, state)
    agreed = parse(answer).consent
    if agreed is True:
        return CallTool(agreed=True, state=state.but(is_sent=True))
    if agreed is None and not state.is_again:
        again = state.but(is_again=True)
        return Question(join((say("question.yes_or_no"), state.question), "joint.none"), again)
    deed = say("deed.use_tool", tool=scene.step.tool)
    return Fail(Code.DECLINED, Code.DECLINED.value, tell_declined(deed, plainly=agreed is False))
