"""Hold the self test to what it waits for, what it proves and what it finds wrong."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import pytest

from bridge.core.modes.mode_table import Fact
from bridge.core.modes.selftest import (
    DONE,
    ECHO,
    RETURN,
    WITHHOLD,
    _wrong,
    enter,
    run,
    waits_for,
    withholds,
)
from bridge.core.state import SelfTest
from bridge.core.tick_context import TickContext
from tests.bridge.core.fake_planner import BOOT
from tests.bridge.core.reached import at
from tests.bridge.core.scripted import FENCE, config
from tests.bridge.core.table import table
from wire import Mode, RobotDescription

NOW_S = 10.0
DRIVE = RobotDescription().drive
PATIENCE_S = DRIVE.timeout_s + DRIVE.lag_s + 0.3
EPS = 1e-9
UGV = RobotDescription.model_validate({"drive": {"kind": "waveshare", "port": "/dev/x"}})


def proving(phase: str = DONE, **change: Any) -> TickContext:
    """Return a tick of a self test that lacks nothing: it has stood for 1 s, all has just come."""
    tick = at("disarmed")
    s = tick.s
    assert s.drive.newest is not None
    tick.now_s, s.mode = NOW_S, Mode.SELFTEST
    s.selftest = SelfTest(phase, NOW_S - 0.1)
    timed_out = change.get("timed_out", False)
    s.drive.newest = s.drive.newest.model_copy(
        update={"echo_boot": change.get("echo", BOOT), "timed_out": timed_out}
    )
    s.drive.received_s, s.drive.still_since_s, s.drive.moving_since_s = NOW_S, NOW_S - 1.0, None
    for name in ("newest", "received_s", "still_since_s", "moving_since_s"):
        if name in change:
            setattr(s.drive, name, change[name])
    scans = change.get("baseline_scans", 20)
    s.lidar = replace(s.lidar, received_s=change.get("scan_s", NOW_S), baseline_scans=scans)
    if "sees" in change:
        picture = s.lidar.picture
        assert picture is not None
        blind = replace(picture, returns=0) if change["sees"] is False else None
        s.lidar = replace(s.lidar, picture=blind)
    return tick


@table(
    ("phase", "change", "waits"),
    [
        (DONE, {}, []),
        (ECHO, {}, ["drive_echo"]),
        (WITHHOLD, {}, ["drive_timeout"]),
        (RETURN, {}, ["drive_timeout"]),
        (DONE, {"received_s": NOW_S - 0.25}, []),
        (DONE, {"received_s": NOW_S - 0.25 - EPS}, ["drive", "encoders_still"]),
        (DONE, {"received_s": None}, ["drive", "encoders_still"]),
        (DONE, {"newest": None, "received_s": None}, ["drive", "encoders_still"]),
        (DONE, {"still_since_s": NOW_S - 0.5}, []),
        (DONE, {"still_since_s": NOW_S - 0.5 + 1e-6}, ["encoders_still"]),
        (DONE, {"scan_s": NOW_S - 0.25}, []),
        (DONE, {"scan_s": NOW_S - 0.25 - EPS}, ["lidar"]),
        (DONE, {"scan_s": None}, ["lidar"]),
        (DONE, {"baseline_scans": 19}, ["lidar_baseline"]),
        (DONE, {"baseline_scans": 21}, []),
        (DONE, {"baseline_scans": 19, "sees": False}, ["lidar_blind"]),
        (DONE, {"baseline_scans": 19, "sees": None}, ["lidar_baseline"]),
        (DONE, {"baseline_scans": 20, "sees": False}, []),
    ],
)
def test_it_waits_for_each_thing_by_name(
    phase: str, change: dict[str, Any], waits: list[str]
) -> None:
    assert list(waits_for(proving(phase, **change))) == waits


@table(
    ("unsaid", "waits"),
    [
        ({"estop_pressed"}, ["stop_input"]),
        ({"bumper_front"}, ["contact_inputs"]),
        ({"bumper_rear"}, ["contact_inputs"]),
        ({"cliff"}, ["contact_inputs"]),
        ({"estop_pressed", "cliff"}, ["stop_input", "contact_inputs"]),
    ],
)
def test_it_waits_for_inputs_that_the_drive_does_not_tell(
    unsaid: set[str], waits: list[str]
) -> None:
    tick = proving()
    assert tick.s.drive.newest is not None
    tick.s.drive.newest = tick.s.drive.newest.model_copy(update=dict.fromkeys(unsaid))
    assert list(waits_for(tick)) == waits
    run(tick)
    assert tick.s.mode is Mode.SELFTEST


@table(
    ("linked", "heard_s", "waits"),
    [(True, None, ["estop_link"]), (True, 3.0, []), (False, None, []), (False, 3.0, [])],
)
def test_it_waits_for_a_stop_buttons_link_where_there_is_one(
    linked: bool, heard_s: float | None, waits: list[str]
) -> None:
    tick = proving()
    tick.config = config(RobotDescription.model_validate({"inputs": {"estop_link": linked}}))
    tick.s.buttons = replace(tick.s.buttons, link_received_s=heard_s)
    assert list(waits_for(tick)) == waits


@table(
    ("phase", "change", "after"),
    [
        (ECHO, {}, WITHHOLD),
        (ECHO, {"echo": "other"}, ECHO),
        (ECHO, {"timed_out": True}, ECHO),
        (ECHO, {"timed_out": None}, ECHO),  # one that reports it must
        (ECHO, {"still_since_s": NOW_S - 0.4}, ECHO),
        (WITHHOLD, {}, WITHHOLD),
        (WITHHOLD, {"timed_out": True}, RETURN),
        (WITHHOLD, {"timed_out": None}, WITHHOLD),
        (WITHHOLD, {"timed_out": True, "echo": "other"}, WITHHOLD),
        (WITHHOLD, {"timed_out": True, "still_since_s": NOW_S}, RETURN),
        (WITHHOLD, {"timed_out": True, "still_since_s": None}, WITHHOLD),
        (RETURN, {"timed_out": True}, RETURN),
        (RETURN, {"timed_out": None}, RETURN),
        (RETURN, {"echo": "other"}, RETURN),
        (RETURN, {"received_s": NOW_S - 0.3}, ECHO),
        (WITHHOLD, {"received_s": None}, ECHO),
        (WITHHOLD, {"newest": None}, ECHO),
    ],
)
def test_silence_proves_a_dead_man_that_is_reported(
    phase: str, change: dict[str, Any], after: str
) -> None:
    tick = proving(phase, **change)
    run(tick)
    assert tick.s.mode is Mode.SELFTEST
    assert tick.s.selftest == SelfTest(after, NOW_S if after != phase else NOW_S - 0.1)


@table("phase", [RETURN, DONE])
def test_with_the_last_proof_it_has_passed_and_nothing_takes_that_back(phase: str) -> None:
    tick = proving(phase)
    run(tick)
    assert tick.s.mode is Mode.DISARMED
    assert (tick.s.selftest.phase, tick.s.selftest.passed) == (DONE, True)
    silent = proving(received_s=None)
    run(silent)
    assert (silent.s.mode, silent.s.selftest.phase) == (Mode.SELFTEST, DONE)
    assert not silent.s.selftest.passed


def wrong(phase: str, now_s: float, moving_since_s: float | None, received_s: float) -> str | None:
    """Return what is wrong of a phase that began at 0 s."""
    tick = proving(phase, moving_since_s=moving_since_s, received_s=received_s)
    tick.now_s, tick.s.selftest = now_s, SelfTest(phase, 0.0)
    found = _wrong(tick)
    run(tick)
    assert tick.s.mode is (Mode.FAULT if found is not None else Mode.SELFTEST)
    return found


@table(
    ("phase", "now_s", "moving_since_s", "heard_s", "found"),
    [
        (WITHHOLD, PATIENCE_S, None, PATIENCE_S, None),
        (WITHHOLD, PATIENCE_S + EPS, None, PATIENCE_S, "drive_no_timeout"),
        (WITHHOLD, PATIENCE_S + EPS, PATIENCE_S, PATIENCE_S, "drive_moves_on"),
        (WITHHOLD, 9.0, None, 8.7, None),  # who is silent is judged by that
        (ECHO, 9.0, None, 9.0, None),
        (RETURN, 9.0, None, 8.7, None),
        (ECHO, 9.0, 8.0, 9.0, "encoders_moving"),
        (ECHO, 9.0, 8.0 + EPS, 9.0, None),
    ],
)
def test_what_takes_too_long_is_wrong(
    phase: str, now_s: float, moving_since_s: float | None, heard_s: float, found: str | None
) -> None:
    assert wrong(phase, now_s, moving_since_s, heard_s) == found


@table(
    ("change", "after"),
    [({}, DONE), ({"echo": "other"}, ECHO), ({"still_since_s": NOW_S - 0.4}, ECHO),
     ({"timed_out": True}, DONE)],
)  # fmt: skip
def test_one_that_is_not_reported_is_left_unproven(change: dict[str, Any], after: str) -> None:
    tick = proving(ECHO, **{"timed_out": None, **change})
    tick.config = config(UGV)
    run(tick)
    assert tick.s.selftest.phase == after
    assert not withholds(tick)


@pytest.mark.parametrize("lost", ["fence_missing", "fence_of_another_map"])
def test_a_fence_that_is_none_or_anothers_is_wrong(lost: str) -> None:
    tick = proving()
    fence = None if lost == "fence_missing" else replace(FENCE, map_id="b" * 16)
    tick.config = replace(tick.config, fence=fence)
    run(tick)
    assert (tick.s.mode, tick.s.fault) == (Mode.FAULT, lost)


@table("start", ["boot", "disarmed", "hold", "active", "estopped", "fault"])
def test_commands_are_withheld_in_that_phase_of_a_self_test_alone(start: str) -> None:
    tick = at(start)
    tick.s.selftest = SelfTest(WITHHOLD)
    assert not withholds(tick)
    mode = tick.s.mode
    run(tick)
    assert tick.s.mode is mode
    for phase in (ECHO, WITHHOLD, RETURN, DONE):
        assert withholds(proving(phase)) is (phase == WITHHOLD)


@table("start", ["hold", "active", "teleop"])
def test_where_the_mode_table_knows_no_way_in_nothing_begins(start: str) -> None:
    tick = at(start)
    before = (tick.s.mode, tick.s.selftest)
    enter(tick, Fact.UP, "up")
    assert (tick.s.mode, tick.s.selftest) == before
