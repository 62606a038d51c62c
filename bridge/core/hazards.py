"""Name what can hurt or go wrong, what watches for it, where in the code, and which test proves it.

docs/safety.md prints this table; a test holds every function and every test in it to exist, each
test to name its row, and every row, gate and detector to be here. Data only.
"""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class Hazard:
    """Tie one thing that can go wrong to its guard."""

    what: str
    guard: str
    """A row's id, a gate (``OBSTACLE``, ``FENCE``, ``CONTACT``), or the law that stands for it."""
    function: str
    """In ``bridge.core``: module and name."""
    tests: tuple[str, ...]
    """In tests/bridge/core: file and names, as pytest writes them."""


_BRAIN, _ROBOT = "test_row_windows.py", "test_row_windows_robot.py"
_MOTION = "test_row_windows_motion.py"

HAZARDS: tuple[Hazard, ...] = (
    Hazard("The planner slows down while the robot drives on what it said before", "BRAIN_LATE",
           "detect_brain.brain",
           (f"{_BRAIN}::test_brain_late_caps_at_half_after_150_ms_and_lost_holds_after_300",)),
    Hazard("The planner dies or hangs while the robot drives", "BRAIN_LOST", "detect_brain.brain",
           (f"{_BRAIN}::test_brain_late_caps_at_half_after_150_ms_and_lost_holds_after_300",
            f"{_BRAIN}::test_a_lost_brain_that_returns_while_the_robot_stops_is_not_called_lost")),
    Hazard("A robot whose planner never returns stays powered, ready to move", "BRAIN_GONE",
           "detect_brain.brain", (f"{_BRAIN}::test_brain_gone_disarms_after_5_s",)),
    Hazard("The planner answers but its mission loop thinks on an old world", "BRAIN_STALE",
           "detect_brain.brain",
           (f"{_BRAIN}::test_a_brain_that_thinks_on_stale_data_is_held_after_1_s",)),
    Hazard("A command made long ago is followed: queued, delayed, replayed", "CMD_STALE",
           "detect_brain.commands", (f"{_BRAIN}::test_an_old_horizon_is_held_after_its_ttl",
           "test_external_brain.py::test_an_old_velocity_holds_after_a_quarter_second")),
    Hazard("A broken planner sends nonsense again and again", "CMD_BAD", "detect_brain.commands",
           (f"{_BRAIN}::test_four_bad_messages_are_forgiven_and_five_are_not",
            "test_external_brain.py::test_going_backwards_in_number_is_scored")),
    Hazard("A flood of commands keeps the loop from its work", "CMD_FLOOD", "flood.judge",
           (f"{_MOTION}::TestFlood::test_four_windows_of_too_much_hold",)),
    Hazard("A planner drives on and on without a person knowing", "BUDGET",
           "detect_brain.commands",
           (f"{_BRAIN}::test_a_spent_grant_holds_at_once_and_a_new_mission_goes_on",
            f"{_BRAIN}::test_the_operator_cap_is_spent_and_refilled_by_a_person")),
    Hazard("The lidar stops, lags or repeats itself; the robot drives on an old picture",
           "LIDAR_STALE", "detect_senses.lidar",
           (f"{_ROBOT}::test_a_silent_lidar_holds_after_250_ms_and_disarms_after_5_s_more",
            f"{_ROBOT}::test_equal_scans_while_moving_are_a_frozen_lidar")),
    Hazard("The lidar is covered or blinded: all silence looks free", "LIDAR_BLIND",
           "detect_place.blind",
           (f"{_MOTION}::TestSight::test_a_covered_lidar_holds_after_300_ms_and_disarms_after_5_s",
            f"{_MOTION}::TestSight::test_one_that_sees_again_is_trusted_after_2_s")),
    Hazard("Nothing watches for obstacles at all", "NO_RANGE", "detect_place.no_range",
           (f"{_MOTION}::TestSight::test_without_a_living_lidar_there_is_no_range",)),
    Hazard("The robot is fast where people pass, as at a narrow door", "SPEED_ZONE",
           "detect_place.zone",
           (f"{_MOTION}::test_a_zone_caps_at_its_speed_while_the_robot_is_in_it",)),
    Hazard("The robot follows a way, or another brain, without knowing where it is", "POSE_LOST",
           "detect_senses.pose",
           (f"{_ROBOT}::test_a_lost_pose_holds",
            "test_external_brain.py::test_without_a_pose_it_is_held_as_waypoints_are")),
    Hazard("The robot was carried, or localization is wrong about it", "POSE_JUMP",
           "detect_senses.pose",
           ("test_story.py::test_a_jump_of_the_pose_needs_a_grant_that_knows_of_it",)),
    Hazard("The robot pushes against something that the lidar does not see", "STUCK",
           "detect_motion.stuck",
           (f"{_MOTION}::TestStuck::test_wheels_that_do_not_turn_end_the_grant_after_1_s",
            f"{_MOTION}::TestStuck::test_the_third_time_in_five_minutes_disarms")),
    Hazard("A wheel turns faster than told, or the other way", "RUNAWAY", "detect_motion.runaway",
           (f"{_MOTION}::TestRunaway::test_a_drive_faster_than_told_is_braked_and_then_cut",
            f"{_MOTION}::TestRunaway::test_a_wheel_that_turns_the_other_way_is_one_too")),
    Hazard("Wheels slip or a gyro fails: odometry tells of another motion", "YAW_DISAGREE",
           "detect_motion.yaw",
           (f"{_MOTION}::TestYaw::test_a_gyro_that_turns_by_itself_caps_the_speed",
            f"{_MOTION}::TestYaw::test_a_silent_gyro_counts")),
    Hazard("The drive falls silent: nobody measures the motion", "ENC_STALE",
           "detect_senses.drive", (f"{_ROBOT}::test_a_silent_drive_holds_after_80_ms",
           f"{_ROBOT}::test_a_drive_silent_for_250_ms_is_stopped_hardest_and_needs_arming")),
    Hazard("The drive does not take commands and keeps the last one", "DRIVER_NACK",
           "detect_senses.drive",
           (f"{_ROBOT}::test_a_deaf_drive_holds_after_10_commands_and_faults_after_50",)),
    Hazard("The drive restarts under way with other settings", "DRIVE_REBOOT",
           "detect_senses.drive", (f"{_ROBOT}::test_a_drive_that_restarted_disarms",)),
    Hazard("A motor is jammed and burns", "OVERCURRENT", "detect_power.current",
           (f"{_MOTION}::TestPower::test_too_much_current_stops_by_peak_or_by_heat",)),
    Hazard("The battery dies while the robot drives", "BATTERY", "detect_power.battery",
           (f"{_MOTION}::TestPower::test_a_low_battery_slows_and_an_empty_one_disarms",)),
    Hazard("The computer wakes the bridge late or not at all", "LOOP_LATE", "detect_loop.loop",
           (f"{_ROBOT}::test_lateness_caps_gaps_hold_and_three_gaps_disarm",)),
    Hazard("A real robot is driven without real-time rights", "NOT_RT", "detect_loop.rights",
           (f"{_ROBOT}::test_not_real_time_is_only_shown_on_a_virtual_drive",)),
    Hazard("A person presses a stop button, or its wire is cut", "ESTOP", "detect_senses.buttons",
           (f"{_ROBOT}::test_an_estop_message_needs_no_proof",
            f"{_ROBOT}::test_the_drives_stop_input_latches_until_reset",
            f"{_ROBOT}::test_a_stop_link_that_falls_silent_counts_as_pressed")),
    Hazard("Something or somebody stands in the way", "OBSTACLE", "obstaclegate.obstacle_gate",
           ("test_story.py::test_an_obstacle_blocks_and_its_leaving_frees",
            "test_gates.py::test_it_stands_at_the_margin_and_says_so")),
    Hazard("The robot is sent where it must not go: stairs, a street", "FENCE",
           "fencegate.fence_scale",
           ("test_gates.py::test_the_fence_is_never_crossed",
            "test_fencegate_exact.py::test_no_keep_out_is_too_thin_to_stop_before",
            "test_horizon.py::test_the_fence_is_tested_on_segments")),
    Hazard("It touches what the lidar missed, or the floor ends", "CONTACT",
           "contactgate.contact_gate",
           ("test_contactgate.py::test_a_driving_robot_that_touches_stops_and_is_blocked_until_let_go",)),
)  # fmt: skip
"""Rows in the order of their table, then the gates."""


LAWS: tuple[Hazard, ...] = (
    Hazard("A stop comes together with orders to move", "in one tick the stop wins",
           "operator.hear_stops", ("test_story.py::test_a_stop_wins_over_all_that_came_with_it",)),
    Hazard("A stop is lost or forgotten", "stops are levels and hold until a person acts",
           "operator.hear_stops", ("test_story.py::test_stop_holds_until_a_person_resumes",)),
    Hazard("The robot moves by itself after a start, a fault or a reset",
           "powered only after a proven request to arm; a reset never powers", "modes.after",
           ("test_modes.py::test_every_transition_obeys_the_laws",
            "test_operator_requests.py::test_without_a_proof_nothing_starts")),
    Hazard("A planner shows a nonce of the future, and keeps what a person signs under it",
           "no nonce can be foretold, and none outlives a stop", "operator.renew_nonce",
           ("test_operator_laws.py::test_a_proof_under_a_nonce_that_was_not_shown_yet_never_counts",
            "test_operator_laws.py::test_after_a_stop_no_proof_from_before_it_counts")),
    Hazard("A request signed before a stop is repeated and ends it",
           "a stop voids every nonce", "operator.hear_stops",
           ("test_operator_requests.py::test_a_proof_from_before_a_stop_does_not_end_it",)),
    Hazard("Two planners drive one robot", "one owner, by hello, standing", "ownership.hear_hello",
           ("test_story.py::test_another_planner_is_told_and_then_held",)),
    Hazard("What was said before a silence is obeyed after it", "every loss is a new epoch",
           "ownership.free_the_lost",
           ("test_story.py::test_what_was_said_before_the_silence_is_not_obeyed",)),
    Hazard("A sender makes its command look younger than it is", "ages run on the bridge's clock",
           "ages.sent_at",
           ("test_ages_and_docs.py::test_the_ring_knows_the_last_256_statuses_and_no_other",)),
    Hazard("A stick that lies pressed takes the robot", "seen released, then neutral, first",
           "stick.hear_teleop",
           ("test_story.py::test_teleop_takes_over_only_after_released_and_neutral",)),
    Hazard("A stop does not slow the robot", "too slow or too long ends with the torque off",
           "stops.judge",
           (f"{_ROBOT}::test_a_stop_that_does_not_slow_the_robot_cuts_the_torque",)),
    Hazard("A command jerks, tips or races", "limits and rates hold at the wheels",
           "limiter.shape", ("test_limiter.py::test_no_input_makes_a_wheel_exceed_its_limits",
           "test_limiter.py::test_no_wheel_changes_faster_than_allowed")),
    Hazard("A lying encoder becomes a command when somebody takes the robot over",
           "what is sent grows out of what was sent, never out of a reading", "limiter.shape",
           ("test_step_laws.py::test_no_reading_becomes_a_speed_when_somebody_takes_over",
            f"{_MOTION}::TestRunaway::test_a_hand_that_takes_over_does_not_hide_one")),
    Hazard("A drive that cannot stop by itself is armed",
           "the self test proves its own time-out first", "selftest.run",
           ("test_story.py::test_the_self_test_withholds_commands_and_nothing_else_does",)),
    Hazard("Brakes wear, or the robot brakes worse than robot.toml says",
           "each stop teaches; what is worse counts at once", "learnt.watch",
           ("test_learnt.py::test_weak_brakes_are_learnt_from_the_first_stop",
            "test_learnt.py::test_nothing_makes_it_better_than_configured_or_worse_than_believable",
            "test_gates_learnt.py::test_what_was_learnt_keeps_the_margin")),
    Hazard("A planner widens the fence, or puts in another than was read",
           "a fence changes only disarmed, by a proof of its text", "fenceop.hear_fence",
           ("test_fenceop.py::test_without_a_fitting_proof_nothing_is_looked_at",
            "test_fenceop.py::test_in_any_other_mode_it_is_refused_loosening_or_not")),
    Hazard("A planner stopped again and again drives further than granted",
           "the way of its stops is metered, too", "grants.meter",
           ("test_grants.py::test_the_way_of_a_stop_is_metered_too",
            "test_grants.py::test_new_missions_for_ever_drive_no_further_than_the_operator_cap")),
    Hazard("Some input makes the bridge itself fail", "the step is total and never raises",
           "step.step", ("test_step_laws.py::test_no_sequence_of_inputs_breaks_a_law",)),
)  # fmt: skip
"""What no row watches because it cannot happen: laws of the code."""
