"""Let a step fail: think again with the observation in hand, or end the goal honestly.

Law: at most as many thoughts as the rules allow; what no other plan could mend ends at once. The
robot stands while the brain thinks, and keeps its place: it is this goal's turn. Who was sent to
look and to come back comes back with nothing, too: that way alone is still driven.
"""

from __future__ import annotations

from dataclasses import replace

from planner.language.catalogue import say
from planner.mission.account import BACK
from planner.mission.activity import Retrying, Thinking
from planner.mission.conversation import list_observations, question_of
from planner.mission.outcomes import failure
from planner.mission.queue import decline, end_running, note_step, settle_activity
from planner.mission.recovery import FRESH
from planner.mission.state import Mission
from planner.mission.transaction import Transaction
from planner.mission.transitions import GoalFact
from planner.plan import Bilingual, Code, Outcome, StepState, parent_of, parents_of
from planner.plan.plan_walk import catch
from planner.skills import Fail, SkillStateBase

SHUT = frozenset({Code.NO_ROUTE, Code.BLOCKED, Code.GOAL_OCCUPIED})
MENDABLE = SHUT | {
    *(Code.NO_ROOM, Code.NOT_REACHED, Code.UNKNOWN_PLACE, Code.NOT_FOUND, Code.LOST_PERSON)
}
"""Another plan may do better. A fault, a spent budget or a missing skill is told at once."""
CAUGHT = MENDABLE | {Code.UNSURE, Code.UNMET, Code.BLIND}
"""What a plan's own ``on_failure`` is for. A fault, a spent budget or a missing part ends the goal
whatever the plan says."""
IN_VAIN = frozenset({Code.NOT_FOUND, Code.LOST_PERSON, Code.UNSURE, Code.UNMET})
"""Nothing was wrong but that it was not there: the way back that the person ordered holds."""
AGAIN_S = 1.0
"""A way that is shut stays so for a while: a step that goes on without it is asked no sooner."""


def fail_step(turn: Transaction, cannot: Fail) -> None:
    """End the running step without success; then think again, or end the goal.

    A leg whose skill knows what to do without it ends alone, and the step goes on. What a person
    declined ends at once: no other plan is thought about.
    """
    leg = turn.driving
    if leg is not None and leg.act.otherwise is not None and cannot.code in SHUT:
        _drop_leg(turn, leg.act.otherwise)
        return
    mission = settle_activity(turn)
    if cannot.code is Code.DECLINED and cannot.said is not None:
        decline(turn, mission, cannot.said)
        return
    said = cannot.said or failure(turn.book.facts, mission, mission.current_step, cannot.code, "")
    before = mission.failure if mission.returning else None
    why = Outcome(code=cannot.code, message=said)
    if before is not None:  # it is told behind the failure on the way there
        both = say("step_failure.both", told=before.message, said=said)
        why = Outcome(code=before.code, message=both)
    mission = note_step(
        turn, mission, state=StepState.FAILED, reason=cannot.reason, said=said, **cannot.figures
    )
    if before is None and cannot.code in CAUGHT and _take_other_way(turn, mission):
        return
    mission = turn.put(mission, failure=why)
    declined = getattr(mission.skill_state, "offered", False)  # nobody wants to look on
    mendable = cannot.code in MENDABLE and before is None and not declined
    if mendable and mission.replans < turn.book.rules.replans:
        think(turn, turn.put(mission, replans=mission.replans + 1))
        return
    give_up(turn, mission)


def _take_other_way(turn: Transaction, mission: Mission) -> bool:
    """Go on with what the plan holds for this failure; say if it holds anything."""
    at = catch(mission.steps, mission.step, turn.now_unix_s)
    if at is None:
        return False
    to_step(turn, turn.put_steps(mission, at.row), at.index)
    turn.set(activity=Retrying(record=turn.next_entry, retry_s=turn.now_s))
    return True


def _drop_leg(turn: Transaction, state: SkillStateBase) -> None:
    """Go on in the step without this leg: its skill is asked soon, standing."""
    turn.put(settle_activity(turn), skill_state=state)
    retry_s = turn.now_s + AGAIN_S
    again = Retrying(record=turn.next_entry, retry_s=retry_s, since_s=turn.now_s)
    turn.set(activity=again)


def give_up(turn: Transaction, mission: Mission) -> None:
    """End the running goal with its failure, where no way back is left to drive."""
    why = mission.failure
    if why is not None and why.code in IN_VAIN and _go_back(turn, mission):
        return
    end_failed(turn, mission, why.message if why is not None else None)


def end_failed(turn: Transaction, mission: Mission, said: Bilingual | None) -> None:
    """End the running goal by its failure, told in these words."""
    code = mission.failure.code if mission.failure is not None else Code.BAD_PLAN
    failed = [s for s in mission.steps[: mission.step + 1] if s.state is StepState.FAILED]
    looked = [s for s in failed if s.kind not in BACK] or failed
    reason = looked[-1].reason if looked else None
    own = failed[-1].said if failed else None  # a step that failed tells why by itself
    end_running(turn, GoalFact.STEP_FAILS, code, reason, said=own or said)


def _go_back(turn: Transaction, mission: Mission) -> bool:
    """Leave out all that was still to be done but the first way back; say if there is one."""
    left = range(mission.step + 1, len(mission.steps))
    pending = (i for i in left if mission.steps[i].state is StepState.PENDING)
    sure = (i for i in pending if _is_sure(mission, i))
    back = next((i for i in sure if mission.steps[i].kind in BACK), None)
    if back is None or mission.failure is None:
        return False
    skipped = {"state": StepState.SKIPPED, "reason": mission.failure.code.value}
    steps = tuple(
        step.model_copy(update=skipped) if i in left and i != back else step
        for i, step in enumerate(mission.steps)
    )
    to_step(turn, turn.put_steps(mission, steps), back)
    turn.set(activity=Retrying(record=turn.next_entry, retry_s=turn.now_s))
    return True


def _is_sure(mission: Mission, index: int) -> bool:
    """Tell whether a step would come without a condition or a failure that is still open."""
    row = mission.steps
    parent, now = parent_of(row, index), (mission.step, *parents_of(row, mission.step))
    if parent is None:
        return True
    branch = {row[i].role for i in now if parent_of(row, i) == parent}
    return row[index].role in branch


def to_step(turn: Transaction, mission: Mission, index: int) -> Mission:
    """Point at a step, of which nothing is done yet."""
    return turn.put(
        mission,
        step=index,
        part=0,
        began_at=None,
        done=0.0,
        skill_state=None,
        recovery=FRESH,
        step_s=0.0,
        step_m=0.0,
    )


def think(turn: Transaction, mission: Mission) -> None:
    """Have the brain think again, standing, with all that came of the goal so far."""
    turn.set(activity=Thinking(record=turn.next_entry))
    ask = question_of(turn, mission)
    observed = list_observations(turn.book.facts, mission)
    turn.emit(replace(ask, observed=observed, replan=mission.replans))
