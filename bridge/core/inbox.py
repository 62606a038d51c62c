"""Hold the messages since the last tick, parsed. All of them may be late, wrong or hostile.

The time of receipt of everything in here is the ``now_s`` of the step that is given it. Whether a
proof's HMAC fits was judged where the bytes were read, so that no key ever reaches the core or a
recording; whether its nonce still counts is judged in the core.
"""

from __future__ import annotations

from dataclasses import dataclass

from wire import (
    DecodeFailure,
    DriveState,
    EstopLink,
    Grant,
    Heartbeat,
    Hello,
    Imu,
    Localization,
    OpKind,
    OpRequest,
    Scan,
    Stop,
    Velocity,
    Waypoints,
)
from wire.value import value


@dataclass(frozen=True, slots=True)
class OperatorArrival:
    """Give an operator's request, the key it came by, and whether its proof's HMAC fits."""

    kind: OpKind
    request: OpRequest
    authentic: bool


@dataclass(frozen=True, slots=True)
class RejectedAt:
    """Tell that bytes on a key did not become a message, by the key's path (``cmd/waypoints``)."""

    key: str
    why: DecodeFailure


@value
class ArrivedAt:
    """Count all payloads that came on one command key, parsed or not, for the flood detector."""

    key: str
    count: int


@value
class LoopFacts:
    """Hold the shell's measurements of its own loop; the core cannot look at a clock."""

    late_s: float = 0.0
    """How long after its time this tick started."""
    missed_ticks: int = 0
    """Whole periods skipped just before this tick."""
    late_p50_us: float = 0.0
    late_max_us: float = 0.0
    step_max_us: float = 0.0
    record_gaps: int = 0


ON_TIME = LoopFacts()


@value
class Inbox:
    """Give one tick's arrivals. Tuples are in order of arrival, oldest first."""

    stops: tuple[Stop, ...] = ()
    ops: tuple[OperatorArrival, ...] = ()
    hellos: tuple[Hello, ...] = ()
    grants: tuple[Grant, ...] = ()
    heartbeats: tuple[Heartbeat, ...] = ()
    localization: Localization | None = None
    teleop: tuple[Velocity, ...] = ()
    external: tuple[Velocity, ...] = ()
    waypoints: tuple[Waypoints, ...] = ()
    drive: tuple[DriveState, ...] = ()
    scan: Scan | None = None
    imu: Imu | None = None
    estop_link: EstopLink | None = None
    fences: tuple[FenceArrival, ...] = ()
    fence_done: FenceDone | None = None
    """What became of the fence that the core asked for."""
    marks: tuple[FenceArrival, ...] = ()
    marks_done: FenceDone | None = None
    """What became of the marks that the core asked for."""
    rejected: tuple[RejectedAt, ...] = ()
    arrived: tuple[ArrivedAt, ...] = ()
    loop: LoopFacts = ON_TIME
    real_time: bool = False
    """Scheduling and memory rights were granted as asked."""
    recorder_ok: bool = False
    recorder_says: str = ""
    """Why it takes no records: code, colon, sentence."""
    sensors_same_host: bool = True
    """Drive, lidar and IMU stamp with this host's monotonic clock: stamps may age them further."""
    localization_same_host: bool = True
    chance: str = ""
    """16 hex digits that the shell drew for this tick alone, after all in here had arrived: what a
    nonce made in this tick is made of. By the time it is recorded it can't be foretold any more."""


EMPTY = Inbox()


@value
class FenceArrival:
    """Give an operator's request for a fence or for marks, and whether its proof binds the text."""

    id: str
    source: str
    nonce: str | None
    authentic: bool
    text: str
    """Empty where the proof does not fit: nobody looks at it."""


@value
class FenceDone:
    """Report the end of a request: ``ok`` with both hashes, or why fence or marks can't be."""

    id: str
    code: str
    detail: str
