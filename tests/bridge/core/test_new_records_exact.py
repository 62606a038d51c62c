"""Hold what a record says before anything was heard, written down a second time.

A level that begins full, a number that begins at one or a flag that begins true is no error of any
function: nothing else would notice.
"""

from __future__ import annotations

from dataclasses import asdict

from bridge.core import Inbox, LoopFacts, initial
from bridge.core.geometry.odometry import OdometryState
from bridge.core.state import BridgeState, SelfTest, Voice
from bridge.core.state_motion import (
    NO_STOP,
    FollowState,
    Gate,
    Learnt,
    Motion,
    Ramp,
    StopPlan,
    Wheel,
)
from bridge.core.state_orders import Grants, LegMemory, Operator, Ownership, PendingFence, Stick
from bridge.core.state_senses import (
    ButtonMemory,
    DetectorMemory,
    DriveMemory,
    Flood,
    LidarMemory,
    LoopMemory,
    PoseMemory,
)
from tests.bridge.core.scripted import config
from tests.bridge.core.table import table
from wire import IDENTITY, STILL, Mode

PLACE = {"x_m": 0.0, "y_m": 0.0, "yaw_rad": 0.0}
REST = {"v_mps": 0.0, "w_radps": 0.0}
WHEEL = {"integral": 0.0, "push": 0.0, "expected_radps": 0.0, "due_radps": 0.0,
         "told_radps": 0.0, "doubt_s": 0.0}  # fmt: skip
FOLLOW = {"along_m": 0.0, "turning": False, "settled": False, "heading_done": False, "tries": 0}
LEARNT = {"lag_more_s": 0.0, "decel_share": 1.0, "lag_at_mps": 0.0, "share_at_mps": 0.0,
          "lag_better": 0, "lag_worst_s": 0.0, "share_better": 0, "share_worst": 1.0,
          "stops": 0}  # fmt: skip
DRIFT = {"x_m": 0.0, "y_m": 0.0, "yaw_rad": 0.0, "travelled_m": 0.0, "turned_rad": 0.0,
         "jumps_at_s": ()}  # fmt: skip
LOOP = {"late_s": 0.0, "missed_ticks": 0, "late_p50_us": 0.0, "late_max_us": 0.0,
        "step_max_us": 0.0, "record_gaps": 0}  # fmt: skip
NOBODY: dict[str, object] = dict.fromkeys(
    ("owner", "last_owner_id", "echo_s", "used_s", "waypoints_seq", "external_seq")
)


@table(
    ("new", "says"),
    [
        (SelfTest(), {"phase": "echo", "since_s": 0.0, "passed": False}),
        (Gate(), {"shut_since_s": None, "shut_s": 0.0, "shut_yaw_rad": 0.0, "blocked": False,
                  "by": "obstacle", "free_scans": 0, "judged_scan": -1}),
        (Voice(), {"status_seq": 0, "ring": (), "event_seq": 0, "odom_seq": 0, "dropped": 0,
                   "status_s": None, "pending": False}),
        (Learnt(), LEARNT),
        (Wheel(), WHEEL),
        (FollowState(), FOLLOW),
        (Ownership(), NOBODY),
        (Grants(), {"mission": None, "metres": 0.0, "seconds": 0.0, "book": (),
                    "operator_metres": 0.0, "operator_seconds": 0.0, "hand_metres": 0.0,
                    "hand_seconds": 0.0, "since_arm": False}),
        (Operator(), {"nonce_no": 0, "nonce_tag": "", "nonce_made_s": 0.0, "old_nonce_no": None,
                      "old_tag": "", "old_until_s": 0.0,
                      "answers": (), "accepted": (), "refusals": ()}),
        (LegMemory(), {"mission": None, "leg": 0, "reached": False, "goal": None, "refusal": None,
                 "horizon": None, "path": None, "sent_s": 0.0}),
        (Stick(), {"released": (), "ready": (), "source_id": None, "pressed_s": None, "seq": -1,
                   "v_mps": 0.0, "w_radps": 0.0, "received_s": 0.0, "sent_s": 0.0}),
        (DriveMemory(), {"newest": None, "received_s": None, "behind": 0, "ahead": 0,
                         "behind_base": 0,
                         "reborn_s": None, "still_since_s": None, "moving_since_s": None}),
        (LidarMemory(), {"newest": None, "received_s": None, "picture": None, "equal": 0,
                         "equal_from_m": 0.0, "baseline_scans": 0, "baseline_returns": 0.0}),
        (PoseMemory(), {"localization": None, "received_s": None, "jumped_s": None, "imu": None,
                        "imu_received_s": None, "good": None, "drift": DRIFT}),
        (ButtonMemory(), {"link_pressed": False, "link_received_s": None, "pressed_s": None,
                          "ordered": False}),
        (LoopMemory(), {"late_at_s": (), "capped_s": None, "gaps_at_s": (), "missed": 0,
                        "real_time": False, "recorder_ok": False}),
        (DetectorMemory(), {"blind_s": 0.0, "yaw_s": 0.0, "runaway_s": 0.0, "sent": (),
                   "stuck_s": 0.0,
                   "progress_at": None, "progress_s": 0.0, "stuck_at_s": (), "peak_s": 0.0,
                   "heat_a2s": 0.0, "low_s": 0.0, "empty_s": 0.0, "zone_mps": None,
                   "outside": False}),
        (Flood(), {"half_since_s": 0.0, "counts": (), "before": (), "level_s": 0.0, "key": ""}),
        (OdometryState(), {"base_in_odom": PLACE, "measured": REST, "left_rad": None,
                           "right_rad": None, "travelled_m": 0.0, "turned_rad": 0.0, "jumps": 0}),
        (Motion(), {"asked": REST, "limiter": {"sent": REST, "left_mps2": 0.0, "right_mps2": 0.0},
                    "left": WHEEL, "right": WHEEL, "powered": False, "follow": FOLLOW,
                    "bound_by": "robot", "cap": 1.0, "free_m": None, "margin_m": None}),
        (LoopFacts(), LOOP),
        (Inbox(), {"stops": (), "ops": (), "hellos": (), "grants": (), "heartbeats": (),
                   "localization": None, "teleop": (), "external": (), "waypoints": (),
                   "drive": (), "scan": None, "imu": None, "estop_link": None, "fences": (),
                   "fence_done": None, "rejected": (), "arrived": (), "loop": LOOP,
                   "real_time": False, "recorder_ok": False, "recorder_says": "",
                   "sensors_same_host": True, "localization_same_host": True, "chance": ""}),
    ],
)  # fmt: skip
def test_a_new_record_has_seen_and_allows_nothing(new: object, says: dict[str, object]) -> None:
    assert asdict(new) == says  # type: ignore[call-overload]  # all are dataclasses
    assert all(type(asdict(new)[name]) is type(said) for name, said in says.items())  # type: ignore[call-overload]


def test_a_new_state_stands_in_boot_at_its_own_time() -> None:
    new = BridgeState(now_s=7.0)
    assert (new.now_s, new.started_s, new.mode_since_s, new.bad_bucket) == (7.0, 0.0, 0.0, 0.0)
    assert (new.tick, new.command_seq, new.epoch_no, new.mode) == (0, 0, 1, Mode.BOOT)
    assert (new.held, new.source, new.waits_since_s, new.rows, new.trail) == (
        None,
        "",
        None,
        {},
        (),
    )
    assert (new.external, new.stopping, new.fault, new.ramp) == (None, None, None, None)
    assert (new.fence_asked, new.braking_trouble, new.learnt) == (None, None, Learnt())
    first = initial(config(), 7.0)
    assert (first.started_s, first.mode_since_s) == (7.0, 7.0)
    assert first.operator == Operator(nonce_made_s=7.0)


def test_a_fence_is_asked_for_before_it_is_written_and_a_ramp_begins_at_its_start() -> None:
    assert not PendingFence("f1", "page", "{}", IDENTITY).written
    ramp = Ramp(1.0, 0.4, 0.39, 0.4, 0.39)
    assert (ramp.sent_m, ramp.real_m, ramp.rise_mps) == (0.0, 0.0, 0.0)
    assert (ramp.sent_high_s, ramp.sent_low_s, ramp.real_high_s, ramp.real_low_s) == (None,) * 4


def test_no_stop_takes_no_time_and_brakes_nothing() -> None:
    assert StopPlan(STILL, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0) == NO_STOP
    assert NO_STOP.duration_s == 0.0
