"""Hold all that one tick hands to the next. Nothing else survives a tick, so a run can be replayed.

``draft`` copies the records that a step writes into; all others are frozen and replaced. All of it
is JSON without NaN or infinity: what is unknown is None.
"""

from __future__ import annotations

from dataclasses import dataclass, field, fields
from operator import attrgetter
from typing import TYPE_CHECKING, Any, TypeVar

from bridge.core.geometry.kinematics import OdometryState
from bridge.core.state_motion import (
    UNLEARNT,
    Gate,
    Learnt,
    Motion,
    Ramp,
    Stopping,
)
from bridge.core.state_orders import (
    External,
    Grants,
    LegMemory,
    Marks,
    Operator,
    Ownership,
    PendingFence,
    Stick,
)
from bridge.core.state_senses import (
    ButtonMemory,
    DetectorMemory,
    DriveMemory,
    Flood,
    LidarMemory,
    LoopMemory,
    PoseMemory,
)
from wire import Mode, Pose2, StandingHold
from wire.value import value

if TYPE_CHECKING:
    from collections.abc import Callable

R = TypeVar("R")


@dataclass(frozen=True, slots=True)
class RowUp:
    """Keep one stage of one row that is up."""

    since_s: float
    dirty_s: float
    """Newest time at which its detector saw the trouble."""
    evidence: str


@dataclass(frozen=True, slots=True)
class SelfTest:
    """Remember how far the self test got."""

    phase: str = "echo"
    """echo -> withhold -> return -> done."""
    since_s: float = 0.0
    passed: bool = False


@value
class Voice:
    """Remember the messages said last, and when."""

    status_seq: int = 0
    ring: tuple[float, ...] = ()
    """Sending times of the last 256 statuses; the newest is ``status_seq``."""
    event_seq: int = 0
    odom_seq: int = 0
    dropped: int = 0
    status_s: float | None = None
    pending: bool = False
    """Something that must be told at once is not yet told: at most 40 statuses a second."""


@dataclass(slots=True)
class BridgeState:
    """Hold the bridge between two ticks. Written only inside ``step``, and there only in a copy."""

    now_s: float
    tick: int = 0
    command_seq: int = 0
    started_s: float = 0.0
    mode: Mode = Mode.BOOT
    mode_since_s: float = 0.0
    epoch_no: int = 1
    held: StandingHold | None = None
    source: str = ""
    """Who moves the robot: W waypoints, X external, T teleop, or nobody."""
    waits_since_s: float | None = None
    """Since when a granted mission stands in HOLD because of a row or an obstacle."""
    bad_bucket: float = 0.0
    rows: dict[str, RowUp] = field(default_factory=dict)
    """Stages that are up, by name; never written to, replaced when one rises or clears."""
    odometry: OdometryState = field(default_factory=OdometryState)
    trail: tuple[tuple[float, Pose2], ...] = ()
    """When and where the robot was in the last readings, to place a scan where it was taken."""
    drive: DriveMemory = field(default_factory=DriveMemory)
    lidar: LidarMemory = field(default_factory=LidarMemory)
    pose: PoseMemory = field(default_factory=PoseMemory)
    buttons: ButtonMemory = field(default_factory=ButtonMemory)
    loop: LoopMemory = field(default_factory=LoopMemory)
    ownership: Ownership = field(default_factory=Ownership)
    grants: Grants = field(default_factory=Grants)
    operator: Operator = field(default_factory=Operator)
    leg: LegMemory = field(default_factory=LegMemory)
    stick: Stick = field(default_factory=Stick)
    external: External | None = None
    stopping: Stopping | None = None
    fault: str | None = None
    """Why FAULT: row, or code of the self test or of the stop that was too slow."""
    selftest: SelfTest = field(default_factory=SelfTest)
    gate: Gate = field(default_factory=Gate)
    motion: Motion = field(default_factory=Motion)
    watch: DetectorMemory = field(default_factory=DetectorMemory)
    flood: Flood = field(default_factory=Flood)
    voice: Voice = field(default_factory=Voice)
    learnt: Learnt = UNLEARNT
    """How much worse than robot.toml this robot brakes; a run begins with what others learnt."""
    fence_asked: PendingFence | None = None
    marks: Marks = field(default_factory=Marks)
    braking_trouble: str | None = None
    """Why what others learnt could not be read."""
    ramp: Ramp | None = None
    """The ramp towards standstill that it is learning from."""

    def sources(self) -> str:
        """Return the letters of the sources that move the robot or hold a grant."""
        owner = self.ownership.owner
        if self.grants.mission is None or owner is None:
            return self.source
        return self.source + ("W" if owner.kind == "planner" else "X")


def copier(cls: type[R]) -> Callable[[R], R]:
    """Return a function that makes a shallow copy of a dataclass of at least two fields.

    Most of the state is frozen and replaced when something arrives, which is rare. The records that
    change every tick are plain slotted dataclasses, copied once per tick: copying costs 1 us, a
    ``dataclasses.replace`` of the same size 4 us. A test holds the promise that the state given to
    ``step`` is unchanged afterwards.
    """
    take = attrgetter(*(one.name for one in fields(cls)))  # type: ignore[arg-type]  # R is a dataclass

    def copy(record: Any) -> R:
        return cls(*take(record))

    return copy


_copy_state = copier(BridgeState)
_copy_drive = copier(DriveMemory)
_copy_motion = copier(Motion)
_copy_watch = copier(DetectorMemory)


def draft(state: BridgeState) -> BridgeState:
    """Return a copy that may be written to without changing the argument."""
    copy = _copy_state(state)
    copy.drive = _copy_drive(state.drive)
    copy.motion = _copy_motion(state.motion)
    copy.watch = _copy_watch(state.watch)
    return copy
