"""Read one bridge status for its meaning to a mission. Pure questions, no memory."""

from __future__ import annotations

from math import cos, hypot, sin

from planner.plan import PauseReason, fault
from wire import SEVERITY, Action, Mode, RowReport, Status, wrap

STANDING_MPS = 0.02
STANDING_RADPS = 0.05
"""The bridge's own meaning of standing."""
GATES = frozenset({"OBSTACLE", "FENCE", "CONTACT"})
SILENT_SECTOR = "LIDAR_SECTOR"
"""Holds a way straight on into what returns nothing, and no turn on the spot."""
MAX_STEP_M = 0.5
"""Odometry moves no farther between two statuses that follow each other."""


def standing(status: Status) -> bool:
    """Tell whether the robot stands, as measured."""
    still = abs(status.measured.v_mps) < STANDING_MPS
    return still and abs(status.measured.w_radps) < STANDING_RADPS


def at_rest(status: Status) -> bool:
    """Tell whether nothing drives the robot and it stands: time for work that may pause us."""
    return status.mode not in (Mode.ACTIVE, Mode.TELEOP, Mode.STOPPING) and standing(status)


def cannot_move(status: Status | None) -> str | None:
    """Return the pause reason of a mode in which nothing can be granted, or None."""
    if status is None or status.mode in (Mode.BOOT, Mode.SELFTEST, Mode.DISARMED):
        return PauseReason.DISARMED.value
    if status.mode is Mode.ESTOPPED:
        return PauseReason.ESTOP.value
    if status.mode is Mode.FAULT:
        worst = worst_row(status)
        return fault(worst.row) if worst is not None else fault("FAULT")
    if status.mode is Mode.TELEOP:
        return PauseReason.TELEOP.value
    return None


def holding_rows(status: Status) -> tuple[RowReport, ...]:
    """Return the rows that keep the robot standing now."""
    floor = SEVERITY[Action.HOLD2]
    return tuple(r for r in status.rows if r.binding and SEVERITY[r.action] >= floor)


def worst_row(status: Status) -> RowReport | None:
    """Return the row that acts hardest, the longest-standing of several."""
    return max(status.rows, key=lambda r: (SEVERITY[r.action], r.for_s), default=None)


def shows(status: Status, row: str) -> bool:
    """Tell whether a row is up and acts."""
    return any(r.row == row and r.action is not Action.CAP for r in status.rows if r.binding)


def refused_grant(status: Status, mission_id: str) -> str | None:
    """Return the code with which a grant for this mission was refused, or None."""
    for answer in status.answers:
        if answer.kind == "grant" and answer.id == mission_id and not answer.accepted:
            return answer.code
    return None


def amount_done(before: Status | None, now: Status, *, turning: bool) -> float:
    """Return the odometry's turn [rad], or way along the heading [m], in between."""
    if before is None or before.boot != now.boot or now.seq <= before.seq:
        return 0.0
    a, b = before.base_in_odom, now.base_in_odom
    if turning:
        return wrap(b.yaw_rad - a.yaw_rad)
    dx, dy = b.x_m - a.x_m, b.y_m - a.y_m
    ahead_m = dx * cos(a.yaw_rad) + dy * sin(a.yaw_rad)
    return ahead_m if abs(ahead_m) <= MAX_STEP_M else 0.0


def driven_m(before: Status | None, now: Status) -> float:
    """Return the odometry's way between two statuses of one boot [m]."""
    if before is None or before.boot != now.boot or now.seq <= before.seq:
        return 0.0
    a, b = before.base_in_odom, now.base_in_odom
    metres = hypot(b.x_m - a.x_m, b.y_m - a.y_m)
    return metres if metres <= MAX_STEP_M else 0.0
