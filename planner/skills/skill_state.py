"""Define what each skill that looks or asks remembers of its step: one frozen record a skill.

Journalled, so that a crash forgets nothing: what was looked at stays looked at, across pauses and
crashes. Times are those of the step itself, so that no clock of a process that is gone comes back.
Data only. A skill that is not in ``STATES`` remembers nothing: its step's record says enough.
"""

from __future__ import annotations

from collections.abc import Mapping
from enum import StrEnum
from types import MappingProxyType
from typing import Annotated, Any, Literal, Self, get_args

from pydantic import Field

from planner.plan import Bilingual, Frozen, PatrolSighting

Point3 = tuple[float, float, float]
"""x, y, height [m] in ``map``."""


class SkillStateBase(Frozen):
    """Be the base of what a skill remembers."""

    def but(self, **changes: Any) -> Self:
        """Return this state with changes.

        Raises:
            TypeError: this skill remembers no such thing.
        """
        foreign = changes.keys() - type(self).model_fields.keys()
        if foreign:
            name = type(self).__name__
            known = ", ".join(sorted(type(self).model_fields))
            raise TypeError(f"{name} has no {', '.join(sorted(foreign))}; it has {known}")
        return self.model_copy(update=changes)


class LookRoundState(SkillStateBase):
    """Remember the spots and directions that were looked in."""

    spot: str | None = None
    """The spot that is looked round from now; its key."""
    views: tuple[int, ...] = ()
    """Directions of that spot that were looked in."""
    turned: int | None = None
    """The direction that was turned to and is to be looked in."""
    spots: tuple[str, ...] = ()
    """Spots that are over: looked round from, or not to be reached."""
    rooms: tuple[str, ...] = ()
    """Rooms that were looked round in."""
    missed: str | None = None
    """The spot to which the way turned out to be shut."""
    shut: tuple[str, ...] = ()
    """Rooms to which there was no way."""


class RoomTourState(LookRoundState):
    """Remember where a look through rooms began, and their order."""

    here: tuple[float, float] | None = None
    """Where the robot stood when it began to look: x [m], y [m] in ``map``."""
    order: tuple[str, ...] = ()
    """Rooms to look in, in their order, as of the beginning."""


class DirectionSeen(Frozen):
    """Hold what a vision model says of the picture of one direction: figures alone."""

    room: str | None
    spot: str
    """The spot's key."""
    view: int
    """The direction's number at that spot, counter-clockwise."""
    left: int
    middle: int
    right: int
    """Things whose middle is in that third of the picture."""
    sure: float
    """0 to 1."""

    @property
    def count(self) -> int:
        """Return how many there are."""
        return self.left + self.middle + self.right


class BoundedSearchState(RoomTourState):
    """Remember that its bounds have ended a search, and whether a person lets it go on."""

    out_of_metres: bool = False
    """The metres that were left did not last for the next way."""
    offered: bool = False
    """A person was asked whether to go on where the bounds had ended it."""
    longer: int = 0
    """Times that a person let it go on."""


class ModelSearchState(BoundedSearchState):
    """Remember the directions that a vision model was shown, and what that cost."""

    asking: bool = False
    """The direction gazed in last is to be asked about."""
    stood: tuple[float, float, float] | None = None
    """Where the robot stood then: x [m], y [m], yaw [rad] in ``map``."""
    seen: tuple[DirectionSeen, ...] = ()
    shown: int = 0
    """Pictures that went out."""
    tokens: int = 0
    money: float = 0.0
    failed: int = 0
    """Pictures in a row about which the model said nothing."""
    unanswered: int = 0
    """Directions about which it said nothing."""
    silent: str | None = None
    """Why it is asked no more: a code."""


class CountState(ModelSearchState):
    """Remember how far a count has come."""

    kind: Literal["count"] = "count"


class AimStage(StrEnum):
    """Say how far a second look at one thing has come."""

    CHOSEN = "chosen"
    NEAR = "near"
    """The robot stands where the thing can be seen."""
    FACING = "facing"


class SearchState(BoundedSearchState):
    """Remember the things that a search looks at again."""

    aim: str | None = None
    """The thing that is looked at again."""
    aim_stage: AimStage = AimStage.CHOSEN
    tried: tuple[str, ...] = ()
    """Things that were looked at again and were not what is wanted."""


class FindState(SearchState, ModelSearchState):
    """Remember how far a search has come."""

    kind: Literal["find"] = "find"


class LookStage(StrEnum):
    """Say what of a look is over."""

    GAZING = "gazing"
    GAZED = "gazed"
    """All was looked at that the question is about."""
    ASKED = "asked"
    """A vision model was asked, too."""


class LookState(RoomTourState):
    """Remember the directions of a look, in which pictures were taken."""

    kind: Literal["look"] = "look"
    stage: LookStage = LookStage.GAZING
    ahead: float | None = None
    """The heading in ``map`` that counts as ahead: how it stood when it looked first [rad]."""
    faced: tuple[float, ...] = ()
    """Directions that were gazed in, in their order: angles to the left of ahead [rad]."""


class FollowStage(StrEnum):
    """Say how the robot goes after somebody."""

    AFTER = "after"
    SHUT = "shut"
    """The way to them turned out to be shut; they are watched, standing."""
    ROUND = "round"
    """They are out of sight, and looked for all round."""


class FollowPersonState(LookRoundState):
    """Remember the person who is followed, and the ways to them that were shut."""

    kind: Literal["follow"] = "follow"
    stage: FollowStage = FollowStage.AFTER
    at: Point3 | None = None
    """Where the person is, as of when they were seen last."""
    seen_s: float = 0.0
    """When they were seen last, in time spent on the step."""
    label: str | None = None
    shut_at: tuple[float, float] | None = None
    """Where the robot stood when the way was shut: x [m], y [m] in ``map``."""
    shut_ways: int = 0
    """Ways that were shut from there, one after the other."""


class ApproachStage(StrEnum):
    """Say how far the way up to a thing has come."""

    DRIVE = "drive"
    FACE = "face"
    CHECK = "check"
    JUDGE = "judge"


class ApproachState(SkillStateBase):
    """Remember the thing or point that is driven up to."""

    at: Point3 | None = None
    """Where it is, as of when it was seen last; None: not known yet."""
    approach: ApproachStage = ApproachStage.DRIVE
    """Holds once ``at`` is known."""
    stand: int = 0
    """Standing points about it that can't be reached."""
    sure: float | None = None
    """How sure of the thing one was when the robot stood before it and began to look."""
    label: str | None = None
    color: str | None = None


class PointingStage(StrEnum):
    """Say how far a vision model and a person have come in agreeing on a point."""

    LOOK = "look"
    POINT = "point"
    """The model is to point."""
    ANSWER = "answer"
    """The model was asked."""
    PROPOSED = "proposed"
    """A person was asked."""
    AGAIN = "again"
    """A person was asked once more."""


class GoToObjectState(SearchState, ApproachState):
    """Remember the search for a thing, the point agreed on, and the way up to it."""

    kind: Literal["go_to_object"] = "go_to_object"
    pointing: PointingStage = PointingStage.LOOK
    pointed: Point3 | None = None
    """Where a vision model pointed: driven to by nobody's word but a person's."""
    again: int = 0
    """Times that the thing had moved and was gone after."""


class GoToPointState(ApproachState):
    """Remember whether the floor that was pointed at was reached."""

    kind: Literal["go_to_point"] = "go_to_point"
    reached: bool = False


class ExploreState(SkillStateBase):
    """Remember how far an exploration has come."""

    kind: Literal["explore"] = "explore"
    arrived: bool = False
    """The robot stands where it was to look from, and the map does not show yet what it saw."""
    shut_ways: int = 0
    """Ways to frontiers that were shut, one after the other."""
    turns: int = 0
    """Turns on the spot that are left of a look round."""
    looks: int = 0
    """Frontiers that were looked at."""
    known_m2: float = 0.0
    """Floor on the map."""
    explored: bool = False
    """No frontier is left."""


class AskStage(StrEnum):
    """Say what was done about an answer."""

    ASK = "ask"
    THOUGHT = "thought"
    """The answer is thought about."""
    AGAIN = "again"
    """It was asked once more."""


class AskState(SkillStateBase):
    """Remember an answer that let nothing go on."""

    kind: Literal["ask"] = "ask"
    stage: AskStage = AskStage.ASK
    heard: str | None = None
    """An answer that was neither yes nor no, after which was asked once more."""


class PatrolState(RoomTourState):
    """Remember the stops of a patrol that are over, and the look at the one where it stands."""

    kind: Literal["patrol"] = "patrol"
    stops: tuple[PatrolSighting, ...] = ()
    """In their order: looked round at, or passed over."""
    arrived_s: float | None = None
    """Since when it stands at the next one, in time spent on the step; None: it drives there."""


class StandAtState(SkillStateBase):
    """Remember the spots at a side of something, chosen once, and which of them are over."""

    kind: Literal["stand_at"] = "stand_at"
    name: Bilingual | None = None
    at: tuple[float, float] | None = None
    """The point of it that is faced: x [m], y [m] in ``map``; None: not chosen yet."""
    spots: tuple[tuple[float, float, float, float, float], ...] = ()
    """Pose (x, y, yaw) and the point that its distance counts from (x, y), each in ``map``."""
    tried: int = 0
    reached: bool = False


class WaitForState(SkillStateBase):
    """Remember until when is waited, and that a word was asked for."""

    kind: Literal["wait_for"] = "wait_for"
    until_unix_s: float | None = None
    """On people's clock: a wait for a time that has come while the goal was paused is over."""
    asked: int = 0
    """Times that somebody said something else than the word."""


class ToolState(SkillStateBase):
    """Remember the question before a call that writes, and that the call was perhaps made."""

    kind: Literal["use_tool"] = "use_tool"
    question: Bilingual | None = None
    is_again: bool = False
    """It was asked once more after an answer that was neither yes nor no."""
    is_sent: bool = False


_State = (
    AskState | CountState | ExploreState | FindState | FollowPersonState | GoToObjectState
    | GoToPointState | LookState | PatrolState | StandAtState | ToolState
    | WaitForState
)  # fmt: skip
SkillState = Annotated[_State, Field(discriminator="kind")]
STATES: Mapping[str, type[SkillStateBase]] = MappingProxyType(
    {variant.model_fields["kind"].default: variant for variant in get_args(_State)}
)
"""By the kind of step; the other kinds remember nothing."""


def begin_state(kind: str) -> SkillStateBase | None:
    """Return the state of a step of this kind that has not begun; None: it remembers nothing."""
    state = STATES.get(kind)
    return state() if state is not None else None
