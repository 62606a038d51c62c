"""Hold a trial's conversations with a robot that drives in lockstep: real planner, real bridge.

Understanding alone says nothing of a search that runs out or of an answer that nobody can use. Here
each goal is driven to its end on a simulated clock, seen by the simulator's truth with a detector's
misses, and what is told at the end is judged as well. Part of a checkout: `tools` is not installed.
"""

from __future__ import annotations

from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import TYPE_CHECKING, TypeVar

from planner.brain.image_questions import ImageDescription, ImageSighting, NotThere
from planner.language.reading import ChangeReading
from planner.language.sentence import parse
from planner.memory import MemoryStore, Recollection, SightingRecorder
from planner.mission.events import Submitted
from planner.mission.reception import receive
from planner.mission.skills.spatial_relations import support_of
from planner.plan import BrainTag, GoalState, StepPlan, say_same
from planner.state_database import StateDatabase
from pons.evals.person_commands import OrderDouble
from pons.evals.person_robot import RobotEar, RobotReply
from pons.evals.person_scripts import PLANS, Reaction
from tools.lockstep import LockstepWorld, TooLong
from tools.lockstep.planner_process import WALL_OFFSET_S

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

    from planner.brain import Brain
    from planner.brain.image_questions import ImageQuestion
    from planner.brain.interface import ThinkRequest, ThinkResult
    from planner.brain.streamed_draft import Hear
    from planner.mission.state import MissionState
    from planner.plan import Goal
    from pons.evals.person_scripts import ScriptTurn

T = TypeVar("T")
THOUGHT_LIMIT_S, DRIVE_LIMIT_S = 30.0, 900.0
STAY_S = 3.0
_ASKING = (GoalState.NEEDS_CLARIFICATION, GoalState.AWAITING_CONFIRMATION)


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


async def _inline(work: Callable[[], T], /) -> T:
    return work()


class DrivenRobot(RobotEar):
    """Take sentences in as the planner does, and drive."""

    def __init__(self, brain: Brain, folder: Path, memory: Path, seed: int = 1) -> None:
        """Put a robot into a site's folder, ready at its dock; ``memory`` is an empty folder."""
        keeper = _PlanKeeper(brain, {})
        self.world = LockstepWorld(site=folder, seed=seed, brain=keeper)
        super().__init__(brain, self.world.scene.site)
        self._plans, self._noted = keeper.plans, _NotedEyes()
        self._eyes = self.world.open_eyes(looker=self._noted)
        missions = self.world.planner.missions
        store = MemoryStore(StateDatabase(memory / "state.db"))
        recollection = Recollection(store, wall=self._wall_s, run=_inline)
        self._recorder = SightingRecorder(
            recollection,
            self.world.scene.site.map_id,
            support=support_of,
            step=lambda: "look",
            clock=lambda: self.world.now_s,
            wall=self._wall_s,
        )
        recollection.flush_by(self._recorder.flush)
        missions.remember_by(recollection)
        missions.commands.desk = OrderDouble()
        self._turn: ScriptTurn | None = None

    def expect(self, turn: ScriptTurn) -> None:
        """Be told what the next turn notes of what is seen and answered."""
        self._turn, self._noted.words = turn, turn.notes.sees

    async def hear(
        self, text: str, *, typed: bool = False, leaning: ChangeReading | None = None
    ) -> RobotReply:
        """Return what a sentence comes to; how it leans the missions work out themselves."""
        del leaning
        before, waiting = self._look(), self._waiting()
        if typed and waiting is not None:
            self.world.answer(self.world.goal(waiting.id), text)
            return self._settle(before, waiting.id, stopped=False)
        said = parse(text)
        given = Submitted("asked", text, said.language)
        stops = receive(before, said, given, self.world.now_s).stops
        goal = self.world.say(text).id
        told = self._settle(before, goal, stopped=False)
        plain = stops and self._book.missions[goal].state is GoalState.SUCCEEDED
        return RobotReply(Reaction.STOP) if plain and told.reaction not in PLANS else told

    async def confirm(self, goal: str, *, yes: bool) -> RobotReply:
        """Return what a yes or no to a plan comes to."""
        before = self._look()
        self.world.answer(self.world.goal(goal), "yes" if yes else "no")
        return self._settle(before, goal, stopped=False)

    def _wall_s(self) -> float:
        return self.world.now_s + WALL_OFFSET_S

    def _look(self) -> MissionState:
        self._recorder.take(self._eyes.sight)
        self._book = self.world.planner.book
        return self._book

    def _settle(self, before: MissionState, goal: str, *, stopped: bool) -> RobotReply:
        """Return what the person hears once no thought is under way any more."""

        def has_thought(world: LockstepWorld) -> bool:
            made = world.planner.book.missions  # after a stop it comes when the bridge has echoed
            return goal in made and all(m.state is not GoalState.PLANNING for m in made.values())

        self.world.run(0.1)
        self.world.run_until(has_thought, THOUGHT_LIMIT_S)
        self.world.run(0.2)
        self._look()
        return self._tell(before, goal, stopped)

    def settle(self, goal: str, *, stays: bool) -> None:
        """Drive on for a moment, or to the end of all that is open; answer what is asked."""
        if stays:
            self.world.run(STAY_S)
            return
        answers = iter(self._turn.notes.hears if self._turn is not None else ())

        def has_ended(world: LockstepWorld) -> bool:
            self._recorder.take(self._eyes.sight)
            book = world.planner.book
            waiting = next((m for m in book.missions.values() if m.state in _ASKING), None)
            if waiting is not None and (words := next(answers, None)) is not None:
                world.answer(world.goal(waiting.id), words)
                return False
            runs = (GoalState.QUEUED, GoalState.RUNNING, GoalState.PLANNING)
            return all(m.state not in runs for m in book.missions.values())

        try:
            self.world.run_until(has_ended, DRIVE_LIMIT_S)
        except TooLong:
            self.world.cancel(self.world.goal(goal))
            self.world.run(1.0)
        self._look()

    def fault_of(self, goal: str, turn: ScriptTurn) -> str:
        """Return what is wrong with a goal's end; empty where it is as the turn notes."""
        if not turn.notes.told or turn.stays:
            return ""
        record: Goal = self.world.goal(goal).record
        outcome = record.outcome
        if outcome is None:
            return f"ends {record.state.value}"
        code, *words = turn.notes.told
        told = f"{outcome.message.en} {outcome.message.zh}"
        if outcome.code.value in code.split("/") and all(word in told for word in words):
            return ""
        return f"ends {outcome.code.value}: {outcome.message.en}"


@contextmanager
def driven_robot(brain: Brain, folder: Path) -> Iterator[DrivenRobot]:
    """Lend a robot at its dock in a site's folder, with a memory that goes with it."""
    with TemporaryDirectory(prefix="pons-trial-") as memory:
        yield DrivenRobot(brain, folder, Path(memory))
