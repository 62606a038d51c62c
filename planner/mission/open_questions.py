"""Keep what waits for a person's word: a step's question, a plan's yes, a brain's only offer.

The robot stands and is free for other goals meanwhile; who waits behind the asking goal waits on.
What an answer to a step means is for the skill that asked to say. A plain yes or no that is said as
a goal is the answer where one thing alone can be meant: a wrong guess would move the robot.
"""

from __future__ import annotations

from planner.brain.interface import OFFLINE
from planner.language.catalogue import join, list_names, message, say
from planner.language.stop import is_stop
from planner.language.utterance import parse
from planner.mission.declined_goals import decline
from planner.mission.queue import clear_hold, enqueue, note_step, release_answered
from planner.mission.scene import DO_THAT, first_deed, scene_of, upon_yes
from planner.mission.skills import Fail
from planner.mission.skills.ask import ask, tell_declined
from planner.mission.state import Mission
from planner.mission.transaction import Transaction
from planner.mission.transitions import PersonCause
from planner.plan import (
    Bilingual,
    Code,
    GoalState,
    Outcome,
    StepState,
    say_same,
)

MAX_ANSWER = 2000
WAITS = frozenset({GoalState.NEEDS_CLARIFICATION, GoalState.AWAITING_CONFIRMATION})
_YES_OR_NO = say("question.yes_or_no")


def asks(mission: Mission) -> bool:
    """Tell whether a goal waits for the answer to a question of one of its own steps."""
    step = mission.current_step
    return (
        mission.state is GoalState.NEEDS_CLARIFICATION
        and step is not None
        and step.state is StepState.RUNNING
    )


def confirms(mission: Mission) -> bool:
    """Tell whether a plan waits for a yes."""
    return mission.state is GoalState.AWAITING_CONFIRMATION


def find_offer(mission: Mission) -> str | None:
    """Return the one order that a brain's question offers; None where it offers none or several.

    An order to stop is none: it is taken from a person's own words alone.
    """
    plan = mission.plan
    if mission.state is not GoalState.NEEDS_CLARIFICATION or plan is None or asks(mission):
        return None
    only = plan.options[0].text if len(plan.options) == 1 else None
    return only if only is not None and not is_stop(only) else None


def asks_freely(mission: Mission) -> bool:
    """Tell whether a model asks about an order and offers none: it reads whatever is answered."""
    plan, brain = mission.plan, mission.brain
    about_order = mission.state is GoalState.NEEDS_CLARIFICATION and not asks(mission)
    model = brain is not None and brain.name != OFFLINE
    return about_order and model and plan is not None and not plan.options


def takes_yes(mission: Mission) -> bool:
    """Tell whether a plain yes or no answers what a goal waits for."""
    return asks(mission) or confirms(mission) or find_offer(mission) is not None


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
        clear_hold(turn, mission)  # the plan was accepted before, and a person lets it go on
    mission = note_step(turn, mission, answer=text[:MAX_ANSWER])
    release_answered(turn)
    if mission.current_step is not None and mission.current_step.kind == "ask":
        act = ask(scene_of(turn, mission))
        if isinstance(act, Fail) and act.said is not None:
            decline(turn, mission, act.said)
            return
    enqueue(turn, turn.put(mission, outcome=None), PersonCause.AGREES, first=True)


def take_no(turn: Transaction, mission: Mission) -> None:
    """End a goal whose plan or only offer a person said no to."""
    if mission.has_begun:
        release_answered(turn)
    deed = first_deed(turn.book.facts, mission.steps[mission.step :]) or DO_THAT
    decline(turn, mission, tell_declined(deed))


def ask_plainly(turn: Transaction, mission: Mission) -> None:
    """Ask for a yes or no to a plan, after an answer that is neither."""
    asked = mission.outcome.message if mission.outcome is not None else _shall_i(mission.text)
    if not asked.en.startswith(_YES_OR_NO.en):
        asked = join((_YES_OR_NO, asked), "joint.none")
    turn.put(mission, outcome=Outcome(code=Code.CONFIRM, message=asked))


def _shall_i(text: str) -> Bilingual:
    return message(Code.ASKED, text=say("question.shall_i_do", text=text[:200]))  # fmt: skip
