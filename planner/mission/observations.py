"""Report the results of a goal's steps to a brain that thinks again. Facts and figures, no advice.

What a person answered is quoted, and cut to what an observation holds: it may inform a plan, and
every plan is validated whatever informed it.
"""

from __future__ import annotations

from planner.brain.interface import MAX_OBSERVED, Exchange, Observation
from planner.language.catalogue import list_names, say
from planner.language.formatting import angle, metres
from planner.mission.plan_walk import NOT_CHOSEN
from planner.mission.state import Consent, Mission, Planning
from planner.plan import CONTROL, Bilingual, StepRecord, StepState, say_same
from planner.site.site_view import SiteView

RESULTS = {
    StepState.SUCCEEDED: "succeeded",
    StepState.FAILED: "failed",
    StepState.SKIPPED: "skipped",
}


def list_observations(facts: SiteView, mission: Mission) -> tuple[Observation, ...]:
    """Return one observation a step that is over, and the question of a step that decides."""
    over = mission.steps[: mission.step]
    now = mission.current_step
    if now is not None and _is_over(now):
        over = (*over, now)
    over = tuple(s for s in over if s.kind not in CONTROL and s.reason != NOT_CHOSEN)
    last = len(over) - 1
    seen = [
        _observation(facts, mission, step, newest=index == last) for index, step in enumerate(over)
    ]
    return tuple(seen[-MAX_OBSERVED:])


def exchanges_of(mission: Consent) -> tuple[Exchange, ...]:
    """Return the questions about the order and their answers, before any step; oldest first."""
    asked = (*mission.questions, *("" for _ in mission.replies))
    pairs = zip(asked, mission.replies, strict=False)
    return tuple(Exchange(asked=question, answer=answer) for question, answer in pairs)


def _is_over(step: StepRecord) -> bool:
    """Tell whether there is something to tell of the current step: it failed, or was answered."""
    answered = step.kind == "ask" and step.answer is not None
    return answered or step.kind == "decide" or step.state is StepState.FAILED


def _observation(
    facts: SiteView, mission: Planning, step: StepRecord, *, newest: bool
) -> Observation:
    answered = step.kind == "ask" and step.answer is not None
    result = "answered" if answered else RESULTS.get(step.state, "succeeded")
    detail = _detail(facts, step)
    if newest and step.state is StepState.FAILED and mission.failure is not None:
        detail = mission.failure.message
    return Observation.model_validate(
        {"step": step.kind, "result": result, "detail": detail, "read": step.read}
    )


def _detail(facts: SiteView, step: StepRecord) -> Bilingual:
    text = step.text or ""
    if step.said is not None:
        return step.said
    match step.kind:
        case "ask":
            answer = step.answer if step.answer is not None else "-"
            return say("observation.asked_answer", text=text[:120], answer=answer[:150])
        case "decide":
            return say("observation.decide_now", text=text)
        case "say":
            return say("observation.said", text=text)
        case "turn":
            return angle(step.turned_rad if step.turned_rad is not None else step.angle_rad or 0.0)
        case "move":
            return metres(step.moved_m if step.moved_m is not None else step.distance_m or 0.0)
        case "wait":
            return say("observation.seconds", seconds=step.seconds or 0)
        case _:
            return _describe_places(facts, step)


def _describe_places(facts: SiteView, step: StepRecord) -> Bilingual:
    wanted = (step.place,) if step.place else step.places
    names = [facts.targets[p].name if p in facts.targets else say_same(p) for p in wanted]
    if step.reason is None:
        return list_names(names)
    if not names:
        return say("observation.reason", reason=step.reason)
    return say("observation.place_reason", names=list_names(names), reason=step.reason)
