"""Detect sensors that are silent, frozen or lost, and a drive that does not listen."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

from bridge.core.geometry.message_age import sensor_age_s
from bridge.core.sensing.sensor_update import JUMPS, JUMPS_WITHIN_S, pose_trouble
from bridge.core.sensing.stop_inputs import pressed

if TYPE_CHECKING:
    from bridge.core.faults.fault_latch import Dirty
    from bridge.core.tick_context import Tick

LIDAR_OLD_S = 0.25
LIDAR_LONG_S = 5.0
EQUAL_SCANS = 5
EQUAL_MOVED_M = 0.02
ENC_S, ENC_LONG_S = 0.08, 0.25
NACK_S, NACK_LONG_S = 0.1, 0.5


def lidar(tick: Tick, dirty: Dirty) -> None:
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


def pose(tick: Tick, dirty: Dirty) -> None:
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


def drive(tick: Tick, dirty: Dirty) -> None:
    """Judge whether the drive reports, and whether it hears."""
    memory = tick.s.drive
    newest, received_s = memory.newest, memory.received_s
    if newest is None or received_s is None:
        return  # SELFTEST waits for the first one
    same_host = tick.inbox.sensors_same_host
    age_s = sensor_age_s(tick.now_s, received_s, newest.stamp_s, same_host=same_host)
    if not age_s <= ENC_S:
        dirty.append(("ENC_STALE.0", f"state {1000 * age_s:.0f} ms old"))
        if age_s > ENC_LONG_S:
            dirty.append(("ENC_STALE.1", f"state {1000 * age_s:.0f} ms old"))
    behind_s = memory.behind * tick.config.period_s
    if behind_s > NACK_S:
        dirty.append(("DRIVER_NACK.0", f"{memory.behind} commands behind"))
        if behind_s > NACK_LONG_S:
            dirty.append(("DRIVER_NACK.1", f"{memory.behind} commands behind"))
    if memory.ahead > 0:
        evidence = f"it echoes a command {memory.ahead} ahead of the newest sent"
        dirty.append(("DRIVE_FOREIGN.0", evidence))
    if memory.reborn_s == tick.now_s:
        dirty.append(("DRIVE_REBOOT.0", f"now {newest.boot_id}"))


def buttons(tick: Tick, dirty: Dirty) -> None:
    """Judge the protective-stop inputs."""
    evidence = pressed(tick)
    if evidence is not None:
        tick.s.buttons = replace(tick.s.buttons, pressed_s=tick.now_s)
    elif tick.s.buttons.ordered:
        evidence = "asked for by message"
    if evidence is not None:
        dirty.append(("ESTOP.0", evidence))
