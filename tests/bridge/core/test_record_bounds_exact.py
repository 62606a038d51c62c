"""Hold the bounds of what is written down and read back: each bound fits, the next number not.

Learnt brakes come from a file and a recording's state from anywhere; what is no number is refused
as such, not for a bound that it happens to miss.
"""

from __future__ import annotations

from functools import lru_cache
from math import inf, nan, nextafter

import pytest
from pydantic import TypeAdapter, ValidationError

from bridge.core.geometry.kinematics import STOPPED, WheelSpeeds
from bridge.core.geometry.lidar_scan import ScanPicture
from bridge.core.geometry.odometry import OdometryState
from bridge.core.geometry.path_profile import Path
from bridge.core.motion.free_distance import NOTHING_KNOWN, FreeLength
from bridge.core.motion.obstacle_gate import ObstaclePass
from bridge.core.state_motion import NO_STOP, UNLEARNT, FollowState, Learnt, LimiterState, StopPlan
from tests.bridge.core.reached import reached
from tests.bridge.core.table import table
from wire import STILL

kinds_of = lru_cache(TypeAdapter)
"""Made once each: a millisecond or ten."""


def refused_as(cls: type, record: object, **changed: object) -> str:
    """Return the kind of error that a record with this field is refused by; none: it is read."""
    kinds = kinds_of(cls)
    fields = kinds.dump_python(record) | changed
    try:
        kinds.validate_python(fields)
    except ValidationError as error:
        return error.errors()[0]["type"]
    return ""


MORE, LESS = "less_than_equal", "greater_than_equal"


@table(
    ("cls", "record", "name", "low", "high"),
    [
        *((LimiterState, LimiterState(), name, -1e6, 1e6) for name in ("left_mps2", "right_mps2")),
        *((StopPlan, NO_STOP, name, 0.0, 1e6) for name in (
            "rim_mps", "first_mps2", "peak_mps2", "rise_s", "flat_s", "fall_s")),
        *((Learnt, UNLEARNT, name, 0.1, 1.0) for name in ("decel_share", "share_worst")),
        *((Learnt, UNLEARNT, name, 0.0, 0.5) for name in ("lag_more_s", "lag_worst_s")),
        *((Learnt, UNLEARNT, name, 0.0, 100.0) for name in ("lag_at_mps", "share_at_mps")),
        *((WheelSpeeds, STOPPED, name, -1e3, 1e3) for name in ("left_radps", "right_radps")),
        *((OdometryState, OdometryState(), name, 0.0, 1e12) for name in (
            "travelled_m", "turned_rad")),
    ],
)  # fmt: skip
def test_a_bound_fits_and_the_next_number_does_not(
    cls: type, record: object, name: str, low: float, high: float
) -> None:
    assert refused_as(cls, record, **{name: low}) == refused_as(cls, record, **{name: high}) == ""
    assert refused_as(cls, record, **{name: nextafter(low, -inf)}) == LESS
    assert refused_as(cls, record, **{name: nextafter(high, inf)}) == MORE


@table(("name", "most"), [("lag_better", 1_000), ("share_better", 1_000), ("stops", 10**9)])
def test_stops_are_counted_up_to_a_bound(name: str, most: int) -> None:
    for count, kind in ((0, ""), (most, ""), (-1, LESS), (most + 1, MORE)):
        assert refused_as(Learnt, UNLEARNT, **{name: count}) == kind


@table(
    ("cls", "record", "name"),
    [
        (LimiterState, LimiterState(), "left_mps2"),
        (StopPlan, NO_STOP, "rim_mps"),
        (Learnt, UNLEARNT, "lag_more_s"),
        (WheelSpeeds, STOPPED, "left_radps"),
        (OdometryState, OdometryState(), "travelled_m"),
        (FollowState, FollowState(), "along_m"),
        (Path, Path((), (), (), (), (), False, None), "heading_rad"),
        (FreeLength, NOTHING_KNOWN, "s_m"),
        (ObstaclePass, ObstaclePass(STILL, 1.0, 2.0, 2.0, True), "free_m"),
        (ScanPicture, None, "first_rad"),
    ],
)
def test_what_is_no_number_or_unknown_is_refused_as_such(
    cls: type, record: object | None, name: str
) -> None:
    record = record or reached("active").state.lidar.picture
    assert refused_as(cls, record) == ""
    for odd in (nan, inf, -inf):
        assert refused_as(cls, record, **{name: odd}) == "finite_number"
    assert refused_as(cls, record, more=1.0) == "unexpected_keyword_argument"
    with pytest.raises(ValidationError):
        kinds_of(cls).validate_python({name: "x"})
