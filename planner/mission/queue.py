"""Keep the queue: the goal that has the robot, those that wait, and those waiting for a person.

Goals take their turns in the order in which they were asked for, however long a brain thinks about
each; only a person's word ("first", "instead", a move) puts one before an older one. One mission
runs at a time. A pause frees the robot but keeps those waiting where they are; only a goal that a
person gives afterwards, or a resume, goes on. Who waits for an answer alone goes on with the
answer, too.
"""

from __future__ import annotations

from planner.mission.activity import TIMED, Activity, AskingImage, Driving, Observing, Thinking
from planner.mission.effects import ClearHold, DropBrain
from planner.mission.outcomes import ended_outcome, failure, plain_outcome
from planner.mission.state import AGENT_SOURCE, Mission, Progress
from planner.mission.transaction import Transaction
from planner.mission.transitions import Cause, GoalFact, PersonCause, next_state
from planner.plan import Bilingual, Code, GoalState, Outcome, PauseReason, StepState
from planner.skills.skill_state import SkillStateBase

PARDON_S = 2.0
"""A request that clears the bridge's hold is echoed within 2 s or was not heard."""


def enqueue(turn: Transaction, mission: Mission, cause: Cause, *, first: bool = False) -> None:
    """Let a planned mission wait for the robot; ``cause`` is why it may."""
    waiting = tuple(i for i in turn.book.queue if i != mission.id)
    turn.move_to(mission, cause, reason=None, held=False, kept=False)
    others = (turn.book.missions[i] for i in waiting)
    later = (n for n, m in enumerate(others) if m.order > mission.order and not _goes_first(m))
    at = 0 if first else next(later, len(waiting))
    turn.set(queue=(*waiting[:at], mission.id, *waiting[at:]))


def _goes_first(mission: Mission) -> bool:
    """Tell whether a mission has its place by a person's word, or by what it has begun."""
    return mission.has_begun or mission.first or mission.replace


def dequeue(turn: Transaction, mission_id: str) -> None:
    """Take a mission out of the queue, if it is there."""
    turn.set(queue=tuple(i for i in turn.book.queue if i != mission_id))


def hold_queue(turn: Transaction) -> None:
    """Keep everyone who waits now waiting until a person acts."""
    for mission in _waiting(turn):
        if not (mission.held and mission.kept):
            turn.put(mission, held=True, kept=True)


def release_queue(turn: Transaction) -> None:
    """Let those who were kept waiting take their turns."""
    for mission in _waiting(turn):
        if mission.held:
            turn.put(mission, held=False, kept=False)


def release_answered(turn: Transaction) -> None:
    """Let those take their turns who waited for an answer and for nothing else."""
    for mission in _waiting(turn):
        if mission.held and not mission.kept:
            turn.put(mission, held=False)


def _waiting(turn: Transaction) -> tuple[Mission, ...]:
    """Return those who wait for the robot, in their order."""
    return tuple(turn.book.missions[i] for i in turn.book.queue)


def hold_now(turn: Transaction, source: str = "") -> str | None:
    """Return the id of the bridge's hold that stands now, or None.

    Args:
        turn: the book.
        source: of the goal that is spoken for: no hold is an agent's to clear, so it is told none.
    """
    held = turn.book.status.held if turn.book.status is not None else None
    return held.id if held is not None and not source.startswith(AGENT_SOURCE) else None


def acknowledge_hold(turn: Transaction) -> None:
    """Note that a person acted: the hold that stands now is about to be cleared."""
    turn.set(pardoned=hold_now(turn), pardon_until_s=turn.now_s + PARDON_S)


def clear_hold(turn: Transaction, mission: Mission) -> None:
    """Clear the hold under which a person gave this goal, now that its plan is accepted.

    A hold that began after the person spoke stays: nobody has answered that one.
    """
    held = hold_now(turn)
    if held is not None and held == mission.given_under_hold:
        acknowledge_hold(turn)
        turn.emit(ClearHold(mission.id))


def standing_hold(turn: Transaction) -> str | None:
    """Return the pause reason of a hold that no person has answered, or None."""
    status = turn.book.status
    if status is None or status.held is None:
        return None
    pardoned = status.held.id == turn.book.pardoned and turn.now_s <= turn.book.pardon_until_s
    return None if pardoned else status.held.reason.value


def settle_activity(turn: Transaction) -> Mission:
    """Write what the running step measured into its mission; the robot is free afterwards."""
    mission, activity = turn.at_work, turn.book.activity
    if activity is not None:
        limited = dict(mission.limited)
        counted = activity.limited if isinstance(activity, Driving) else {}
        for name, count in counted.items():
            limited[name] = limited.get(name, 0) + count
        metres = round(mission.metres + activity.metres, 4)
        done = round(mission.done + activity.amount, 5)
        mission = turn.put(mission, metres=metres, limited=limited, done=done)
        if isinstance(activity, TIMED) and activity.since_s is not None:
            mission = _settle_step(turn, mission, activity, activity.since_s)
        if isinstance(activity, Thinking):  # nobody waits for this thought any more
            turn.emit(DropBrain(mission.id))
    turn.set(activity=None)
    return mission


def _settle_step(
    turn: Transaction, mission: Mission, activity: Activity, since_s: float
) -> Mission:
    """Write down a looking step's expense, and what its skill remembers."""
    return turn.put(
        mission,
        step_s=round(mission.step_s + max(0.0, turn.now_s - since_s), 3),
        step_m=round(mission.step_m + activity.metres, 4),
        skill_state=skill_state_now(mission, activity),
    )


def skill_state_now(mission: Progress, activity: Activity | None) -> SkillStateBase | None:
    """Return what the running step's skill remembers now; None: nothing yet."""
    kept = activity.act.state if isinstance(activity, (Driving, Observing, AskingImage)) else None
    return kept if kept is not None else mission.skill_state


def pause_running(
    turn: Transaction, reason: str, cause: Cause = GoalFact.INTERRUPTED, by: str | None = None
) -> None:
    """Stand still and keep the running mission's place; those who wait are kept waiting."""
    if turn.running is not None:
        mission = settle_activity(turn)
        if reason == PauseReason.TELEOP.value:  # from now on another hand moves the robot
            mission = turn.put(mission, began_at=None)
        turn.move_to(mission, cause, reason=reason, outcome=_hint(reason), stopped_by=by)
        turn.set(running=None)
    hold_queue(turn)


def yield_robot(
    turn: Transaction, mission: Mission, cause: Cause, reason: str | None, said: Outcome | None
) -> None:
    """Leave the robot standing and free while a person is asked; queued goals are kept waiting."""
    turn.set(running=None, activity=None)
    turn.move_to(mission, cause, reason=reason, outcome=said)
    for other in _waiting(turn):
        if not other.held:
            turn.put(other, held=True)


def _hint(reason: str) -> Outcome | None:
    """Tell a person what a paused goal needs, where the reason alone doesn't."""
    return plain_outcome(Code.NOT_ARMED) if reason == "disarmed" else None


def pause_planning(turn: Transaction, mission: Mission, reason: str) -> None:
    """Stop thinking about a goal; a resume thinks anew."""
    turn.emit(DropBrain(mission.id))
    turn.move_to(mission, PersonCause.PAUSES, reason=reason)


def end_running(
    turn: Transaction,
    cause: Cause,
    code: Code,
    reason: str | None = None,
    row: str = "",
    said: Bilingual | None = None,
) -> None:
    """End the running mission with its figures; steps never begun are skipped."""
    mission = settle_activity(turn)
    said = said or failure(turn.book.facts, mission, mission.current_step, code, row)
    finish(turn, mission, cause, ended_outcome(turn, mission, code, said), reason)


def finish(
    turn: Transaction, mission: Mission, cause: Cause, outcome: Outcome, reason: str | None = None
) -> None:
    """Write the end of a mission, wherever it stood, and free what it had."""
    plan = mission.plan
    if plan is not None and plan.steps:
        after = {StepState.RUNNING: StepState.FAILED, StepState.PENDING: StepState.SKIPPED}
        cancelled = next_state(mission.state, cause) is GoalState.CANCELLED
        steps = tuple(
            s.model_copy(
                update={
                    "state": StepState.SKIPPED if cancelled and s.state in after
                    else after.get(s.state, s.state),
                    "reason": reason if s.state is StepState.RUNNING else s.reason,
                }
            )
            for s in plan.steps
        )  # fmt: skip
        plan = plan.model_copy(update={"steps": steps})
    turn.move_to(mission, cause, outcome=outcome, reason=reason, plan=plan, held=False, kept=False)
    dequeue(turn, mission.id)
    if turn.book.running == mission.id:
        turn.set(running=None, activity=None)


def cancel(turn: Transaction, mission: Mission) -> None:
    """End a goal because somebody asked."""
    if mission.state is GoalState.PLANNING:
        turn.emit(DropBrain(mission.id))
    if turn.book.running == mission.id:
        end_running(turn, PersonCause.CANCELS, Code.CANCELLED)
        return
    outcome = plain_outcome(Code.CANCELLED)
    if mission.metres > 0.0:
        outcome = ended_outcome(turn, mission, Code.CANCELLED, outcome.message)
    finish(turn, mission, PersonCause.CANCELS, outcome)


def reorder(turn: Transaction, mission_id: str, before: str | None) -> None:
    """Put a queued mission before another, or last."""
    others = [i for i in turn.book.queue if i != mission_id]
    at = others.index(before) if before is not None and before in others else len(others)
    turn.set(queue=(*others[:at], mission_id, *others[at:]))
    for moved in _waiting(turn):  # their positions changed: whoever listens must hear it
        turn.put(moved)


def next_up(turn: Transaction) -> Mission | None:
    """Return the mission that may have the robot now, or None.

    Of several people the first who asked goes first, though the thought about it takes longest.
    """
    if turn.book.running is not None or standing_hold(turn) is not None:
        return None
    thinking = turn.book.goals_in(GoalState.PLANNING)
    if any(m.first for m in thinking):
        return None  # "forget that, …": the robot stays free for what is thought about
    found = next((m for m in _waiting(turn) if not m.held), None)
    if found is None or _goes_first(found):
        return found
    return None if any(m.order < found.order for m in thinking) else found


def note_step(turn: Transaction, mission: Mission, **changes: object) -> Mission:
    """Change the record of the mission's current step."""
    steps = list(mission.steps)
    steps[mission.step] = steps[mission.step].model_copy(update=changes)
    return turn.put_steps(mission, tuple(steps))


def decline(turn: Transaction, mission: Mission, said: Bilingual) -> None:
    """End a goal where the robot stands; a question that was answered is over, the rest skipped."""
    if turn.book.running == mission.id:
        mission = settle_activity(turn)
    if mission.asks and mission.steps[mission.step].answer is not None:
        mission = note_step(turn, mission, state=StepState.SUCCEEDED)
    outcome = ended_outcome(turn, mission, Code.DECLINED, said)
    finish(turn, mission, PersonCause.DECLINES, outcome, Code.DECLINED.value)
