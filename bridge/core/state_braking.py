"""Hold what the core knows of this robot's brakes, and the ramp that it is learning from."""

from __future__ import annotations

from typing import Annotated, ClassVar

from pydantic import ConfigDict, Field

from wire.value import value

MOST_LAG_S = 0.5
"""Nothing later is believed: robot.toml's own bound on a drive's lag."""
LEAST_SHARE = 0.1
MOST_STOPS = 10**9
_Share = Annotated[float, Field(ge=LEAST_SHARE, le=1.0)]
_Lag = Annotated[float, Field(ge=0.0, le=MOST_LAG_S)]
_Speed = Annotated[float, Field(ge=0.0, le=100.0)]
_Few = Annotated[int, Field(ge=0, le=1_000)]


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
