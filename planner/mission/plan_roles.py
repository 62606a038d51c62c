"""Let a plan act on what runs: in its place, after it, ending it, as an answer, or as a stop.

Laws: a goal is ended only where the person's own words take something back, outside of conditions
and quotes; a plan that comes in its place ends it no sooner than it may itself be walked. What
answers a question is what the person said, word for word, and never what a model makes of it: so no
model can say yes. A goal that a person took back by a stop never goes on by itself, and what is put
in its place drives without a further yes only where the person's own words take the old one back
and ask for the new. Pure.
"""

from __future__ import annotations

from planner.language.catalogue import join, list_names, say
from planner.language.commands import ResumeCommand
from planner.language.folding import has_chinese
from planner.language.motion_guard.mentioned_names import label_named, places_named
from planner.language.motion_guard.taking_back import ends_goal, takes_back
from planner.language.sentence import parse
from planner.mission.awaited_word import list_waiting
from planner.mission.events import Planned
from planner.mission.open_questions import take_sentence
from planner.mission.outcomes import plain_outcome
from planner.mission.queue import cancel, finish
from planner.mission.spoken_status import stop_told
from planner.mission.state import GivenOrder, Mission, MissionState, goal_to_end
from planner.mission.transaction import Transaction
from planner.mission.transitions import BrainCause, PersonCause
from planner.plan import (
    AnswerPlan,
    Bilingual,
    Clarify,
    Code,
    GoalState,
    Option,
    Outcome,
    Plan,
    PlanRole,
    Refuse,
    StepPlan,
    places_of,
    plan_record,
    say_same,
    words_of,
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
    before = [m for m in turn.book.goals_in(*IN_HAND) if m.order < new.order]
    return before[-1] if before else None


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
    paused = turn.book.goals_in(GoalState.PAUSED, besides=mission.id)
    named = _goals_named(turn, mission)
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


def _goals_named(turn: Transaction, new: Mission) -> list[Mission]:
    """Return the open goals of which a person's words name a place or a thing."""
    open_ = (*IN_HAND, GoalState.RUNNING, GoalState.QUEUED, GoalState.PAUSED)
    places = set(places_named(new.words, turn.book.facts.names))
    return [
        goal
        for goal in turn.book.goals_in(*open_, besides=new.id)
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
    finish(turn, mission, BrainCause.ANSWERS, plain_outcome(Code.ANSWERED, text=said))


def find_asking(turn: Transaction, mission: Mission) -> Mission | None:
    """Return the one goal whose question a sentence answers; end the sentence's own goal.

    Where none waits, or several, nothing is answered and the person is told so.
    """
    waiting = list_waiting(turn.book, mission.id)
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


UNCONFIRMED = say("goal.unconfirmed")


def end_stopped(
    turn: Transaction, mission: Mission, echoed: bool, also: Bilingual | None = None
) -> None:
    """End a sentence that was an order to stop, and say whether the bridge has heard it."""
    heard = stop_told(turn.book) if echoed else UNCONFIRMED
    told = heard if also is None else join((heard, also))
    if echoed:
        said = Outcome(code=Code.STOPPED, message=told)
        finish(turn, mission, PersonCause.ORDERS_STOP, said)
        return
    said = Outcome(code=Code.FAULT, message=told)
    turn.move_to(mission, PersonCause.STOP_UNHEARD, reason="bridge_silent", outcome=said)


def end_paused(turn: Transaction, goal_id: str | None) -> None:
    """End a goal that a person's words have stopped, and that is not to go on."""
    stopped = turn.mission(goal_id)
    if stopped is not None and stopped.state in (GoalState.PAUSED, GoalState.QUEUED):
        cancel(turn, stopped)


def stop_after_all(turn: Transaction, mission: Mission, event: Planned) -> None:
    """Take a sentence that orders no step for the stop that it was."""
    plan = event.plan
    cancels = isinstance(plan, StepPlan) and plan.does is PlanRole.CANCEL
    if cancels and ends_goal(mission.words):
        end_paused(turn, mission.interrupted)
    own = words_of(plan) if event.brain is None else None  # the planner's own, as it was told
    also = own or _tell_rest(turn, mission, plan)
    end_stopped(turn, turn.put(mission, brain=event.brain), echoed=True, also=also)


def tell_left(rest: str) -> Bilingual | None:
    """Say that what followed a stop in the same breath was not done; None: nothing did."""
    return say("goal.rest_left", text=rest[:60]) if rest else None


def _tell_rest(turn: Transaction, mission: GivenOrder, plan: Plan | None) -> Bilingual | None:
    """Say what became of the words behind a stop, of which no step has come."""
    rest = parse(mission.text).behind_stop
    if rest and isinstance(plan, AnswerPlan | Refuse):
        return words_of(plan)
    if rest and turn.book.queue and _says_go_on(rest):  # not with what was just stopped
        end_paused(turn, mission.interrupted)
        waiting = turn.book.missions[turn.book.queue[0]]
        return say("goal.rest_go_on", text=waiting.text[:60])
    return tell_left(rest)


def _says_go_on(rest: str) -> bool:
    """Tell whether words begin as an order to go on: "go on with the others"."""
    words = [*rest] if has_chinese(rest) else rest.split()
    joint = "" if has_chinese(rest) else " "
    return any(isinstance(parse(joint.join(words[:n])).intent, ResumeCommand) for n in (1, 2, 3))


def corrects(turn: Transaction, mission: Mission) -> bool:
    """Tell whether a sentence that has stopped a goal puts another drive in its place."""
    stopped = turn.mission(mission.interrupted)
    words = parse(mission.text).behind_stop or mission.words  # the stop itself takes nothing back
    return stopped is not None and bool(stopped.steps) and takes_back(words)


def ask_what_was_meant(book: MissionState, mission: GivenOrder) -> Bilingual:
    """Ask whether a sentence with a stop word in it was an order to do something."""
    told, text = stop_told(book), mission.text[:60]
    return say("goal.doubtful_stop", told=told, text=text)
