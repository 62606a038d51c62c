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
    "modes.operator": {"CLEAN_S": 2.0, "STANDING_S": 0.5, "STICK_S": 0.25},
    "motion.braking": {
        "CREEP_MPS": 0.1,
        "CREEP_RADPS": 0.3,
        "STANDING_MPS": 0.02,
        "TURNING_MPS": 1e-4,
    },
    "modes.mode_logic": {
        "REVOKED_BLOCKED_S": 300.0,
        "REVOKED_S": 30.0,
        "DWELL_S": 0.2,
        "SLOW_S": 0.15,
    },
    "faults.detectors": {
        "HAND_SHOWN_S": 1.0,
        "BRAIN_LATE_S": 0.15,
        "BRAIN_LOST_S": 0.3,
        "BRAIN_GONE_S": 5.0,
        "BRAIN_STALE_S": 1.0,
        "EXTERNAL_S": 0.25,
        "BAD_TRIPS": 5.0,
        "LATES_WITHIN_S": 1.0,
        "MISSED": 2,
        "GAPS_WITHIN_S": 10.0,
        "BLIND_S": 0.3,
        "BLIND_LONG_S": 5.0,
        "BLIND_SHARE": 0.05,
        "PEAK_S": 0.1,
        "HEAT_S": 2.0,
        "DEAD_MAN_S": 0.7,
        "CHARGE_LOW": 0.2,
        "CHARGE_EMPTY": 0.1,
        "CHARGE_UP": 0.05,
        "CHARGE_S": 2.0,
        "LIDAR_OLD_S": 0.25,
        "LIDAR_LONG_S": 5.0,
        "EQUAL_SCANS": 5,
        "EQUAL_MOVED_M": 0.02,
        "ENC_LONG_S": 0.25,
        "NACK_LONG_S": 0.5,
    },
    "faults.detect_motion": {
        "SLACK_MPS": 0.15,
        "RUNAWAY_S": 0.1,
        "RUNAWAY_LONG_S": 0.25,
        "FOLLOWS_S": 0.2,
        "ASKED_MPS": 0.1,
        "MOVED_MPS": 0.03,
        "MOVED_SHARE": 0.2,
        "ASKED_RADPS": 0.2,
        "TURNED_RADPS": 0.05,
        "STUCK_S": 1.0,
        "PROGRESS_M": 0.02,
        "PROGRESS_RAD": 0.05,
        "PROGRESS_S": 5.0,
        "TIMES": 3,
        "WITHIN_S": 300.0,
        "YAW_RADPS": 0.3,
        "YAW_S": 0.5,
        "GYRO_OLD_S": 0.25,
    },
    "sensing.stop_inputs": {"LINK_SILENT_S": 0.5},
    "sensing.sensor_update": {
        "FREE_M": 0.3,
        "MARGIN_M": 0.05,
        "REACH_M": 2.0,
        "POOR_QUALITY": 0.5,
        "POSE_OLD_S": 0.3,
        "JUMP_M": 0.1,
        "JUMP_RAD": radians(5),
        "BASELINE_SCANS": 20,
        "LATE_S": 0.005,
        "LATES": 5,
        "GAP_S": 0.1,
        "GAPS": 3,
        "SEES_SHARE": 0.1,
        "DRIFT_M": 0.2,
        "DRIFT_RAD": radians(10),
        "FORGIVEN_M_PER_M": 0.1,
        "FORGIVEN_RAD_PER_M": 0.05,
        "FORGIVEN_RAD_PER_RAD": 0.1,
        "JUMPS": 3,
        "JUMPS_WITHIN_S": 60.0,
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
    "authority.external_velocity": {"TTL_S": 0.25},
    "motion.motion_gates": {
        "FENCE_MARGIN_M": 0.15,
        "INWARD_MPS": 0.15,
        "SHUT_S": 0.5,
        "FREE_SCANS": 5,
        "TELEOP_FENCE_MPS": 0.2,
        "UNKNOWN_MPS": 0.2,
    },
    "authority.message_limits": {
        "WINDOW_S": 0.25,
        "SLACK": 1.2,
        "ONE_MORE": 1,
        "FULL_S": 1.0,
        "DRAIN_S": 0.5,
        "FULL": 10.0,
    },
    "authority.ownership": {
        "OPERATOR_METRES": 500.0,
        "OPERATOR_SECONDS": 3600.0,
        "HAND_METRES": 50.0,
        "HAND_SECONDS": 600.0,
        "OUTSIDE_COUNTS": 10.0,
        "LIVE_S": 0.3,
    },
    "authority.leg_tracking": {
        "FIRST_WITHIN_M": 0.5,
        "MIN_GAP_M": 0.05,
        "MAX_GAP_M": 0.25,
        "MIN_END_GAP_M": 0.01,
        "MIN_SPEED_MPS": 0.05,
    },
    "config": {"PERIOD_S": 0.01},
    "authority.requests": {
        "NONCE_S": 60.0,
        "OLD_NONCE_S": 10.0,
        "KEPT": 64,
        "SHOWN": 16,
        "SHOWN_S": 10.0,
        "REFUSAL_S": 1.0,
    },
    "motion.pursuit": {"REACHED_M": 0.1, "REACHED_RAD": 0.1},
    "modes.selftest": {"FRESH_S": 0.25, "STILL_S": 0.5, "MOVING_S": 1.0, "PATIENCE_S": 0.3},
    "state_orders": {"MAX_MISSIONS": 64},
    "authority.stick": {"NEUTRAL_MPS": 0.02, "NEUTRAL_RADPS": 0.05},
    "modes.teleop": {
        "CAUSAL_S": 0.4,
        "RECEIPT_S": 0.25,
    },
    "modes.transition": {"GRACE_S": 0.2, "SLACK_MPS": 0.1},
    "reporting.report": {"EVERY_S": 0.05, "AT_LEAST_S": 0.025},
    "tick_context": {
        "STANDING_MPS": 0.02,
        "STANDING_RADPS": 0.05,
        "DRAIN": 0.25,
        "LONGEST_S": 0.05,
    },
}


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
