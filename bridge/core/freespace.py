"""Say how far the robot may go along the arc of a motion.

Owns the geometry of a disc swept along an arc among one scan's points. Scaling a motion keeps its
curve, so one pass over the points serves every speed. Knows no time, no limits and no speeds.
"""

from __future__ import annotations

from math import acos, asin, atan2, cos, hypot, inf, pi, sin, sqrt, tau
from typing import TYPE_CHECKING, ClassVar

from pydantic import ConfigDict

from bridge.core.braking import TURNING_MPS, reaction_s, speed_scale
from bridge.core.odometry import along_arc, arc_end
from wire.geometry import Pose2, between, wrap
from wire.value import value

if TYPE_CHECKING:
    from bridge.core.scanpicture import Points, ScanPicture
    from wire.geometry import Twist2

__all__ = ["FreeLength", "free_length", "reaction_s", "speed_scale"]

MARGIN_M = 0.05
REACH_M = 2.0
"""Nobody looks further: at the fastest and weakest that robot.toml may say, caps hold before."""
MOVED_M = 1.0
"""A scan taken further away says nothing of here; LIDAR_STALE holds the robot long before."""
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
    if not (
        abs(twist.v_mps) < inf
        and abs(twist.w_radps) < inf
        and hypot(robot.x_m, robot.y_m) <= MOVED_M
    ):
        return NOTHING_KNOWN
    if abs(twist.v_mps) < TURNING_MPS:
        return FreeLength(reach_m, True, True, _touches(picture, robot, disc))
    curve = twist.w_radps / abs(twist.v_mps)
    heading = robot.yaw_rad if twist.v_mps > 0.0 else robot.yaw_rad + pi
    start = Pose2(robot.x_m, robot.y_m, heading)
    known, covered = _seen(picture, start, curve, disc, reach_m)
    if not covered:
        return FreeLength(0.0, known, False, False)
    touching = _touches(picture, robot, disc)
    if touching:
        clearance = _clearance(picture.points, robot.x_m, robot.y_m)
        if _loses_clearance(picture.points, start, curve, clearance, radius_m):
            return FreeLength(0.0, known, True, False)
        disc = max(_BEAD_M, clearance - _BEAD_M)  # what is clear now may stay so
    if abs(curve) <= _STRAIGHT_PER_M:
        s = _straight(_ahead(picture, start, disc), start, disc, reach_m)
    elif abs(curve) * reach_m < pi / 2:
        s = _arc(_ahead(picture, start, disc), start, curve, disc, reach_m)
    else:
        s = _arc(picture.points, start, curve, disc, reach_m)
    return FreeLength(s, known, True, touching)


def _seen(
    picture: ScanPicture, start: Pose2, curve: float, disc: float, reach: float
) -> tuple[bool, bool]:
    """Tell whether the sector that the arc sweeps came back, and whether the lidar covers it.

    The sector spans the directions, seen from the lidar, in which the disc lies half way and at the
    end of the look ahead, which ends after a quarter turn.
    """
    if picture.whole and picture.returns == picture.beams > 0:
        return True, True
    look = min(reach, (pi / 2) / abs(curve)) if curve != 0.0 else reach
    low, high = inf, -inf
    for part in (look / 2, look):
        x, y = arc_end(start, part, curve * part)
        dx, dy = x - picture.lidar_x_m, y - picture.lidar_y_m
        away = hypot(dx, dy)
        toward = wrap(atan2(dy, dx) - start.yaw_rad) if away > disc / 10 else 0.0
        half = asin(disc / away) if away > disc else pi / 2
        low, high = min(low, toward - half), max(high, toward + half)
    sector = picture.sector(start.yaw_rad + (low + high) / 2, (high - low) / 2)
    return sector.known, sector.covered


def _ahead(picture: ScanPicture, start: Pose2, disc: float) -> Points:
    """Return the points that may lie ahead of the robot, none left out.

    A point at least a disc away that is ahead of the robot lies, for the lidar, within a quarter
    turn and what the offset between lidar and robot adds.
    """
    offset = hypot(start.x_m - picture.lidar_x_m, start.y_m - picture.lidar_y_m)
    if not offset < disc:
        return picture.points
    half = pi / 2 + asin(offset / disc) + picture.step_rad
    return picture.points_within(start.yaw_rad, half)


def _between(points: Points, start: Pose2, right: float, left: float) -> list[tuple[float, float]]:
    """Return the points in a lane along the heading, from ``right`` to ``left`` of it [m].

    This runs over every beam in every tick; of 185 points ahead in a home, 5 to 25 are left for the
    geometry that costs.
    """
    c, s = cos(start.yaw_rad), sin(start.yaw_rad)
    off = start.y_m * c - start.x_m * s
    low, high = off + right, off + left
    xs, ys = points
    return [(x, y) for x, y in zip(xs, ys, strict=True) if low < y * c - x * s < high]


def _straight(points: Points, start: Pose2, disc: float, reach: float) -> float:
    """Return how far a disc goes straight on until it touches a point; none is inside it now."""
    c, s = cos(start.yaw_rad), sin(start.yaw_rad)
    off = start.y_m * c - start.x_m * s
    free, begin = reach, start.x_m * c + start.y_m * s
    for x, y in _between(points, start, -disc, disc):
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
    rx, ry = side * rho * sin(start.yaw_rad), -side * rho * cos(start.yaw_rad)  # from the centre
    inner = (rho - disc) * (rho - disc) if rho > disc else 0.0
    outer = (rho + disc) * (rho + disc)
    disc2, rho2 = disc * disc, rho * rho
    free, far2 = reach, (reach + disc) * (reach + disc)
    for x, y in _between(points, start, *_lane(rho, side, disc, reach)):
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


def _touches(picture: ScanPicture, robot: Pose2, disc: float) -> bool:
    """Tell whether a point lies within the disc with its margin."""
    moved = hypot(robot.x_m, robot.y_m)
    if picture.nearest_m is None or picture.nearest_m > disc + moved:
        return False
    return _clearance(picture.points, robot.x_m, robot.y_m) < disc


def _clearance(points: Points, x: float, y: float) -> float:
    """Return the distance of the nearest point [m]; infinite if there is none."""
    return sqrt(
        min(
            [(px - x) * (px - x) + (py - y) * (py - y) for px, py in zip(*points, strict=True)],
            default=inf,
        )
    )


def _loses_clearance(points: Points, start: Pose2, curve: float, now: float, radius: float) -> bool:
    """Tell whether going on brings the nearest point nearer; at contact, by whatever little."""
    lost = _CLEARANCE_LOST_M if now > radius + 0.01 else 0.0
    return not all(
        _clearance(points, place.x_m, place.y_m) >= now - lost
        for place in (along_arc(start, step, curve * step) for step in _STEPS_M)
    )
