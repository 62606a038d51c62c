"""Hear a scripted person as the planner does, and reply as a model would; drive nothing.

The missions' own code decides (``receive``, the reducer, the guard). A plan that is accepted counts
as under way or done by the next sentence, as the script says.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from itertools import count
from math import inf
from typing import TYPE_CHECKING

from planner.brain.interface import ThinkResult
from planner.language.sentence import parse
from planner.mission.allowed_commands import refusal
from planner.mission.effects import AskBrain
from planner.mission.events import Cancel, Confirm, Planned, Reply, Stopped, Submitted
from planner.mission.open_questions import asks
from planner.mission.plan_request import thinker
from planner.mission.reception import receive, receive_answer
from planner.mission.reducer import advance
from planner.mission.skills import Eyesight
from planner.mission.skills.perception import PictureLimits
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
    plan_record,
    say_same,
)
from planner.plan.slots import steps_of
from planner.site.site_view import facts_of, vocabulary_of
from pons.evals.cases import Case
from pons.evals.evidence import give_evidence
from pons.evals.hostile_plans import expected_plan
from wire import CameraConfig

if TYPE_CHECKING:
    from planner.brain import Brain
    from planner.brain.interface import ThinkRequest
    from planner.brain.streamed_draft import Hear
    from planner.language.reading import ChangeReading
    from planner.mission.effects import Effect
    from planner.mission.errors import MissionError
    from planner.mission.events import Command, Event
    from planner.mission.state import Mission
    from planner.site.site import Site

from pons.evals.person_commands import PersonCommands
from pons.evals.person_pose import pose_after, standing_status
from pons.evals.person_scripts import PLANS, Reaction, ScriptTurn

_NOW_S = 1000.0
_TURN_S = 20.0


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
        eyes = Eyesight(CameraConfig(), _CLASSES, model=True, pictures=_PICTURES)
        facts = facts_of(site)
        self._book = MissionState(facts, eyes=eyes, sight=Sight())
        self._pose = facts.targets[facts.home].pose
        self._plans: dict[str, StepPlan] = {}
        self._sure: dict[str, StepPlan] = {}
        self._ids, self._now_s = count(), _NOW_S
        self._commands = PersonCommands(self._think, site, self)
        self._left: list[Effect] = []

    @property
    def book(self) -> MissionState:
        """Return where all goals stand."""
        return self._book

    @property
    def status_age_s(self) -> float:
        """Return an age without end: no bridge is heard."""
        return inf

    def obey(self, command: Command) -> MissionError | None:
        """Obey a command to the planner itself at once."""
        error = refusal(self._book, command)
        if error is None:
            self._book, effects = advance(self._book, command, self._now_s)
            self._left += effects
        return error

    def expect(self, turn: ScriptTurn) -> None:
        """Be told what the next turn notes; what is not driven needs nothing of it."""

    def fault_of(self, goal: str, turn: ScriptTurn) -> str:
        """Return what is wrong with a goal's end; what is not driven has none."""
        del goal, turn
        return ""

    async def hear(
        self, text: str, *, typed: bool = False, leaning: ChangeReading | None = None
    ) -> RobotReply:
        """Return what a sentence comes to."""
        self._now_s += _TURN_S
        status = standing_status(self._pose)
        self._book = replace(self._book, status=status, status_s=self._now_s)
        before = self._book
        waiting = self._waiting()
        said = parse(text)
        if typed and waiting is not None:
            taken = receive_answer(before, said, waiting.id, self._now_s)
            if taken.command is not None:
                await self._on(taken.command)
            if taken.sentence is not None:
                return await self.hear(taken.sentence, leaning=taken.lean)
            return self._tell(before, waiting.id, taken.stops)
        goal = f"goal-{next(self._ids)}"
        given = Submitted(goal, text, said.language)
        heard = receive(before, said, given, self._now_s, leaning=leaning)
        if heard.stops:
            await self._on(Stopped("person"))
        await self._on(heard.given)
        if heard.takes_back is not None:
            await self._on(Cancel(heard.takes_back))
        made = self._book.missions.get(goal)
        stopped = made is not None and made.has_ended and goal not in self._plans
        return self._tell(before, goal, heard.stops and (heard.given.stop or stopped))

    async def _on(self, event: Event) -> None:
        self._book, effects = advance(self._book, event, self._now_s)
        for effect in effects:
            await self._carry(effect)

    async def _carry(self, effect: Effect) -> None:
        if not isinstance(effect, AskBrain):
            return
        planned = await self._commands.think(effect)
        if isinstance(planned.plan, StepPlan):
            self._plans[effect.id] = planned.plan
        if planned.sure is not None:
            self._sure[effect.id] = planned.sure
        await self._on(planned)
        while self._left:
            await self._carry(self._left.pop(0))

    async def _think(self, ask: AskBrain) -> Planned:
        means = Means(camera=True, detector=True, model=True)
        remember = self._commands.remember
        think = thinker(
            self._brain, vocabulary_of(self._site), None, means, _CLASSES, remember=remember
        )
        return await think(ask)

    def _plan_of(self, mission: Mission) -> StepPlan | None:
        """Return a goal's plan; after a no to a model's, what the order says to the grammar."""
        sure = self._sure.get(mission.id)
        if sure is not None and mission.plan == plan_record(sure):
            self._plans[mission.id] = sure  # a yes is to this one, whatever becomes of its record
        made = mission.plan
        if mission.id not in self._plans and made is not None and made.steps:
            self._plans[mission.id] = StepPlan(steps=steps_of(made.steps))  # a button carried it
        return self._plans.get(mission.id)

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
            plan = self._plan_of(taken)
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
            return RobotReply(reaction, self._plan_of(asking), asking.id, offer)
        dropped = [
            m.id for m in self._book.missions.values()
            if m.state is GoalState.CANCELLED and before.missions.get(m.id) not in (None, m)
        ]  # fmt: skip
        if dropped:
            declined = self._book.missions[dropped[0]].outcome
            no = declined is not None and declined.code is Code.DECLINED
            return RobotReply(Reaction.DROPS if no else Reaction.CANCEL)
        if mission is not None and mission.state is GoalState.SUCCEEDED:
            return RobotReply(Reaction.ANSWER, goal=goal)
        return RobotReply(Reaction.NO)

    def _is_taken(self, before: MissionState, mission: Mission) -> bool:
        """Tell whether a plan is newly under way; one whose own step asks is."""
        open_ = (GoalState.QUEUED, GoalState.RUNNING, GoalState.PAUSED)
        was = before.missions.get(mission.id)
        taken, had = (m is not None and (m.state in open_ or asks(m)) for m in (mission, was))
        return taken and not had

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
                if not runs:
                    self._pose = pose_after(self._book.facts, mission, self._pose)
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


_PICTURES = PictureLimits(24)
_CLASSES = ("person", "cup", "bottle", "chair", "cat", "dog", "book", "backpack", "ball")


class ScriptedModel:
    """Reply as a strong model would: with the plan that the person wants, in its role.

    Every third plan of its own moves besides somewhere that nobody named: the guard must ask.
    """

    def __init__(self, *, whims: bool = True) -> None:
        """Choose whether it has whims."""
        self._turn: ScriptTurn | None = None
        self._plans, self._whims, self.hostile = 0, whims, 0
        self._thoughts = 0

    @property
    def tag(self) -> BrainTag:
        """Return the double's name."""
        return BrainTag(name="scripted-model", version="1")

    def expect(self, turn: ScriptTurn) -> None:
        """Be told what the person of the script wants next."""
        self._turn, self._thoughts = turn, 0

    async def think(self, request: ThinkRequest, hear: Hear | None = None) -> ThinkResult:
        """Return the reply to the turn that is expected."""
        del hear
        return ThinkResult(plan=self._reply(request), brain=self.tag, calls=1)

    def _reply(self, request: ThinkRequest) -> StepPlan | AnswerPlan | Clarify | Refuse:
        turn = self._turn
        wanted = turn.wanted if turn is not None else frozenset()
        made = None
        if turn is not None and turn.plan is not None and wanted & PLANS:
            replies = turn.notes.model or (turn.plan,)
            self._thoughts += bool(request.observed)
            reply = replies[min(self._thoughts, len(replies) - 1)]
            made = expected_plan(Case(request.text, "", wanted=reply))
        if made is None:
            return self._talk(wanted)
        role = PlanRole.AFTER if Reaction.AFTER in wanted else PlanRole.NEW
        role = PlanRole.INSTEAD if Reaction.INSTEAD in wanted else role
        self._plans += 1
        if self._whims and self._plans % 3 == 0:
            self.hostile += 1
            made = made.model_copy(update={"steps": (*made.steps, _WHIM)})
        quoted = give_evidence(made, request.text, request.vocabulary)
        return quoted.model_copy(update={"does": role})

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


_WHIM = GoTo(place="entrance")
"""No script speaks of it."""
