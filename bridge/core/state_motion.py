"""Hold the core's memory of motion: requests and commands, the stop in progress, brakes.

Records only; the laws that fill them stand in :mod:`bridge.core.motion` and in
:mod:`bridge.core.modes`.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from enum import StrEnum
from typing import Annotated, ClassVar

from pydantic import ConfigDict, Field

from wire import Action
from wire.geometry import STILL, Twist2
from wire.value import value

MOST_LAG_S = 0.5
"""Nothing later is believed: robot.toml's own bound on a drive's lag."""
LEAST_SHARE = 0.1
MOST_STOPS = 10**9
WEAK_SHARE = 0.5
"""Of robot.toml's deceleration: brakes weaker than this lower the speed limits, too."""
_Share = Annotated[float, Field(ge=LEAST_SHARE, le=1.0)]
_Lag = Annotated[float, Field(ge=0.0, le=MOST_LAG_S)]
_Speed = Annotated[float, Field(ge=0.0, le=100.0)]
_Few = Annotated[int, Field(ge=0, le=1_000)]


@value
class Braking:
    """Say how much worse than robot.toml the robot brakes, as its own stops have shown."""

    lag_more_s: float = 0.0
    """Lag beyond ``drive.lag_s``."""
    decel_share: float = 1.0
    """Deceleration as a share of ``limits.max_decel_mps2``, in (0, 1]."""


AS_CONFIGURED = Braking()


@value
class Learnt:
    """Say how much worse than robot.toml this robot brakes. The bounds know nothing better."""

    lag_more_s: _Lag = 0.0
    """Lag beyond ``drive.lag_s``."""
    decel_share: _Share = 1.0
    """Deceleration as a share of ``limits.max_decel_mps2``."""
    lag_at_mps: _Speed = 0.0
    """The speed of the stop that taught the lag; only stops from nearly there can unlearn it."""
    share_at_mps: _Speed = 0.0
    lag_better: _Few = 0
    """Better stops in a row."""
    lag_worst_s: _Lag = 0.0
    """The worst of those."""
    share_better: _Few = 0
    share_worst: _Share = 1.0
    stops: Annotated[int, Field(ge=0, le=MOST_STOPS)] = 0
    """Stops that taught anything, since this robot.toml."""
    __pydantic_config__: ClassVar[ConfigDict] = ConfigDict(extra="forbid", allow_inf_nan=False)

    def in_force(self) -> Braking:
        """Return the braking that gates may count on."""
        if self.lag_more_s == 0.0 and self.decel_share == 1.0:
            return AS_CONFIGURED
        return Braking(self.lag_more_s, self.decel_share)

    def speed_share(self) -> float:
        """Return the factor on the limits that weak brakes leave; 1 where they are not weak.

        With the same share of speed as of deceleration a stop takes as long as robot.toml plans, so
        that "too slow" and "too long" go on judging it by the plan.
        """
        return 1.0 if self.decel_share >= WEAK_SHARE else self.decel_share


UNLEARNT = Learnt()


@value
class Ramp:
    """Follow one ramp towards standstill. Speeds are those of the faster rim [m/s]."""

    since_s: float
    from_mps: float
    """What was sent when it began."""
    real_from_mps: float
    sent_mps: float
    """The newest."""
    real_mps: float
    sent_m: float = 0.0
    """Path since it began, of what was sent and of what was measured."""
    real_m: float = 0.0
    rise_mps: float = 0.0
    """How much it rose in between, added up."""
    sent_high_s: float | None = None
    """When each fell to three quarters and to one quarter of ``from_mps``."""
    sent_low_s: float | None = None
    real_high_s: float | None = None
    real_low_s: float | None = None


_Accel = Annotated[float, Field(ge=-1e6, le=1e6)]


class Profile(StrEnum):
    """Say how the output may move."""

    NORMAL = "NORMAL"
    """Follow the target."""
    STOP = "STOP"
    """Ramp to zero with the ordinary deceleration, whatever the target."""
    FASTEST = "FASTEST"
    """Ramp to zero with the hardest deceleration and no jerk limit, whatever the target."""


@value
class LimiterState:
    """Remember the twist sent last, and how each wheel's speed was changing [m/s2]."""

    sent: Twist2 = STILL
    left_mps2: _Accel = 0.0
    right_mps2: _Accel = 0.0
    __pydantic_config__: ClassVar[ConfigDict] = ConfigDict(extra="forbid", allow_inf_nan=False)


@value
class Wheel:
    """Remember one wheel's control between two ticks."""

    integral: float = 0.0
    """What has been learnt of this motor since it began to turn, as a share of the bound, with the
    sign of the speed meant: +0.5 is half of what may be added. So it shrinks with the speed."""
    push: float = 0.0
    """Proportional and integral part of the newest reading together, likewise."""
    expected_radps: float = 0.0
    """What the motor of the description turns at when this tick's command has worked."""
    due_radps: float = 0.0
    """That of the tick before: what the newest reading should show."""
    told_radps: float = 0.0
    doubt_s: float = 0.0
    """How long readings have been further off than any motor explains; DOUBT_S stays."""


AT_REST = Wheel()


@value
class FollowState:
    """Remember how far along one path the robot is.

    A new leg begins with :data:`NEW`; the next horizon of a leg goes on with what was learnt.
    """

    along_m: float = 0.0
    turning: bool = False
    settled: bool = False
    """The place is as good as it gets; only a heading may be left."""
    heading_done: bool = False
    tries: int = 0
    __pydantic_config__: ClassVar[ConfigDict] = ConfigDict(extra="forbid", allow_inf_nan=False)


NEW = FollowState()


_Part = Annotated[float, Field(ge=0.0, le=1e6)]


@dataclass(frozen=True, slots=True)
class StopPlan:
    """Hold a stop: deceleration rises from ``first`` to ``peak``, stays, and fades to nothing.

    Speeds are those of the faster rim [m/s]; both wheels keep their ratio all the way down.
    """

    start: Twist2
    rim_mps: _Part
    first_mps2: _Part
    peak_mps2: _Part
    rise_s: _Part
    flat_s: _Part
    fall_s: _Part
    __pydantic_config__: ClassVar[ConfigDict] = ConfigDict(extra="forbid", allow_inf_nan=False)

    @property
    def duration_s(self) -> float:
        """Return how long the ramp lasts, without any lag of the drive."""
        return self.rise_s + self.flat_s + self.fall_s


NO_STOP = StopPlan(STILL, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0)


def profile_of(action: Action) -> Profile:
    """Return the ramp that an action means."""
    return Profile.FASTEST if action is Action.FAST1 else Profile.STOP


@dataclass(frozen=True, slots=True)
class Stopping:
    """Remember the stop in progress, to judge whether the robot really slows down."""

    action: Action
    """What it ends in: HOLD2 keeps torque, STOP1 and FAST1 take it away."""
    cause: str
    since_s: float
    plan: StopPlan
    source: str
    """Who moved the robot: may go on when a HOLD2 clears, if it was W or X."""
    resumes: bool
    """False where a person asked for it."""
    reset_needed: bool = False
    slow_s: float = 0.0
    """How full the window is in which it is measured to be too slow."""


@dataclass(frozen=True, slots=True)
class Gate:
    """Remember how the gates for obstacle, fence and contact shut the way."""

    shut_since_s: float | None = None
    """Since when the way asked for is shut, without a gap; None while it is not."""
    shut_s: float = 0.0
    """How full the window is in which it is shut and the robot has not turned away from it."""
    shut_yaw_rad: float = 0.0
    """Heading in ``odom`` when that window began to fill."""
    blocked: bool = False
    by: str = "obstacle"
    """Which gate left nothing of the way when it was called blocked: obstacle, fence, contact."""
    free_scans: int = 0
    judged_scan: int = -1


@dataclass(slots=True)
class Motion:
    """Remember the requested and the sent twists."""

    asked: Twist2 = STILL
    """What the source in charge wants, before gates and limits."""
    limiter: LimiterState = field(default_factory=LimiterState)
    """Its ``sent`` is what was meant last: what wheel control adds to it is not in there."""
    turns_out: bool = False
    """Before a blind sector its owner asks for a turn on the spot, which leads out of the hold."""
    left: Wheel = AT_REST
    right: Wheel = AT_REST
    powered: bool = False
    follow: FollowState = NEW
    bound_by: str = "robot"
    """What set the nearest bound, for the status."""
    cap: float = 1.0
    free_m: float | None = None
    margin_m: float | None = None

    def forget_sent(self) -> None:
        """Begin at rest when torque comes back: a twist sent before it went is no speed now."""
        self.limiter = LimiterState()
