"""Define what planner and ROS 2 process tell each other: Nav2's goals, and what RViz may show.

``nav2/goal`` is a level: the planner repeats on each status where Nav2 is to go, or that it is to
go nowhere, and its silence means nowhere. ``nav2/state`` says what became of that goal, and Nav2's
newest twist, which moves the robot only where the planner says it to the bridge (docs/ros2.md).
``plan/view`` is for people to look at, and moves nothing.
"""

from __future__ import annotations

from typing import Annotated, Final, Literal

from pydantic import Field

from wire.base import Record
from wire.bounded_types import Code, Count, Name, Seconds, Text
from wire.geometry import MAX_SPEED_MPS, MAX_TURN_RADPS, Metres, Pose2

UNASKED_S: Final = 0.5
"""A planner that says nothing for so long wants nothing; it speaks twenty times a second."""
MAX_SHOWN: Final = 256
"""Points of a way, and places."""
Nav2Phase = Literal["idle", "sent", "driving", "succeeded", "aborted", "cancelled"]
"""``sent``: published, and Nav2 has not named a goal of its own for it yet."""


class Nav2Goal(Record):
    """Say where Nav2 is to bring the robot now; no goal: it is to end what it does."""

    planner_id: Name
    seen: Count
    """The status on which this was said."""
    mission: Name | None
    leg: Count
    goal: Pose2 | None
    """In ``map``."""
    here: Pose2 | None
    """The robot in ``map``: where Nav2 is sent in place of a goal that nobody wants any more."""


class Nav2State(Record):
    """Say what became of the newest goal, and what Nav2 asks of the wheels."""

    boot_id: Name
    seq: Count
    mission: Name | None
    leg: Count
    phase: Nav2Phase
    phase_s: Seconds
    """For so long it has been so."""
    twist: Count
    """Number of the newest twist; 0: none came."""
    twist_age_s: Seconds
    v_mps: Annotated[float, Field(ge=-MAX_SPEED_MPS, le=MAX_SPEED_MPS)]
    w_radps: Annotated[float, Field(ge=-MAX_TURN_RADPS, le=MAX_TURN_RADPS)]
    code: Code | None
    """What keeps Nav2 from being heard."""
    detail: Text


class PlaceView(Record):
    """Name a place where it is in ``map``."""

    name: Annotated[str, Field(max_length=64)]
    x_m: Metres
    y_m: Metres


class PlanView(Record):
    """Say what the robot is about, for people who look at it with the tools of ROS."""

    seq: Count
    mode: Name
    """Of the bridge."""
    held: Text
    """What holds the robot; empty where nothing does."""
    mission: Name | None
    path: Annotated[tuple[tuple[Metres, Metres], ...], Field(max_length=MAX_SHOWN)]
    """The way of the leg that is driven, in ``map`` [m]; empty while standing is wanted."""
    places: Annotated[tuple[PlaceView, ...], Field(max_length=MAX_SHOWN)]
