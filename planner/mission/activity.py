"""Define what the running step is doing now, between two statuses: one record for each activity.

An activity dies with the process; the journal keeps what is needed to begin it again. Data only:
``*_s`` are on the caller's monotonic clock.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from enum import StrEnum

from planner.mission.recovery import LadderRung
from planner.plan import Bilingual
from planner.skills.actions import AskImage, DriveLeg, Observe, Way
from wire import Pose2


@dataclass(frozen=True, slots=True, kw_only=True)
class _StepActivity:
    record: int
    """The journal entry that says this step started; nothing moves or speaks before it is safe."""
    metres: float = 0.0
    """What odometry says was driven, by whomever."""
    amount: float = 0.0
    """What odometry says was done in this leg, as in ``Mission.done``."""


@dataclass(frozen=True, slots=True)
class Manoeuvre:
    """Describe a short way of its own that a leg makes because it is blocked."""

    rung: LadderRung
    goal: Pose2
    way: Way
    until_s: float
    """When it ends anyhow."""
    begun_m: float
    """Of ``metres``, when it began."""
    part: int = 0
    """Of the rung's turns."""
    heading_rad: float = 0.0
    """The robot's in ``map``, when the rung began."""
    stays: bool = False
    """It stands where somebody can pass already: its own way goes on once that is free."""
    is_early: bool = False
    """Nothing held the leg when it was asked for."""


@dataclass(frozen=True, slots=True)
class RouteDoubt:
    """Remember that the route search saw a leg's way closed, and what came of it."""

    leg: int
    """The leg whose way is doubted, or was bent."""
    at_m: tuple[float, float]
    """Where the way is closed, in ``map``."""
    since_s: float
    seen_s: float
    code: str
    """``route_doubted``, ``route_kept``, ``route_kept_shorter``, ``route_bent`` or
    ``route_keeps_right``."""


@dataclass(frozen=True, slots=True)
class LegDoubts:
    """Hold what a leg by route doubts of its way, and when it was last looked after."""

    newest: RouteDoubt | None = None
    searched_s: float = float("-inf")
    """When a way round was searched last because of a doubt."""
    right_searched_s: float = float("-inf")
    """When a way on the right was searched last."""
    met_s: float = float("-inf")
    """When somebody was last seen to come towards the robot."""
    made_way_s: float = float("-inf")
    """When it was last decided who makes way."""
    closed_in_s: float = float("-inf")
    """When another robot was last about to touch this one, as both went on."""
    bends: int = 0
    """Ways taken because the one before was doubted."""


class RoutePurpose(StrEnum):
    """Name what a way is searched for."""

    LEG = "leg"
    """The leg's own way."""
    DETOUR = "detour"
    """Round what the lidar sees."""
    DOUBT = "doubt"
    """Round what the route search remembers; without one the leg goes on."""
    KEEP_RIGHT = "keep_right"
    """With room for somebody who comes; without one the leg goes on."""
    EXPLORE = "explore"
    """To say whether to look from elsewhere; without an answer the leg goes on."""


@dataclass(frozen=True, kw_only=True)
class LegRoutes:
    """Hold the way of a leg: the one that is streamed, the one that is searched, and the tries."""

    leg: int | None = None
    """The leg that is streamed; None: stand."""
    ticket: int | None = None
    """The route that is being searched."""
    purpose: RoutePurpose = RoutePurpose.LEG
    """Of the newest search."""
    route_when_standing: bool = False
    retry_s: float | None = None
    """When the next try is due after a failed route."""
    routes: int = 0
    """Routes asked for in this step because one was lost or refused, not because of obstacles."""
    detours_failed: int = 0
    detours: int = 0
    explore_asked_s: float = float("-inf")
    """When it was asked last whether to look from elsewhere."""
    doubts: LegDoubts = LegDoubts()


@dataclass(frozen=True, kw_only=True)
class LegHolds:
    """Hold since when something keeps a leg from going on."""

    rung_since_s: float | None = None
    """Since when the rung of the recovery ladder that is next has been waited for."""
    occupied_since_s: float | None = None
    """Since when something stands where the leg is to end."""
    row_since_s: float | None = None
    """Since when a row of the bridge, or what stands in the way, holds the robot."""
    blocked_since_s: float | None = None
    refused_since_s: float | None = None
    idle_since_s: float | None = None
    jumped: bool = False
    """The pose jumped, and no new leg has begun since."""


@dataclass(frozen=True, kw_only=True)
class LegPace:
    """Hold how a leg is driven, as the statuses tell."""

    moving_s: float = 0.0
    """Time for which the leg was followed and nothing held it."""
    left_m: float | None = None
    """Along the path, as of the newest status."""
    limited: dict[str, int] = field(default_factory=dict)
    """Statuses during which the bridge's limit of that name was the nearest one."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Driving(_StepActivity, LegRoutes, LegHolds, LegPace):
    """Drive one leg to a goal: its route is searched, streamed, lost and searched again.

    Each idea is a record, which is all that many a function takes.
    """

    act: DriveLeg
    """What the skill asked for last: the goal, the way, the budget and what is remembered."""
    since_s: float
    """When this leg began: the step's time is counted from here."""
    asked_s: float
    """When the skill was asked last."""
    manoeuvre: Manoeuvre | None = None
    """The leg's own way waits until this is done."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Retrying(_StepActivity):
    """Stand, and ask the skill again soon: it had nothing to do yet, or its way was shut."""

    retry_s: float
    """When it is asked."""
    since_s: float | None = None
    """From when the step's time is counted; None: not at all."""
    row_since_s: float | None = None
    """Since when a row of the bridge holds the robot."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Observing(_StepActivity):
    """Stand and take pictures in."""

    act: Observe
    since_s: float
    asked_s: float
    """When the skill was asked last."""
    until_s: float
    """When this ends anyhow."""
    look_seq: int = -1
    """The newest picture that was counted."""
    looked: int = 0
    """Pictures that were counted."""
    standing_s: float | None = None
    """Since when the robot stands and pictures count."""


@dataclass(frozen=True, slots=True, kw_only=True)
class AwaitingAnswer(_StepActivity):
    """Stand until somebody has answered."""

    ticket: int
    """The question whose answer is waited for."""
    until_s: float
    """When the wait ends without one."""


@dataclass(frozen=True, slots=True, kw_only=True)
class AskingImage(AwaitingAnswer):
    """Stand until a question about the picture is answered."""

    act: AskImage
    since_s: float


@dataclass(frozen=True, slots=True, kw_only=True)
class LookingUp(AwaitingAnswer):
    """Stand until memory has answered."""


@dataclass(frozen=True, slots=True, kw_only=True)
class CallingTool(AwaitingAnswer):
    """Stand until a tool has answered; it is asked once the step's beginning is on disk."""

    agreed: bool
    is_sent: bool = False


@dataclass(frozen=True, slots=True, kw_only=True)
class Waiting(_StepActivity):
    """Stand until a time."""

    until_s: float


@dataclass(frozen=True, slots=True, kw_only=True)
class Speaking(_StepActivity):
    """Say the step's words as soon as its beginning is on disk."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Asking(_StepActivity):
    """Ask a person as soon as the step's beginning is on disk."""

    question: Bilingual
    aloud: bool = True
    """The question is spoken; False where it was perhaps spoken before."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Thinking(_StepActivity):
    """Stand while the brain thinks again."""


Activity = (
    Driving
    | Retrying
    | Observing
    | AskingImage
    | LookingUp
    | CallingTool
    | Waiting
    | Speaking
    | Asking
    | Thinking
)
TIMED = (Driving, Retrying, Observing, AskingImage)
"""Activities whose time and way are counted against the step's budget."""
