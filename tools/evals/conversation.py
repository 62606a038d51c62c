"""Hold conversations with a robot by script: a person who says, hears, answers, loses patience.

The missions' own code takes every sentence in (``receive``, the reducer, the guard); plans are not
driven: a plan that is accepted is under way or done by the next sentence, as the script says. The
person is a small state machine: who is asked answers, with a yes only to what was meant; who is not
understood says it in other words; both cost patience. A conversation is right where every turn came
to what is expected and nothing was accepted that moves otherwise.
"""

from __future__ import annotations

from dataclasses import dataclass
from enum import StrEnum
from typing import TYPE_CHECKING

from pons.evals.suites import HELD_OUT, TUNED

if TYPE_CHECKING:
    from planner.brain import Brain

from planner.language.motion_guard.step_words import moves
from tools.evals.robot import ConversationRobot, RobotReply
from tools.evals.scripted_model import ScriptedModel
from tools.evals.scripts import PLANS, Reaction, Script, ScriptTurn

PATIENCE = 3
"""So often a person answers what they did not expect, or says it in other words."""


@dataclass(frozen=True, slots=True)
class GoalScore:
    """Hold how one numbered goal of a trial went."""

    number: str
    fault: str = ""
    """Empty: right."""
    yeses: int = 0
    """So often the person had to say yes to just what they had ordered."""

    def __add__(self, other: GoalScore) -> GoalScore:
        fault = self.fault or other.fault
        return GoalScore(self.number, fault, self.yeses + other.yeses)


@dataclass(frozen=True, slots=True)
class Conversation:
    """Hold how one conversation went."""

    script: Script
    fault: str
    """Empty: right."""
    said: tuple[str, ...]
    moves_wrongly: bool
    goals: tuple[GoalScore, ...] = ()
    """Of a trial, in order."""

    @property
    def right(self) -> bool:
        return not self.fault


class _Mood(StrEnum):
    """Say what the person does next."""

    SAYS = "says"
    HEARS = "hears"
    ANSWERS = "answers"
    REPHRASES = "rephrases"
    GOES_ON = "goes_on"
    GIVES_UP = "gives_up"


async def converse(script: Script, brain: Brain, robot: ConversationRobot) -> Conversation:
    """Return how a conversation with a robot went that nobody has talked to yet.

    A person gives up at the first turn that goes wrong; in a trial, whose goals are counted one by
    one, they go on with the next.
    """
    talk = _Talk(script, brain, robot)
    faults, scores, wrong = list[str](), dict[str, GoalScore](), False
    for number, turn in enumerate(script.turns, 1):
        before = talk.yeses
        heard, fault = await talk.take(turn)
        wrong |= bool(fault) and heard.reaction in PLANS and _moves(heard)
        faults += [f"turn {number}: {fault}"] if fault else []
        if turn.goal:
            score = GoalScore(turn.goal, fault, talk.yeses - before)
            scores[turn.goal] = scores.get(turn.goal, GoalScore(turn.goal)) + score
        elif fault:
            break
    told = tuple(scores.values())
    return Conversation(script, faults[0] if faults else "", tuple(talk.said), wrong, told)


class _Talk:
    """Be the person of one script, with a robot that hears."""

    def __init__(self, script: Script, brain: Brain, robot: ConversationRobot) -> None:
        self._robot, self._brain = robot, brain
        self._yes = "yes" if script.language == "en" else "好的"
        self._patience = PATIENCE
        self.said: list[str] = []
        self.yeses = 0

    async def take(self, turn: ScriptTurn) -> tuple[RobotReply, str]:
        """Say one turn until it is understood; return what was heard last and what is wrong."""
        self._robot.expect(turn)
        if isinstance(self._brain, ScriptedModel):
            self._brain.expect(turn)
        words, mood = iter(turn.says), _Mood.SAYS
        self._patience = PATIENCE if turn.goal else self._patience
        heard = RobotReply(Reaction.NO)
        while mood not in (_Mood.GOES_ON, _Mood.GIVES_UP):
            if mood in (_Mood.SAYS, _Mood.REPHRASES):
                self.said.append(next(words, turn.says[0]))
                heard = await self._robot.hear(self.said[-1], typed=turn.typed)
                mood = _Mood.HEARS
            elif mood is _Mood.ANSWERS:
                heard, mood = await self._answer(heard, turn), _Mood.HEARS
            else:
                mood, self._patience = _judge(heard, turn, self._patience)
        fits = mood is _Mood.GOES_ON
        if heard.reaction in PLANS:
            self._robot.settle(heard.goal, stays=turn.stays and fits)
        fault = self._robot.fault_of(heard.goal, turn) if fits and heard.goal else ""
        return heard, fault if fits else _tell(heard)

    async def _answer(self, heard: RobotReply, turn: ScriptTurn) -> RobotReply:
        yes = _is_meant(heard, turn)
        self.said.append("yes" if yes else "no")
        if heard.reaction is not Reaction.CONFIRMS:
            return await self._robot.hear(self._yes)
        self.yeses += yes
        return await self._robot.confirm(heard.goal, yes=yes)


def _tell(heard: RobotReply) -> str:
    """Describe what came in place of what was wanted, for the table."""
    plan = heard.plan.steps if heard.plan is not None else ()
    told = "; ".join(str(step.model_dump(exclude_defaults=True)) for step in plan)
    return f"{heard.reaction} {told}".strip()


def _moves(heard: RobotReply) -> bool:
    """Tell whether what was accepted moves the robot: words alone do not."""
    return heard.plan is None or any(moves(step) for step in heard.plan.steps)


def _judge(heard: RobotReply, turn: ScriptTurn, patience: int) -> tuple[_Mood, int]:
    """Return what the person does upon what they heard, and the patience that is left."""
    fits = heard.plan is not None and (turn.plan is None or turn.plan.fits(heard.plan))
    fulfils = heard.reaction in turn.wanted or (Reaction.INSTEAD in turn.wanted and heard.alone)
    if fulfils and (heard.reaction not in PLANS or fits):
        return _Mood.GOES_ON, patience
    if heard.reaction in PLANS:
        return _Mood.GIVES_UP, patience  # it does what was not said
    if heard.reaction is Reaction.DROPS:  # upon their own no: they say it again
        return _Mood.REPHRASES, patience
    if patience <= 0:
        return _Mood.GIVES_UP, 0
    answers = heard.reaction is Reaction.CONFIRMS or (
        heard.reaction is Reaction.ASKS and heard.offer and _is_meant(heard, turn)
    )
    return (_Mood.ANSWERS if answers else _Mood.REPHRASES), patience - 1


def _is_meant(heard: RobotReply, turn: ScriptTurn) -> bool:
    """Tell whether a yes to what is asked would do what the person wants."""
    if heard.reaction is Reaction.CONFIRMS:
        fits = heard.plan is not None and turn.plan is not None and turn.plan.fits(heard.plan)
        return fits and bool(turn.wanted & PLANS)
    return bool(turn.wanted & PLANS) and any(heard.offer == other for other in turn.says[1:])


def show_conversations(
    name: str, brain: str, held: tuple[Conversation, ...], hostile: int = 0
) -> str:
    """Return the figures, and every conversation that went wrong with where it did."""
    lines = []
    for split in (TUNED, HELD_OUT):
        mine = [each for each in held if each.script.split == split]
        wrong = sum(each.moves_wrongly for each in mine)
        right = sum(each.right for each in mine)
        lines.append(
            f"conversations {name} {split}, {brain}: {right} of {len(mine)} right, "
            f"{wrong} wrong motions"
        )
    lines += _goal_lines(name, brain, held) if not hostile else ()
    if hostile:
        lines.append(f"  the model added motion that nobody asked for {hostile} times")
    lines += [
        f"  {each.script.name}: {each.fault} <- {' / '.join(each.said)}"
        for each in held
        if not each.right
    ]
    return "\n".join(lines)


def _goal_lines(name: str, brain: str, held: tuple[Conversation, ...]) -> list[str]:
    """Return a trial's figures, goal by goal; nothing of conversations that count none."""
    goals = [goal for each in held for goal in each.goals]
    if not goals:
        return []
    right, yeses = sum(not goal.fault for goal in goals), sum(goal.yeses for goal in goals)
    told = f"goals {name}, {brain}: {right} of {len(goals)} right, {yeses} yeses to what was said"
    odd = [goal for goal in goals if goal.fault or goal.yeses]
    return [told, *(f"  [{g.number}] {g.fault or f'right after {g.yeses} yes'}" for g in odd)]
