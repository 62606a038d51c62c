"""Take goals in and carry them to the queue: given, understood, asked back, confirmed, stopped."""

from __future__ import annotations

import dataclasses

from planner.language.catalogue import join, say
from planner.language.sentence import parse
from planner.mission import open_questions, plan_roles, queue
from planner.mission.activity import Thinking
from planner.mission.awaited_word import TAKES_YES, AwaitedWord, wait_of
from planner.mission.conversation import question_of
from planner.mission.events import Planned, Restarted, Submitted
from planner.mission.follow_up import departure_of, newest_order, way_back_of
from planner.mission.outcomes import plain_outcome
from planner.mission.plan_check import UNASKED, ask_for_motion, unwalkable
from planner.mission.replan import fingerprint, rethought
from planner.mission.spoken_status import go_on_told
from planner.mission.state import Mission
from planner.mission.transaction import Transaction
from planner.mission.transitions import FIRST, BrainCause, Cause, GoalFact, PersonCause
from planner.plan import (
    STEPLESS,
    AnswerPlan,
    Clarify,
    Code,
    GoalState,
    Option,
    Outcome,
    PauseReason,
    PlanRole,
    Refuse,
    StepPlan,
    plan_record,
)

MAP_CHANGED = say("goal.map_changed")
HOW_FAR_UNKNOWN = say("goal.map_changed_in_step")
LEGS_UNWRITTEN = 100
"""More legs than a planner can have streamed and not yet written when it died: the bridge latches
what was reached by leg, so no number is ever streamed twice."""


def submit(turn: Transaction, event: Submitted) -> None:
    """Take a goal in. One id is one goal: a repeated id changes nothing."""
    if event.id in turn.book.missions:
        return
    if event.stop or event.doubtful_stop:
        stop(turn, event.by)
        plan_roles.end_paused(turn, event.denies)
    elif event.resumes:
        queue.acknowledge_hold(turn)
    if not (event.stop or event.local):
        open_questions.make_room(turn, event.text)
    order, now_unix_s, here = turn.book.order + 1, turn.now_unix_s, turn.book.pose
    turn.set(order=order)
    mission = Mission(
        id=event.id, order=order, text=event.text, changed=event.changed, points=event.points,
        language=event.language, state=FIRST, confirm=event.confirm, replace=event.replace,
        first=event.first, doubtful_stop=event.doubtful_stop, interrupted=event.interrupts,
        given_under_hold=queue.hold_now(turn, event.source), source=event.source, by=event.by,
        map_id=turn.book.facts.map_id,
        accepted_at=None if here is None else (here.x_m, here.y_m, here.yaw_rad),
        departed_at=departure_of(turn.book, turn.now_s),
        created_unix_s=now_unix_s, updated_unix_s=now_unix_s,
    )  # fmt: skip
    if event.stop or (event.doubtful_stop and not event.echoed):
        plan_roles.end_stopped(
            turn, mission, event.echoed, event.also or plan_roles.tell_left(event.rest)
        )
        return
    if event.asking:
        asking = open_questions.take_sentence(turn, mission, event.asking)
        if asking is not None:
            reply(turn, asking, event.text, event.by)
        return
    _think(turn, turn.put(mission))


def _think_anew(
    turn: Transaction, mission: Mission, cause: Cause, deed: StepPlan | None = None
) -> None:
    """Have a brain think about an order again that waited for a person until now."""
    _think(turn, turn.move_to(mission, cause, reason=None, outcome=None, plan=None), deed)


def _think(turn: Transaction, mission: Mission, deed: StepPlan | None = None) -> None:
    newest = newest_order(turn.book, mission.id, turn.now_s)
    turn.emit(dataclasses.replace(question_of(turn, mission), newest=newest, deed=deed))


def take_plan(turn: Transaction, event: Planned) -> None:
    """Take the brain's answer, if somebody still waits for it."""
    mission = turn.mission(event.id)
    thinks = isinstance(turn.book.activity, Thinking)
    if mission is not None and mission is turn.running and thinks:
        rethought(turn, mission, event)
        return
    if mission is None or mission.state is not GoalState.PLANNING:
        return
    plan = event.plan
    stepless = not isinstance(plan, StepPlan) or plan.does in STEPLESS
    if mission.doubtful_stop and stepless:
        plan_roles.stop_after_all(turn, mission, event)
        return
    if plan is None:
        outcome = event.failure or plain_outcome(Code.BAD_PLAN, why=say("plan.no_answer"))
        mission = turn.put(mission, brain=event.brain)
        cause = BrainCause.FAILS if outcome.code is Code.MODEL_UNAVAILABLE else BrainCause.REFUSES
        queue.finish(turn, mission, cause, outcome, outcome.code.value)
        return
    mission = turn.put(mission, plan=plan_record(plan), brain=event.brain)
    if isinstance(plan, StepPlan) and plan.does in STEPLESS:
        _act_on_others(turn, mission, plan.does)
        return
    if isinstance(plan, StepPlan | Clarify):  # surely an order
        open_questions.close_older(turn, mission)
    match plan:
        case AnswerPlan():
            answer = plain_outcome(Code.ANSWERED, text=plan.text)
            queue.finish(turn, mission, BrainCause.ANSWERS, answer)
        case Refuse():
            told = go_on_told(turn.book, plan.reason, turn.now_s)
            outcome = Outcome(code=plan.code, message=told)
            queue.finish(turn, mission, BrainCause.REFUSES, outcome, plan.code.value)
        case Clarify(options=(Option(plan=StepPlan(steps=(_, *_)) as offered),)) if (
            vain := unwalkable(turn.book, mission, plan_record(offered).steps)
        ):  # a yes would only be refused
            mission = turn.put(mission, plan=plan_record(offered))
            queue.finish(turn, mission, BrainCause.REFUSES, vain, vain.code.value)
        case Clarify():
            told = go_on_told(
                turn.book, open_questions.tell_offer(mission, plan.question), turn.now_s
            )
            said = Outcome(code=plan.code, message=told)
            turn.move_to(mission, BrainCause.ASKS, reason=plan.code.value, outcome=said)
        case StepPlan():
            share, back = plan_roles.share_of(plan), way_back_of(mission)
            mission = turn.put(mission, speed_share=share, accepted_at=back)
            _walkable(turn, plan_roles.assume_role(turn, mission, plan.does), event)


def _act_on_others(turn: Transaction, mission: Mission, role: PlanRole) -> None:
    """End the goal that a person means, or take the person's own words for a question's answer."""
    if role is PlanRole.CANCEL:
        plan_roles.end_current(turn, mission, plan_roles.goal_in_hand(turn, mission))
        return
    asking = plan_roles.find_asking(turn, mission)
    if asking is not None:
        reply(turn, asking, mission.words, mission.by)


def _walkable(turn: Transaction, mission: Mission, event: Planned) -> None:
    """Refuse what can't be walked before anything moves; else wait for a yes or for the robot."""
    outcome = unwalkable(turn.book, mission, mission.steps)
    if outcome is not None and mission.doubtful_stop:
        left = outcome.message if parse(mission.text).behind_stop else None
        plan_roles.end_stopped(turn, mission, echoed=True, also=left)
        return
    if outcome is not None:
        queue.finish(turn, mission, BrainCause.REFUSES, outcome, outcome.code.value)
        return
    mission = turn.put(mission, tried=(fingerprint(mission.steps),))
    shall_i = ask_for_motion(turn.book.facts, (), mission.steps, event.unasked)
    if mission.doubtful_stop and not (shall_i is None and plan_roles.corrects(turn, mission)):
        asked = plan_roles.ask_what_was_meant(turn.book, mission)
        if shall_i is not None:  # a yes is a yes to all that is asked
            asked = join((shall_i.message, asked))
        said = Outcome(code=Code.CONFIRM, message=asked)
        turn.move_to(mission, BrainCause.NEEDS_YES, reason="doubtful_stop", outcome=said)
    elif shall_i is not None:
        sure = None if event.sure is None else plan_record(event.sure)
        turn.move_to(mission, BrainCause.NEEDS_YES, reason=UNASKED, outcome=shall_i, sure=sure)
    elif mission.doubtful_stop:  # it stands, and what was said in its place is what was asked
        plan_roles.end_paused(turn, mission.interrupted)
        ready(turn, turn.put(mission, confirm=False), BrainCause.PLANS)
    elif mission.confirm:
        turn.move_to(mission, BrainCause.NEEDS_YES)
    else:
        ready(turn, mission, BrainCause.PLANS)


def ready(turn: Transaction, mission: Mission, cause: Cause) -> None:
    """Let a planned goal wait for the robot, or take it from the one it replaces."""
    queue.clear_hold(turn, mission)
    if mission.has_begun:  # it was asked under way, and goes on where it stood
        queue.release_answered(turn)
        queue.enqueue(turn, mission, cause, first=True)
        return
    if mission.replace and (replaced := plan_roles.goal_in_hand(turn, mission)) is not None:
        queue.cancel(turn, replaced)
    queue.enqueue(turn, mission, cause, first=mission.replace or mission.first)


def confirm(turn: Transaction, mission: Mission, by: str) -> None:
    """Take a person's yes."""
    ready(turn, open_questions.keep_answer(turn, mission, None, by), PersonCause.AGREES)


def reply(turn: Transaction, mission: Mission, text: str, by: str) -> None:
    """Take a person's answer: to a step's question, to a plan, or to one about the order itself."""
    mission = open_questions.keep_answer(turn, mission, text, by)
    open_questions.ask_anew(turn, mission)
    agreed, waits = parse(text).consent, wait_of(mission)
    if waits is AwaitedWord.STEP:
        open_questions.take_answer(turn, mission, text)
    elif agreed is False and waits in (*TAKES_YES, AwaitedWord.CHOICE):
        open_questions.take_no(turn, mission)
    elif agreed and waits is AwaitedWord.CHOICE:
        open_questions.ask_which(turn, mission)
    elif waits is AwaitedWord.PLAN and agreed:
        ready(turn, mission, PersonCause.AGREES)
    elif waits is AwaitedWord.PLAN:
        open_questions.ask_plainly(turn, mission)
    elif (offered := open_questions.find_offered_plan(mission, text)) is not None:
        mission = open_questions.note_answer(turn, mission, text)
        mission = turn.put(mission, replace=mission.replace or offered.does is PlanRole.INSTEAD)
        turn.move_to(mission, PersonCause.EXPLAINS, reason=None, outcome=None, plan=None)
        take_plan(turn, Planned(mission.id, offered, None, mission.brain))
    else:
        deed = open_questions.find_offered_plan(mission, text, is_standing=True)
        mission = open_questions.note_answer(
            turn, mission, open_questions.complete_order(turn.book.facts, mission, text)
        )
        _think_anew(turn, mission, PersonCause.EXPLAINS, deed)


def pause(turn: Transaction, mission: Mission) -> None:
    """Pause a goal; if it was running, those who wait are kept waiting."""
    reason = PauseReason.OPERATOR.value
    if mission.state is GoalState.RUNNING:
        queue.pause_running(turn, reason, PersonCause.PAUSES)
    elif mission.state is GoalState.PLANNING:
        queue.pause_planning(turn, mission, reason)
    else:
        turn.put(mission, held=True, kept=True)


def resume(turn: Transaction, mission: Mission) -> None:
    """Go on with a paused goal and let the queue go on; or let one that is kept waiting go."""
    queue.acknowledge_hold(turn)
    if mission.state is GoalState.QUEUED:
        turn.put(mission, held=False, kept=False)
        return
    queue.release_queue(turn)
    if mission.plan is None or not mission.steps:
        _think_anew(turn, mission, PersonCause.RESUMES_UNPLANNED)
    else:
        queue.enqueue(turn, turn.put(mission, outcome=None), PersonCause.RESUMES, first=True)


def stop(turn: Transaction, by: str) -> None:
    """Stand. Running and thinking goals pause; those who wait are kept waiting."""
    reason = PauseReason.STOP.value
    queue.pause_running(turn, reason, PersonCause.PAUSES, by)
    for mission in turn.book.goals_in(GoalState.PLANNING):
        queue.pause_planning(turn, turn.put(mission, stopped_by=by), reason)
    turn.set(pardoned=None, pardon_until_s=float("-inf"))


def restart(turn: Transaction, event: Restarted) -> None:
    """Take up the journal of a process that is gone: nothing of it goes on by itself."""
    missions = {m.id: m for m in sorted(event.missions, key=lambda m: m.order)}
    order = max((m.order for m in missions.values()), default=0)
    turn.set(
        missions=missions,
        queue=_queue(event, missions),
        running=None,
        activity=None,
        order=order,
        wall_offset_s=event.wall_offset_s,
        local_offset_s=event.local_offset_s,
        asked_s=open_questions.waiting_since(missions, turn.now_s),
    )
    for mission in missions.values():
        if mission.state in (GoalState.RUNNING, GoalState.PLANNING):
            reason = PauseReason.PLANNER_RESTARTED.value
            leg = mission.leg + LEGS_UNWRITTEN
            turn.move_to(mission, GoalFact.RESTARTED, reason=reason, leg=leg)
        if not mission.has_ended and mission.map_id != turn.book.facts.map_id:
            _forget_poses(turn, turn.book.missions[mission.id])
    queue.hold_queue(turn)


def _forget_poses(turn: Transaction, mission: Mission) -> None:
    """Drop where a goal began on another map: a point of that map is nowhere on this one."""
    if mission.map_id and mission.began_at is not None:  # better unfinished than done twice
        said = Outcome(code=Code.NOT_REACHED, message=HOW_FAR_UNKNOWN)
        queue.finish(turn, mission, GoalFact.PROGRESS_UNKNOWN, said, "map_changed")
    elif mission.map_id:
        mission = turn.put(mission, accepted_at=None, departed_at=None, skill_state=None)
        if mission.state is GoalState.PAUSED:
            turn.put(mission, outcome=Outcome(code=Code.NOT_REACHED, message=MAP_CHANGED))
    turn.put(turn.book.missions[mission.id], map_id=turn.book.facts.map_id)


def _queue(event: Restarted, missions: dict[str, Mission]) -> tuple[str, ...]:
    """Return the waiting goals, in the order that was journalled; goals missing there come last."""
    waiting = [m.id for m in missions.values() if m.state is GoalState.QUEUED]
    return tuple(dict.fromkeys([*(i for i in event.queue if i in waiting), *waiting]))
