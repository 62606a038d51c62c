"""Hold records: what each says before anything was heard, and what a written one may hold."""

from __future__ import annotations

from dataclasses import fields, is_dataclass
from functools import lru_cache
from math import inf, nan, nextafter
from typing import Any

import pytest
from pydantic import TypeAdapter, ValidationError

from bridge.core import Inbox, initial
from bridge.core.geometry.kinematics import STOPPED, OdometryState, WheelSpeeds
from bridge.core.geometry.lidar_scan import ScanPicture
from bridge.core.geometry.path_profile import Path
from bridge.core.motion.free_distance import NOTHING_KNOWN, FreeLength
from bridge.core.motion.obstacle_gate import ObstaclePass
from bridge.core.state import BridgeState, draft
from bridge.core.state_motion import (
    NO_STOP,
    UNLEARNT,
    FollowState,
    Learnt,
    LimiterState,
    Ramp,
    StopPlan,
)
from bridge.core.state_orders import (
    Grants,
    MissionLeft,
    PendingFence,
)
from tests.bridge.core.reached import reached
from tests.bridge.core.scripted import config
from tests.bridge.core.table import table
from wire import IDENTITY, STILL, Mode


def begins_with(record: Any) -> dict[str, object]:
    """Return what is not none, zero, false or empty in a record and in the records inside it.

    A level that begins full, a number that begins at one or a flag that begins true is no error of
    any function: nothing else would notice.
    """
    found: dict[str, object] = {}
    for field in fields(record):
        value = getattr(record, field.name)
        if is_dataclass(value):
            found |= {f"{field.name}.{name}": it for name, it in begins_with(value).items()}
        elif value:
            found[field.name] = value
    return found


def test_a_new_state_stands_in_boot_and_has_seen_and_allows_nothing() -> None:
    new = {
        "now_s": 7.0,
        "mode": Mode.BOOT,
        "epoch_no": 1,
        "stick.seq": -1,
        "selftest.phase": "echo",
        "gate.by": "obstacle",
        "gate.judged_scan": -1,
        "motion.bound_by": "robot",
        "motion.cap": 1.0,
        "learnt.decel_share": 1.0,
        "learnt.share_worst": 1.0,
    }
    assert begins_with(BridgeState(now_s=7.0)) == new
    begun = dict.fromkeys(("started_s", "mode_since_s", "operator.nonce_made_s"), 7.0)
    assert begins_with(initial(config(), 7.0)) == new | begun


def test_an_inbox_that_nobody_filled_holds_nothing_and_tells_one_host() -> None:
    assert begins_with(Inbox()) == {"sensors_same_host": True, "localization_same_host": True}


def test_a_fence_is_asked_for_before_it_is_written_and_a_ramp_begins_at_its_start() -> None:
    assert not PendingFence("f1", "page", "{}", IDENTITY).written
    ramp = Ramp(1.0, 0.4, 0.39, 0.4, 0.39)
    assert (ramp.sent_m, ramp.real_m, ramp.rise_mps) == (0.0, 0.0, 0.0)
    assert (ramp.sent_high_s, ramp.sent_low_s, ramp.real_high_s, ramp.real_low_s) == (None,) * 4


def test_no_stop_takes_no_time_and_brakes_nothing() -> None:
    assert StopPlan(STILL, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0) == NO_STOP
    assert NO_STOP.duration_s == 0.0


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


def test_what_is_written_in_a_draft_is_not_seen_by_who_holds_the_state() -> None:
    state = reached("active").state
    copy = draft(state)
    for name in ("drive", "motion", "watch"):
        assert getattr(copy, name) == getattr(state, name)
        assert getattr(copy, name) is not getattr(state, name)


@pytest.mark.parametrize(
    ("left", "name"),
    [
        ((None, 0.0, 0.0, 0.0, 0.0), None),
        (("m", 1.0, 1.0, 1.0, 1.0), None),
        (("m", 0.0, 1.0, 1.0, 1.0), "mission's metres"),
        (("m", 1.0, 0.0, 1.0, 1.0), "mission's seconds"),
        (("m", 1.0, 1.0, 0.0, 1.0), "operator's metres"),
        (("m", 1.0, 1.0, 1.0, 0.0), "operator's seconds"),
        (("m", nan, 1.0, 1.0, 1.0), "mission's metres"),
    ],
)
def test_what_is_used_up_is_named(
    left: tuple[str | None, float, float, float, float], name: str | None
) -> None:
    mission, metres, seconds, operator_metres, operator_seconds = left
    grants = Grants(mission, metres, seconds, (), operator_metres, operator_seconds)
    assert grants.spent_part() == name


def test_what_a_mission_may_still_use_goes_into_the_book_and_nothing_stays_granted() -> None:
    book = tuple(MissionLeft(f"m{i}", 1.0, 2.0) for i in range(64))
    after = Grants("m3", 5.0, 6.0, book, 7.0, 8.0, True).return_budget()
    rest = (*book[:3], *book[4:], MissionLeft("m3", 5.0, 6.0))
    assert after == Grants(None, 0.0, 0.0, rest, 7.0, 8.0, True)
    full = Grants("new", 5.0, 6.0, book).return_budget()
    assert full.book == (*book[1:], MissionLeft("new", 5.0, 6.0))
    assert after.return_budget() is after
