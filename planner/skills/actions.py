"""Define a skill's inputs and the actions it may ask for. Data only: no book, no bridge, no clock.

A skill is a pure function of a :class:`Scene`: asked when its step begins, after each leg of it was
reached, and again after a pause or a crash. It answers with one act; the mission carries it out.
What a skill must remember it hands over with its act: ``state`` holds while the act lasts, ``then``
once it is done, ``otherwise`` where its way turns out to be shut.
"""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from enum import StrEnum
from typing import Any, Generic, TypeVar, cast

from planner.perception.snapshot import Sight
from planner.plan import Bilingual, Code, Language, PictureBill, StepRecord
from planner.site.site_view import SiteView
from planner.skills.perception import NO_EYES, Eyesight, ImageAnswer, WantedObject
from planner.skills.skill_state import SkillStateBase
from wire import Pose2

S_co = TypeVar("S_co", covariant=True)
S = TypeVar("S")

UNSEEN = Sight()
"""Nothing was ever seen."""
ANSWER_S = 125.0
"""Longest wait for an answer about a picture. A model has its own time, set to 120 s at most, and
says so when that is over: this is for an answer that gets lost."""


class Way(StrEnum):
    """How a leg gets to its goal."""

    ROUTE = "route"
    """By the search, round what stands in the way."""
    STRAIGHT = "straight"
    """Straight along the heading, ahead or backwards, or not at all."""
    ASIDE = "aside"
    """To where somebody who stands at the goal can walk past the robot."""
    EXPLORE = "explore"
    """To where floor is seen that is not on the map yet; by route, once that is known."""
    SPIN = "spin"
    """On the spot: the bridge turns to the heading by the shorter way."""


@dataclass(frozen=True, slots=True)
class Scene(Generic[S_co]):
    """Tell a skill where its step stands; ``S_co`` is what this skill remembers, or None."""

    step: StepRecord
    facts: SiteView
    state: S_co
    """What the skill handed over with what it asked for before; at first a new one."""
    pose: Pose2 | None
    """The robot in ``map`` now, where known."""
    began: Pose2 | None
    """The robot in ``map`` when the step began."""
    done: float
    """What odometry says was done of the step: radians of a turn, else metres along the heading."""
    part: int
    """Legs of this step that were reached."""
    accepted: Pose2 | None
    """The robot in ``map`` when the goal was accepted, where it was known."""
    language: Language = Language.EN
    """Of the order."""
    eyes: Eyesight = NO_EYES
    sight: Sight = UNSEEN
    now_s: float = 0.0
    """On the clock of the sight."""
    gazed_s: float | None = None
    """Since when was gazed, where a gaze has just ended."""
    spent_s: float = 0.0
    """Time for which this step was worked on."""
    spent_m: float = 0.0
    """What was driven for this step."""
    answer: ImageAnswer | None = None
    """What came of a question about the picture that was just asked."""
    unix_s: float = 0.0
    """The same moment in Unix time."""
    local_offset_s: float = 0.0
    """Of people's own clock from UTC."""
    upon: Bilingual | None = None
    """What moves next upon a yes to the question that the step asks; None: nothing does."""
    thinks: bool = False
    """The brain may read an answer that is neither yes nor no, and plan anew."""
    left_m: float = 60.0
    """What the bridge still let the goal drive when this step began."""
    afterwards: tuple[tuple[tuple[float, float], ...], ...] = ()
    """Where the steps after this one drive, in ``map`` [m], for each branch that may come."""
    offers: bool = False
    """A person may be asked whether a search is to go on that its bounds have ended."""
    has_else: bool = False
    """The step is a condition, and the person said what to do where it does not hold."""

    def but(self, state: S) -> Scene[S]:
        """Return the scene with another state."""
        return cast("Scene[S]", replace(cast("Scene[Any]", self), state=state))


@dataclass(frozen=True, slots=True)
class DriveLeg:
    """Drive one leg, within its budget."""

    goal: Pose2
    heading: bool
    """The goal's yaw matters too."""
    way: Way = Way.ROUTE
    target: str | None = None
    """The place that is driven to."""
    limit_s: float | None = None
    """Longest time in motion; None: the bridge's grant bounds it."""
    limit_m: float | None = None
    """Longest way; None: the bridge's grant bounds it."""
    state: SkillStateBase | None = None
    then: SkillStateBase | None = None
    otherwise: SkillStateBase | None = None
    """The step goes on with these where there is no way; None: it fails."""
    wanted: WantedObject | None = None
    """As soon as this is seen for sure the skill is asked again."""
    watch: bool = False
    """The skill is asked again as the sight changes, twice a second at most."""
    bill: PictureBill | None = None
    """What a vision model has cost so far and may cost, for the step's record."""
    sees: tuple[float, float] | None = None
    """The leg ends where this point is seen from, on the map, and faces it."""
    sees_from_m: float = 0.0
    """No nearer to it."""
    exact: bool = False
    """The leg ends at its goal or not at all: free floor beside it will not do."""


@dataclass(frozen=True, slots=True)
class Observe:
    """Stand and look, until so many new pictures were thought upon, or for so long."""

    looks: int
    seconds: float = 6.0
    """Longest wait for them; without any the robot is blind, and the step fails."""
    state: SkillStateBase | None = None
    then: SkillStateBase | None = None
    wanted: WantedObject | None = None
    watch: bool = False
    bill: PictureBill | None = None


@dataclass(frozen=True, slots=True)
class AskImage:
    """Ask about the picture, standing: a vision model in words, or the point behind a pixel.

    With ``x`` and ``y`` (0 to 1000) the point there; else with ``point`` where these words are,
    with ``seek`` whether such a thing is there and how many; else what is seen, as an answer to
    these words: in the pictures of all ``views``, the names of the directions gazed in, where they
    are still there; else in the newest one, of ``now``.
    """

    words: str = ""
    point: bool = False
    seek: bool = False
    x: int | None = None
    y: int | None = None
    views: tuple[Bilingual, ...] = ()
    now: Bilingual | None = None
    seconds: float = ANSWER_S
    state: SkillStateBase | None = None
    then: SkillStateBase | None = None
    bill: PictureBill | None = None


@dataclass(frozen=True, slots=True)
class Stand:
    """Stand for a while [s]."""

    seconds: float
    state: SkillStateBase | None = None
    """Held from now on."""


@dataclass(frozen=True, slots=True)
class Speak:
    """Say words, at most once."""

    text: str


@dataclass(frozen=True, slots=True)
class Question:
    """Ask a person, standing; the skill is asked again with the answer in its step's record."""

    text: Bilingual
    state: SkillStateBase | None = None
    """Held from now on, also while nobody has answered yet."""


@dataclass(frozen=True, slots=True)
class LookUp:
    """Look up what is remembered, standing; the step ends with it."""

    seconds: float = 5.0


@dataclass(frozen=True, slots=True)
class CallTool:
    """Ask the step's tool, standing, as soon as the step's beginning is on disk."""

    agreed: bool = False
    """A person said yes to this call."""
    seconds: float = ANSWER_S
    state: SkillStateBase | None = None
    """Held from now on."""


@dataclass(frozen=True, slots=True)
class Think:
    """Have the brain think again with the sights and answers so far."""

    state: SkillStateBase | None = None
    """Held from now on; a thought with the same state as before is the same one, interrupted."""


@dataclass(frozen=True, slots=True)
class Retry:
    """Wait, standing, and ask the skill again: it knows not where the robot is, or what it saw."""

    seconds: float = 1.0
    state: SkillStateBase | None = None
    """Held from now on; None: as before."""


@dataclass(frozen=True, slots=True)
class Finish:
    """End the step well; ``figures`` go into its record."""

    figures: dict[str, Any] = field(default_factory=dict)
    code: Code | None = None
    """What the step came to, where it has something to tell."""
    said: Bilingual | None = None
    read: Bilingual | None = None
    """What a model said of a picture: for people alone."""


@dataclass(frozen=True, slots=True)
class Skip:
    """Leave the step out, for a reason."""

    reason: str


@dataclass(frozen=True, slots=True)
class Fail:
    """End the step without success: a precondition does not hold, or odometry disagrees."""

    code: Code
    reason: str
    said: Bilingual | None = None
    """The sentence for people where the code's own would not do."""
    figures: dict[str, Any] = field(default_factory=dict)


SkillAction = (
    DriveLeg
    | Stand
    | Observe
    | AskImage
    | LookUp
    | CallTool
    | Speak
    | Question
    | Think
    | Retry
    | Finish
    | Skip
    | Fail
)
