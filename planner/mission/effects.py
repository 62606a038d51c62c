"""List what the reducer may ask of the world. Motion is not among them: see ``motion_request``.

What is streamed to the bridge is a level, not an event, so that no lost effect can keep a robot
moving: after every step the caller reads ``motion_request(book)`` anew.
"""

from __future__ import annotations

from dataclasses import dataclass

from planner.brain.interface import Exchange, Observation
from planner.brain.situation import Situation
from planner.mission.state import Mission
from planner.navigation.obstruction import Obstruction
from planner.navigation.route import RouteRequest
from planner.plan import ChangedOrder, Language, LastOrder, Span, StepPlan
from planner.skills.actions import AskImage, Way


@dataclass(frozen=True, slots=True)
class AskBrain:
    """Have a sentence understood; answer with ``Planned``."""

    id: str
    text: str
    """The newest thing the person said about this goal: an answer to our question replaces it."""
    language: Language
    room: str | None = None
    """The room that the robot is in, where known."""
    observed: tuple[Observation, ...] = ()
    """What came of the steps so far, where the goal is thought about again."""
    replan: int = 0
    """How often it was thought about again after a step that failed."""
    order: str = ""
    """What was said first."""
    standing: str = ""
    """The whole sentence of the standing order whose goal this is."""
    departed: bool = False
    """The order before led the robot away from where it was given: "come back" means there."""
    newest: LastOrder | None = None
    """The order before, which the text may change."""
    exchanges: tuple[Exchange, ...] = ()
    """What was asked about it, and answered; the newest answer is the text."""
    situation: Situation | None = None
    """Where things stand, and what came of the goals before."""
    changed: ChangedOrder | None = None
    """What the text makes of the order before it, for the built-in brain."""
    deed: StepPlan | None = None
    """What the standing order that the text is does each time, where the person was shown it."""

    @property
    def own_words(self) -> str:
        """Return the part of the text that is an order by itself; empty where it is steps."""
        return self.text if self.changed is None else self.changed.words


@dataclass(frozen=True, slots=True)
class DropBrain:
    """Nobody waits for this answer any more."""

    id: str


@dataclass(frozen=True, slots=True)
class ClearHold:
    """Bring the ``op/resume`` that came with a person's words for this goal to the bridge."""

    id: str


@dataclass(frozen=True, slots=True)
class AskRoute:
    """Have a way searched; answer with ``Routed``."""

    id: str
    ticket: int
    request: RouteRequest
    """What is searched; the points that the lidar sees and the shut ways come with the search."""
    heading: bool
    """The goal's yaw matters, too."""
    obstacles: bool
    """Count what the lidar sees now."""
    way: Way = Way.ROUTE
    """A spin needs no search: the engine answers it by itself."""
    shut: tuple[Obstruction, ...] = ()
    """Ways that are remembered as shut, whether the lidar sees them now or not."""
    speed_mps: float | None = None
    """The fastest that this way may be driven; None: as the route says."""


@dataclass(frozen=True, slots=True)
class AskEyes:
    """Have something asked about the picture; answer with ``Told``."""

    id: str
    ticket: int
    language: Language
    asked: AskImage
    """What the skill wants to know."""


@dataclass(frozen=True, slots=True)
class AskMemory:
    """Have looked up what is remembered; answer with ``Recalled``."""

    id: str
    ticket: int
    label: str | None = None
    """A thing, a person or what was told of, in the person's words."""
    place: str | None = None
    when: Span | None = None
    deeds: bool = False
    witnessed: bool = False
    """Only what was seen or done counts, and no words that were told: branches hang on it."""


@dataclass(frozen=True, slots=True)
class AskTool:
    """Have a tool called; answer with ``ToolAnswered``."""

    id: str
    ticket: int
    tool: str
    arguments: tuple[str, ...] = ()
    agreed: bool = False
    """A person said yes to this call."""


@dataclass(frozen=True, slots=True)
class KeepPicture:
    """Keep the picture that a gaze has ended with, for the question at the end of its step."""

    id: str
    number: int
    """Of the direction, in the order of gazing; 0 begins a new look."""
    seq: int
    """As the camera numbers it: any other picture shows something else."""


@dataclass(frozen=True, slots=True)
class SavePicture:
    """Keep the picture that a gaze at a patrol's stop has ended with, for people to look at."""

    id: str
    step: int
    stop: int
    place: str
    seq: int
    """As the camera numbers it: any other picture shows something else."""
    is_inward: bool = True
    """It looks into the stop's own room, and not through a door."""


@dataclass(frozen=True, slots=True)
class Journal:
    """Write these records in one transaction; answer with ``Journalled(entry)``."""

    entry: int
    missions: tuple[Mission, ...]
    queue: tuple[str, ...]


@dataclass(frozen=True, slots=True)
class SayAloud:
    """Give listeners to events words to speak or show. At most once, even across a crash."""

    id: str
    text: str


@dataclass(frozen=True, slots=True)
class GoalChange:
    """Tell listeners that a goal has changed."""

    id: str


TaskEffect = (
    AskBrain | DropBrain | AskRoute | AskEyes | AskMemory | AskTool | KeepPicture | SavePicture
)
"""What is done beside the loop."""
Effect = TaskEffect | ClearHold | Journal | SayAloud | GoalChange
