"""Hold conversations with a robot by script: a person who says, hears, answers, loses patience.

The missions' own code takes every sentence in (``receive``, the reducer, the guard); plans are not
driven: a plan that is accepted is under way or done by the next sentence, as the script says. The
person is a small state machine: who is asked answers, with a yes only to what was meant; who is not
understood says it in other words; both cost patience. A conversation is right where every turn came
to what is expected and nothing was accepted that moves otherwise.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from enum import StrEnum
from itertools import count
from pathlib import Path
from typing import TYPE_CHECKING

from planner.brain.interface import ThinkResult
from planner.language.commands import CancelCommand
from planner.language.utterance import parse
from planner.mission.effects import AskBrain
from planner.mission.events import Cancel, Confirm, Planned, Reply, Stopped, Submitted
from planner.mission.plan_request import thinker
from planner.mission.reception import goal_to_end, receive, receive_answer
from planner.mission.reducer import advance
from planner.mission.skills import Eyesight
from planner.mission.state import MissionState
from planner.perception.snapshot import Sight
from planner.plan import (
    AnswerPlan,
    BrainTag,
    Clarify,
    Code,
    GoalState,
    GoTo,
    Means,
    PlanRole,
    Refuse,
    StepPlan,
    say_same,
)
from planner.site.site_view import facts_of, vocabulary_of
from pons.evals.cases import HELD_OUT, TUNED, Case
from pons.evals.hostile_plans import expected_plan
from pons.evals.matchers import BadMatcher, Expectation, read_expectation
from wire import CameraConfig

if TYPE_CHECKING:
    from collections.abc import Iterator

    from planner.brain import Brain
    from planner.brain.interface import ThinkRequest
    from planner.brain.streamed_draft import Hear
    from planner.mission.effects import Effect
    from planner.mission.events import Event
    from planner.mission.state import Mission
    from planner.site.site import Site

SCRIPTS = Path(__file__).parent / "persons"
PATIENCE = 3
"""So often a person answers what they did not expect, or says it in other words."""
FEWEST, MOST = 3, 8
"""Turns of a conversation."""
VARIANTS = 3
"""Times that a script with blanks is held, each with other places and things."""
_BLANKS = {
    "en": {
        "ABC": (("the kitchen", "kitchen"), ("the study", "study"), ("the bedroom", "bedroom"),
                ("the bathroom", "bathroom"), ("the living room", "living_room"),
                ("the hallway", "hallway")),
        "T": (("cup", "cup"), ("bottle", "bottle"), ("chair", "chair"), ("ball", "ball")),
    },
    "zh": {
        "ABC": (("厨房", "kitchen"), ("书房", "study"), ("卧室", "bedroom"), ("卫生间", "bathroom"),
                ("客厅", "living_room"), ("走廊", "hallway")),
        "T": (("杯子", "杯子"), ("瓶子", "瓶子"), ("椅子", "椅子"), ("球", "球")),
    },
}  # fmt: skip
_NOW_S = 1000.0
_TURN_S = 20.0


class Reaction(StrEnum):
    """Say what a sentence came to."""

    NEW = "new"
    INSTEAD = "instead"
    AFTER = "after"
    ASKS = "asks"
    CONFIRMS = "confirms"
    NO = "no"
    ANSWER = "answer"
    CANCEL = "cancel"
    STOP = "stop"
    DROPS = "drops"
    """A question or a plan was given up, upon a no."""


_PLANS = frozenset({Reaction.NEW, Reaction.INSTEAD, Reaction.AFTER})


@dataclass(frozen=True, slots=True)
class ScriptTurn:
    """Hold one turn of a script."""

    says: tuple[str, ...]
    """The sentence, and other words for it."""
    wanted: frozenset[Reaction]
    plan: Expectation | None = None
    typed: bool = False
    """It is written into the answer box of the question that waits."""
    stays: bool = False
    """What it set going is still under way when the person goes on."""


@dataclass(frozen=True, slots=True)
class Script:
    """Hold one conversation."""

    split: str
    name: str
    language: str
    turns: tuple[ScriptTurn, ...]


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


# Scripts --------------------------------------------------------------------------------------


def read_scripts(language: str) -> tuple[Script, ...]:
    """Return a language's conversations, each as often as its blanks are filled.

    Raises:
        BadMatcher: a script can't be read.
    """
    text = (SCRIPTS / f"{language}.txt").read_text("utf-8")
    blocks = (block for block in text.split("\n## ")[1:] if block.strip())
    return tuple(script for block in blocks for script in _read_block(block, language))


def _read_block(block: str, language: str) -> Iterator[Script]:
    head, *lines = block.strip().splitlines()
    split, _, name = head.partition(" ")
    if split not in ("tuned", "held"):
        raise BadMatcher(f"{head!r}: expected tuned or held, and a name")
    kept = [line for line in lines if line.strip() and not line.startswith("#")]
    if not FEWEST <= len(kept) <= MOST:
        raise BadMatcher(f"{name!r}: {len(kept)} turns; expected {FEWEST} to {MOST}")
    blanks = "{" in block
    for variant in range(VARIANTS if blanks else 1):
        turns = tuple(_read_turn(_fill(line, language, variant)) for line in kept)
        tag = f"{name}-{variant + 1}" if blanks else name
        yield Script(TUNED if split == "tuned" else HELD_OUT, tag, language, turns)


def _fill(line: str, language: str, variant: int) -> str:
    """Fill blanks: names in what is said, ids in what is expected."""
    said, bar, wanted = line.partition(" | ")
    places, things = _BLANKS[language]["ABC"], _BLANKS[language]["T"]
    for number, blank in enumerate("ABC"):
        name, id_ = places[(variant * 2 + number) % len(places)]
        said, wanted = said.replace(f"{{{blank}}}", name), wanted.replace(f"{{{blank}}}", id_)
    name, id_ = things[variant % len(things)]
    return f"{said.replace('{T}', name)}{bar}{wanted.replace('{T}', id_)}"


def _read_turn(line: str) -> ScriptTurn:
    said, bar, wanted = line.partition(" | ")
    stays, wanted = wanted.startswith("~ "), wanted.removeprefix("~ ")
    typed, said = said.startswith("> "), said.removeprefix("> ")
    reactions, plans = set[Reaction](), list[str]()
    for way in wanted.split(" | "):
        names, _, plan = way.removeprefix("~ ").partition(":")
        try:
            reactions |= {Reaction(name) for name in names.strip().split("/")}
        except ValueError as wrong:
            raise BadMatcher(f"{line!r}: {wrong}") from wrong
        plans += [plan.strip()] if plan.strip() else []
    if not bar or (reactions & _PLANS and not plans):
        raise BadMatcher(f"{line!r}: expected a sentence, a bar, and what it comes to")
    expected = read_expectation(" | ".join(plans)) if plans else None
    return ScriptTurn(tuple(said.split(" // ")), frozenset(reactions), expected, typed, stays)


# The robot's side -----------------------------------------------------------------------------


@dataclass(frozen=True, slots=True)
class RobotReply:
    """Hold what the person hears after one sentence."""

    reaction: Reaction
    plan: StepPlan | None = None
    goal: str = ""
    offer: str = ""
    alone: bool = False
    """No other goal goes on beside the one that was taken."""


class RobotEar:
    """Take sentences in as the planner does; drive nothing."""

    def __init__(self, brain: Brain, site: Site) -> None:
        """Take the brain and the site."""
        self._brain, self._site = brain, site
        eyes = Eyesight(CameraConfig(), _CLASSES)
        self._book = MissionState(facts_of(site), eyes=eyes, sight=Sight())
        self._plans: dict[str, StepPlan] = {}
        self._ids, self._now_s = count(), _NOW_S

    @property
    def book(self) -> MissionState:
        """Return where all goals stand."""
        return self._book

    async def hear(self, text: str, *, typed: bool = False) -> RobotReply:
        """Return what a sentence comes to."""
        self._now_s += _TURN_S
        before = self._book
        waiting = self._waiting()
        said = parse(text)
        if typed and waiting is not None:
            taken = receive_answer(before, said, waiting.id, self._now_s)
            if taken.command is not None:
                await self._on(taken.command)
            if taken.sentence is not None:
                return await self.hear(taken.sentence)
            return self._tell(before, waiting.id, taken.stops)
        goal = f"goal-{next(self._ids)}"
        heard = receive(before, said, Submitted(goal, text, said.language), self._now_s)
        if heard.stops:
            await self._on(Stopped("person"))
        await self._on(heard.given)
        if heard.takes_back is not None:
            await self._on(Cancel(heard.takes_back))
        return self._tell(before, goal, heard.stops and heard.given.stop)

    async def _on(self, event: Event) -> None:
        self._book, effects = advance(self._book, event, self._now_s)
        for effect in effects:
            await self._carry(effect)

    async def _carry(self, effect: Effect) -> None:
        if not isinstance(effect, AskBrain):
            return
        if isinstance(
            parse(effect.text).intent, CancelCommand
        ):  # the planner's own, before any brain
            ended = goal_to_end(self._book, effect.id)
            done = AnswerPlan(text=say_same("done"))
            await self._on(Planned(effect.id, done))
            if ended is not None:
                await self._on(Cancel(ended))
            return
        means = Means(camera=True, detector=True)
        think = thinker(self._brain, vocabulary_of(self._site), None, means, _CLASSES)
        planned: Planned = await think(effect)
        if isinstance(planned.plan, StepPlan):
            self._plans[effect.id] = planned.plan
        await self._on(planned)

    def _waiting(self) -> Mission | None:
        asking = (GoalState.NEEDS_CLARIFICATION, GoalState.AWAITING_CONFIRMATION)
        open_ = [m for m in self._book.missions.values() if m.state in asking]
        return max(open_, key=lambda m: m.order, default=None)

    def _tell(self, before: MissionState, goal: str, stopped: bool) -> RobotReply:
        """Return what has changed, as a person would be told."""
        if stopped:
            return RobotReply(Reaction.STOP)
        taken = next((m for m in self._book.missions.values() if self._is_taken(before, m)), None)
        if taken is not None:
            plan = self._plans.get(taken.id)
            if plan is not None and plan.does in (PlanRole.CANCEL, PlanRole.ANSWER_TO):
                return RobotReply(Reaction.CANCEL)
            runs = (GoalState.QUEUED, GoalState.RUNNING)
            alone = all(m is taken or m.state not in runs for m in self._book.missions.values())
            return RobotReply(self._role(before, taken), plan, taken.id, alone=alone)
        mission = self._book.missions.get(goal)
        asking = self._waiting()
        if asking is not None and (mission is None or not mission.has_ended or mission is asking):
            reaction = (
                Reaction.CONFIRMS
                if asking.state is GoalState.AWAITING_CONFIRMATION
                else Reaction.ASKS
            )
            options = asking.plan.options if asking.plan is not None else ()
            offer = options[0].text if len(options) == 1 else ""
            return RobotReply(reaction, self._plans.get(asking.id), asking.id, offer)
        dropped = [
            m.id for m in self._book.missions.values()
            if m.state is GoalState.CANCELLED and before.missions.get(m.id) not in (None, m)
        ]  # fmt: skip
        if dropped:
            declined = self._book.missions[dropped[0]].outcome
            no = declined is not None and declined.code is Code.DECLINED
            return RobotReply(Reaction.DROPS if no else Reaction.CANCEL)
        if mission is not None and mission.state is GoalState.SUCCEEDED:
            return RobotReply(Reaction.ANSWER)
        return RobotReply(Reaction.NO)

    def _is_taken(self, before: MissionState, mission: Mission) -> bool:
        open_ = (GoalState.QUEUED, GoalState.RUNNING, GoalState.PAUSED)
        was = before.missions.get(mission.id)
        return mission.state in open_ and (was is None or was.state not in open_)

    def _role(self, before: MissionState, taken: Mission) -> Reaction:
        ended = [
            m.id for m in before.missions.values()
            if m.state in (GoalState.QUEUED, GoalState.RUNNING)
            and self._book.missions[m.id].state is GoalState.CANCELLED
        ]  # fmt: skip
        if ended:
            return Reaction.INSTEAD
        waits = [
            m for m in before.missions.values()
            if m.state in (GoalState.QUEUED, GoalState.RUNNING) and m.id != taken.id
        ]  # fmt: skip
        return Reaction.AFTER if waits and taken.first else Reaction.NEW

    def settle(self, goal: str, *, stays: bool) -> None:
        """Have a goal that was taken run on, or be done."""
        missions = dict(self._book.missions)
        for id_, mission in missions.items():
            if mission.state in (GoalState.QUEUED, GoalState.RUNNING, GoalState.PAUSED):
                runs = stays and (id_ == goal or mission.state is GoalState.RUNNING)
                state = GoalState.RUNNING if runs else GoalState.SUCCEEDED
                missions[id_] = mission.model_copy(update={"state": state})
        running = next((m.id for m in missions.values() if m.state is GoalState.RUNNING), None)
        self._book = replace(
            self._book, missions=missions, running=running, queue=(), activity=None
        )

    async def confirm(self, goal: str, *, yes: bool) -> RobotReply:
        """Return what a yes or no to a plan comes to, given by button."""
        before = self._book
        await self._on(Confirm(goal) if yes else Reply(goal, "no"))
        return self._tell(before, goal, stopped=False)


_CLASSES = ("person", "cup", "bottle", "chair", "cat", "dog", "book", "backpack", "sports_ball")


# The person -----------------------------------------------------------------------------------


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
            wrong = heard is not None and heard.reaction in _PLANS
            what = f"turn {number}: {heard.reaction if heard else 'nothing'}"
            plan = heard.plan.steps if heard is not None and heard.plan is not None else ()
            told = "; ".join(str(step.model_dump(exclude_defaults=True)) for step in plan)
            return Conversation(script, f"{what} {told}".strip(), tuple(said), wrong)
        if heard.reaction in _PLANS:
            robot.settle(heard.goal, stays=turn.stays)
    return Conversation(script, "", tuple(said), moves_wrongly=False)


def _judge(heard: RobotReply, turn: ScriptTurn, patience: int) -> tuple[_Mood, int]:
    """Return what the person does upon what they heard, and the patience that is left."""
    fits = heard.plan is not None and (turn.plan is None or turn.plan.fits(heard.plan))
    fulfils = heard.reaction in turn.wanted or (Reaction.INSTEAD in turn.wanted and heard.alone)
    if fulfils and (heard.reaction not in _PLANS or fits):
        return _Mood.GOES_ON, patience
    if heard.reaction in _PLANS:
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
        return fits and bool(turn.wanted & _PLANS)
    return bool(turn.wanted & _PLANS) and any(heard.offer == other for other in turn.says[1:])


# A model by script ----------------------------------------------------------------------------


class ScriptedModel:
    """Reply as a strong model would: with the plan that the person wants, in its role.

    Every third plan of its own moves besides somewhere that nobody named: the guard must ask.
    """

    def __init__(self, *, whims: bool = True) -> None:
        """Choose whether it has whims."""
        self._turn: ScriptTurn | None = None
        self._plans, self._whims, self.hostile = 0, whims, 0

    @property
    def tag(self) -> BrainTag:
        """Return the double's name."""
        return BrainTag(name="scripted-model", version="1")

    def expect(self, turn: ScriptTurn) -> None:
        """Be told what the person of the script wants next."""
        self._turn = turn

    async def think(self, request: ThinkRequest, hear: Hear | None = None) -> ThinkResult:
        """Return the reply to the turn that is expected."""
        del hear
        return ThinkResult(plan=self._reply(request), brain=self.tag, calls=1)

    def _reply(self, request: ThinkRequest) -> StepPlan | AnswerPlan | Clarify | Refuse:
        turn = self._turn
        wanted = turn.wanted if turn is not None else frozenset()
        made = None
        if turn is not None and turn.plan is not None and wanted & _PLANS:
            made = expected_plan(Case(request.text, "", wanted=turn.plan))
        if made is None:
            return self._talk(wanted)
        role = PlanRole.AFTER if Reaction.AFTER in wanted else PlanRole.NEW
        role = PlanRole.INSTEAD if Reaction.INSTEAD in wanted else role
        self._plans += 1
        if self._whims and self._plans % 3 == 0:
            self.hostile += 1
            return made.model_copy(update={"steps": (*made.steps, _WHIM), "does": role})
        return made.model_copy(update={"does": role})

    @staticmethod
    def _talk(wanted: frozenset[Reaction]) -> AnswerPlan | Clarify | Refuse | StepPlan:
        words = say_same("So it is. 是的。")
        if Reaction.ASKS in wanted:
            return Clarify(code=Code.AMBIGUOUS, question=words)
        if Reaction.CANCEL in wanted:
            return StepPlan(steps=(), does=PlanRole.CANCEL)
        if Reaction.NO in wanted:
            return Refuse(code=Code.NO_CAPABILITY, reason=words)
        return AnswerPlan(text=words)


_WHIM = GoTo(place="charging_dock")
"""No script speaks of it."""


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
