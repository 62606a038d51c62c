"""Let a model's plan act on what runs: in its place, right after it, ending it, or as an answer.

Laws: a goal is ended only where the person's own words take something back, outside of conditions
and quotes; a plan that comes in its place ends it no sooner than it may itself be walked. What
answers a question is what the person said, word for word, and never what a model makes of it: so no
model can say yes. Pure.
"""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

from planner.language.catalogue import list_names, message, say
from planner.language.motion_guard.clause_moods import ClauseMood
from planner.language.motion_guard.clauses import read_clauses
from planner.language.motion_guard.mentioned_names import label_named, places_named
from planner.mission.open_questions import WAITS, take_sentence
from planner.mission.queue import cancel, finish
from planner.mission.state import goal_to_end
from planner.mission.transitions import BrainCause
from planner.plan import (
    Bilingual,
    Clarify,
    Code,
    GoalState,
    Option,
    Outcome,
    PlanRole,
    Vocabulary,
    places_of,
    plan_record,
    say_same,
)

if TYPE_CHECKING:
    from planner.mission.state import GivenOrder, Mission, MissionState
    from planner.mission.transaction import Transaction
    from planner.plan import StepPlan


_ENDS_IT = (
    r"\b(?:forget|cancel|never ?mind|scrap|scratch|abort|drop|call off|leave it|skip|enough|quit"
    r"|(?:don't|do not) (?:go|bother|need|look|do|drive))\b"
    r"|取消|撤销|算了|放弃|忘了|免了|不用|不要|别"
)
_ENDS = re.compile(_ENDS_IT)
_TAKES_BACK = re.compile(
    rf"(?:^|[,.;!|] *)(?:\w+ )?(?:no|nope|not)\b|\bnot (?:the|there|that|this)\b"
    r"|\b(?:instead|rather|wrong|i meant?|changed? (?:my|the|of)|actually|sorry|make (?:it|that))\b"
    rf"|不对|不是|不去|不不|^不|改|换|错|而是|还是去|我(?:说|要|指)的是|我是说|{_ENDS_IT}"
)


IN_HAND = frozenset(
    {GoalState.PLANNING, GoalState.NEEDS_CLARIFICATION, GoalState.AWAITING_CONFIRMATION}
)


def goal_in_hand(turn: Transaction, new: GivenOrder) -> Mission | None:
    """Return the goal that "forget that" means: the running, else the newest that thinks or asks.

    A goal that a person paused keeps its place, and so do those that wait.
    """
    if turn.running is not None:
        return turn.running
    open_ = (m for m in turn.book.missions.values() if m.order < new.order and m.state in IN_HAND)
    return max(open_, key=lambda m: m.order, default=None)


def takes_back(text: str) -> bool:
    """Tell whether a person's words take anything back, whatever they name."""
    return _TAKES_BACK.search(_unconditional(text)) is not None


def ends_goal(text: str) -> bool:
    """Tell whether a person's words end what is done, and nothing in its place."""
    return _ENDS.search(_unconditional(text)) is not None


def _unconditional(text: str) -> str:
    """Return what a sentence says outside of conditions and quotes, denials included."""
    clauses = read_clauses(text, Vocabulary())
    hangs = any(each.hung or each.mood is ClauseMood.CONDITION for each in clauses)
    out = {ClauseMood.CONDITION, ClauseMood.DENIED} if hangs else set()
    return " | ".join(each.text for each in clauses if each.mood not in out and not each.hung)


def assume_role(turn: Transaction, mission: Mission, role: PlanRole) -> Mission:
    """Return a goal that will be queued as its plan says, where the person's words bear that."""
    if role is PlanRole.AFTER:
        return turn.put(mission, first=True)
    if role is PlanRole.INSTEAD and takes_back(mission.words):
        return turn.put(mission, replace=True)
    return mission


def end_current(turn: Transaction, mission: Mission, target: Mission | None) -> None:
    """End the goal that a person wants ended; ask where their words do not say so.

    The goal that the person's own words name is meant; else the one in hand, else the only one
    that is paused. Of several paused ones none is chosen for them: they are asked which.
    """
    named, paused = _goals_named(turn, mission), _goals_in(turn, mission, GoalState.PAUSED)
    if len(named) == 1:
        target = named[0]
    elif target is None and len(paused) > 1:
        names = list_names(say_same(f"“{each.text[:60]}”") for each in paused)
        _ask(turn, mission, say("confirmation.end_which", names=names))
        return
    target = target or next(iter(paused), None)
    if target is None:
        _answer(turn, mission, say("commands.nothing_to_cancel"))
        return
    text = target.text[:60]
    said = (mission.words, mission.text) if named else (mission.words,)  # "forget that" – "which?"
    if not any(map(ends_goal, said)):
        question = say("confirmation.end_goal", text=text)
        order = "cancel it" if mission.language == "en" else "取消任务"
        offer = Option(label=say("confirmation.end_it"), text=order)
        _ask(turn, mission, question, offer)
        return
    cancel(turn, target)
    _answer(turn, mission, say("commands.done", done=say("commands.cancelled"), text=text))


def _goals_in(turn: Transaction, new: GivenOrder, *states: GoalState) -> list[Mission]:
    """Return the other goals in these states, oldest first."""
    others = (m for m in turn.book.missions.values() if m.state in states and m.id != new.id)
    return sorted(others, key=lambda m: m.order)


def _goals_named(turn: Transaction, new: Mission) -> list[Mission]:
    """Return the open goals of which a person's words name a place or a thing."""
    open_ = (*IN_HAND, GoalState.RUNNING, GoalState.QUEUED, GoalState.PAUSED)
    places = set(places_named(new.words, turn.book.facts.names))
    return [
        goal
        for goal in _goals_in(turn, new, *open_)
        if _goes_to(goal, places)
        or any(step.object and label_named(step.object, new.words) for step in goal.steps)
    ]


def _goes_to(goal: Mission, places: set[str]) -> bool:
    return any(not places.isdisjoint(places_of(step)) for step in goal.steps)


def goals_to_end(book: MissionState, new: Mission) -> tuple[str, ...]:
    """Return the goals that a plain "forget that" or a denial ends; none: there are none.

    What was added to the running order ends with it, and a paused order is not ended by the denial
    of a place that it has nothing to do with.
    """
    found = goal_to_end(book, new.id)
    if found is None:
        return (new.id,) if new.replies else ()
    goal, places = book.missions[found], set(places_named(new.words, book.facts.names))
    if goal.state is GoalState.PAUSED and places and not _goes_to(goal, places):
        return ()
    added = (i for i in book.queue if book.missions[i].first and i != found and not places)
    return (found, *added)


def _ask(turn: Transaction, mission: Mission, question: Bilingual, *offers: Option) -> None:
    asks = Clarify(code=Code.AMBIGUOUS, question=question, options=offers)
    mission = turn.put(mission, plan=plan_record(asks))
    said = Outcome(code=asks.code, message=question)
    turn.move_to(mission, BrainCause.ASKS, reason=asks.code.value, outcome=said)


def _answer(turn: Transaction, mission: Mission, said: Bilingual) -> None:
    text = message(Code.ANSWERED, text=said)
    finish(turn, mission, BrainCause.ANSWERS, Outcome(code=Code.ANSWERED, message=text))


def find_asking(turn: Transaction, mission: Mission) -> Mission | None:
    """Return the one goal whose question a sentence answers; end the sentence's own goal.

    Where none waits, or several, nothing is answered and the person is told so.
    """
    waiting = [m for m in turn.book.missions.values() if m.state in WAITS and m.id != mission.id]
    if not waiting:
        refused = Outcome(code=Code.NOT_UNDERSTOOD, message=say("talk.nothing_asked"))
        finish(turn, mission, BrainCause.REFUSES, refused, Code.NOT_UNDERSTOOD.value)
        return None
    return take_sentence(turn, mission, tuple(m.id for m in waiting))


LEAST_SPEED_SHARE = 0.25
"""Slower than that a robot blocks people's way for minutes; who wants less says stop."""


SLOW_SHARE = 0.5
"""Of the planned speeds, for an order to do something slowly; "faster" takes it back."""


def share_of(plan: StepPlan) -> float:
    """Return the share of the planned speeds that an order leaves."""
    return SLOW_SHARE if plan.pace == "slow" else 1.0


def change_speed(turn: Transaction, mission: Mission, *, slower: bool) -> None:
    """Halve the speed cap of a running goal, or double it up to the whole; no lower than a quarter.

    The bridge's own limits hold as ever: this can only make the robot slower than planned.
    """
    share = mission.speed_share / 2.0 if slower else mission.speed_share * 2.0
    turn.put(mission, speed_share=min(1.0, max(LEAST_SPEED_SHARE, share)))
