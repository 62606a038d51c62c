"""Say how far the robot may go along the arc of a motion.

Owns the geometry of a disc swept along an arc among one scan's points. Scaling a motion keeps its
curve, so one pass over the points serves every speed. Knows no time, no limits and no speeds.
"""

from __future__ import annotations

from math import acos, asin, atan2, cos, hypot, inf, pi, sin, sqrt, tau
from typing import TYPE_CHECKING, ClassVar

from pydantic import ConfigDict

from bridge.core.geometry.kinematics import along_arc, arc_end
from bridge.core.motion.braking import TURNING_MPS
from bridge.core.sensing.sensor_update import MARGIN_M, REACH_M
from wire.geometry import Pose2, between, wrap
from wire.value import value

if TYPE_CHECKING:
    from bridge.core.geometry.lidar_scan import Points, ScanPicture
    from wire.geometry import Twist2

SECTOR_M = 2.0
"""How far the sector reaches in which beams must have come back, however far one looks."""
MOVED_M = 1.0
"""A scan taken further away says nothing of here; LIDAR_STALE holds the robot long before."""
_TIGHTEST_PER_M = 1e9
"""No wheels drive it; a circle of no radius would divide by zero."""
_STRAIGHT_PER_M = 1e-3  # 2 mm beside a straight line after 2 m
_ROUNDING_RAD = 1e-6
_STEPS_M = (0.02, 0.05)  # where clearance is looked at again
_BEAD_M = 1e-3
_CLEARANCE_LOST_M = 2e-4  # a wall is seen as beads 6 mm apart: driving along it changes this much


@value
class FreeLength:
    """Tell how far a motion is free."""

    s_m: float
    """Along the arc until the disc with its margin touches; at most the reach."""
    known: bool
    """At least half of the beams of the sector swept came back; otherwise cap the speed."""
    covered: bool
    """The lidar sees that way; otherwise ``s_m`` is 0."""
    touching: bool
    """Something is inside the margin already, and this motion loses no clearance to it."""
    __pydantic_config__: ClassVar[ConfigDict] = ConfigDict(extra="forbid", allow_inf_nan=False)


NOTHING_KNOWN = FreeLength(0.0, False, False, False)


def free_length(
    picture: ScanPicture,
    base_in_odom_now: Pose2,
    twist: Twist2,
    radius_m: float,
    reach_m: float = REACH_M,
) -> FreeLength:
    """Return how far the arc of a motion is free of the scan's points.

    Args:
        picture: the newest scan.
        base_in_odom_now: where odometry says the robot is, in the scan's ``odom``.
        twist: its direction and curve count, not its size. Turning in place sweeps nothing but
            the disc itself, so it is always free.
        radius_m: the disc that holds the robot; the margin is added here.
        reach_m: how far to look.
    """
    robot = between(picture.base_in_odom, base_in_odom_now)
    disc = radius_m + MARGIN_M
    moved = hypot(robot.x_m, robot.y_m)
    v, w = twist.v_mps, twist.w_radps
    if not (abs(v) < inf and abs(w) < inf and moved <= MOVED_M):
        return NOTHING_KNOWN
    if abs(v) < TURNING_MPS:
        points = picture.points(disc + moved + _BEAD_M)
        return FreeLength(reach_m, True, True, _touches(picture, points, robot, moved, disc))
    curve = w / abs(v)
    if not abs(curve) <= _TIGHTEST_PER_M:
        return NOTHING_KNOWN
    start = robot if v > 0.0 else Pose2(robot.x_m, robot.y_m, robot.yaw_rad + pi)
    known, covered = _sector_state(picture, start, curve, disc, moved)
    if not covered:
        return FreeLength(0.0, known, False, False)
    # No place on the arc is further from its start than the path, or than the circle is wide.
    away = reach_m if abs(curve) * reach_m <= 2.0 else max(2.0 / abs(curve), _STEPS_M[-1])
    points = picture.points(away + disc + moved + _BEAD_M)
    touching = _touches(picture, points, robot, moved, disc)
    if touching:
        clearance = _clearance(points, robot.x_m, robot.y_m)
        if _loses_clearance(points, start, curve, clearance, radius_m):
            return FreeLength(0.0, known, True, False)
        disc = max(_BEAD_M, clearance - _BEAD_M)  # what is clear now may stay so
    if abs(curve) <= _STRAIGHT_PER_M:
        s = _straight(points, start, disc, reach_m)
    else:
        s = _arc(points, start, curve, disc, reach_m)
    return FreeLength(s, known, True, touching)


def _sector_state(
    picture: ScanPicture, start: Pose2, curve: float, disc: float, moved: float
) -> tuple[bool, bool]:
    """Tell whether the sector that the arc sweeps came back, and whether the lidar covers it.

    The sector spans the directions, seen from the lidar, in which the disc lies half way and at the
    end of the look ahead, which ends after a quarter turn.
    """
    if picture.whole and _few_missing(picture, disc, moved):
        return True, True
    look = min(SECTOR_M, (pi / 2) / abs(curve)) if curve != 0.0 else SECTOR_M
    low, high = inf, -inf
    for part in (look / 2, look):
        x, y = arc_end(start, part, curve * part)
        dx, dy = x - picture.lidar_x_m, y - picture.lidar_y_m
        away = hypot(dx, dy)
        toward = wrap(atan2(dy, dx) - start.yaw_rad) if away > disc / 10 else 0.0
        half = asin(disc / away) if away > disc else pi / 2
        low, high = min(low, toward - half), max(high, toward + half)
    sector = picture.sector(start.yaw_rad + (low + high) / 2, (high - low) / 2)
    return sector.is_known, sector.covered


def _few_missing(picture: ScanPicture, disc: float, moved: float) -> bool:
    """Tell whether so few beams are missing that no sector could lack half of its own.

    Half way, the disc is at most so far from the lidar; what it fills there is part of any sector.
    Nearly always so, and ten times cheaper than counting.
    """
    missing = picture.beams - picture.returns
    if missing == 0:
        return picture.beams > 0
    away = SECTOR_M / 2 + moved + hypot(picture.lidar_x_m, picture.lidar_y_m)
    return 2 * missing <= 2 * asin(min(1.0, disc / away)) / picture.step_rad - 3


def _straight(points: Points, start: Pose2, disc: float, reach: float) -> float:
    """Return how far a disc goes straight on until it touches a point; none is inside it now.

    These loops run over every point in every tick. Only what lies in the lane along the heading
    comes to the geometry that costs: of 100 points near a robot in a home, 5 to 25.
    """
    c, s = cos(start.yaw_rad), sin(start.yaw_rad)
    off = start.y_m * c - start.x_m * s
    free, begin = reach, start.x_m * c + start.y_m * s
    low, high = off - disc, off + disc
    for x, y in zip(*points, strict=True):
        if low < y * c - x * s < high:
            ahead = x * c + y * s - begin
            if 0.0 < ahead < free + disc:
                aside = y * c - x * s - off
                free = min(free, ahead - sqrt(max(0.0, disc * disc - aside * aside)))
    return max(0.0, free)


def _arc(points: Points, start: Pose2, curve: float, disc: float, reach: float) -> float:
    """Return how far along a circle a disc goes until it touches a point; none is inside it now.

    About the circle's centre, a point at distance D and angle a ahead of the robot is touched when
    the robot is acos((D^2 + rho^2 - disc^2) / 2 D rho) short of it (law of cosines). A point is
    never touched before the path is as long as its distance less the disc.
    """
    rho, side = 1.0 / abs(curve), 1.0 if curve > 0.0 else -1.0
    x0, y0 = start.x_m, start.y_m
    c, s = cos(start.yaw_rad), sin(start.yaw_rad)
    off = y0 * c - x0 * s
    right, left = _lane(rho, side, disc, reach)
    low, high = off + right, off + left
    rx, ry = side * rho * s, -side * rho * c  # from the centre
    inner = (rho - disc) * (rho - disc) if rho > disc else 0.0
    outer = (rho + disc) * (rho + disc)
    disc2, rho2 = disc * disc, rho * rho
    free, far2 = reach, (reach + disc) * (reach + disc)
    for x, y in zip(*points, strict=True):
        if low < y * c - x * s < high:
            px, py = x - x0, y - y0
            dx, dy = px + rx, py + ry
            square = dx * dx + dy * dy
            if inner < square < outer and px * px + py * py < far2:
                short = (square + rho2 - disc2) / (2 * sqrt(square) * rho)
                ahead = side * atan2(rx * dy - ry * dx, rx * dx + ry * dy)
                turn = (ahead - acos(min(1.0, max(-1.0, short)))) % tau
                if turn > tau - _ROUNDING_RAD:
                    turn = 0.0  # at contact now: a rounding below zero is no way round the circle
                if turn * rho < free:
                    free = turn * rho
                    far2 = (free + disc) * (free + disc)
    return free


def _lane(rho: float, side: float, disc: float, reach: float) -> tuple[float, float]:
    """Return the right and the left end of all that a disc sweeps along an arc [m].

    The centre leaves its first heading by rho (1 - cos(s / rho)), which grows until half a turn;
    what the disc touches lies within a disc of the centre. A little more, for what is rounded.
    """
    bow = rho * (1.0 - cos(min(pi, reach / rho)))
    wide = disc + _BEAD_M
    return (-wide, bow + wide) if side > 0.0 else (-bow - wide, wide)


def _touches(picture: ScanPicture, points: Points, robot: Pose2, moved: float, disc: float) -> bool:
    """Tell whether a point lies within the disc with its margin."""
    if picture.nearest_m is None or picture.nearest_m > disc + moved:
        return False
    return _clearance(points, robot.x_m, robot.y_m) < disc


def _clearance(points: Points, x: float, y: float) -> float:
    """Return the distance of the nearest point [m]; infinite if there is none."""
    return sqrt(
        min(
            [(px - x) * (px - x) + (py - y) * (py - y) for px, py in zip(*points, strict=True)],
            default=inf,
        )
    )


def _loses_clearance(points: Points, start: Pose2, curve: float, now: float, radius: float) -> bool:
    """Return whether going on brings the nearest point nearer; at contact, by any amount."""
    lost = _CLEARANCE_LOST_M if now > radius + 0.01 else 0.0
    return not all(
        _clearance(points, place.x_m, place.y_m) >= now - lost
        for place in (along_arc(start, step, curve * step) for step in _STEPS_M)
    )
