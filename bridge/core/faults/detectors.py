"""Detect faults: one function a row or a few, read as one table.

A detector takes the tick and a list, to which it adds each stage whose trouble it sees, with the
evidence. It keeps its own windows in ``watch`` and changes nothing else: what follows of it is for
the latch, the mode and, where a grant ends, :mod:`bridge.core.modes.mode_logic`. Those of motion
stand in :mod:`bridge.core.faults.detect_motion`.
"""

from __future__ import annotations

from math import inf
from typing import TYPE_CHECKING

from bridge.core.authority.message_limits import FULL_S
from bridge.core.faults import detect_motion
from bridge.core.geometry.stopping import reaction_s, speed_before
from bridge.core.sensing.sensor_update import (
    GAP_S,
    GAPS,
    JUMPS,
    JUMPS_WITHIN_S,
    LATE_S,
    LATES,
    pose_trouble,
)
from bridge.core.sensing.stop_inputs import pressed_input
from bridge.core.tick_context import LONGEST_S, POWERED, fill, sensor_age_s
from wire import Mode

if TYPE_CHECKING:
    from bridge.core.faults.fault_latch import Dirty
    from bridge.core.tick_context import TickContext


BRAIN_LATE_S = 0.15
BRAIN_LOST_S = 0.3
BRAIN_GONE_S = 5.0
BRAIN_STALE_S = 1.0
EXTERNAL_S = 0.25
BAD_TRIPS = 5.0
HAND_SHOWN_S = 1.0

LIDAR_OLD_S = 0.25
LIDAR_LONG_S = 5.0
EQUAL_SCANS = 5
EQUAL_MOVED_M = 0.02
BLIND_SHARE = 0.05
BLIND_S = 0.3
BLIND_LONG_S = 5.0

ENC_LONG_S = 0.25
NACK_LONG_S = 0.5
PEAK_S = 0.1
HEAT_S = 2.0
"""So long a motor bears its peak current, as heat, before it must rest."""
DEAD_MAN_S = 0.7
"""The longest that robot.toml may ask of a drive, 0.5 s, and what a report and the motors' lag add
where it is measured by the wheels."""
CHARGE_LOW = 0.20
CHARGE_EMPTY = 0.10
CHARGE_UP = 0.05
CHARGE_S = 2.0
_CHARGE_ROWS = frozenset({"BATTERY.0", "BATTERY.1"})

# A host that stalls for 30 ms must not disarm anyone: cap, then hold, disarm on persistence.
LATES_WITHIN_S = 1.0
MISSED = 2
GAPS_WITHIN_S = 10.0


def brain(tick: TickContext, dirty: Dirty) -> None:
    """Judge the owner by the newest status it has shown to have seen."""
    s = tick.s
    echo_s = s.ownership.echo_s
    if echo_s is None:
        return
    age_s = tick.now_s - echo_s
    if not age_s <= BRAIN_LATE_S:
        if age_s > BRAIN_LOST_S:
            dirty.append(("BRAIN_LOST.0", f"silent for {age_s:.2f} s"))
            moved = s.grants.since_arm and s.mode in POWERED and s.source != "T"
            if age_s > BRAIN_GONE_S and moved:
                dirty.append(("BRAIN_GONE.0", f"silent for {age_s:.1f} s"))
        else:
            dirty.append(("BRAIN_LATE.0", f"echo {1000 * age_s:.0f} ms old"))
    used_s = s.ownership.used_s
    if s.ownership.owner is None or used_s is None:
        return
    if not tick.now_s - used_s <= BRAIN_STALE_S:
        dirty.append(("BRAIN_STALE.0", f"uses a status {tick.now_s - used_s:.2f} s old"))


def commands(tick: TickContext, dirty: Dirty) -> None:
    """Judge the source being followed, the owner's manners, and the budgets left to drive."""
    s = tick.s
    horizon = s.leg.horizon
    if horizon is not None and horizon.points and not s.leg.reached:
        age_s = tick.now_s - s.leg.sent_s
        if not age_s <= horizon.ttl_s:
            dirty.append(("CMD_STALE.0", f"horizon {age_s:.2f} s old, ttl {horizon.ttl_s} s"))
    if s.external is not None:
        age_s = tick.now_s - s.external.sent_s
        if not age_s <= EXTERNAL_S:
            dirty.append(("CMD_STALE.1", f"velocity {age_s:.2f} s old"))
    if not s.bad_bucket < BAD_TRIPS:
        dirty.append(("CMD_BAD.0", f"{s.bad_bucket:.0f} bad messages"))
    if s.grants.mission is not None:
        what = s.grants.spent_part()
        if what is not None:
            dirty.append(("BUDGET.0", f"{what} are spent"))


def hand(tick: TickContext, dirty: Dirty) -> None:
    """Judge the budget left to a hand on the stick, while it drives or asks to."""
    s = tick.s
    pressed_s = s.stick.pressed_s
    asks = pressed_s is not None and tick.now_s - pressed_s <= HAND_SHOWN_S
    if s.mode is Mode.TELEOP or (s.mode in POWERED and asks):
        what = s.grants.spent_hand_part()
        if what is not None:
            dirty.append(("HAND_BUDGET.0", f"{what} are spent"))


def flood(tick: TickContext, dirty: Dirty) -> None:
    """Call it a flood once it has lasted for four windows."""
    counted = tick.s.flood
    if not counted.level_s < FULL_S:
        dirty.append(("CMD_FLOOD.0", f"more than allowed on {counted.key}"))


def lidar(tick: TickContext, dirty: Dirty) -> None:
    """Judge the newest scan's age, and whether scans still change while the robot moves."""
    s = tick.s
    scan, received_s = s.lidar.newest, s.lidar.received_s
    if scan is None or received_s is None:
        return  # SELFTEST waits for the first one, and nothing is armed before
    same_host = tick.inbox.sensors_same_host
    age_s = sensor_age_s(tick.now_s, received_s, scan.stamp_s, same_host=same_host)
    evidence = None
    if not age_s <= LIDAR_OLD_S:
        evidence = f"scan {age_s:.2f} s old"
    elif s.lidar.equal >= EQUAL_SCANS:
        moved_m = s.odometry.travelled_m - s.lidar.equal_from_m
        if moved_m >= EQUAL_MOVED_M:
            evidence = f"{s.lidar.equal} equal scans over {moved_m:.2f} m"
    if evidence is not None:
        dirty.append(("LIDAR_STALE.0", evidence))
        up = s.rows.get("LIDAR_STALE.0")
        if up is not None and tick.now_s - up.since_s >= LIDAR_LONG_S:
            dirty.append(("LIDAR_STALE.1", evidence))


def pose(tick: TickContext, dirty: Dirty) -> None:
    """Judge localization."""
    if tick.robot_in_map is None:
        evidence = pose_trouble(tick) or "no pose"
        dirty.append(("POSE_LOST.0", evidence))
        dirty.append(("POSE_LOST.1", evidence))
    jumped = tick.s.pose.jumped_s == tick.now_s
    if jumped:
        dirty.append(("POSE_JUMP.0", "localization displaced the robot"))
    at_s = tick.s.pose.drift.jumps_at_s
    if jumped and len(at_s) == JUMPS and tick.now_s - at_s[0] <= JUMPS_WITHIN_S:
        dirty.append(("POSE_JUMP.1", f"{JUMPS} times within {JUMPS_WITHIN_S:.0f} s"))


def drive(tick: TickContext, dirty: Dirty) -> None:
    """Judge whether the drive reports, and whether it hears."""
    memory, robot_drive = tick.s.drive, tick.config.robot.drive
    newest, received_s = memory.newest, memory.received_s
    if newest is None or received_s is None:
        return  # SELFTEST waits for the first one
    same_host = tick.inbox.sensors_same_host
    age_s = sensor_age_s(tick.now_s, received_s, newest.stamp_s, same_host=same_host)
    if not age_s <= robot_drive.encoder_window_s:
        dirty.append(("ENC_STALE.0", f"state {1000 * age_s:.0f} ms old"))
        if age_s > ENC_LONG_S:
            dirty.append(("ENC_STALE.1", f"state {1000 * age_s:.0f} ms old"))
    behind_s = memory.behind * tick.config.period_s
    if behind_s > robot_drive.answer_window_s:
        dirty.append(("DRIVER_NACK.0", f"{memory.behind} commands behind"))
        if behind_s > NACK_LONG_S:
            dirty.append(("DRIVER_NACK.1", f"{memory.behind} commands behind"))
    if memory.ahead > 0:
        evidence = f"it echoes a command {memory.ahead} ahead of the newest sent"
        dirty.append(("DRIVE_FOREIGN.0", evidence))
    elif memory.echoes_other:
        dirty.append(("DRIVE_FOREIGN.0", f"it echoes a command of {memory.echoes_other}"))
    if memory.reborn_s == tick.now_s:
        dirty.append(("DRIVE_REBOOT.0", f"now {newest.boot_id}"))


def buttons(tick: TickContext, dirty: Dirty) -> None:
    """Judge the protective-stop inputs."""
    evidence = pressed_input(tick)
    if evidence is None and tick.s.buttons.ordered:
        evidence = "asked for by message"
    if evidence is not None:
        dirty.append(("ESTOP.0", evidence))


def blind(tick: TickContext, dirty: Dirty) -> None:
    """Judge how many beams come back, beside the normal number here; none is never normal."""
    lidar, watch = tick.s.lidar, tick.s.watch
    if lidar.picture is None:
        return
    normal = lidar.baseline_returns
    sees = lidar.picture.returns >= max(1.0, BLIND_SHARE * normal)
    if sees and watch.blind_s == 0.0:
        return
    watch.blind_s = fill(watch.blind_s, tick.dt_s, BLIND_LONG_S, dirty=not sees)
    if watch.blind_s >= BLIND_S and not sees:
        evidence = f"{lidar.picture.returns} of {lidar.picture.beams} beams, normally {normal:.0f}"
        dirty.append(("LIDAR_BLIND.0", evidence))
        if watch.blind_s >= BLIND_LONG_S:
            dirty.append(("LIDAR_BLIND.1", evidence))


def no_range(tick: TickContext, dirty: Dirty) -> None:
    """Judge whether anything watches for obstacles: a lidar that has spoken, and still does."""
    if tick.s.mode in {Mode.BOOT, Mode.SELFTEST}:
        return  # which wait for the first scan
    if tick.s.lidar.newest is None or "LIDAR_STALE.1" in tick.s.rows:
        for stage in ("NO_RANGE.0", "NO_RANGE.1"):
            dirty.append((stage, "the lidar says nothing"))


ZONE_POSE_S = 0.1
"""Localization's period: by so much the pose may be late, as at the fence's gate."""


def zone(tick: TickContext, dirty: Dirty) -> None:
    """Find the slowest zone that the robot is in, or must slow down for; ``cap`` takes its value.

    Before a zone the robot may be no faster than lets it be slow enough at the outline, wherever it
    is headed: a zone that it passes beside costs it the speed of that last half metre.
    """
    fence, here, watch = tick.fence, tick.robot_in_map, tick.s.watch
    watch.zone_mps = None
    if fence is None or not fence.zones or here is None:
        return
    robot, learnt = tick.config.robot, tick.s.learnt
    limits, lag_s = robot.limits, robot.drive.late_s + learnt.lag_more_s
    reaction = reaction_s(0.0, ZONE_POSE_S, lag_s, limits)
    decel = limits.max_decel_mps2 * learnt.decel_share
    allowed = [
        speed_before(gap_m, mps, decel, reaction)
        for gap_m, mps in fence.zones_near(here.x_m, here.y_m)
    ]
    slowest = min(allowed, default=inf)
    if slowest < limits.max_speed_mps:
        watch.zone_mps = slowest
        dirty.append(("SPEED_ZONE.0", f"at most {slowest:.2f} m/s here"))


def loop(tick: TickContext, dirty: Dirty) -> None:
    """Judge this tick's lateness."""
    facts, s = tick.inbox.loop, tick.s
    late_at_s, gaps_at_s = s.loop.late_at_s, s.loop.gaps_at_s
    many = len(late_at_s) == LATES and tick.now_s - late_at_s[0] <= LATES_WITHIN_S
    if facts.late_s > LATE_S and many:
        dirty.append(("LOOP_LATE.0", f"{LATES} late ticks within {LATES_WITHIN_S} s"))
    elif facts.missed_ticks >= MISSED:
        dirty.append(("LOOP_LATE.0", f"{facts.missed_ticks} ticks missed"))
    if s.tick > 1 and not tick.dt_s <= GAP_S:
        dirty.append(("LOOP_LATE.1", f"a gap of {1000 * tick.dt_s:.0f} ms"))
        if len(gaps_at_s) == GAPS and tick.now_s - gaps_at_s[0] <= GAPS_WITHIN_S:
            dirty.append(("LOOP_LATE.2", f"{GAPS} gaps within {GAPS_WITHIN_S} s"))


def rights(tick: TickContext, dirty: Dirty) -> None:
    """Judge whether the system granted real time. On a virtual drive it is only shown."""
    if not (tick.s.loop.real_time or tick.config.robot.drive.virtual):
        dirty.append(("NOT_RT.0", "scheduling or memory rights refused"))


def dead_man(tick: TickContext, dirty: Dirty) -> None:
    """Judge what is known of a dead-man that the self test can't prove."""
    config, drive = tick.config, tick.config.robot.drive
    if drive.reports_dead_man:
        return
    if config.dead_man_s is None:
        dirty.append(("DEAD_MAN.0", f"not tried; its firmware claims {drive.dead_man_s:g} s"))
    longest_s = drive.dead_man_s if config.dead_man_s is None else config.dead_man_s
    if not longest_s <= DEAD_MAN_S:
        dirty.append(("DEAD_MAN.1", f"it stops after {longest_s:.2f} s"))


def current(tick: TickContext, dirty: Dirty) -> None:
    """Judge the motors' current: its peak, and the heat that I^2 t leaves (IEC 60034-11)."""
    state, watch, drive = tick.s.drive.newest, tick.s.watch, tick.config.robot.drive
    if state is None or state.current_a is None:
        return
    drawn, peak = abs(state.current_a), drive.peak_current_a
    watch.peak_s = fill(watch.peak_s, tick.dt_s, PEAK_S, dirty=not drawn <= peak)
    bearable = drive.continuous_current_a * drive.continuous_current_a
    full = HEAT_S * (peak * peak - bearable)
    heat = watch.heat_a2s + (drawn * drawn - bearable) * min(tick.dt_s, LONGEST_S)
    watch.heat_a2s = min(max(heat, 0.0), full)
    if watch.peak_s >= PEAK_S:
        dirty.append(("OVERCURRENT.0", f"{drawn:.1f} A, at most {peak:.1f}"))
    elif full > 0.0 and watch.heat_a2s >= full:
        dirty.append(("OVERCURRENT.0", f"{drawn:.1f} A for too long"))


def battery(tick: TickContext, dirty: Dirty) -> None:
    """Judge the charge; a row that is up stays until the charge is well above its limit again."""
    state, watch, rows = tick.s.drive.newest, tick.s.watch, tick.s.rows
    if state is None:
        return
    if state.battery is None:  # no news is no charge: what is up stays as it was
        dirty.extend((name, up.evidence) for name, up in rows.items() if name in _CHARGE_ROWS)
        return
    charge, dt_s = state.battery, tick.dt_s
    if charge >= CHARGE_LOW + CHARGE_UP and watch.low_s == watch.empty_s == 0.0:
        return
    watch.low_s = fill(watch.low_s, dt_s, CHARGE_S, dirty=not charge >= CHARGE_LOW)
    watch.empty_s = fill(watch.empty_s, dt_s, CHARGE_S, dirty=not charge >= CHARGE_EMPTY)
    if watch.low_s >= CHARGE_S or ("BATTERY.0" in rows and not charge >= CHARGE_LOW + CHARGE_UP):
        dirty.append(("BATTERY.0", f"{100 * charge:.0f} %"))
    if watch.empty_s >= CHARGE_S or (
        "BATTERY.1" in rows and not charge >= CHARGE_EMPTY + CHARGE_UP
    ):
        dirty.append(("BATTERY.1", f"{100 * charge:.0f} %"))


DETECTORS = (
    brain,
    commands,
    hand,
    flood,
    lidar,
    blind,
    no_range,
    pose,
    zone,
    drive,
    detect_motion.sector,
    detect_motion.runaway,
    detect_motion.progress,
    detect_motion.yaw,
    current,
    battery,
    buttons,
    dead_man,
    loop,
    rights,
)
"""In the order of the table of rows. A new row adds one here."""
