"""Hold the core's numbers and tables to the ones that were decided, written down a second time.

A window that is a tenth longer, or a row that clears by another way, breaks no law by itself; it
must break this.
"""

from __future__ import annotations

from importlib import import_module
from math import radians

import pytest

from bridge.core.faults.fault_table import STAGES
from bridge.core.modes.mode_table import LATCHED, TRANSITIONS
from bridge.core.tick_context import MOVING, POWERED
from tests.bridge.core import oracle
from tests.bridge.core.table import table
from wire import SEVERITY, Action, Mode

NUMBERS: dict[str, dict[str, float]] = {
    "modes.mode_logic": {"DWELL_S": 0.2},
    "faults.detectors": {"BLIND_SHARE": 0.05},
    "faults.detect_motion": {"TURNED_RADPS": 0.05},
    "sensing.sensor_update": {
        "DRIFT_M": 0.2,
        "DRIFT_RAD": radians(10),
        "FORGIVEN_RAD_PER_RAD": 0.1,
        "DRIVE_LOST_S": 0.25,
        "SCAN_LOST_S": 0.25,
        "SEQ_AHEAD": 1_000,
    },
    "sensing.blind_sector": {
        "BINS": 120,
        "LEAST_RAD": 0.2,
        "NEAR_SHARE": 0.7,
        "REACHED_SHARE": 0.85,
        "SEEN_SHARE": 0.95,
        "FARTHER_M": 0.3,
        "FARTHER_SHARE": 0.15,
        "TURN_RAD": 0.27,
        "ON_SPOT_M": 0.05,
        "SLACK_RAD": 0.11,
        "SEEN_S": 0.2,
        "COARSE_RAD": 0.045,
        "RECENT_S": 0.35,
        "AHEAD_RAD": radians(60),
    },
    "authority.ownership": {"HAND_METRES": 50.0, "HAND_SECONDS": 600.0},
    "config": {"PERIOD_S": 0.01},
}
"""What the tests of its own module take from it, or hold from one side alone. All other windows and
bounds stand, to their edges, in the tables of their modules' tests."""


CLEARS = {
    "BRAIN_LOST.0": "ON_GRANT",
    "POSE_JUMP.0": "ON_GRANT",
    "BRAIN_GONE.0": "ON_REARM",
    "LIDAR_STALE.1": "ON_REARM",
    "LIDAR_BLIND.1": "ON_REARM",
    "STUCK.1": "ON_REARM",
    "POSE_JUMP.1": "ON_REARM",
    "ENC_STALE.1": "ON_REARM",
    "DRIVE_REBOOT.0": "ON_REARM",
    "BATTERY.1": "ON_REARM",
    "LOOP_LATE.2": "ON_REARM",
    "RUNAWAY.0": "ON_RESET",
    "RUNAWAY.1": "ON_RESET",
    "DRIVER_NACK.1": "ON_RESET",
    "DRIVE_FOREIGN.0": "ON_RESET",
    "OVERCURRENT.0": "ON_RESET",
    "ESTOP.0": "ON_RESET",
    "DEAD_MAN.0": "REBOOT",
    "DEAD_MAN.1": "REBOOT",
    "NOT_RT.0": "REBOOT",
}
"""All others clear by themselves,"""


CLEAN_S = {
    "BUDGET.0": 0.0,
    "HAND_BUDGET.0": 0.0,
    "SPEED_ZONE.0": 0.0,
    "LIDAR_STALE.0": 1.0,
    "LIDAR_BLIND.0": 2.0,
    "LIDAR_SECTOR.0": 2.0,
    "LIDAR_SECTOR.1": 2.0,
    "STUCK.0": 2.0,
    "YAW_DISAGREE.0": 2.0,
    "BATTERY.0": 5.0,
    "LOOP_LATE.0": 2.0,
}
"""after so long, or half a second."""


# From each mode: by what, to which.
TABLE = """
BOOT the_process_is_up SELFTEST
SELFTEST self_test_passed DISARMED
SELFTEST self_test_found_a_fault FAULT
DISARMED arm HOLD
HOLD grant_and_waypoints_of_this_epoch_and_owner,_not_held ACTIVE
ACTIVE final_reached_or_no_points,_and_standing HOLD
HOLD teleop TELEOP
ACTIVE teleop TELEOP
TELEOP dead-man_released_or_stale HOLD
HOLD STOP1 STOPPING
HOLD FAST1 STOPPING
HOLD CUT0 FAULT
HOLD disarm STOPPING
HOLD the_stop_is_too_slow_or_too_long FAULT
STOPPING CUT0 FAULT
STOPPING disarm STOPPING
STOPPING standing_200_ms,_stop_keeps_torque HOLD
STOPPING standing_200_ms,_stop_takes_torque_away DISARMED
STOPPING standing_200_ms,_a_row_clears_by_reset FAULT
STOPPING rows_cleared,_grant_still_valid ACTIVE
STOPPING the_stop_is_too_slow_or_too_long FAULT
ESTOPPED reset DISARMED
FAULT reset DISARMED
ESTOPPED reset_before_the_self_test_has_passed SELFTEST
FAULT reset_before_the_self_test_has_passed SELFTEST
"""


@table("module", NUMBERS)
def test_numbers_are_the_ones_decided(module: str) -> None:
    found = import_module(f"bridge.core.{module}")
    assert {name: getattr(found, name) for name in NUMBERS[module]} == NUMBERS[module]


def test_robot_toml_hides_no_more_of_a_lidar_than_the_gate_keeps_clear() -> None:
    freespace = import_module("bridge.core.motion.free_distance")
    assert import_module("wire.robot").HIDDEN_BEYOND_M == freespace.MARGIN_M


def test_rates_are_the_wires() -> None:
    flood = import_module("bridge.core.authority.message_limits")
    assert flood.RATES_HZ == {
        "cmd/waypoints": 10.0, "cmd/teleop": 20.0, "cmd/external": 20.0, "cmd/grant": 40.0,
        "cmd/heartbeat": 40.0, "cmd/hello": 40.0,
    }  # fmt: skip


@table("name", oracle.TABLE)
def test_a_stage_does_binds_and_clears_as_decided(name: str) -> None:
    stage, (action, binds, share) = STAGES[name], oracle.TABLE[name]
    assert (stage.action.value, stage.binds) == (action, binds)
    assert stage.clears.value == CLEARS.get(name, "AUTO")
    assert stage.clean_s == CLEAN_S.get(name, 0.5)
    if name == "SPEED_ZONE.0":
        assert stage.cap_zone
    elif share is not None:
        assert (stage.cap_factor or (stage.cap_mps or 0.0) / 0.5) == pytest.approx(share)


def test_the_mode_table_is_the_one_decided() -> None:
    expected = {tuple(line.split()) for line in TABLE.split("\n") if line}
    for mode in ("ACTIVE", "TELEOP"):
        for cause in ("HOLD2", "STOP1", "FAST1", "stop", "disarm"):
            expected.add((mode, cause, "STOPPING"))
        expected.add((mode, "CUT0", "FAULT"))
    expected |= {(mode.value, "estop", "ESTOPPED") for mode in Mode if mode is not Mode.ESTOPPED}
    said = {
        (mode.value, cause.value.replace(" ", "_"), to.value)
        for (mode, cause), to in TRANSITIONS.items()
    }
    assert said == expected
    assert {Mode.HOLD, Mode.ACTIVE, Mode.TELEOP, Mode.STOPPING} == POWERED
    assert {Mode.ACTIVE, Mode.TELEOP} == MOVING
    assert {Mode.ESTOPPED, Mode.FAULT} == LATCHED


def test_actions_get_worse_in_this_order() -> None:
    assert sorted(Action, key=lambda action: SEVERITY[action]) == list(oracle.ORDER)
