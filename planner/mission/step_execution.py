"""Walk the running mission's plan: begin steps, carry out what their skills ask, end them.

When a leg is done, ``arrival`` tells. Nothing moves or speaks before its beginning is journalled.
"""

from __future__ import annotations

from planner import skills
from planner.bridge_client.bridge_status import cannot_move
from planner.language.catalogue import message, say
from planner.language.plan_words import name_call
from planner.mission import queue
from planner.mission.account import outcome_code
from planner.mission.activity import (
    Asking,
    AskingImage,
    CallingTool,
    Driving,
    LookingUp,
    Observing,
    Retrying,
    Speaking,
    Waiting,
)
from planner.mission.effects import AskEyes, AskMemory, AskTool, SayAloud
from planner.mission.legs import ask_route, measure_from, settle_amounts
from planner.mission.outcomes import ended_outcome, moves, plain_outcome
from planner.mission.scene import scene_of
from planner.mission.state import Mission
from planner.mission.step_failure import end_failed, fail_step, think, to_step
from planner.mission.transaction import Transaction
from planner.mission.transitions import GoalFact
from planner.plan import CONTROL, JUDGED, NEEDS_CAMERA, Code, StepState, parent_of
from planner.plan.plan_walk import RoundBudget, enter
from planner.plan.plan_walk import go_on as go_on_walking
from planner.skills.patrol import so_far
from planner.skills.skill_state import PatrolState


def start_next(turn: Transaction) -> None:
    """Give the robot to the next in the queue, as long as it is free."""
    while (mission := queue.next_up(turn)) is not None:
        settle_amounts(turn, turn.book.pose)
        mission = turn.book.missions[mission.id]
        queue.dequeue(turn, mission.id)
        turn.set(running=mission.id)
        mission = turn.move_to(mission, GoalFact.TURN, reason=None, outcome=None)
        _look_anew(turn, mission)
        begin_step(turn)


def _look_anew(turn: Transaction, mission: Mission) -> None:
    """Begin a look that branches hang on, or a patrol's, again after a pause or a crash.

    Half a look proves nothing. A patrol's stops that are over stay so.
    """
    step, state = mission.current_step, mission.skill_state
    if isinstance(state, PatrolState):
        turn.put(mission, skill_state=PatrolState(stops=state.stops))
    begun = step is not None and step.state is StepState.RUNNING
    if begun and step is not None and step.role in JUDGED and step.kind in NEEDS_CAMERA:
        to_step(turn, mission, mission.step)


def begin_step(turn: Transaction) -> None:
    """Begin the current step of the running mission, or end a mission that has no more."""
    mission = _enter(turn, turn.at_work)
    step = mission.current_step
    if step is None or step.state is StepState.SKIPPED:  # left out: only the way back was driven
        if mission.failure is not None:
            end_failed(turn, mission, mission.failure.message)
            return
        outcome = ended_outcome(turn, mission, outcome_code(mission), None)
        queue.finish(turn, mission, GoalFact.STEPS_OVER, outcome)
        return
    if step.state is StepState.FAILED:  # paused while a better plan was thought about
        think(turn, mission)
        return
    cause = cannot_move(turn.book.status) if moves(step) else None
    if cause is not None:
        turn.set(activity=None)
        queue.pause_running(turn, cause)
        return
    mission = measure_from(turn, mission, turn.book.pose)
    carry_out(turn, mission, skills.act_of(scene_of(turn, mission)))


def _enter(turn: Transaction, mission: Mission) -> Mission:
    """Go down to the first step to do, where the current one holds steps."""
    step = mission.current_step
    if step is None or step.kind not in CONTROL:
        return mission
    at = enter(mission.steps, mission.step, turn.now_unix_s)
    return to_step(turn, turn.put_steps(mission, at.row), at.index)


def carry_out(  # noqa: C901, PLR0912  # one case an act
    turn: Transaction, mission: Mission, act: skills.SkillAction
) -> None:
    """Do what a skill asked for."""
    match act:
        case skills.DriveLeg():
            _begin(turn, mission, bill=act.bill, **so_far(act.state))
            leg = Driving(record=turn.next_entry, act=act, since_s=turn.now_s, asked_s=turn.now_s)
            turn.set(activity=leg)
            ask_route(turn)
        case skills.Observe():
            _gaze(turn, mission, act)
        case skills.AskImage():
            _inquire(turn, mission, act)
        case skills.Retry():
            _later(turn, mission, act)
        case skills.Stand():
            _begin(turn, _keep_state(turn, mission, act.state))
            until_s = turn.now_s + act.seconds
            turn.set(activity=Waiting(record=turn.next_entry, until_s=until_s))
        case skills.Speak():
            _begin(turn, mission)
            turn.set(activity=Speaking(record=turn.next_entry))
        case skills.LookUp():
            _look_up(turn, mission, act)
        case skills.CallTool():
            _call_tool(turn, mission, act)
        case skills.Question():
            _ask(turn, mission, act)
        case skills.Think():
            _decide(turn, mission, act)
        case skills.Finish():
            told = (
                {} if act.code is None else {"code": act.code, "said": act.said, "read": act.read}
            )
            finish_step(turn, StepState.SUCCEEDED, **act.figures, **told)
        case skills.Skip():
            finish_step(turn, StepState.SKIPPED, reason=act.reason)
        case skills.Fail():
            fail_step(turn, act)


def _begin(turn: Transaction, mission: Mission, **record: object) -> Mission:
    """Note in the record of the current step that it runs."""
    return queue.note_step(turn, mission, state=StepState.RUNNING, reason=None, **record)


def _keep_state(
    turn: Transaction, mission: Mission, state: skills.SkillStateBase | None
) -> Mission:
    """Keep what a skill remembers from now on; None: as before."""
    return turn.put(mission, skill_state=state or mission.skill_state)


def _gaze(turn: Transaction, mission: Mission, act: skills.Observe) -> None:
    _begin(turn, mission, bill=act.bill)
    observing = Observing(
        record=turn.next_entry,
        act=act,
        since_s=turn.now_s,
        asked_s=turn.now_s,
        until_s=turn.now_s + act.seconds,
    )
    turn.set(activity=observing)


def _inquire(turn: Transaction, mission: Mission, act: skills.AskImage) -> None:
    """Ask about the picture, standing; the answer comes with the ticket."""
    _begin(turn, mission, bill=act.bill)
    asking = AskingImage(
        record=turn.next_entry,
        act=act,
        since_s=turn.now_s,
        ticket=turn.take_ticket(),
        until_s=turn.now_s + act.seconds,
    )
    turn.set(activity=asking)
    turn.emit(AskEyes(mission.id, asking.ticket, mission.language, act))


def _look_up(turn: Transaction, mission: Mission, act: skills.LookUp) -> None:
    _begin(turn, mission)
    step, ticket, until_s = (
        mission.steps[mission.step],
        turn.take_ticket(),
        turn.now_s + act.seconds,
    )
    turn.set(activity=LookingUp(record=turn.next_entry, ticket=ticket, until_s=until_s))
    asked = (step.object, step.place, step.span, step.deeds, step.role in JUDGED)
    turn.emit(AskMemory(mission.id, ticket, *asked))


def _call_tool(turn: Transaction, mission: Mission, act: skills.CallTool) -> None:
    """Have a tool asked once this is on disk."""
    _begin(turn, _keep_state(turn, mission, act.state))
    calling = CallingTool(
        record=turn.next_entry,
        ticket=turn.take_ticket(),
        agreed=act.agreed,
        until_s=turn.now_s + act.seconds,
    )
    turn.set(activity=calling)


def go_on(
    turn: Transaction,
    then: skills.SkillStateBase | None,
    *,
    gazed_s: float | None = None,
    answer: skills.ImageAnswer | None = None,
) -> None:
    """Go on in the step after a gaze or an answer: ask its skill what is next."""
    mission = queue.settle_activity(turn)
    mission = turn.put(mission, part=mission.part + 1, skill_state=then or mission.skill_state)
    carry_out(turn, mission, skills.act_of(scene_of(turn, mission, gazed_s, answer)))


def _later(turn: Transaction, mission: Mission, act: skills.Retry) -> None:
    """Try again soon; how long what holds has stood runs on, so that no wait lasts for ever."""
    retry_s = turn.now_s + act.seconds
    if act.state is not None:
        mission = turn.put(mission, skill_state=act.state)
    if isinstance(turn.book.activity, Retrying):
        turn.change(retry_s=retry_s)
        return
    _begin(turn, mission)
    turn.set(activity=Retrying(record=turn.next_entry, retry_s=retry_s))


def _ask(turn: Transaction, mission: Mission, act: skills.Question) -> None:
    """Ask a person. What was answered before was about another question: it is forgotten."""
    again = _is_under_way(mission, act.state)  # then it was perhaps said
    _begin(turn, _keep_state(turn, mission, act.state), answer=None)
    asking = Asking(record=turn.next_entry, question=act.text, aloud=not again)
    turn.set(activity=asking)


def _is_under_way(mission: Mission, state: skills.SkillStateBase | None) -> bool:
    """Tell whether the current step was begun, and its skill remembers what it did then."""
    begun = mission.steps[mission.step].state is StepState.RUNNING
    return begun and state in (None, mission.skill_state)


def _decide(turn: Transaction, mission: Mission, act: skills.Think) -> None:
    if _is_under_way(mission, act.state):  # paused meanwhile: it was counted
        think(turn, mission)
        return
    if mission.decides >= turn.book.rules.decides:
        said = message(
            Code.OUT_OF_BUDGET, budget=say("account.thoughts", count=turn.book.rules.decides)
        )
        fail_step(turn, skills.Fail(Code.OUT_OF_BUDGET, "thoughts", said))
        return
    mission = _begin(turn, _keep_state(turn, mission, act.state))
    think(turn, turn.put(mission, decides=mission.decides + 1))


def finish_step(turn: Transaction, state: StepState, **record: object) -> None:
    """Write the end of a step and begin the next."""
    mission = queue.settle_activity(turn)
    mission = queue.note_step(turn, mission, state=state, **record)
    if mission.plan is None or mission.returning:  # only the way back was left
        to_step(turn, mission, len(mission.steps))
        begin_step(turn)
        return
    at = go_on_walking(mission.steps, mission.step, RoundBudget(turn.now_unix_s, mission.metres))
    if at.unmet:
        parent = parent_of(mission.steps, mission.step)
        rounds = mission.steps[parent].round if parent is not None else 1
        said = message(Code.UNMET, rounds=rounds)
        fail_step(turn, skills.Fail(Code.UNMET, Code.UNMET.value, said))
        return
    to_step(turn, turn.put_steps(mission, at.row), at.index)
    begin_step(turn)


def speak_if_safe(turn: Transaction) -> None:
    """Say the words of a step whose beginning is on disk; a question then waits for its answer."""
    mission, activity = turn.running, turn.book.activity
    if mission is None or activity is None or turn.book.safe < activity.record:
        return
    if isinstance(activity, Speaking):
        text = mission.steps[mission.step].text or "" if mission.current_step is not None else ""
        turn.emit(SayAloud(mission.id, text))
        finish_step(turn, StepState.SUCCEEDED)
    elif isinstance(activity, CallingTool) and not activity.is_sent:
        _send_call(turn, mission, activity)
    elif isinstance(activity, Asking):
        if activity.aloud:
            turn.emit(SayAloud(mission.id, activity.question.of(mission.language)))
        turn.set(asked_s={**turn.book.asked_s, mission.id: turn.now_s})
        said = plain_outcome(Code.ASKED, text=activity.question)
        queue.yield_robot(turn, mission, GoalFact.STEP_ASKS, "asked", said)


def _send_call(turn: Transaction, mission: Mission, calling: CallingTool) -> None:
    """Have the tool asked, and people told of it, once."""
    step = mission.steps[mission.step]
    call = step.tool or "", step.arguments
    asking = say("tool.asking", call=name_call(*call))
    turn.emit(AskTool(mission.id, calling.ticket, *call, calling.agreed))
    turn.emit(SayAloud(mission.id, asking.of(mission.language)))
    turn.change(is_sent=True)
