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

from pons.evals.cases import HELD_OUT, TUNED

if TYPE_CHECKING:
    from planner.brain import Brain
    from planner.site.site import Site

from planner.language.motion_guard.step_words import moves
from pons.evals.person_robot import RobotEar, RobotReply, ScriptedModel
from pons.evals.person_scripts import PLANS, Reaction, Script, ScriptTurn

PATIENCE = 3
"""So often a person answers what they did not expect, or says it in other words."""


@dataclass(frozen=True, slots=True)
class Conversation:
    """Hold how one conversation went."""

    script: Script
    fault: str
    """Empty: right."""
    said: tuple[str, ...]
    moves_wrongly: bool

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


async def converse(script: Script, brain: Brain, site: Site) -> Conversation:
    """Return how a conversation went."""
    robot, patience, said = RobotEar(brain, site), PATIENCE, list[str]()
    for number, turn in enumerate(script.turns, 1):
        if isinstance(brain, ScriptedModel):
            brain.expect(turn)
        words, heard, mood = iter(turn.says), None, _Mood.SAYS
        while mood not in (_Mood.GOES_ON, _Mood.GIVES_UP):
            if mood in (_Mood.SAYS, _Mood.REPHRASES):
                text = next(words, turn.says[0])
                said.append(text)
                heard = await robot.hear(text, typed=turn.typed)
                mood = _Mood.HEARS
            elif mood is _Mood.ANSWERS and heard is not None:
                yes = _is_meant(heard, turn)
                said.append("yes" if yes else "no")
                heard = await (
                    robot.confirm(heard.goal, yes=yes)
                    if heard.reaction is Reaction.CONFIRMS
                    else robot.hear("yes" if script.language == "en" else "好的")
                )
                mood = _Mood.HEARS
            elif heard is not None:
                mood, patience = _judge(heard, turn, patience)
        if mood is _Mood.GIVES_UP or heard is None:
            wrong = heard is not None and heard.reaction in PLANS and _moves(heard)
            what = f"turn {number}: {heard.reaction if heard else 'nothing'}"
            plan = heard.plan.steps if heard is not None and heard.plan is not None else ()
            told = "; ".join(str(step.model_dump(exclude_defaults=True)) for step in plan)
            return Conversation(script, f"{what} {told}".strip(), tuple(said), wrong)
        if heard.reaction in PLANS:
            robot.settle(heard.goal, stays=turn.stays)
    return Conversation(script, "", tuple(said), moves_wrongly=False)


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
    if hostile:
        lines.append(f"  the model added motion that nobody asked for {hostile} times")
    lines += [
        f"  {each.script.name}: {each.fault} <- {' / '.join(each.said)}"
        for each in held
        if not each.right
    ]
    return "\n".join(lines)
