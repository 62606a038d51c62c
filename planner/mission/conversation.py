"""Gather what a brain is told: where things stand, the last goals, what came of this one's steps.

Pure. Law: nothing that a model read in a picture, and nothing said after it, is among what is told
of other goals; one in whose course a picture was read is told by its order and its code alone. Of
the goal's own steps facts and figures are told, and no advice. What a person answered is quoted,
and cut to what an observation holds: it may inform a plan, and every plan is validated whatever
informed it.
"""

from __future__ import annotations

from math import degrees
from typing import TYPE_CHECKING

from planner.brain.interface import MAX_OBSERVED, Exchange, Observation
from planner.brain.situation import MAX_QUEUED, MAX_RECENT, OpenQuestion, RecentGoal, Situation
from planner.language.catalogue import list_names, say
from planner.language.commands import OutcomeCommand
from planner.language.formatting import angle, metres
from planner.language.sentence import parse
from planner.mission.account import name_place
from planner.mission.awaited_word import list_waiting
from planner.mission.effects import AskBrain
from planner.mission.outcomes import find_place_near, spot_at
from planner.mission.state import Consent, GivenOrder, Mission, MissionState, Planning
from planner.plan import CONTROL, Bilingual, Code, GoalState, StepRecord, StepState, places_of
from planner.plan.plan_walk import NOT_CHOSEN
from planner.site.site_view import SiteView

if TYPE_CHECKING:
    from planner.mission.transaction import Transaction


_EYES = frozenset({"look", "find", "count"})
"""Steps of which a detector has words of its own."""
_ORDER, _TOLD, _QUEUED = 70, 80, 50  # characters
_UNSEEN = frozenset({GoalState.PLANNING, GoalState.QUEUED, GoalState.RUNNING})


def situation_of(book: MissionState, mission: Mission, now_s: float) -> Situation:
    """Return where things stand for a brain that thinks about this goal."""
    status, pose, running = book.status, book.pose, book.running_goal
    near = find_place_near(book.facts, pose) if pose is not None else None
    waiting = [i for i in book.queue if i != mission.id]
    own = running is None or running.id == mission.id
    return Situation(
        battery=status.drive.battery if status is not None else None,
        room=spot_at(book.facts, pose).room,
        place=near.id if near is not None else None,
        heading_deg=round(degrees(pose.yaw_rad)) if pose is not None else None,
        running=None if own or running is None else running.text[:_ORDER],
        step=None if own or running is None else _step(running),
        queue=tuple(book.missions[i].text[:_QUEUED] for i in waiting[:MAX_QUEUED]),
        more=max(0, len(waiting) - MAX_QUEUED),
        thinking=_orders_in(book, mission, GoalState.PLANNING)[:MAX_QUEUED],
        paused=_orders_in(book, mission, GoalState.PAUSED)[: -MAX_QUEUED - 1 : -1],
        question=_question(book, mission),
        recent=_recent(book, mission, now_s + book.wall_offset_s),
    )


def question_of(turn: Transaction, mission: Mission) -> AskBrain:
    """Return what a brain is asked about a goal, with where things stand."""
    return AskBrain(
        *(mission.id, mission.words, mission.language),
        room=spot_at(turn.book.facts, turn.book.pose).room,
        order=mission.text,
        exchanges=exchanges_of(mission),
        departed=mission.departed_at is not None,
        situation=situation_of(turn.book, mission, turn.now_s),
        changed=None if mission.replies else mission.changed,
    )


def _orders_in(book: MissionState, mission: GivenOrder, state: GoalState) -> tuple[str, ...]:
    """Return the other orders in a state, oldest first."""
    return tuple(m.text[:_QUEUED] for m in book.goals_in(state, besides=mission.id))


def _step(running: Mission) -> str | None:
    step = running.current_step
    return None if step is None else f"{step.kind} {step.place or ''}".strip()


def _question(book: MissionState, mission: GivenOrder) -> OpenQuestion | None:
    """Return the newest question that waits, besides this goal's own."""
    waiting = list_waiting(book, mission.id)
    newest = max(waiting, key=lambda m: m.updated_unix_s, default=None)
    if newest is None:
        return None
    asked = _tell_outcome(newest)
    return OpenQuestion(order=newest.text[:_ORDER], asked=asked)


def _recent(book: MissionState, mission: GivenOrder, now_unix_s: float) -> tuple[RecentGoal, ...]:
    """Return the newest goals before this one that are not under way, newest first."""
    before = (
        m for m in book.missions.values() if m.order < mission.order and m.state not in _UNSEEN
    )
    newest = sorted(before, key=lambda m: -m.order)[:MAX_RECENT]
    return tuple(
        RecentGoal(
            order=m.text[:_ORDER],
            outcome=m.outcome.code.value if m.outcome is not None else m.state.value,
            told=_tell_outcome(m),
            minutes=max(0, int((now_unix_s - m.created_unix_s) / 60.0)),
        )
        for m in newest
    )


def _tell_outcome(mission: Mission) -> str:
    """Return what a person was told of a goal; nothing where a picture was read for it, nor where
    it repeats what another goal came to.
    """
    if mission.outcome is None:
        return ""
    if any(step.read is not None for step in mission.steps):
        return _tell_looks(mission)[:_TOLD]
    if mission.outcome.code is Code.MODEL_UNAVAILABLE:  # a server's own words may be in it
        return ""
    if isinstance(parse(mission.text).intent, OutcomeCommand):
        return ""
    return mission.outcome.message.of(mission.language)[:_TOLD]


def _tell_looks(mission: Mission) -> str:
    """Return the detector's own words of a goal that looked.

    Nothing of a step that comes after a model's reading: a ``say`` or an answer may repeat it.
    """
    told: list[str] = []
    for step in mission.steps:
        if step.said is not None and step.kind in _EYES:
            told.append(step.said.of(mission.language))
        if step.read is not None:
            break
    return " ".join(told)


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
    names = [name_place(facts, place) for place in places_of(step)]
    if step.reason is None:
        return list_names(names)
    if not names:
        return say("observation.reason", reason=step.reason)
    return say("observation.place_reason", names=list_names(names), reason=step.reason)
