"""Define what a skill is told and what it may ask for. Data only: no book, no bridge, no clock.

A skill is a pure function of a :class:`Scene`: asked when its step begins, after each leg of it was
reached, and again after a pause or a crash. It answers with one act; the mission carries it out.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from enum import StrEnum
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from planner.mission.records import Facts
    from planner.plan import Bilingual, Code, StepRecord
    from wire import Pose2


class Way(StrEnum):
    """How a leg gets to its goal."""

    ROUTE = "route"
    """By the search, round what stands in the way."""
    STRAIGHT = "straight"
    """Straight along the heading, ahead or backwards, or not at all."""
    SPIN = "spin"
    """On the spot: the bridge turns to the heading by the shorter way."""


@dataclass(frozen=True, slots=True)
class Scene:
    """Tell a skill where its step stands."""

    step: StepRecord
    facts: Facts
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


@dataclass(frozen=True, slots=True)
class Drive:
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


@dataclass(frozen=True, slots=True)
class Stand:
    """Stand for a while [s]."""

    seconds: float


@dataclass(frozen=True, slots=True)
class Speak:
    """Say words, at most once."""

    text: str


@dataclass(frozen=True, slots=True)
class Question:
    """Ask a person, standing, and wait for the answer."""

    text: str


@dataclass(frozen=True, slots=True)
class Think:
    """Have the brain think again with what was seen and heard."""


@dataclass(frozen=True, slots=True)
class Later:
    """Wait, standing, until the robot knows where it is."""


@dataclass(frozen=True, slots=True)
class Done:
    """End the step well; ``figures`` go into its record."""

    figures: dict[str, Any] = field(default_factory=dict)


@dataclass(frozen=True, slots=True)
class Skip:
    """Leave the step out, for a reason."""

    reason: str


@dataclass(frozen=True, slots=True)
class Cannot:
    """End the step without success: a precondition does not hold, or odometry disagrees."""

    code: Code
    reason: str
    said: Bilingual | None = None
    """The sentence for people where the code's own would not do."""
    figures: dict[str, Any] = field(default_factory=dict)


Act = Drive | Stand | Speak | Question | Think | Later | Done | Skip | Cannot
