"""Define the bridge's status and events: the only word on the robot's real state."""

from __future__ import annotations

from enum import StrEnum
from typing import Annotated

from pydantic import Field

from wire.base import Record
from wire.bounded_types import (
    Code,
    Count,
    Epoch,
    Fingerprint,
    Length,
    Name,
    Ratio,
    RowName,
    Seconds,
    Text,
)
from wire.commands import OwnerKind
from wire.geometry import Pose2, Twist2


class Mode(StrEnum):
    """Name the bridge's modes."""

    BOOT = "BOOT"
    SELFTEST = "SELFTEST"
    DISARMED = "DISARMED"
    HOLD = "HOLD"
    ACTIVE = "ACTIVE"
    TELEOP = "TELEOP"
    STOPPING = "STOPPING"
    ESTOPPED = "ESTOPPED"
    FAULT = "FAULT"


class Action(StrEnum):
    """Name a row's actions, mildest first."""

    NONE = "NONE"
    CAP = "CAP"
    HOLD2 = "HOLD2"
    STOP1 = "STOP1"
    FAST1 = "FAST1"
    CUT0 = "CUT0"


SEVERITY = {action: rank for rank, action in enumerate(Action)}


class HeldReason(StrEnum):
    """Say why every grant is refused until a person acts."""

    STOP = "stop"
    TELEOP = "teleop"
    NEW_PLANNER = "planner_restarted"
    FAULT = "fault"


class StandingHold(Record):
    """Stand until arm or resume."""

    reason: HeldReason
    id: Name


class Owner(Record):
    """Name the owner, the one that may send waypoints or external velocities."""

    planner_id: Name
    kind: OwnerKind


class GrantLeft(Record):
    """Show the bridge's remainder for the mission granted in this epoch."""

    mission: Name
    metres: Length
    seconds: Seconds


class LegReport(Record):
    """Tell how far the leg is; ``reached`` is latched for this leg, decided standing."""

    mission: Name
    leg: Count
    following: bool
    reached: bool
    residual_m: Length
    residual_rad: Annotated[float, Field(ge=0.0, le=7.0)]
    refusal: Code | None
    """Why the newest horizon of this leg was not taken, if it was not."""


class RowReport(Record):
    """Show one row that is up, and its evidence."""

    row: RowName
    action: Action
    for_s: Seconds
    evidence: Text
    binding: bool
    """False: shown only, because its source does not move the robot."""


class Answer(Record):
    """Echo one request with its verdict, so that the sender can fall silent."""

    id: Name
    kind: Code
    accepted: bool
    code: Code
    detail: Text


class LimitsInForce(Record):
    """Give the bounds on the command now, and which one is nearest."""

    v_mps: Annotated[float, Field(ge=0.0, le=10.0)]
    w_radps: Annotated[float, Field(ge=0.0, le=20.0)]
    by: Code
    """Row, gate or robot.toml's limit that sets it, in lower case."""
    free_m: Length | None
    """Free length along the arc asked for; null without a lidar."""
    margin_m: float | None = Field(default=None, ge=-100_000.0, le=100_000.0)
    """Free length less the stopping distance at the speed sent."""


class BrakingReport(Record):
    """Report the braking that gates count on: robot.toml's, or worse where learnt."""

    lag_s: Annotated[float, Field(ge=0.0, le=2.0)]
    decel_mps2: Annotated[float, Field(ge=0.0, le=10.0)]
    learnt: bool
    """False: both as robot.toml says."""
    stops: Count
    """How many stops have taught anything, since this robot.toml."""
    trouble: Code | None
    """Why what earlier runs learnt could not be read."""


class TickStats(Record):
    """Summarise the loop since start, and its last second."""

    ticks: Count
    missed: Count
    late_p50_us: Annotated[float, Field(ge=0.0, le=1e9)]
    late_max_us: Annotated[float, Field(ge=0.0, le=1e9)]
    step_max_us: Annotated[float, Field(ge=0.0, le=1e9)]
    dropped: Count
    """Messages dropped since start, whatever the reason."""
    record_gaps: Count


class DriveReport(Record):
    """Describe the drive as the bridge knows it."""

    kind: Name
    virtual: bool
    enabled: bool
    timed_out: bool | None
    """Null: the drive does not report it."""
    boot_id: Name | None
    battery: Ratio | None
    real_time: bool
    """Scheduling and memory rights were granted as asked."""


class Status(Record):
    """Say everything that others may rely on."""

    protocol: Count
    robot: Name
    boot: Name
    seq: Count
    at_s: Seconds
    """Monotonic time of this host; display and tests only."""
    mode: Mode
    action: Action
    epoch: Epoch
    nonce: Name
    owner: Owner | None
    held: StandingHold | None
    grant: GrantLeft | None
    leg: LegReport | None
    base_in_odom: Pose2
    base_in_map: Pose2 | None
    asked: Twist2
    sent: Twist2
    measured: Twist2
    limits: LimitsInForce
    rows: tuple[RowReport, ...]
    answers: tuple[Answer, ...]
    waiting_for: tuple[Code, ...]
    """What SELFTEST or arming still lacks."""
    blocked: bool
    robot_hash: Fingerprint
    fence_hash: Fingerprint
    marks_hash: Fingerprint | None = None
    """Of the marks in force, set by the bridge for the planner; None: there are none."""
    map_id: Fingerprint | None
    operator_metres: Length
    """What is left of the distance allowed since the last operator act."""
    operator_seconds: Seconds
    drive: DriveReport
    braking: BrakingReport
    ticks: TickStats


class Event(Record):
    """Record one transition or refusal, once, for people and logs. Never relied upon."""

    boot: Name
    seq: Count
    tick: Count
    at_s: Seconds
    code: Code
    mode: Mode
    detail: Text
