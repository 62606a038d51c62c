"""Take a second thought: the new steps take the place of the rest, or the goal ends as it stood.

Law: the same steps again are no new plan, so a brain whose answer to a sentence is always the same
(the offline brain's is) ends a goal after one thought instead of trying for ever. Some new plans
need a person's yes though nobody asked to see them first: ``needs_yes`` has one rule a line.
"""

from __future__ import annotations

import json

from planner.brain.interface import OFFLINE
from planner.language.catalogue import join, message, say
from planner.language.questions import looks_round
from planner.mission.account import name_place
from planner.mission.events import Planned
from planner.mission.outcomes import plain_outcome
from planner.mission.plan_check import NO_STEPS, UNASKED, ask_for_motion, unwalkable
from planner.mission.queue import clear_hold, end_running, note_step, yield_robot
from planner.mission.scene import first_deed, scene_of
from planner.mission.state import Mission
from planner.mission.step_execution import begin_step, carry_out
from planner.mission.step_failure import give_up, to_step
from planner.mission.transaction import Transaction
from planner.mission.transitions import BrainCause, Cause, GoalFact
from planner.plan import (
    AnswerPlan,
    Bilingual,
    Clarify,
    Code,
    Outcome,
    Plan,
    PlanRecord,
    Refuse,
    StepPlan,
    StepRecord,
    StepState,
    places_of,
    plan_record,
)
from planner.plan.plan_walk import asked_of, close_open
from planner.site.site_view import SiteView
from planner.skills.ask import ask_again

SAME_AGAIN = say("plan.same_again")


def fingerprint(steps: tuple[StepRecord, ...]) -> str:
    """Return what steps ask for, whatever came of them; of a plain step as it always was."""
    asked = {"kind", "place", "places", "object", "text", "seconds", "angle_rad", "distance_m"}
    asked |= {"x", "y"}
    told = [{**asked_of(s), **s.model_dump(mode="json", include=asked)} for s in steps]
    return json.dumps(told, sort_keys=True)


def rethought(turn: Transaction, mission: Mission, event: Planned) -> None:
    """Take the answer of a brain that was asked again while the goal runs."""
    turn.set(activity=None)
    if event.brain is not None:
        mission = turn.put(mission, brain=event.brain)
    plan = event.plan
    steps = _steps(plan, mission)
    # Of a question its answer is thought about that was neither yes nor no.
    if mission.asks and _of_no_use(turn, mission, event, steps):
        carry_out(turn, mission, ask_again(scene_of(turn, mission)))
        return
    if steps is None:
        _no_steps(turn, mission, plan, event.failure)
        return
    refused = unwalkable(turn.book, mission, steps) or _same_again(mission, steps)
    if refused is not None:
        _end(turn, mission, GoalFact.STEP_FAILS, refused)
        return
    _adopt(turn, mission, steps, event.unasked)


def _steps(plan: Plan | None, mission: Mission) -> tuple[StepRecord, ...] | None:
    """Return the new steps; a question under way is a step that asks and one that decides."""
    if isinstance(plan, StepPlan):
        return plan_record(plan).steps
    if isinstance(plan, Clarify):
        question = plan.question.of(mission.language)
        return (
            StepRecord(kind="ask", text=question),
            StepRecord(kind="decide", text=mission.words[:500]),
        )
    return None


def _of_no_use(
    turn: Transaction, mission: Mission, event: Planned, steps: tuple[StepRecord, ...] | None
) -> bool:
    """Tell whether a thought leaves nothing better than to ask the person once more."""
    if steps is not None:
        return bool(unwalkable(turn.book, mission, steps) or _same_again(mission, steps))
    offline = event.brain is not None and event.brain.name == OFFLINE
    return event.plan is None or (isinstance(event.plan, Refuse) and offline)


def _same_again(mission: Mission, steps: tuple[StepRecord, ...]) -> Outcome | None:
    tried = {*mission.tried, fingerprint(mission.steps[mission.step :])}
    if fingerprint(steps) not in tried:
        return None
    return plain_outcome(Code.BAD_PLAN, why=SAME_AGAIN)


def _no_steps(
    turn: Transaction, mission: Mission, plan: Plan | None, failure: Outcome | None
) -> None:
    decides = mission.failure is None
    if isinstance(plan, AnswerPlan) and decides:
        note_step(turn, mission, state=StepState.SUCCEEDED)
        said = message(Code.ANSWERED, text=plan.text)
        end_running(turn, BrainCause.ANSWERS, Code.ANSWERED, said=said)
        return
    if isinstance(plan, AnswerPlan) and mission.failure is not None:
        _fail_with_advice(turn, mission, mission.failure, plan.text)
        return
    if isinstance(plan, Refuse):
        _end(turn, mission, BrainCause.REFUSES, Outcome(code=plan.code, message=plan.reason))
        return
    why = failure or plain_outcome(Code.BAD_PLAN, why=NO_STEPS)
    _end(turn, mission, GoalFact.STEP_FAILS, why)


def _fail_with_advice(turn: Transaction, mission: Mission, why: Outcome, text: Bilingual) -> None:
    """End the goal by its failure, and tell behind it what the brain says to that."""
    step = mission.current_step
    told = (step.said if step is not None else None) or why.message
    if text.en not in told.en:  # the built-in brain says the failure again
        told = join((told, text))
    mission = note_step(turn, mission, said=told)
    give_up(turn, turn.put(mission, failure=why.model_copy(update={"message": told})))


def _end(turn: Transaction, mission: Mission, cause: Cause, why: Outcome) -> None:
    """End the goal; where a step had failed, that failure is told."""
    if mission.failure is not None:
        give_up(turn, mission)
        return
    note_step(turn, mission, state=StepState.FAILED, reason=why.code.value)
    end_running(turn, cause, why.code, why.code.value, said=why.message)


def _adopt(
    turn: Transaction, mission: Mission, steps: tuple[StepRecord, ...], unasked: tuple[int, ...]
) -> None:
    question, reason = _first_question(turn.book.facts, mission, steps, unasked)
    if mission.failure is None:
        mission = note_step(turn, mission, state=StepState.SUCCEEDED)
    before = close_open(mission.steps[: mission.step + 1], mission.step)
    mission = turn.put(
        mission,
        plan=PlanRecord(kind="plan", steps=(*before, *steps)),
        tried=(*mission.tried, fingerprint(steps)),
        failure=None,
    )
    mission = to_step(turn, mission, mission.step + 1)
    if mission.confirm or question is not None:
        yield_robot(turn, mission, BrainCause.NEEDS_YES, reason, question)
    else:
        clear_hold(turn, mission)
        begin_step(turn)


def _first_question(
    facts: SiteView, mission: Mission, steps: tuple[StepRecord, ...], unasked: tuple[int, ...]
) -> tuple[Outcome | None, str | None]:
    """Return what a person is asked before new steps are walked, with its reason.

    What nobody asked for comes first: that question names all of it.
    """
    shall_i = ask_for_motion(facts, mission.steps, steps, unasked)
    if shall_i is not None:
        return shall_i, UNASKED
    question = needs_yes(facts, mission, steps)
    reason = "new_plan" if mission.asks else "new_place"
    return question, None if question is None else reason


BACK = ""
"""Where a goal was given: no place has this id."""
ROAMS = frozenset({"find", "count", "follow", "go_to_object", "go_to_point", "look", "explore"})
"""Steps that lead where the eyes say, and not to a place."""


def needs_yes(facts: SiteView, mission: Mission, steps: tuple[StepRecord, ...]) -> Outcome | None:
    """Return the question to a person before these new steps are walked, or None.

    ``new_place``: the person named where to go, or what to; a brain that found that shut must not
    choose another destination by itself, nor roam for what was not asked for. After an answer that
    was neither yes nor no, whatever moves needs a yes of its own.
    """
    if mission.asks:
        deed = first_deed(facts, steps)
        why = None if deed is None else say("confirmation.would", deed=deed)
    elif mission.failure is None:
        return None
    else:
        why = _elsewhere(facts, mission.steps, steps) or _roaming(mission.steps, steps)
    return None if why is None else plain_outcome(Code.CONFIRM, why=why)


def _elsewhere(
    facts: SiteView, before: tuple[StepRecord, ...], steps: tuple[StepRecord, ...]
) -> Bilingual | None:
    """Say which place is new, if one is."""
    known = {place for step in before for place in _places(facts, step)}
    fresh = [p for step in steps for p in _places(facts, step) if p not in known]
    if not fresh:
        return None
    back = fresh[0] == BACK
    name = say("confirmation.start") if back else name_place(facts, fresh[0])
    return say("confirmation.elsewhere", name=name)


def _roaming(before: tuple[StepRecord, ...], steps: tuple[StepRecord, ...]) -> Bilingual | None:
    """Say which step leads where the eyes say and was not in the plan before, if one does."""
    known = {_make_key(step) for step in before}
    fresh = next((s for s in steps if _roams(s) and _make_key(s) not in known), None)
    if fresh is None:
        return None
    return say(f"confirmation.{fresh.kind}", what=fresh.object or "")


def _roams(step: StepRecord) -> bool:
    if step.kind == "look":
        return step.place is None and looks_round(step.text or "")
    return step.kind in ROAMS or (step.kind == "stand_at" and step.object is not None)


def _make_key(step: StepRecord) -> tuple[str, str, str | None, int | None, int | None]:
    """Return a step's aim as a key; a look round is the same for any question."""
    what = (step.object or "").strip().casefold()
    if step.kind == "look":
        what = "round" if _roams(step) else "ahead"
    return step.kind, what, step.place, step.x, step.y


def _places(facts: SiteView, step: StepRecord) -> tuple[str, ...]:
    if step.kind == "return_home":
        return (facts.home,)
    return (BACK,) if step.kind == "come_back" else places_of(step)
