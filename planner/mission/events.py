"""List what can happen to the missions of a robot. Ids come in; none is minted here."""

from __future__ import annotations

from dataclasses import dataclass

from planner.mission.state import Mission
from planner.navigation.obstruction import Obstruction
from planner.navigation.route import FloorReport
from planner.perception.snapshot import Sight
from planner.plan import (
    AnswerPlan,
    Bilingual,
    BrainTag,
    ChangedOrder,
    Clarify,
    Code,
    Language,
    Outcome,
    Refuse,
    Step,
    StepPlan,
)
from planner.site.site_view import SiteView
from planner.skills.perception import ImageAnswer as EyeAnswer
from wire import Status


@dataclass(frozen=True, slots=True)
class Submitted:
    """Somebody gave a goal. ``stop``: the sentence itself is an order to stop."""

    id: str
    text: str
    language: Language
    confirm: bool = False
    replace: bool = False
    """It ends what is in hand once it is understood."""
    first: bool = False
    """It comes in place of a goal that was taken back: nobody who waits overtakes it."""
    resumes: bool = False
    """The sentence itself says "go on": the hold that stands is about to be cleared."""
    stop: bool = False
    doubtful_stop: bool = False
    """The sentence holds a stop word and has stopped the robot; it is thought about only now."""
    rest: str = ""
    """What a sentence that orders a stop says behind it, in the same breath."""
    echoed: bool = True
    """The bridge has confirmed that stop."""
    interrupts: str | None = None
    """The goal that had the robot, or was thought about, as the sentence stopped it."""
    denies: str | None = None
    """The goal on whose way the sentence says that the robot is wrong."""
    asking: tuple[str, ...] = ()
    """The goals whose question the sentence may answer."""
    source: str = "api"
    by: str = "api"
    """The door that it came through, to be shown."""
    local: bool = False
    """It is said to the planner itself, or answers: no order that needs room among the others."""
    changed: ChangedOrder | None = None
    """What it makes of the order before it."""
    points: tuple[Step, ...] = ()
    """What it is given as, in place of words: its whole plan, and no brain is asked."""
    also: Bilingual | None = None
    """What was done beside the stop that these words were: told with it."""


@dataclass(frozen=True, slots=True)
class Planned:
    """The brain answered; ``failure`` where there is no usable plan."""

    id: str
    plan: StepPlan | AnswerPlan | Clarify | Refuse | None
    failure: Outcome | None = None
    brain: BrainTag | None = None
    unasked: tuple[int, ...] = ()
    """The steps of the plan that move the robot though no words of a person ask for it."""
    sure: StepPlan | None = None
    """The built-in brain's own reading of the order, where a model's plan has such steps."""


@dataclass(frozen=True, slots=True)
class Routed:
    """A route came, or the code of why there is none."""

    id: str
    ticket: int
    failure: str | None = None
    short_m: float = 0.0
    """From the end of the route to its goal."""
    end_m: tuple[float, float] | None = None
    """Where it ends, in ``map``."""
    length_m: float = 0.0
    floor: FloorReport | None = None
    """What the map shows, where somebody explores."""


@dataclass(frozen=True, slots=True)
class RouteDoubted:
    """The route search remembers something that closes the way of the leg that is streamed."""

    id: str
    leg: int
    at_m: tuple[float, float]
    """Where it is closed, in ``map``."""


@dataclass(frozen=True, slots=True)
class Oncoming:
    """Somebody comes towards the robot on the way of the leg that is streamed."""

    id: str
    leg: int
    at_m: tuple[float, float]
    """Where they are on it, in ``map``."""
    far_m: float
    """Along it, from the robot to there."""
    seen_m: tuple[float, float] = (0.0, 0.0)
    """Where the lidar sees their side."""
    radius_m: float = 0.0
    """Of the disc that holds what is seen of them."""


@dataclass(frozen=True, slots=True)
class ClosingIn:
    """Another robot and the one that drives this leg are about to touch, as both go on."""

    id: str
    leg: int


@dataclass(frozen=True, slots=True)
class Seen:
    """The bridge spoke. ``off_path``: the robot is too far from the path that is streamed."""

    status: Status
    off_path: bool = False
    left_m: float | None = None
    """Along that path, to its end."""


@dataclass(frozen=True, slots=True)
class Surveyed:
    """The lidar was asked what stands in the way of the leg that is streamed."""

    obstruction: Obstruction | None
    moves: bool = False
    """It moved within the last seconds: somebody who may walk on."""
    opened: tuple[Obstruction, ...] = ()
    """Of the ways that are remembered as shut: through these the lidar sees now."""
    local_offset_s: float = 0.0
    """Of people's own clock from UTC, to tell them since when."""
    radius_m: float = 0.0
    """Of what moved there, where something did; else of what is as round as a robot."""


@dataclass(frozen=True, slots=True)
class Sighted:
    """The eyes spoke: a look, or that they are blind. Only the newest word counts."""

    sight: Sight
    classes: tuple[str, ...] = ()
    """What can be found now; empty where that is not known."""


@dataclass(frozen=True, slots=True)
class Told:
    """A question about the picture was answered."""

    id: str
    ticket: int
    answer: EyeAnswer


@dataclass(frozen=True, slots=True)
class Recalled:
    """Memory has answered: in words from figures and from what people told, never a model's."""

    id: str
    ticket: int
    code: Code
    said: Bilingual


@dataclass(frozen=True, slots=True)
class ToolAnswered:
    """A tool has answered, could not be asked, or may be asked upon a person's yes alone."""

    id: str
    ticket: int
    said: Bilingual
    """In our own words: what was asked, why it failed, or the question."""
    read: Bilingual | None = None
    """The server's words: tainted."""
    problem: str | None = None
    """A stable code; None: it answered."""
    asks: bool = False
    """``said`` is to be asked first."""


@dataclass(frozen=True, slots=True)
class Journalled:
    """All entries up to ``entry`` are on disk."""

    entry: int


@dataclass(frozen=True, slots=True)
class Cancel:
    """End a goal."""

    id: str


@dataclass(frozen=True, slots=True)
class Pause:
    """Keep a goal's place, standing."""

    id: str


@dataclass(frozen=True, slots=True)
class Resume:
    """Go on with a paused goal, or let a goal that is kept waiting take its turn."""

    id: str


@dataclass(frozen=True, slots=True)
class Confirm:
    """Say yes to a plan."""

    id: str
    by: str = "api"


@dataclass(frozen=True, slots=True)
class Reply:
    """Answer a question."""

    id: str
    text: str
    by: str = "api"


@dataclass(frozen=True, slots=True)
class ChangeSpeed:
    """Halve the speed cap of a running goal, or double it again up to the whole."""

    id: str
    slower: bool


@dataclass(frozen=True, slots=True)
class Move:
    """Put a queued goal before another, or last."""

    id: str
    before: str | None = None


@dataclass(frozen=True, slots=True)
class Stopped:
    """Somebody said stop. Running and thinking goals pause, queued ones are kept waiting."""

    source: str


@dataclass(frozen=True, slots=True)
class Restarted:
    """A new planner process took up the journal. Nothing moves until a person acts."""

    missions: tuple[Mission, ...]
    queue: tuple[str, ...]
    wall_offset_s: float
    local_offset_s: float = 0.0
    """Of people's own clock from UTC."""


@dataclass(frozen=True, slots=True)
class Known:
    """A place was taught, moved or forgotten: these are the places now."""

    facts: SiteView


@dataclass(frozen=True, slots=True)
class Tick:
    """Time went by."""


Command = Cancel | Pause | Resume | Confirm | Reply | Move | ChangeSpeed
Fact = (
    Submitted
    | Planned
    | Routed
    | RouteDoubted
    | Oncoming
    | ClosingIn
    | Seen
    | Surveyed
    | Sighted
    | Told
    | Recalled
    | ToolAnswered
    | Journalled
    | Stopped
    | Restarted
    | Known
    | Tick
)
Event = Command | Fact
