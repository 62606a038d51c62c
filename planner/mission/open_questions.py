"""Keep what waits for a person's word: a step's question, a plan's yes, a brain's only offer.

The robot stands and is free for other goals meanwhile; who waits behind the asking goal waits on.
What an answer to a step means is for the skill that asked to say. A plain yes or no that is said as
a goal is the answer where one thing alone can be meant: a wrong guess would move the robot.
Whatever waits ends by itself one day (after the time set for answers, by a newer order, or to make
room), so that no number of open questions keeps an order out. After a restart the time runs anew.
"""

from __future__ import annotations

from planner.brain.interface import OFFLINE
from planner.language.catalogue import join, list_names, message, say
from planner.language.changes.antecedents import complete_person, complete_place
from planner.language.changes.reader import read_changes
from planner.language.offered_choice import choose
from planner.language.schedule import ScheduleCommand
from planner.language.sentence import parse
from planner.mission import queue
from planner.mission.awaited_word import (
    ABOUT_ORDER,
    WAITS,
    AwaitedWord,
    find_offer,
    list_waiting,
    wait_of,
)
from planner.mission.outcomes import ended_outcome, moves, plain_outcome
from planner.mission.plan_check import key_of_deed, unwalkable
from planner.mission.scene import scene_of, upon_yes, whole_deed
from planner.mission.state import MAX_ANSWERS, MAX_OPEN, GivenOrder, Mission, MissionState, Planning
from planner.mission.transaction import Transaction
from planner.mission.transitions import GoalFact, PersonCause
from planner.plan import (
    Bilingual,
    Code,
    Edit,
    GoalAnswer,
    Outcome,
    StepPlan,
    say_same,
)
from planner.site.site_view import SiteView
from planner.skills import Fail
from planner.skills.ask import ask, tell_declined
from planner.skills.skill_state import BoundedSearchState

MAX_ANSWER = 2000
SUPERSEDED = "superseded"
_YES_OR_NO = say("question.yes_or_no")


def find_choice(mission: Planning, answer: str) -> str | None:
    """Return the one of several orders, offered by the grammar's question, that an answer names.

    A model reads the answer itself.
    """
    plan, brain = mission.plan, mission.brain
    if plan is None or brain is None or brain.name != OFFLINE:
        return None
    offers = [(each.text, each.label.en, each.label.zh) for each in plan.options]
    chosen = choose(offers, answer)
    return plan.options[chosen].text if chosen is not None else None


def find_offered_plan(
    mission: Mission, answer: str, *, is_standing: bool = False
) -> StepPlan | None:
    """Return the plan that was laid before a person and that this answer takes; None: none.

    ``is_standing``: what the standing order does each time that was laid before the person.
    """
    plan = mission.plan
    if plan is None or wait_of(mission) not in ABOUT_ORDER:
        return None
    order = find_offer(mission) if parse(answer).consent else find_choice(mission, answer)
    taken = (each for each in plan.options if each.text in (order, answer))
    return next((each.plan for each in taken if each.is_standing is is_standing), None)


def complete_order(facts: SiteView, asking: Mission, answer: str) -> str:
    """Return the order that an answer agrees to, chooses or completes.

    Else it is the answer as it was said.
    """
    offered = find_offer(asking) if parse(answer).consent else None
    chosen = offered or find_choice(asking, answer)
    if chosen is not None or asking.brain is None or asking.brain.name != OFFLINE:
        return chosen or answer
    changes = read_changes(answer, facts.names)
    named = [complete_place(each, asking, facts.names) for each in changes]
    placed = [
        complete_person(each, asking, facts.names) for each in changes if each.act is Edit.WHERE
    ]
    return next((order for order in (*named, *placed) if order is not None), answer)


def keep_answer(turn: Transaction, mission: Mission, said: str | None, by: str) -> Mission:
    """Keep what a person answered and under which hold, beside the question as it was asked."""
    answer = GoalAnswer(
        asked=mission.outcome.message if mission.outcome is not None else None,
        said=None if said is None else said[:MAX_ANSWER],
        by=by,
        unix_s=turn.now_unix_s,
    )
    answers = (*mission.answers, answer)[-MAX_ANSWERS:]
    return turn.put(mission, answers=answers, given_under_hold=queue.hold_now(turn, mission.source))


def note_answer(turn: Transaction, mission: Mission, text: str) -> Mission:
    """Keep an answer about an order beside the brain's question that it answers."""
    said = mission.outcome.message.of(mission.language) if mission.outcome is not None else ""
    unknown = ("" for _ in mission.replies[len(mission.questions) :])
    questions = (*mission.questions, *unknown, said)
    return turn.put(mission, replies=(*mission.replies, text), questions=questions)


def tell_offer(mission: Planning, question: Bilingual) -> Bilingual:
    """Return a model's question with the one order that a yes to it gives, where it hides that.

    "Shall I say hello?" with “go to the bathroom” behind it would make a yes an order unheard. A
    standing order is told with its time: so a model proposes one, and only a person's yes keeps it.
    """
    plan, brain = mission.plan, mission.brain
    model = brain is not None and brain.name != OFFLINE
    if not model or plan is None or len(plan.options) != 1:
        return question
    order = plan.options[0].text
    standing = parse(order).intent
    if isinstance(standing, ScheduleCommand) and standing.when is not None:
        what = standing.order if standing.reminder is None else order
        proposed = say("standing.propose", order=what[:200], when=standing.words[:200])
        return join((question, proposed))
    if order.casefold() in f"{question.en} {question.zh}".casefold():
        return question
    return say("question.offers", asked=question, order=order[:200])


def ask_which(turn: Transaction, mission: Mission) -> None:
    """Ask which of several orders is meant, after a mere yes."""
    offers = () if mission.plan is None else mission.plan.options
    asked = say("question.which_offer", offers=list_names(each.label for each in offers))
    turn.put(mission, outcome=Outcome(code=Code.AMBIGUOUS, message=asked))


def take_sentence(turn: Transaction, mission: Mission, asking: tuple[str, ...]) -> Mission | None:
    """End a goal whose words answer another; return the goal they answer, None of several."""
    names = list_names(say_same(f"“{turn.book.missions[asked].text[:60]}”") for asked in asking)
    if len(asking) > 1:
        said = say("question.for_none", names=names)
        outcome = Outcome(code=Code.AMBIGUOUS, message=said)
        turn.move_to(
            mission, PersonCause.MAY_MEAN_SEVERAL, reason=Code.AMBIGUOUS.value, outcome=outcome
        )
        return None
    said = say("question.taken", names=names)
    outcome = Outcome(code=Code.ANSWERED, message=said)
    turn.move_to(mission, PersonCause.ANSWERS_ANOTHER, outcome=outcome)
    return turn.book.missions[asking[0]]


def take_answer(turn: Transaction, mission: Mission, text: str) -> None:
    """Write the answer into its step, and go on in it first of all who wait.

    What ends the goal ends it now, whatever else runs or holds the robot.
    """
    facts, agreed = turn.book.facts, parse(text).consent
    if agreed or (agreed is None and upon_yes(facts, mission) is None):
        queue.clear_hold(turn, mission)  # the plan was accepted before, and a person lets it go on
    mission = queue.note_step(turn, mission, answer=text[:MAX_ANSWER])
    state = mission.skill_state
    if agreed and isinstance(state, BoundedSearchState) and state.offered:
        mission = _search_on(turn, mission, state)
    queue.release_answered(turn)
    if mission.asks:
        act = ask(scene_of(turn, mission))
        if isinstance(act, Fail) and act.said is not None:
            queue.decline(turn, mission, act.said)
            return
    queue.enqueue(turn, turn.put(mission, outcome=None), PersonCause.AGREES, first=True)


def _search_on(turn: Transaction, mission: Mission, state: BoundedSearchState) -> Mission:
    """Give a search the bounds and the grant of another one, in the rooms that are left."""
    more = {"offered": False, "out_of_metres": False, "longer": state.longer + 1}
    return turn.put(
        mission,
        skill_state=state.model_copy(update=more),
        step_s=0.0,
        step_m=0.0,
        grants=mission.grants + 1,
        granted_at_m=mission.metres,
    )


def take_no(turn: Transaction, mission: Mission) -> None:
    """End a goal whose plan or only offer a person said no to."""
    if mission.has_begun:
        queue.release_answered(turn)
    if _offer_sure_reading(turn, mission):
        return
    deed = whole_deed(turn.book.facts, mission.steps[mission.step :])
    queue.decline(turn, mission, tell_declined(deed))


def _offer_sure_reading(turn: Transaction, mission: Mission) -> bool:
    """Ask for what the order says to the built-in brain, in place of a model's plan; say if so.

    The order itself was not taken back: "go to the kitchen", and a no to the bathroom.
    """
    sure = mission.sure
    if sure is None or mission.has_begun or not any(map(moves, sure.steps)):
        return False
    same = [key_of_deed(s) for s in sure.steps] == [key_of_deed(s) for s in mission.steps]
    if same or unwalkable(turn.book, mission, sure.steps) is not None:
        return False
    why = say("confirmation.would", deed=whole_deed(turn.book.facts, sure.steps))
    said = plain_outcome(Code.CONFIRM, why=why)
    turn.put(mission, plan=sure, sure=None, reason="new_plan", outcome=said)
    return True


def ask_plainly(turn: Transaction, mission: Mission) -> None:
    """Ask for a yes or no to a plan, after an answer that is neither."""
    shall_i = message(Code.ASKED, text=say("question.shall_i_do", text=mission.text[:200]))
    asked = mission.outcome.message if mission.outcome is not None else shall_i
    if not asked.en.startswith(_YES_OR_NO.en):
        asked = join((_YES_OR_NO, asked), "joint.none")
    turn.put(mission, outcome=Outcome(code=Code.CONFIRM, message=asked))


def end_unanswered(turn: Transaction) -> None:
    """End every goal whose question nobody answered in time; note since when the others wait."""
    asked_s: dict[str, float] = {}
    limit_s = turn.book.rules.answer_s
    for mission in list_waiting(turn.book):
        since_s = turn.book.asked_s.get(mission.id, turn.now_s)
        if turn.now_s - since_s > limit_s:
            said = message(Code.NO_ANSWER, text=_repeat_question(mission), seconds=f"{limit_s:.0f}")
            _end(turn, mission, said, GoalFact.UNANSWERED, Code.NO_ANSWER.value)
        else:
            asked_s[mission.id] = since_s
    if asked_s != turn.book.asked_s:
        turn.set(asked_s=asked_s)


def ask_anew(turn: Transaction, mission: GivenOrder) -> None:
    """Forget since when a goal waits: it was answered, and may ask again."""
    left = {i: s for i, s in turn.book.asked_s.items() if i != mission.id}
    turn.set(asked_s=left)


def waiting_since(missions: dict[str, Mission], now_s: float) -> dict[str, float]:
    """Return since when each goal waits for an answer, in a process that has just begun."""
    return {m.id: now_s for m in missions.values() if m.state in WAITS}


def close_older(turn: Transaction, new: GivenOrder) -> None:
    """End the brain's questions about older orders of the same source: a new order came instead.

    A question of a step and a plan that waits for its yes stay: they have their time.
    """
    for mission in tuple(turn.book.missions.values()):
        older = mission.order < new.order and mission.source == new.source
        if older and wait_of(mission) in ABOUT_ORDER:
            _make_way(turn, mission, new.text)


def has_room(book: MissionState) -> bool:
    """Tell whether one more order can be taken, perhaps in place of a question."""
    return count_open(book) < MAX_OPEN or bool(list_waiting(book))


def count_open(book: MissionState) -> int:
    """Count the goals that have not ended."""
    return sum(not m.has_ended for m in book.missions.values())


def make_room(turn: Transaction, text: str) -> None:
    """End the oldest questions while goals are more than may be open: about orders first."""
    while count_open(turn.book) >= MAX_OPEN and (waiting := list_waiting(turn.book)):
        _make_way(turn, min(waiting, key=_worth), text)


def _worth(mission: Mission) -> tuple[int, int]:
    waits = wait_of(mission)
    return (0 if waits in ABOUT_ORDER else 1 if waits is AwaitedWord.PLAN else 2), mission.order


def _make_way(turn: Transaction, mission: Mission, newer: str) -> None:
    asked, newer = _repeat_question(mission), newer[:60]
    said = say("question.superseded", asked=asked, newer=newer)
    _end(turn, mission, said, GoalFact.SUPERSEDED, SUPERSEDED)


def _repeat_question(mission: Mission) -> Bilingual:
    return mission.outcome.message if mission.outcome is not None else say_same(mission.text[:200])


def _end(
    turn: Transaction, mission: Mission, said: Bilingual, cause: GoalFact, reason: str
) -> None:
    queue.finish(turn, mission, cause, ended_outcome(turn, mission, Code.NO_ANSWER, said), reason)
