"""Be the robot that a scripted person talks to: the planner's own shell in lockstep.

Undriven, what a goal set going counts as under way or done by the next sentence, as the script
says. Driven, each goal is brought to its end on a simulated clock, seen by the simulator's truth
with a detector's misses, and what is told at the end is judged as well.
"""

from __future__ import annotations

from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import TYPE_CHECKING, TypeVar

from lockstep.planner_process import WALL_OFFSET_S
from planner.brain.image_questions import ImageDescription, ImageSighting, NotThere
from planner.language.schedule import ScheduleCommand, can_lean
from planner.language.sentence import parse
from planner.memory import MemoryStore, Recollection, SightingRecorder
from planner.mission.awaited_word import AwaitedWord, wait_of
from planner.mission.errors import MissionError
from planner.mission.events import Planned
from planner.mission.reception import hears_stop
from planner.plan import (
    AnswerPlan,
    BrainTag,
    Clarify,
    Code,
    GoalState,
    PlanRole,
    StepPlan,
    plan_record,
    say_same,
)
from planner.plan.slots import steps_of
from planner.skills.spatial_relations import support_of
from planner.state_database import StateDatabase
from tools.evals.scripts import Reaction
from tools.lockstep import LockstepWorld, TooLong
from tools.lockstep.standing_world import StandingWorld

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

    from planner.brain import Brain
    from planner.brain.image_questions import ImageQuestion
    from planner.brain.interface import ThinkRequest, ThinkResult
    from planner.brain.streamed_draft import Hear
    from planner.language.schedule import ChangeOrders, OrderCommand
    from planner.mission.effects import AskBrain
    from planner.mission.state import Mission, MissionState
    from planner.plan import Bilingual, Goal, Language, StepRecord
    from tools.evals.scripts import ScriptTurn

T = TypeVar("T")
THOUGHT_LIMIT_S, DRIVE_LIMIT_S = 30.0, 900.0
STAY_S = 3.0
_ASKING = (GoalState.NEEDS_CLARIFICATION, GoalState.AWAITING_CONFIRMATION)
_GOES = (GoalState.QUEUED, GoalState.RUNNING)
_KEPT = say_same("So it is kept. 记住了。")


@dataclass(frozen=True, slots=True)
class RobotReply:
    """Hold what the person hears after one sentence."""

    reaction: Reaction
    plan: StepPlan | None = None
    goal: str = ""
    offer: str = ""
    alone: bool = False
    """No other goal goes on beside the one that was taken."""


@dataclass
class _PlanKeeper:
    """Be a brain whose plans are known by goal."""

    brain: Brain
    plans: dict[str, StepPlan]

    @property
    def tag(self) -> BrainTag:
        return self.brain.tag

    async def think(self, request: ThinkRequest, hear: Hear | None = None) -> ThinkResult:
        thought = await self.brain.think(request, hear)
        if isinstance(thought.plan, StepPlan) and not request.observed:
            self.plans[request.goal] = thought.plan
        return thought


class _NotedEyes:
    """Say of each picture what the trial's turn notes."""

    tag = BrainTag(name="noted-eyes", version="1")
    words = ""

    async def describe(self, asked: ImageQuestion) -> ImageDescription:
        del asked
        verdict, _, words = self.words.partition(" ")
        seen = {"yes": True, "no": False}.get(verdict)
        return ImageDescription(say_same(words or "I see a room."), seen, self.tag)

    async def point(self, asked: ImageQuestion) -> NotThere:
        del asked
        return NotThere(self.tag)

    async def seek(self, asked: ImageQuestion) -> ImageSighting:
        del asked
        return ImageSighting(False, 0, 0, 0, 0.9, self.tag)


class _OrderTaker:
    """Take every standing order whose time is read; keep none."""

    def __init__(self) -> None:
        self._has_order = False

    async def take(self, command: OrderCommand, ask: AskBrain, given: Mission) -> Planned | None:
        del given
        if can_lean(command) and not self._has_order:
            return None
        self._has_order |= isinstance(command, ScheduleCommand)
        read = not isinstance(command, ScheduleCommand) or command.problem is None
        made = AnswerPlan(text=_KEPT) if read else Clarify(code=Code.INCOMPLETE, question=_KEPT)
        return Planned(ask.id, made)

    async def change(self, command: ChangeOrders, language: Language) -> Bilingual | None:
        del command, language
        return _KEPT

    def allowed_steps(self, source: str) -> tuple[StepRecord, ...] | None:
        del source
        return None

    def sentence_of(self, source: str) -> tuple[str, str | None]:
        del source
        return "", None

    def refuse_offer(self, text: str) -> Bilingual | None:
        del text
        return None


async def _inline(work: Callable[[], T], /) -> T:
    return work()


class ConversationRobot:
    """Take sentences in as the planner does, and say what each came to."""

    def __init__(self, brain: Brain, folder: Path, memory: Path, *, driven: bool = False) -> None:
        """Put a robot into a site's folder, at its dock; ``memory`` is an empty folder."""
        self._keeper, self._noted = _PlanKeeper(brain, {}), _NotedEyes()
        make = LockstepWorld if driven else StandingWorld
        self.world: LockstepWorld | StandingWorld = make(site=folder, brain=self._keeper)
        self._eyes = self.world.open_eyes(looker=self._noted)
        missions, site = self.world.planner.missions, self.world.scene.site
        recollection = Recollection(
            MemoryStore(StateDatabase(memory / "state.db")), wall=self._wall_s, run=_inline
        )
        self._recorder = SightingRecorder(
            recollection, site.map_id, support=support_of, step=lambda: "look",
            clock=lambda: self.world.now_s, wall=self._wall_s,
        )  # fmt: skip
        recollection.flush_by(self._recorder.flush)
        missions.remember_by(recollection)
        missions.commands.desk = _OrderTaker()
        self._turn: ScriptTurn | None = None

    def think_with(self, brain: Brain) -> None:
        """Let another brain turn sentences into plans from now on."""
        self._keeper.brain = brain

    def expect(self, turn: ScriptTurn) -> None:
        """Be told what the next turn notes of what is seen and answered."""
        self._turn, self._noted.words = turn, turn.notes.sees

    async def hear(self, text: str, *, typed: bool = False) -> RobotReply:
        """Return what a sentence comes to."""
        before, waiting = self._book(), self._waiting()
        if typed and waiting is not None:
            self.world.answer(self.world.goal(waiting.id), text)
            return self._reply_after(before, waiting.id)
        stops = hears_stop(before, parse(text), self.world.now_s)
        try:
            goal = self.world.say(text).id
        except MissionError:
            return RobotReply(Reaction.NO)
        told = self._reply_after(before, goal)
        ended = self._book().missions[goal].state is GoalState.SUCCEEDED
        return RobotReply(Reaction.STOP) if stops and ended and not told.plan else told

    async def confirm(self, goal: str, *, yes: bool) -> RobotReply:
        """Return what a yes or no to a plan comes to."""
        before = self._book()
        self.world.answer(self.world.goal(goal), "yes" if yes else "no")
        return self._reply_after(before, goal)

    def settle(self, goal: str, *, stays: bool) -> None:
        """Have a goal that was taken run on, or be done."""
        if isinstance(self.world, StandingWorld):
            self.world.settle(goal if stays else None)
            return
        if stays:
            self.world.run(STAY_S)
            return
        answers = iter(self._turn.notes.hears if self._turn is not None else ())

        def has_ended(world: LockstepWorld) -> bool:
            waiting = self._waiting()
            if waiting is not None and (words := next(answers, None)) is not None:
                world.answer(world.goal(waiting.id), words)
                return False
            runs = (*_GOES, GoalState.PLANNING)
            return all(m.state not in runs for m in self._book().missions.values())

        try:
            self.world.run_until(has_ended, DRIVE_LIMIT_S)
        except TooLong:
            self.world.cancel(self.world.goal(goal))
            self.world.run(1.0)

    def fault_of(self, goal: str, turn: ScriptTurn) -> str:
        """Return what is wrong with a driven goal's end; empty where it is as the turn notes."""
        if isinstance(self.world, StandingWorld) or not turn.notes.told or turn.stays:
            return ""
        record: Goal = self.world.goal(goal).record
        outcome = record.outcome
        if outcome is None:
            return f"ends {record.state.value}"
        code, *words = turn.notes.told
        # An expectation's words are read in small letters, and the scripted model says them so.
        told = f"{outcome.message.en} {outcome.message.zh}".casefold()
        if outcome.code.value in code.split("/") and all(w.casefold() in told for w in words):
            return ""
        return f"ends {outcome.code.value}: {outcome.message.en}"

    def _wall_s(self) -> float:
        return self.world.now_s + WALL_OFFSET_S

    def _book(self) -> MissionState:
        self._recorder.take(self._eyes.sight)
        return self.world.planner.book

    def _reply_after(self, before: MissionState, goal: str) -> RobotReply:
        """Return what the person hears once no thought is under way any more."""

        def has_thought(world: LockstepWorld | StandingWorld) -> bool:
            made = world.planner.book.missions  # after a stop it comes when the bridge has echoed
            return goal in made and all(m.state is not GoalState.PLANNING for m in made.values())

        self.world.run(0.1)
        self.world.run_until(has_thought, THOUGHT_LIMIT_S)
        self.world.run(0.2)
        return self._tell(before, goal)

    def _tell(self, before: MissionState, goal: str) -> RobotReply:
        """Return what has changed, as a person would be told."""
        book = self._book()
        taken = next((m for m in book.missions.values() if self._is_taken(before, m)), None)
        if taken is not None:
            plan = self._plan_of(taken)
            if plan is not None and plan.does in (PlanRole.CANCEL, PlanRole.ANSWER_TO):
                return RobotReply(Reaction.CANCEL)
            alone = all(m is taken or m.state not in _GOES for m in book.missions.values())
            return RobotReply(_role(before, book, taken), plan, taken.id, alone=alone)
        mission, asking = book.missions.get(goal), self._waiting()
        if asking is not None and (mission is None or not mission.has_ended or mission is asking):
            confirms = asking.state is GoalState.AWAITING_CONFIRMATION
            options = asking.plan.options if asking.plan is not None else ()
            offer = options[0].text if len(options) == 1 else ""
            reaction = Reaction.CONFIRMS if confirms else Reaction.ASKS
            return RobotReply(reaction, self._plan_of(asking), asking.id, offer)
        dropped = [
            m for m in book.missions.values()
            if m.state is GoalState.CANCELLED and before.missions.get(m.id) not in (None, m)
        ]  # fmt: skip
        if dropped:
            declined = dropped[0].outcome
            no = declined is not None and declined.code is Code.DECLINED
            return RobotReply(Reaction.DROPS if no else Reaction.CANCEL)
        if mission is not None and mission.state is GoalState.SUCCEEDED:
            return RobotReply(Reaction.ANSWER, goal=goal)
        return RobotReply(Reaction.NO)

    def _plan_of(self, mission: Mission) -> StepPlan | None:
        """Return a goal's plan, a brain's own where it is the one that is kept."""
        kept, made = self._keeper.plans.get(mission.id), mission.plan
        if made is None or not made.steps or (kept is not None and plan_record(kept) == made):
            return kept
        return StepPlan(steps=steps_of(made.steps))

    def _waiting(self) -> Mission | None:
        open_ = [m for m in self._book().missions.values() if m.state in _ASKING]
        return max(open_, key=lambda m: m.order, default=None)

    def _is_taken(self, before: MissionState, mission: Mission) -> bool:
        """Tell whether a plan is newly under way, or done at once; one whose own step asks is."""
        was = before.missions.get(mission.id)
        had = was is not None and (was.has_ended or _is_under_way(was))
        has_steps = mission.plan is not None and bool(mission.plan.steps)
        done = mission.state is GoalState.SUCCEEDED and has_steps
        return not had and (done or _is_under_way(mission))


def _is_under_way(mission: Mission) -> bool:
    return mission.state in (*_GOES, GoalState.PAUSED) or wait_of(mission) is AwaitedWord.STEP


def _role(before: MissionState, book: MissionState, taken: Mission) -> Reaction:
    went = [m for m in before.missions.values() if m.state in _GOES]
    if any(book.missions[m.id].state is GoalState.CANCELLED for m in went):
        return Reaction.INSTEAD
    waits = any(m.id != taken.id for m in went)
    return Reaction.AFTER if waits and taken.first else Reaction.NEW


@contextmanager
def conversation_robot(
    brain: Brain, folder: Path, *, driven: bool = False
) -> Iterator[ConversationRobot]:
    """Lend a robot at its dock in a site's folder, with a memory that goes with it."""
    with TemporaryDirectory(prefix="pons-conversation-") as memory:
        yield ConversationRobot(brain, folder, Path(memory), driven=driven)
